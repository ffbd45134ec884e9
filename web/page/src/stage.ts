//! The canvas: what of the mechanism it shows, and when it is painted.

import { type Box, boxOf, Camera, MARKS, type Margin, type Vec } from "./camera.ts";
import { byId } from "./dom.ts";
import { GhostLayer } from "./draw/ghost_layer.ts";
import { drawOverlay, type Overlay } from "./draw/overlay.ts";
import { Painter } from "./draw/painter.ts";
import { TraceLayer } from "./draw/trace_layer.ts";
import type { Client } from "./engine/client.ts";
import type { Frame, Shape } from "./engine/protocol.ts";
import { Signal } from "./signal.ts";
import type { Theme } from "./theme.ts";

/** While the scale changes the picture is stretched; after so long, ms, it is asked for anew. */
const SETTLED = 90;

/** A picture younger than this, ms, need not be replaced before the display shows it. */
const YOUNG = 6;

/** What a frame to come will show is painted without it if none has come after so long, ms. */
const PATIENT = 30;

export class Stage {
  camera = new Camera();
  /** What is drawn over the mechanism. */
  overlay: Overlay = {};
  /** A frame has been painted. */
  readonly painted = new Signal<Frame>();
  /** The display is about to show what there is. */
  readonly beat = new Signal<number>();
  /** The display has what there is. */
  readonly shown = new Signal();

  private readonly context: CanvasRenderingContext2D;
  private painter: Painter | undefined;
  /** What the next frame is painted with: the one before is seen until that comes. */
  private next: Painter | undefined;
  private readonly reshaped: (readonly [number, readonly Shape[]])[] = [];
  private readonly traces = new TraceLayer();
  private readonly ghosts = new GhostLayer();
  private isStale = true;
  /** When the picture is to be painted anew, at the latest. */
  private due = Infinity;
  private isFitted = false;
  private lastPainted = 0;
  private settling = 0;
  private red: ReadonlySet<number> = new Set();

  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly client: Client,
    private readonly theme: Theme,
  ) {
    const context = canvas.getContext("2d", { alpha: false });
    if (context === null) throw new Error("this browser has no canvas");
    this.context = context;
    new ResizeObserver(() => this.resize()).observe(canvas);
    client.greeted.listen(() => {
      this.isFitted = false;
    });
    client.drawn.listen(() => this.takeDrawing());
    client.reshaped.listen((figures) => this.reshaped.push(...figures));
    client.standing.listen(() => this.clear());
    client.moved.listen(() => this.takeFrame());
    client.traced.listen(() => this.refresh());
    client.missed.listen((off) => {
      this.red = new Set(off.map(({ constraint }) => constraint));
      this.refresh();
    });
    theme.changed.listen(() => {
      this.takeDrawing();
      this.takeFrame();
    });
    const show = (now: number): void => {
      this.beat.tell(now);
      if (this.isStale || now >= this.due) this.paint();
      this.shown.tell();
      requestAnimationFrame(show);
    };
    requestAnimationFrame(show);
    this.resize();
  }

  /** Something of the picture has changed. */
  refresh(): void {
    this.isStale = true;
  }

  /** Something has changed that the engine answers with a frame: both are painted at once. */
  refreshWithFrame(): void {
    this.due = Math.min(this.due, performance.now() + PATIENT);
  }

  /** Shows all that there is. */
  fit(): void {
    const box = this.box();
    this.look(box === undefined ? this.camera : this.camera.fitted(box, this.margin()));
  }

  /** What is drawn by hand stays where the hand is: the view is not fitted to it. */
  stay(): void {
    if (this.isFitted) return;
    this.isFitted = true;
    this.client.view(this.camera.scale);
  }

  /** Shows the plane through another camera. */
  look(camera: Camera): void {
    const isSameScale = camera.scale === this.camera.scale;
    this.camera = camera;
    this.refresh();
    if (isSameScale) return;
    clearTimeout(this.settling);
    this.settling = setTimeout(() => this.client.view(this.camera.scale), SETTLED);
  }

  /** Makes a place of the canvas known to those who look for it: px from its corner. */
  placeOf(event: { clientX: number; clientY: number }): Vec {
    const { left, top } = this.canvas.getBoundingClientRect();
    return { x: event.clientX - left, y: event.clientY - top };
  }

  private box(): Box | undefined {
    const { drawing, traces } = this.client;
    const corners: Vec[] = [];
    if (drawing?.bounds) {
      const [x0, y0, x1, y1] = drawing.bounds;
      corners.push({ x: x0, y: y0 }, { x: x1, y: y1 });
    }
    for (const { figures } of drawing?.ghosts ?? []) {
      const [scale, [cx, cy]] = [drawing?.scale ?? 1, drawing?.centre ?? [0, 0]];
      for (const { place } of figures) {
        if (place !== undefined)
          corners.push({ x: cx + place[0] / scale, y: cy - place[1] / scale });
      }
    }
    for (const { at } of traces.list) {
      for (let k = 0; k + 1 < at.length; k += 2) corners.push({ x: at[k] ?? 0, y: at[k + 1] ?? 0 });
    }
    return boxOf(corners);
  }

  /** What the tools lie over is left free. */
  private margin(): Margin {
    const rect = (id: string): DOMRect => byId(id).getBoundingClientRect();
    const [all, tools, transport] = [rect("canvas"), rect("tools"), rect("transport")];
    const isRow = tools.width > tools.height;
    return {
      left: isRow ? MARKS : tools.right - all.left + MARKS,
      right: all.right - rect("zoom").left + MARKS,
      top: isRow ? tools.bottom - all.top + MARKS : MARKS,
      bottom: all.bottom - transport.top + MARKS,
    };
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    const density = window.devicePixelRatio || 1;
    const [width, height] = [Math.max(clientWidth, 1), Math.max(clientHeight, 1)];
    this.canvas.width = Math.round(width * density);
    this.canvas.height = Math.round(height * density);
    this.camera = this.camera.resized(width, height, density);
    // Painted at once: a canvas that changes its size is empty.
    this.paint();
  }

  private takeDrawing(): void {
    const { drawing } = this.client;
    if (drawing === undefined) return;
    this.next = new Painter(drawing, this.client.classes, this.theme.alarm, this.theme.isDark);
    this.reshaped.length = 0;
  }

  /** The first picture that has something on it is shown whole. */
  private fitOnce(): void {
    if (this.isFitted || !this.client.drawing?.bounds) return;
    this.isFitted = true;
    this.fit();
    this.client.view(this.camera.scale);
  }

  private clear(): void {
    this.painter = undefined;
    this.next = undefined;
    this.refresh();
  }

  /** A frame while something is held is painted at once; others when the display asks. */
  private takeFrame(): void {
    this.painter = this.next ?? this.painter;
    this.next = undefined;
    for (const [idx, shapes] of this.reshaped.splice(0)) this.painter?.reshape(idx, shapes);
    this.fitOnce();
    this.refresh();
    const isHeld = this.overlay.held !== undefined;
    if (isHeld && performance.now() - this.lastPainted > YOUNG) this.paint();
  }

  private paint(): void {
    const { context, camera, client, painter } = this;
    const { frame } = client;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.globalAlpha = 1;
    context.fillStyle = this.theme.paper;
    context.fillRect(0, 0, this.canvas.width, this.canvas.height);
    this.isStale = false;
    this.due = Infinity;
    this.lastPainted = performance.now();
    if (painter !== undefined && frame !== undefined) {
      context.lineCap = "round";
      context.lineJoin = "round";
      this.lay(this.ghosts.draw(painter, camera));
      painter.paintBelow(context, camera, frame, this.red);
      const mark = client.drawing?.mark ?? 1;
      this.lay(this.traces.draw(client.traces, camera, mark, this.theme.isDark));
      painter.paintAbove(context, camera, frame, this.red);
      context.setTransform(camera.density, 0, 0, camera.density, 0, 0);
      context.globalAlpha = 1;
      drawOverlay(context, camera, client, this.overlay, this.theme);
      client.seen(frame.seq);
      this.painted.tell(frame);
      this.report(frame);
    }
  }

  /** Puts a layer on the canvas. */
  private lay(layer: HTMLCanvasElement | undefined): void {
    if (layer === undefined) return;
    this.context.setTransform(1, 0, 0, 1, 0, 0);
    this.context.globalAlpha = 1;
    this.context.drawImage(layer, 0, 0);
  }

  /** Tells who measures the page what the canvas shows now. */
  private report({ seq, time, at }: Frame): void {
    const { scale, centre, width, height } = this.camera;
    const detail = { seq, time, at, scale, centre, width, height };
    this.canvas.dispatchEvent(new CustomEvent("linkwork-painted", { detail }));
  }
}
