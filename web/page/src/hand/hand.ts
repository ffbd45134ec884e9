//! Mouse, pen and fingers on the canvas: one of them uses the tool, two move the view.

import { distance, type Vec } from "../camera.ts";
import type { Page } from "../page.ts";
import { Signal } from "../signal.ts";
import type { Tool, Touch } from "./tool.ts";

/** How near is near, px: a finger covers more than a mouse's tip. */
const REACH = { mouse: 12, pen: 14, touch: 24 } as const;

/** A mouse may tell more than a thousand places a second; a point is led to one of them in so many ms. */
const APART = 7;

/** One notch of a wheel. */
const NOTCH = 1.0016;

export class Hand {
  readonly changed = new Signal<Tool>();
  private readonly pressed = new Map<number, Vec>();
  private isPanning = false;
  private isUsing = false;
  private lastEarly = 0;

  constructor(
    private readonly page: Page,
    public tool: Tool,
  ) {
    const { canvas } = page.stage;
    const on = (name: string, act: (event: PointerEvent) => void): void =>
      canvas.addEventListener(name, (event) => act(event as PointerEvent));
    on("pointerdown", (event) => this.down(event));
    on("pointermove", (event) => this.move(event));
    // Comes at once, where a browser has it: moves wait until the display is about to show something.
    on("pointerrawupdate", (event) => this.early(event));
    on("pointerup", (event) => this.up(event));
    on("pointercancel", (event) => this.up(event, true));
    on("pointerleave", () => this.leave());
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
  }

  take(tool: Tool): void {
    this.tool.cancel(this.page);
    this.tool = tool;
    this.page.hint(tool.help);
    this.changed.tell(tool);
  }

  cancel(): void {
    this.tool.cancel(this.page);
    this.isUsing = false;
  }

  private touch(event: PointerEvent): Touch {
    const { stage } = this.page;
    const at = stage.placeOf(event);
    const reach = REACH[event.pointerType as keyof typeof REACH] ?? REACH.mouse;
    return { at, place: stage.camera.toPlane(at), shift: event.shiftKey, reach };
  }

  private down(event: PointerEvent): void {
    const { canvas } = this.page.stage;
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    const touch = this.touch(event);
    this.pressed.set(event.pointerId, touch.at);
    if (this.pressed.size > 1) {
      // A second finger: both move the view.
      if (this.isUsing) this.tool.cancel(this.page);
      this.isUsing = false;
      this.isPanning = true;
      return;
    }
    this.isPanning = event.button !== 0 || this.tool.letsPan(this.page, touch);
    this.isUsing = event.button === 0;
    if (this.isUsing) this.tool.down(this.page, touch);
  }

  private move(event: PointerEvent): void {
    const touch = this.touch(event);
    const before = this.pressed.get(event.pointerId);
    if (before === undefined) {
      if (this.pressed.size === 0) this.tool.move(this.page, touch, false);
      return;
    }
    if (this.isPanning) this.pan(event.pointerId, before, touch.at);
    else if (this.isUsing) this.tool.move(this.page, touch, true);
    this.pressed.set(event.pointerId, touch.at);
  }

  /** What the engine has to answer it hears of early: the frame to come may then show it. */
  private early(event: PointerEvent): void {
    if (!this.isUsing || this.isPanning || !this.pressed.has(event.pointerId)) return;
    if (event.timeStamp - this.lastEarly < APART) return;
    this.lastEarly = event.timeStamp;
    this.tool.move(this.page, this.touch(event), true);
  }

  private up(event: PointerEvent, isCancelled = false): void {
    if (!this.pressed.delete(event.pointerId)) return;
    if (this.isUsing && isCancelled) this.tool.cancel(this.page);
    else if (this.isUsing) this.tool.up(this.page, this.touch(event));
    this.isUsing = false;
    if (this.pressed.size === 0) this.isPanning = false;
  }

  private leave(): void {
    if (this.pressed.size > 0) return;
    const { overlay } = this.page.stage;
    if (overlay.near === undefined) return;
    this.page.stage.overlay = { ...overlay, near: undefined };
    this.page.stage.refresh();
  }

  private pan(id: number, before: Vec, at: Vec): void {
    const { stage } = this.page;
    const other = [...this.pressed].find(([pointer]) => pointer !== id)?.[1];
    if (other === undefined) {
      stage.look(stage.camera.panned({ x: at.x - before.x, y: at.y - before.y }));
      return;
    }
    const factor = distance(at, other) / Math.max(distance(before, other), 1);
    const middle = { x: (at.x + other.x) / 2, y: (at.y + other.y) / 2 };
    const by = { x: (at.x - before.x) / 2, y: (at.y - before.y) / 2 };
    stage.look(stage.camera.panned(by).zoomed(factor, middle));
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const { stage } = this.page;
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
    if (event.shiftKey) {
      stage.look(stage.camera.panned({ x: -lines * (event.deltaX + event.deltaY), y: 0 }));
      return;
    }
    // Two fingers that spread on a pad come as a wheel with Ctrl, and finer.
    const notches = lines * event.deltaY * (event.ctrlKey ? 5 : 1);
    stage.look(stage.camera.zoomed(NOTCH ** -notches, stage.placeOf(event)));
  }
}
