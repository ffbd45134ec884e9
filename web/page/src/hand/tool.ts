//! What a press on the canvas does, as long as one tool is in hand.

import type { Vec } from "../camera.ts";
import type { Page } from "../page.ts";

/** A press, a move or a lift of a mouse, a pen or a finger. */
export interface Touch {
  /** px from the corner of the canvas. */
  readonly at: Vec;
  /** The same in the plane. */
  readonly place: Vec;
  readonly shift: boolean;
  /** How far from something one may be and still mean it, px. */
  readonly reach: number;
}

export interface Tool {
  readonly name: string;
  readonly key: string;
  /** Lines of its picture, and areas. */
  readonly icon: readonly [string, string?];
  readonly help: string;
  down(page: Page, touch: Touch): void;
  /** With or without a press. */
  move(page: Page, touch: Touch, isPressed: boolean): void;
  up(page: Page, touch: Touch): void;
  /** Gives up what is under way. */
  cancel(page: Page): void;
  /** Whether a drag that begins here moves the view instead. */
  letsPan(page: Page, touch: Touch): boolean;
}
