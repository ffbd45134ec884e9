//! What is drawn over the mechanism: what the hand is at, what does not hold, the scale.

import type { Camera, Vec } from "../camera.ts";
import type { Client } from "../engine/client.ts";
import type { Off } from "../engine/protocol.ts";
import { placeOf } from "../scene.ts";
import type { Theme } from "../theme.ts";

/** What the hand is at. */
export interface Overlay {
  /** The point under the mouse. */
  readonly near?: number | undefined;
  /** The point that keys act on, or whose menu is open. */
  readonly chosen?: number | undefined;
  /** The point that is held, and where it is asked to be, in the plane. */
  readonly held?: { readonly point: number; readonly to: Vec } | undefined;
  /** Lines and places that a tool is about to make, in the plane. */
  readonly planned?:
    | { readonly line?: readonly [Vec, Vec]; readonly places: readonly Vec[] }
    | undefined;
}

/** The errors of so many constraints are written; the panel lists the others. */
const MOST_LABELS = 6;

type Context = CanvasRenderingContext2D;

export function drawOverlay(
  context: Context,
  camera: Camera,
  client: Client,
  overlay: Overlay,
  theme: Theme,
): void {
  context.setLineDash([]);
  const labels: Vec[] = [];
  for (const off of client.off.slice(0, MOST_LABELS)) {
    const at = labelPlace(camera, client, off, labels);
    if (at === undefined) continue;
    labels.push(at);
    drawError(context, off, at, theme);
  }
  const ring = (handle: number | undefined, radius: number, width: number): void => {
    const place = handle === undefined ? undefined : placeOf(client, handle);
    if (place === undefined) return;
    const at = camera.toCanvas(place);
    context.strokeStyle = theme.accent;
    context.lineWidth = width;
    context.beginPath();
    context.arc(at.x, at.y, radius, 0, 2 * Math.PI);
    context.stroke();
  };
  ring(overlay.near, 9, 1.5);
  ring(overlay.chosen, 9, 2.5);
  if (overlay.held !== undefined) drawHeld(context, camera, client, overlay.held, theme);
  if (overlay.planned !== undefined) drawPlanned(context, camera, overlay.planned, theme);
  drawScale(context, camera, theme);
}

/** From a point that cannot follow to where it is asked to be. */
function drawHeld(
  context: Context,
  camera: Camera,
  client: Client,
  held: NonNullable<Overlay["held"]>,
  theme: Theme,
): void {
  const place = placeOf(client, held.point);
  if (place === undefined) return;
  const [from, to] = [camera.toCanvas(place), camera.toCanvas(held.to)];
  context.strokeStyle = theme.accent;
  context.lineWidth = 2.5;
  context.beginPath();
  context.arc(from.x, from.y, 10, 0, 2 * Math.PI);
  context.stroke();
  if (Math.hypot(from.x - to.x, from.y - to.y) < 3) return;
  context.lineWidth = 1.5;
  context.setLineDash([5, 4]);
  context.beginPath();
  context.moveTo(from.x, from.y);
  context.lineTo(to.x, to.y);
  context.stroke();
  context.setLineDash([]);
}

function drawPlanned(
  context: Context,
  camera: Camera,
  planned: NonNullable<Overlay["planned"]>,
  theme: Theme,
): void {
  context.strokeStyle = theme.accent;
  context.fillStyle = theme.paper;
  context.lineWidth = 2;
  if (planned.line !== undefined) {
    const [a, b] = planned.line.map((place) => camera.toCanvas(place));
    if (a !== undefined && b !== undefined) {
      context.setLineDash([6, 4]);
      context.beginPath();
      context.moveTo(a.x, a.y);
      context.lineTo(b.x, b.y);
      context.stroke();
      context.setLineDash([]);
    }
  }
  for (const place of planned.places) {
    const at = camera.toCanvas(place);
    context.beginPath();
    context.arc(at.x, at.y, 4.5, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
  }
}

/** Where the error of a constraint is written: beside it, and not on another. */
function labelPlace(
  camera: Camera,
  client: Client,
  off: Off,
  others: readonly Vec[],
): Vec | undefined {
  const constraint = client.state?.constraints.find(({ handle }) => handle === off.constraint);
  const places = (constraint?.points ?? []).map((handle) => placeOf(client, handle));
  const known = places.filter((place) => place !== undefined).slice(0, 2);
  if (known.length === 0) return undefined;
  const sum = known.reduce((a, b) => ({ x: a.x + b.x, y: a.y + b.y }), { x: 0, y: 0 });
  const middle = camera.toCanvas({ x: sum.x / known.length, y: sum.y / known.length });
  let at = { x: middle.x + 10, y: middle.y - 26 };
  const isTaken = (): boolean =>
    others.some((other) => Math.abs(other.y - at.y) < 22 && Math.abs(other.x - at.x) < 190);
  while (isTaken()) at = { x: at.x, y: at.y + 22 };
  return at;
}

/** By how much a constraint is off. */
function drawError(context: Context, off: Off, { x, y }: Vec, theme: Theme): void {
  const text = `${off.name}: off by ${off.shown}`;
  context.font = '12px system-ui, "DejaVu Sans", sans-serif';
  context.textAlign = "left";
  const width = context.measureText(text).width + 12;
  context.fillStyle = theme.alarm.edge;
  context.beginPath();
  context.roundRect(x, y, width, 20, 5);
  context.fill();
  context.fillStyle = theme.isDark ? "#12171c" : "#ffffff";
  context.fillText(text, x + 6, y + 14);
}

/** A bar of a round length, lower left. */
function drawScale(context: Context, camera: Camera, theme: Theme): void {
  const goal = 110 / camera.scale;
  const power = 10 ** Math.floor(Math.log10(goal));
  const length = power * ([5, 2].find((factor) => factor * power <= goal) ?? 1);
  const px = length * camera.scale;
  const [x, y] = [18, camera.height - (camera.width < 640 ? 72 : 20)];
  context.strokeStyle = theme.soft;
  context.fillStyle = theme.soft;
  context.lineWidth = 1.2;
  context.beginPath();
  context.moveTo(x, y - 4);
  context.lineTo(x, y);
  context.lineTo(x + px, y);
  context.lineTo(x + px, y - 4);
  context.moveTo(x + px / 2, y - 3);
  context.lineTo(x + px / 2, y);
  context.stroke();
  context.font = '12px Helvetica, Arial, "Liberation Sans", "DejaVu Sans", sans-serif';
  context.textAlign = "left";
  context.fillText(String(Number(length.toPrecision(3))), x + px + 7, y + 4);
}
