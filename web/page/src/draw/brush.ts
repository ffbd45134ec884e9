//! How classes of shapes are drawn on this paper at this size.

import type { Look } from "../engine/protocol.ts";
import { onPaper } from "./dark.ts";

/** The least size of letters, px. */
const LEAST_LETTER = 12;
/** Below half a px a line is a shade of grey. */
const LEAST_WIDTH = 0.5;

/** What is set before a shape is drawn. */
export interface Brush {
  readonly fill: string | undefined;
  readonly stroke: string | undefined;
  readonly width: number;
  readonly dash: readonly number[];
  readonly opacity: number;
  /** Of letters, px. */
  readonly size: number;
  readonly rule: CanvasFillRule;
}

/** Colours of what does not hold: its edges, and what lies within. */
export interface Alarm {
  readonly edge: string;
  readonly inside: string;
}

export function brush(look: Look, mark: number, isDark: boolean): Brush {
  const colour = (name: string | null): string | undefined =>
    name === null || name === "none" ? undefined : onPaper(name, isDark);
  return {
    fill: colour(look.fill),
    stroke: colour(look.stroke),
    width: Math.max(look.width * mark, LEAST_WIDTH),
    dash: look.dash.map((length) => length * mark),
    opacity: look.opacity,
    size: Math.max((look.size ?? 0) * mark, LEAST_LETTER),
    rule: look.evenodd === true ? "evenodd" : "nonzero",
  };
}

/** The same for what does not hold; `isOver` says whether it lies over its own edge. */
export function alarmed(plain: Brush, alarm: Alarm, isOver: boolean): Brush {
  const colour = isOver ? alarm.inside : alarm.edge;
  return {
    ...plain,
    fill: plain.fill === undefined ? undefined : alarm.inside,
    stroke: plain.stroke === undefined ? undefined : colour,
  };
}
