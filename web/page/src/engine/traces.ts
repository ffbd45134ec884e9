//! Paths that points left, as far as the engine told them.

import type { TraceUpdate } from "./protocol.ts";

/** A path in the plane. */
export interface Trace {
  point: number;
  name: string;
  class: string;
  colour: string;
  /** x and y in turn. */
  at: number[];
  /** Samples whose frame missed its tolerance. */
  missed: Set<number>;
  /** Grows when samples are taken away or the look changes, not when they are added. */
  version: number;
}

export class Traces {
  readonly list: Trace[] = [];

  update(updates: readonly TraceUpdate[], n: number | undefined): void {
    for (const update of updates) this.updateOne(update);
    if (n !== undefined) this.list.length = Math.min(this.list.length, n);
  }

  private updateOne(update: TraceUpdate): void {
    const old = this.list[update.trace];
    const isNew = old === undefined || old.class !== update.class || old.colour !== update.colour;
    const isCut = old !== undefined && 2 * update.from < old.at.length;
    const at = old?.at ?? [];
    at.length = Math.min(at.length, 2 * update.from);
    for (const number of update.at) at.push(number);
    const missed = new Set([...(old?.missed ?? [])].filter((k) => k < update.from));
    for (const k of update.missed) missed.add(k);
    this.list[update.trace] = {
      point: update.point,
      name: update.name,
      class: update.class,
      colour: update.colour,
      at,
      missed,
      version: (old?.version ?? 0) + (isNew || isCut ? 1 : 0),
    };
  }
}
