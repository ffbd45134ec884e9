//! Paths that points left, as far as the engine told them.

import type { TraceUpdate } from "./protocol.ts";

/** A path in the plane. */
export interface Trace {
  point: number;
  name: string;
  colour: string;
  /** x and y in turn. */
  readonly at: number[];
  /** In units of the plane. */
  length: number;
  /** Samples whose frame missed its tolerance. */
  readonly missed: Set<number>;
  /** Another one when samples are taken away or the colour changes, not when samples are added. None is
   * given twice, so that a path of the same version is the same path, and goes on. */
  version: number;
}

export class Traces {
  readonly list: Trace[] = [];
  private nVersions = 0;

  update(updates: readonly TraceUpdate[], n: number | undefined): void {
    for (const update of updates) this.updateOne(update);
    if (n !== undefined) this.list.length = Math.min(this.list.length, n);
  }

  private updateOne(update: TraceUpdate): void {
    const { point, name, colour, from } = update;
    const fresh: Trace = { point, name, colour, at: [], length: 0, missed: new Set(), version: 0 };
    const trace = this.list[update.trace] ?? fresh;
    this.list[update.trace] = trace;
    const isCut = 2 * from < trace.at.length;
    if (isCut) cut(trace, from);
    if (trace === fresh || isCut || trace.colour !== colour) trace.version = ++this.nVersions;
    Object.assign(trace, { point, name, colour });
    const { at } = trace;
    for (let k = 0; k + 1 < update.at.length; k += 2) {
      const [x, y] = [update.at[k] ?? 0, update.at[k + 1] ?? 0];
      if (at.length > 0) trace.length += Math.hypot(x - (at.at(-2) ?? x), y - (at.at(-1) ?? y));
      at.push(x, y);
    }
    for (const k of update.missed) trace.missed.add(k);
  }
}

/** Leaves so many samples of a path. */
function cut(trace: Trace, nSamples: number): void {
  const { at, missed } = trace;
  at.length = 2 * nSamples;
  for (const k of missed) if (k >= nSamples) missed.delete(k);
  trace.length = 0;
  for (let k = 2; k + 1 < at.length; k += 2) {
    trace.length += Math.hypot(
      (at[k] ?? 0) - (at[k - 2] ?? 0),
      (at[k + 1] ?? 0) - (at[k - 1] ?? 0),
    );
  }
}
