//! Paints a drawing list on a canvas.

import type { Camera } from "../camera.ts";
import type { Drawing, Figure, Frame, Look, Shape } from "../engine/protocol.ts";
import { type Alarm, alarmed, type Brush, brush } from "./brush.ts";

/** How strongly something that is switched off is drawn. */
const OFF = 0.3;

/** Layers that lie below the paths. */
const BELOW_PATHS: ReadonlySet<string> = new Set(["construction", "plate", "rail", "wheel"]);

/** Names of points lean. */
const LETTERS = 'Helvetica, Arial, "Liberation Sans", "DejaVu Sans", sans-serif';

interface Stroke {
  readonly brush: Brush;
  readonly path: Path2D | undefined;
  readonly text: string;
  readonly at: readonly [number, number];
}

interface Item {
  readonly constraint: number | undefined;
  readonly opacity: number;
  readonly strokes: readonly Stroke[];
  /** The same as what does not hold; made when it is first needed. */
  red: readonly Stroke[] | undefined;
}

type Context = CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D;

/** A drawing list made ready for a canvas. */
export class Painter {
  private readonly items: Item[];
  readonly ghosts: readonly { readonly opacity: number; readonly figures: readonly Figure[] }[];
  private readonly brushes = new Map<string, Brush>();
  /** Bars of one length share their path. */
  private readonly paths = new Map<string, Path2D>();
  /** The first figure that lies above the paths. */
  private readonly nBelow: number;

  constructor(
    private readonly drawing: Drawing,
    private readonly classes: Readonly<Record<string, Look>>,
    private readonly alarm: Alarm,
    private readonly isDark: boolean,
  ) {
    this.items = drawing.figures.map((figure) => this.item(figure));
    const above = drawing.figures.findIndex((figure) => !BELOW_PATHS.has(figure.layer));
    this.nBelow = above < 0 ? drawing.figures.length : above;
    this.ghosts = drawing.ghosts ?? [];
  }

  /** Takes in that a figure has changed its form. */
  reshape(idx: number, shapes: readonly Shape[]): void {
    const item = this.items[idx];
    if (item === undefined) return;
    this.items[idx] = { ...item, strokes: this.strokes(shapes), red: undefined };
  }

  /** Paints what lies below the paths. */
  paintBelow(context: Context, camera: Camera, frame: Frame, red: ReadonlySet<number>): void {
    this.paint(context, camera, frame, red, 0, this.nBelow);
  }

  /** Paints what lies above the paths. */
  paintAbove(context: Context, camera: Camera, frame: Frame, red: ReadonlySet<number>): void {
    this.paint(context, camera, frame, red, this.nBelow, this.items.length);
  }

  /** Paints a pose of the past. */
  paintGhost(context: Context, camera: Camera, figures: readonly Figure[]): void {
    for (const figure of figures) {
      const [x, y, turn] = figure.place ?? [0, 0, 0];
      this.place(context, camera, x, y, turn);
      const opacity = figure.off === true ? OFF : 1;
      for (const stroke of this.strokes(figure.shapes)) this.stroke(context, stroke, opacity);
    }
  }

  private paint(
    context: Context,
    camera: Camera,
    frame: Frame,
    red: ReadonlySet<number>,
    from: number,
    to: number,
  ): void {
    const { place } = frame;
    for (let k = from; k < to; k++) {
      const item = this.items[k];
      if (item === undefined) continue;
      this.place(context, camera, place[3 * k] ?? 0, place[3 * k + 1] ?? 0, place[3 * k + 2] ?? 0);
      const isRed = item.constraint !== undefined && red.has(item.constraint);
      const strokes = isRed ? this.inRed(item) : item.strokes;
      for (const stroke of strokes) this.stroke(context, stroke, item.opacity);
    }
  }

  /** Puts the figure's own px on the canvas. */
  private place(context: Context, camera: Camera, x: number, y: number, turn: number): void {
    const { drawing } = this;
    const ratio = camera.scale / drawing.scale;
    const [cx, cy] = drawing.centre;
    const centre = camera.toCanvas({ x: cx, y: cy });
    const phi = (turn * Math.PI) / 180;
    const [c, s] = [ratio * Math.cos(phi), ratio * Math.sin(phi)];
    context.setTransform(
      camera.density * c,
      camera.density * s,
      -camera.density * s,
      camera.density * c,
      camera.density * (centre.x + ratio * x),
      camera.density * (centre.y + ratio * y),
    );
  }

  private stroke(context: Context, { brush, path, text, at }: Stroke, opacity: number): void {
    context.globalAlpha = brush.opacity * opacity;
    if (path === undefined) {
      this.letters(context, brush, text, at);
      return;
    }
    if (brush.fill !== undefined) {
      context.fillStyle = brush.fill;
      context.fill(path, brush.rule);
    }
    if (brush.stroke !== undefined) {
      context.strokeStyle = brush.stroke;
      context.lineWidth = brush.width;
      context.setLineDash(brush.dash as number[]);
      context.stroke(path);
    }
  }

  private letters(
    context: Context,
    brush: Brush,
    text: string,
    at: readonly [number, number],
  ): void {
    context.font = `italic ${brush.size}px ${LETTERS}`;
    context.textAlign = "center";
    if (brush.stroke !== undefined) {
      context.strokeStyle = brush.stroke;
      context.lineWidth = brush.width;
      context.setLineDash([]);
      context.strokeText(text, at[0], at[1]);
    }
    context.fillStyle = brush.fill ?? "";
    context.fillText(text, at[0], at[1]);
  }

  private item(figure: Figure): Item {
    return {
      constraint: figure.constraint,
      opacity: figure.off === true ? OFF : 1,
      strokes: this.strokes(figure.shapes),
      red: undefined,
    };
  }

  private inRed(item: Item): readonly Stroke[] {
    item.red ??= item.strokes.map((stroke, k) => ({
      ...stroke,
      brush: alarmed(stroke.brush, this.alarm, k > 0),
    }));
    return item.red;
  }

  private strokes(shapes: readonly Shape[]): readonly Stroke[] {
    return shapes.map((shape) => ({
      brush: this.brush(shape.class),
      path: shape.text === undefined ? this.path(shape) : undefined,
      text: shape.text ?? "",
      at: shape.at ?? [0, 0],
    }));
  }

  private path(shape: Shape): Path2D {
    if (shape.circle !== undefined) {
      const [x, y, radius] = shape.circle;
      const circle = new Path2D();
      circle.arc(x, y, Math.max(radius, 0), 0, 2 * Math.PI);
      return circle;
    }
    const d = shape.d ?? "";
    let path = this.paths.get(d);
    if (path === undefined) {
      path = new Path2D(d);
      this.paths.set(d, path);
    }
    return path;
  }

  private brush(name: string): Brush {
    let found = this.brushes.get(name);
    if (found === undefined) {
      const look = this.classes[name] ?? PLAIN;
      found = brush(look, this.drawing.mark, this.isDark);
      this.brushes.set(name, found);
    }
    return found;
  }
}

/** What a class looks like that the engine did not say. */
const PLAIN: Look = { fill: null, stroke: "#273542", width: 1, dash: [], opacity: 1 };
