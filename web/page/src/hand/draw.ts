//! Tools that draw: what they make is written as statements.

import { distance, typed, typedPlace, type Vec } from "../camera.ts";
import type { Page } from "../page.ts";
import { barAt, freeName, type OnBar, placeOf, pointAt, pointOf } from "../scene.ts";
import type { Tool, Touch } from "./tool.ts";

/** An end of what is drawn: a point that there is, or a place for a new one. */
interface End {
  readonly handle?: number;
  readonly place: Vec;
}

function endAt(page: Page, touch: Touch): End {
  const point = pointAt(page.client, page.stage.camera, touch.at, touch.reach);
  const place = point && placeOf(page.client, point.handle);
  return point && place ? { handle: point.handle, place } : { place: touch.place };
}

function plan(page: Page, planned: Page["stage"]["overlay"]["planned"]): void {
  page.stage.overlay = { planned };
  page.stage.refresh();
}

/** Collects statements; names new points. */
class Writer {
  readonly statements: string[] = [];
  private readonly names: string[] = [];

  constructor(private readonly page: Page) {}

  /** The name of an end, which is made if it is not there. */
  name(end: End, isFrozen = false): string {
    const { state } = this.page.client;
    const there = end.handle === undefined ? undefined : pointOf(this.page.client, end.handle);
    if (there !== undefined) return there.name;
    const name = freeName(state, this.names);
    this.names.push(name);
    const place = typedPlace(end.place, this.page.stage.camera.scale);
    this.statements.push(`point ${name} = ${place}${isFrozen ? " frozen" : ""}`);
    return name;
  }

  write(): void {
    this.page.stage.stay();
    void this.page.do(this.statements.join("; "));
  }
}

export class DrawPoint implements Tool {
  readonly name = "Point";
  readonly key = "p";
  readonly icon = ["M10 6.5a3.5 3.5 0 1 0 0 7a3.5 3.5 0 1 0 0-7z"] as const;
  readonly help = "Click where a point is to be; with Shift it is frozen.";

  letsPan(): boolean {
    return false;
  }

  down(): void {}

  move(page: Page, touch: Touch): void {
    plan(page, { places: [touch.place] });
  }

  up(page: Page, touch: Touch): void {
    plan(page, undefined);
    const writer = new Writer(page);
    writer.name({ place: touch.place }, touch.shift);
    writer.write();
  }

  cancel(page: Page): void {
    plan(page, undefined);
  }
}

/** Draws what goes from one point to another: by a drag, or by two clicks. */
class DrawBetween implements Tool {
  private first: End | undefined;
  private pressedAt: Vec | undefined;

  constructor(
    readonly name: string,
    readonly key: string,
    readonly icon: readonly [string, string?],
    readonly help: string,
    private readonly write: (writer: Writer, from: End, to: End) => void,
  ) {}

  letsPan(): boolean {
    return false;
  }

  down(page: Page, touch: Touch): void {
    this.pressedAt = touch.at;
    this.first ??= endAt(page, touch);
  }

  move(page: Page, touch: Touch): void {
    const here = endAt(page, touch);
    if (this.first === undefined) plan(page, { places: [here.place] });
    else {
      const [a, b] = [this.first.place, here.place];
      plan(page, { line: [a, b], places: [a, b] });
    }
  }

  up(page: Page, touch: Touch): void {
    const { first, pressedAt } = this;
    if (first === undefined || pressedAt === undefined) return;
    const here = endAt(page, touch);
    const { camera } = page.stage;
    const isSame = here.handle !== undefined && here.handle === first.handle;
    const isClose = distance(camera.toCanvas(first.place), touch.at) < touch.reach;
    // The first of two clicks.
    if (isSame || isClose) return;
    this.cancel(page);
    const writer = new Writer(page);
    this.write(writer, first, here);
    writer.write();
  }

  cancel(page: Page): void {
    this.first = undefined;
    this.pressedAt = undefined;
    plan(page, undefined);
  }
}

/** Puts a point on a bar: a new one by a click, one that is there by a drag to the bar. */
class DrawOnBar implements Tool {
  private from: End | undefined;

  constructor(
    readonly name: string,
    readonly key: string,
    readonly icon: readonly [string, string?],
    readonly help: string,
    private readonly write: (writer: Writer, point: string, on: OnBar, ends: string) => void,
  ) {}

  letsPan(): boolean {
    return false;
  }

  down(page: Page, touch: Touch): void {
    const end = endAt(page, touch);
    this.from = end.handle === undefined ? undefined : end;
  }

  move(page: Page, touch: Touch): void {
    const there = this.target(page, touch);
    const place = there === undefined ? touch.place : this.placeOn(page, there);
    const places = [place];
    if (this.from === undefined) plan(page, { places });
    else plan(page, { line: [this.from.place, place], places });
  }

  up(page: Page, touch: Touch): void {
    const on = this.target(page, touch);
    const { from } = this;
    this.cancel(page);
    if (on === undefined) {
      page.hinted.tell({ text: "There is no bar here: draw a rod first.", isWrong: true });
      return;
    }
    const [a, b] = [pointOf(page.client, on.bar.a), pointOf(page.client, on.bar.b)];
    if (a === undefined || b === undefined) return;
    const writer = new Writer(page);
    const point = writer.name(from ?? { place: this.placeOn(page, on) });
    this.write(writer, point, on, `${a.name} ${b.name}`);
    writer.write();
  }

  cancel(page: Page): void {
    this.from = undefined;
    plan(page, undefined);
  }

  private target(page: Page, touch: Touch): OnBar | undefined {
    return barAt(page.client, page.stage.camera, touch.at, 1.5 * touch.reach, this.from?.handle);
  }

  private placeOn(page: Page, { bar, share }: OnBar): Vec {
    const [a, b] = [placeOf(page.client, bar.a), placeOf(page.client, bar.b)];
    if (a === undefined || b === undefined) return { x: 0, y: 0 };
    return { x: a.x + share * (b.x - a.x), y: a.y + share * (b.y - a.y) };
  }
}

/** All tools that draw. */
export function drawingTools(): Tool[] {
  return [
    new DrawPoint(),
    new DrawBetween(
      "Rod",
      "l",
      ["M4 14a2 2 0 1 0 .1 0zM16 3a2 2 0 1 0 .1 0zM5.5 14.6l9-8.2"],
      "Drag from one end of a rod to the other; where no point is, one is made.",
      (writer, from, to) =>
        writer.statements.push(`length ${writer.name(from)} ${writer.name(to)}`),
    ),
    new DrawBetween(
      "Motor",
      "m",
      [
        "M3.5 10a6.5 6.5 0 1 1 3 5.5M6.5 15.5l-.4-3.2M6.5 15.5l3.2-.3",
        "M10 7.5a2.5 2.5 0 1 0 .1 0z",
      ],
      "Drag from the centre of a motor to the point that it turns.",
      (writer, from, to) => {
        const [centre, rim] = [writer.name(from, true), writer.name(to)];
        writer.statements.push(`motor ${centre} ${rim} speed 1rev`);
      },
    ),
    new DrawOnBar(
      "Glider",
      "g",
      ["M2 13h16M6.5 7h7v6h-7z"],
      "Click a bar for a block that slides on it, or drag a point to the bar.",
      (writer, point, _on, ends) => writer.statements.push(`glider ${point} on ${ends}`),
    ),
    new DrawOnBar(
      "Hinge",
      "h",
      ["M2 13l16-6M10 8a2 2 0 1 0 .1 0z"],
      "Click a bar for a pin in it, or drag a point to the bar.",
      (writer, point, { share }, ends) =>
        writer.statements.push(`hinge ${point} on ${ends} at ${typed(share, 100)}`),
    ),
  ];
}
