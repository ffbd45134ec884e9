//! Questions about the mechanism that is shown: what is near, what hangs on what, what names are free.

import { along, type Camera, distance, distanceToSegment, type Vec } from "./camera.ts";
import type { Client } from "./engine/client.ts";
import type { ConstraintState, Drawing, Figure, PointState, State } from "./engine/protocol.ts";

/** A straight part between two points. */
export interface Bar {
  readonly constraint: ConstraintState;
  readonly a: number;
  readonly b: number;
}

/** A place on a bar. */
export interface OnBar {
  readonly bar: Bar;
  readonly share: number;
}

/** Which of a constraint's points a bar lies between. */
const BAR_ENDS: ReadonlyMap<string, readonly [number, number]> = new Map([
  ["length", [0, 1]],
  ["motor", [0, 1]],
  ["glider", [1, 2]],
  ["hinge", [1, 2]],
  ["rigid", [0, 1]],
]);

const drawnPoints = new WeakMap<Drawing, readonly PointState[]>();

/** The points of a drawing: their joints have their names, and what is frozen has ground under it. */
function pointsOf(drawing: Drawing): readonly PointState[] {
  let points = drawnPoints.get(drawing);
  if (points === undefined) {
    const isGround = ({ layer }: Figure): boolean => layer === "ground";
    const frozen = new Set(drawing.figures.filter(isGround).map(({ point }) => point));
    points = drawing.figures
      .filter(({ layer }) => layer === "joint")
      .map(({ point = -1, note = "" }) => ({
        handle: point,
        name: note,
        frozen: frozen.has(point),
      }));
    drawnPoints.set(drawing, points);
  }
  return points;
}

/** All points; where there are too many to be listed, those that are drawn. */
export function points({ state, drawing }: Client): readonly PointState[] {
  if (state === undefined) return [];
  return state.unlisted > 0 && drawing !== undefined ? pointsOf(drawing) : state.points;
}

export function pointOf(client: Client, handle: number): PointState | undefined {
  return points(client).find((point) => point.handle === handle);
}

/** Where a point is now; none if it is not. */
export function placeOf(client: Client, handle: number): Vec | undefined {
  const { frame } = client;
  const [x, y] = [frame?.at[2 * handle], frame?.at[2 * handle + 1]];
  return x === undefined || y === undefined ? undefined : { x, y };
}

/** Where all points are. */
export function* places(client: Client): Generator<readonly [PointState, Vec]> {
  for (const point of points(client)) {
    const place = placeOf(client, point.handle);
    if (place !== undefined) yield [point, place];
  }
}

/** The point nearest to a place of the canvas, no farther than `reach` px. */
export function pointAt(
  client: Client,
  camera: Camera,
  at: Vec,
  reach: number,
): PointState | undefined {
  let best: PointState | undefined;
  let least = reach;
  for (const [point, place] of places(client)) {
    const far = distance(camera.toCanvas(place), at);
    // Of points that lie on one another the last one made is on top.
    if (far <= least) [best, least] = [point, far];
  }
  return best;
}

/** The bars of a mechanism. */
export function bars(state: State | undefined): Bar[] {
  const found: Bar[] = [];
  for (const constraint of state?.constraints ?? []) {
    const ends = BAR_ENDS.get(constraint.kind);
    const a = ends && constraint.points[ends[0]];
    const b = ends && constraint.points[ends[1]];
    if (a !== undefined && b !== undefined) found.push({ constraint, a, b });
  }
  return found;
}

/** The bar nearest to a place of the canvas that is not one of `not`'s own. */
export function barAt(
  client: Client,
  camera: Camera,
  at: Vec,
  reach: number,
  not?: number,
): OnBar | undefined {
  let best: OnBar | undefined;
  let least = reach;
  for (const bar of bars(client.state)) {
    const [a, b] = [placeOf(client, bar.a), placeOf(client, bar.b)];
    if (a === undefined || b === undefined || bar.a === not || bar.b === not) continue;
    const [p, q] = [camera.toCanvas(a), camera.toCanvas(b)];
    const far = distanceToSegment(at, p, q);
    if (far <= least) [best, least] = [{ bar, share: along(at, p, q) }, far];
  }
  return best;
}

/** The next name for a point that nothing has. */
export function freeName(state: State | undefined, also: readonly string[] = []): string {
  const taken = new Set(also);
  for (const list of [state?.points, state?.constraints, state?.parameters]) {
    for (const { name } of list ?? []) taken.add(name);
  }
  for (let k = 0; k < 26; k++) {
    const name = String.fromCharCode(65 + k);
    if (!taken.has(name)) return name;
  }
  for (let k = 1; ; k++) if (!taken.has(`P${k}`)) return `P${k}`;
}

/** The constraints at a point. */
export function constraintsAt(state: State | undefined, handle: number): ConstraintState[] {
  return (state?.constraints ?? []).filter(({ points }) => points.includes(handle));
}
