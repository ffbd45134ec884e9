//! What the page and an engine tell one another; `docs/protocol.md` describes it for other clients.

/** The protocol that this page speaks. */
export const PROTOCOL = 1;

/** A message of a statement, for people. */
export interface Said {
  readonly kind: "line" | "note" | "warning" | "error";
  readonly text: string;
  readonly message?: string;
  /** Where in the text that was sent the mistake is, in UTF-16 units. */
  readonly from?: number;
  readonly to?: number;
  readonly helps?: readonly string[];
}

/** What became of a text. */
export interface Answer {
  readonly ok: boolean;
  readonly said?: readonly Said[];
  readonly wrote?: readonly string[];
  readonly quit?: boolean;
  /** The statement that a gesture became. */
  readonly statement?: string | null;
}

/** What may stand at a place of a text. */
export interface Completion {
  readonly start: number;
  readonly candidates: readonly { readonly text: string; readonly shown: string }[];
  readonly hint: string | null;
  readonly pieces: readonly Piece[];
  /** Whether the statement goes on in the next line. */
  readonly incomplete: boolean;
}

/** A stretch of a text that has a colour. */
export interface Piece {
  readonly from: number;
  readonly to: number;
  readonly class: string;
  readonly unknown?: boolean;
}

/** A file to be taken home. */
export interface FileAnswer {
  readonly ok: boolean;
  readonly name?: string;
  readonly mime?: string;
  readonly text?: string;
  readonly said?: readonly Said[];
}

export interface Example {
  readonly name: string;
  readonly about: string;
  readonly text: string;
}

export interface PointState {
  readonly handle: number;
  readonly name: string;
  readonly frozen: boolean;
}

export interface ConstraintState {
  readonly handle: number;
  readonly name: string;
  readonly kind: string;
  /** The statement that makes it. */
  readonly text: string;
  readonly on: boolean;
  readonly points: readonly number[];
}

export interface MotorState {
  readonly name: string;
  readonly on: boolean;
  readonly speed: number;
  /** The speed as typed. */
  readonly shown: string;
}

export interface ParameterState {
  readonly name: string;
  readonly text: string;
  readonly value: number | readonly number[] | null;
  /** Whether it depends on others. */
  readonly live: boolean;
  /** Whether others depend on it. */
  readonly used: boolean;
}

export interface SettingState {
  readonly name: string;
  readonly text: string;
  /** The words that it takes, if it takes words. */
  readonly words: readonly string[];
  /** What it is, in a sentence. */
  readonly what: string;
}

/** All that changes with statements and not with frames. */
export interface State {
  readonly time: number;
  readonly frame: number;
  readonly dt: number;
  readonly playing: boolean;
  readonly speed: number;
  readonly held: { readonly point: number; readonly client: number } | null;
  readonly points: readonly PointState[];
  readonly constraints: readonly ConstraintState[];
  readonly motors: readonly MotorState[];
  readonly parameters: readonly ParameterState[];
  readonly settings: readonly SettingState[];
  readonly freedoms: number | null;
  /** Whether all is as it should be, where that is known. */
  readonly sound: boolean | null;
  readonly verdict: string | null;
  readonly check: readonly string[] | null;
  readonly receipt: readonly string[] | null;
  /** How many points and constraints are not listed because there are too many. */
  readonly unlisted: number;
  /** The statements that `undo` and `redo` would take. */
  readonly undo: string | null;
  readonly redo: string | null;
  /** Handles of points with a path. */
  readonly traced: readonly number[];
}

/** A constraint that misses its tolerance. */
export interface Off {
  readonly constraint: number;
  readonly name: string;
  readonly residual: number;
  readonly shown: string;
}

/** How a class of shapes is drawn; px where marks have their full size. */
export interface Look {
  readonly fill: string | null;
  readonly stroke: string | null;
  readonly width: number;
  readonly dash: readonly number[];
  readonly opacity: number;
  /** Of letters. */
  readonly size?: number | null;
  readonly evenodd?: boolean;
}

/** One outline in one style. */
export interface Shape {
  readonly class: string;
  readonly d?: string;
  readonly circle?: readonly [number, number, number];
  readonly text?: string;
  readonly at?: readonly [number, number];
}

/** A group of shapes that moves as one. */
export interface Figure {
  readonly layer: string;
  readonly constraint?: number;
  readonly point?: number;
  readonly note?: string;
  readonly off?: boolean;
  /** The point that it lies on, and the one that it is turned to. */
  readonly on?: readonly [number, number?];
  /** Of a pose of the past. */
  readonly place?: readonly [number, number, number];
  readonly shapes: readonly Shape[];
}

/** The drawing list. */
export interface Drawing {
  readonly topology: number;
  /** px a unit of the plane. */
  readonly scale: number;
  readonly centre: readonly [number, number];
  /** How large marks and strokes are, at most 1. */
  readonly mark: number;
  readonly bounds: readonly [number, number, number, number] | null;
  /** How many handles there are. */
  readonly points: number;
  /** From the bottom up; one that changes its form is replaced. */
  readonly figures: Figure[];
  readonly ghosts?: readonly { readonly opacity: number; readonly figures: readonly Figure[] }[];
}

/** A piece of a path. */
export interface TraceUpdate {
  readonly trace: number;
  readonly point: number;
  readonly name: string;
  readonly class: string;
  readonly colour: string;
  /** How many samples stay before `at` is added. */
  readonly from: number;
  readonly at: readonly number[];
  readonly missed: readonly number[];
}

export interface Entry {
  readonly number: number;
  readonly text: string;
  readonly by: string;
}

export interface Hello {
  readonly protocol: number;
  readonly version: string;
  readonly engine: string;
  readonly client: number;
}

/** All that an engine may say; each message has some of these. */
export interface Message {
  readonly answer?: number;
  readonly hello?: Hello;
  /** How the classes of the next drawing are drawn. */
  readonly classes?: Readonly<Record<string, Look>>;
  readonly state?: Partial<State>;
  readonly off?: readonly Off[];
  readonly drawing?: Drawing;
  readonly shapes?: {
    readonly topology: number;
    readonly figures: readonly (readonly [number, readonly Shape[]])[];
  };
  readonly traces?: readonly TraceUpdate[];
  /** How many traces there are. */
  readonly n?: number;
  readonly journal?: readonly Entry[];
  readonly said?: readonly Said[];
  readonly refused?: string;
}

/** Where everything is. */
export interface Frame {
  readonly seq: number;
  readonly topology: number;
  readonly time: number;
  readonly residual: number;
  /** Positions by handle, x and y in turn, in the plane. */
  readonly at: Float64Array;
  /** Placements of figures: x, y, turn in turn. */
  readonly place: Float32Array;
}

const FRAME_HEAD = 24;
/** Bytes of a figure that is elsewhere than its points say. */
const NEWS = 16;

/** Reads a frame of a drawing; none if it is not one. `before` are placements of the frame before. */
export function readFrame(
  buffer: ArrayBuffer,
  drawing: Drawing,
  before: Float32Array | undefined,
): Frame | undefined {
  const begin = FRAME_HEAD + 16 * drawing.points;
  const rest = buffer.byteLength - begin;
  if (rest < 0 || rest % NEWS !== 0) return undefined;
  const view = new DataView(buffer);
  const at = new Float64Array(buffer, FRAME_HEAD, 2 * drawing.points);
  const place = new Float32Array(3 * drawing.figures.length);
  if (before !== undefined) place.set(before);
  layOnPoints(place, drawing, at);
  for (let from = begin; from < buffer.byteLength; from += NEWS) {
    const k = view.getUint32(from, true);
    if (k >= drawing.figures.length) return undefined;
    for (const n of [0, 1, 2]) place[3 * k + n] = view.getFloat32(from + 4 + 4 * n, true);
  }
  return {
    seq: Number(view.getBigUint64(0, true)),
    topology: view.getUint32(8, true),
    time: view.getFloat64(12, true),
    residual: view.getFloat32(20, true),
    at,
    place,
  };
}

/** Puts figures where the points are that they lie on. */
function layOnPoints(place: Float32Array, drawing: Drawing, at: Float64Array): void {
  const { scale } = drawing;
  const [cx, cy] = drawing.centre;
  for (const [k, { on }] of drawing.figures.entries()) {
    if (on === undefined) continue;
    const [a, b] = on;
    const x = ((at[2 * a] ?? 0) - cx) * scale;
    const y = (cy - (at[2 * a + 1] ?? 0)) * scale;
    place[3 * k] = x;
    place[3 * k + 1] = y;
    if (b === undefined) continue;
    const dx = ((at[2 * b] ?? 0) - cx) * scale - x;
    const dy = (cy - (at[2 * b + 1] ?? 0)) * scale - y;
    place[3 * k + 2] = (Math.atan2(dy, dx) * 180) / Math.PI;
  }
}

/** To which drawing a frame belongs. */
export function topologyOf(buffer: ArrayBuffer): number {
  return buffer.byteLength < FRAME_HEAD ? -1 : new DataView(buffer).getUint32(8, true);
}
