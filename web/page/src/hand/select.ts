//! The bare hand: drags points, chooses them, freezes and thaws them.

import { distance, typed, type Vec } from "../camera.ts";
import type { PointState } from "../engine/protocol.ts";
import type { Page } from "../page.ts";
import { pointAt, pointOf } from "../scene.ts";
import type { Tool, Touch } from "./tool.ts";

/** A press that moves no farther than this is a click, px. */
const STILL = 4;
/** Two clicks within this time are one double click, ms. */
const DOUBLE = 320;

/** What a frozen point's drag and a loose one's pull are asked for: no finer than a quarter px. */
export function rounded(place: Vec, scale: number): Vec {
  return { x: Number(typed(place.x, 4 * scale)), y: Number(typed(place.y, 4 * scale)) };
}

export class Select implements Tool {
  readonly name = "Move";
  readonly key = "v";
  readonly icon = ["M5 3l10 7-4.5 1L8 16z"] as const;
  readonly help =
    "Drag a point. Click it for what can be done with it, double click to freeze or thaw it.";

  private pressed: { readonly point: PointState; readonly at: Vec } | undefined;
  private isHeld = false;
  private clicked: { readonly handle: number; readonly timer: number } | undefined;

  /** `open` shows what can be done with a point, `close` hides it. */
  constructor(
    private readonly open: (handle: number) => void,
    private readonly close: () => void,
  ) {}

  letsPan(page: Page, touch: Touch): boolean {
    return this.near(page, touch) === undefined;
  }

  down(page: Page, touch: Touch): void {
    this.close();
    const point = this.near(page, touch);
    this.pressed = point && { point, at: touch.at };
  }

  move(page: Page, touch: Touch, isPressed: boolean): void {
    if (!isPressed) {
      const near = this.near(page, touch)?.handle;
      if (near !== page.stage.overlay.near) this.show(page, { near });
      return;
    }
    const { pressed } = this;
    if (pressed === undefined) return;
    if (!this.isHeld) {
      if (distance(touch.at, pressed.at) < STILL) return;
      this.isHeld = true;
      this.take(page, pressed.point);
    }
    const to = rounded(touch.place, page.stage.camera.scale);
    const last = page.stage.overlay.held?.to;
    if (last?.x === to.x && last.y === to.y) return;
    this.show(page, { held: { point: pressed.point.handle, to } });
    page.client.move(to.x, to.y);
  }

  up(page: Page, _touch: Touch): void {
    const { pressed } = this;
    this.pressed = undefined;
    if (pressed === undefined) {
      this.show(page, {});
    } else if (this.isHeld) {
      this.isHeld = false;
      this.show(page, {});
      void this.release(page);
    } else {
      this.click(page, pressed.point);
    }
  }

  cancel(page: Page): void {
    if (this.isHeld) page.client.cancel();
    this.isHeld = false;
    this.pressed = undefined;
    this.show(page, {});
    this.close();
  }

  private near(page: Page, touch: Touch): PointState | undefined {
    return pointAt(page.client, page.stage.camera, touch.at, touch.reach);
  }

  private show(page: Page, overlay: Page["stage"]["overlay"]): void {
    page.stage.overlay = overlay;
    page.stage.canvas.style.cursor = overlay.held
      ? "grabbing"
      : overlay.near === undefined
        ? ""
        : "grab";
    if (overlay.held === undefined) page.stage.refresh();
    else page.stage.refreshWithFrame();
  }

  private take(page: Page, point: PointState): void {
    page.client.grab(point.handle).then((answer) => {
      if (!answer.ok) page.report("", answer);
    });
  }

  private async release(page: Page): Promise<void> {
    const answer = await page.client.release();
    if (typeof answer.statement === "string") page.hint(answer.statement);
    if (answer.said?.length) page.answered.tell(answer.said);
  }

  /** The first click waits for a second. */
  private click(page: Page, point: PointState): void {
    const { clicked } = this;
    if (clicked !== undefined) clearTimeout(clicked.timer);
    if (clicked?.handle === point.handle) {
      this.clicked = undefined;
      turnSupport(page, point.handle);
      return;
    }
    const timer = setTimeout(() => {
      this.clicked = undefined;
      this.open(point.handle);
    }, DOUBLE);
    this.clicked = { handle: point.handle, timer };
  }
}

/** Freezes what is loose, thaws what is frozen. */
export function turnSupport(page: Page, handle: number): void {
  const point = pointOf(page.client, handle);
  if (point !== undefined) void page.do(`${point.frozen ? "thaw" : "freeze"} ${point.name}`);
}
