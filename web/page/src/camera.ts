//! What part of the plane the canvas shows, and where on it each place lies.

/** A place or a difference of places. */
export interface Vec {
  readonly x: number;
  readonly y: number;
}

/** A rectangle of the plane. */
export interface Box {
  readonly lo: Vec;
  readonly hi: Vec;
}

/** Free space around what is fitted, px. */
export interface Margin {
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}

/** What marks take, which have a size on the canvas and none in the plane. */
export const MARKS = 32;
const ALL_MARKS: Margin = { left: MARKS, right: MARKS, top: MARKS, bottom: MARKS };
/** The part of a canvas that is left free at most. */
const MOST_FREE = 0.55;

/** A map from the plane, y up, to the canvas, y down, the same scale on both axes. */
export class Camera {
  constructor(
    /** px per unit of the plane. */
    readonly scale = 100,
    /** What lies in the middle. */
    readonly centre: Vec = { x: 0, y: 0 },
    /** Size of the canvas, px. */
    readonly width = 800,
    readonly height = 600,
    /** Pixels of the display a px. */
    readonly density = 1,
  ) {}

  toCanvas(p: Vec): Vec {
    return {
      x: this.width / 2 + (p.x - this.centre.x) * this.scale,
      y: this.height / 2 - (p.y - this.centre.y) * this.scale,
    };
  }

  toPlane(p: Vec): Vec {
    return {
      x: this.centre.x + (p.x - this.width / 2) / this.scale,
      y: this.centre.y - (p.y - this.height / 2) / this.scale,
    };
  }

  resized(width: number, height: number, density: number): Camera {
    return new Camera(this.scale, this.centre, width, height, density);
  }

  private showing(scale: number, centre: Vec): Camera {
    return new Camera(scale, centre, this.width, this.height, this.density);
  }

  /** Moved by so many px. */
  panned(by: Vec): Camera {
    const { x, y } = this.centre;
    const centre = { x: x - by.x / this.scale, y: y + by.y / this.scale };
    return this.showing(this.scale, centre);
  }

  /** Larger by a factor, with the place under `fixed` (px) where it is. */
  zoomed(factor: number, fixed: Vec): Camera {
    const scale = this.scale * factor;
    if (!Number.isFinite(scale) || scale < 1e-300) return this;
    const under = this.toPlane(fixed);
    const centre = {
      x: under.x - (fixed.x - this.width / 2) / scale,
      y: under.y + (fixed.y - this.height / 2) / scale,
    };
    return this.showing(scale, centre);
  }

  /** Shows all of a box. */
  fitted(box: Box, margin = ALL_MARKS): Camera {
    const half = { x: (box.hi.x - box.lo.x) / 2, y: (box.hi.y - box.lo.y) / 2 };
    const centre = { x: box.lo.x + half.x, y: box.lo.y + half.y };
    // On a small canvas there is less to spare.
    const share = Math.min(
      1,
      (MOST_FREE * this.width) / (margin.left + margin.right),
      (MOST_FREE * this.height) / (margin.top + margin.bottom),
    );
    const [left, right, top, bottom] = [margin.left, margin.right, margin.top, margin.bottom].map(
      (free) => free * share,
    ) as [number, number, number, number];
    const room = { x: (this.width - left - right) / 2, y: (this.height - top - bottom) / 2 };
    const fitted = Math.min(room.x / half.x, room.y / half.y);
    // All in one place: any scale will do.
    const scale = Number.isFinite(fitted) && fitted > 0 ? fitted : 100;
    const aside = { x: (left - right) / 2 / scale, y: (bottom - top) / 2 / scale };
    return this.showing(scale, { x: centre.x - aside.x, y: centre.y - aside.y });
  }

  equals(other: Camera): boolean {
    return (
      this.scale === other.scale &&
      this.centre.x === other.centre.x &&
      this.centre.y === other.centre.y &&
      this.width === other.width &&
      this.height === other.height &&
      this.density === other.density
    );
  }
}

/** The smallest box that holds these places; none if there are none. */
export function boxOf(places: Iterable<Vec>): Box | undefined {
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const { x, y } of places) {
    if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
    x0 = Math.min(x0, x);
    y0 = Math.min(y0, y);
    x1 = Math.max(x1, x);
    y1 = Math.max(y1, y);
  }
  return x0 <= x1 ? { lo: { x: x0, y: y0 }, hi: { x: x1, y: y1 } } : undefined;
}

/** A number as one would type it, no finer than what a px at this scale can tell. */
export function typed(value: number, scale: number): string {
  const unit = 10 ** -Math.ceil(Math.log10(scale));
  const rounded = Number((Math.round(value / unit) * unit).toPrecision(12));
  return Number.isFinite(rounded) ? String(rounded === 0 ? 0 : rounded) : String(value);
}

/** A place as one would type it. */
export function typedPlace(p: Vec, scale: number): string {
  return `(${typed(p.x, scale)}, ${typed(p.y, scale)})`;
}

export function distance(a: Vec, b: Vec): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}

/** How far along a segment the place lies that is nearest to `p`, from 0 to 1. */
export function along(p: Vec, a: Vec, b: Vec): number {
  const d = { x: b.x - a.x, y: b.y - a.y };
  const square = d.x * d.x + d.y * d.y;
  if (square === 0) return 0;
  const share = ((p.x - a.x) * d.x + (p.y - a.y) * d.y) / square;
  return Math.min(1, Math.max(0, share));
}

/** From a place to the nearest of a segment. */
export function distanceToSegment(p: Vec, a: Vec, b: Vec): number {
  const share = along(p, a, b);
  return distance(p, { x: a.x + share * (b.x - a.x), y: a.y + share * (b.y - a.y) });
}
