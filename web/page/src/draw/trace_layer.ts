//! A layer for paths: what is there stays, and what is new is added.

import type { Camera } from "../camera.ts";
import type { Trace, Traces } from "../engine/traces.ts";
import { onPaper } from "./dark.ts";

/** A path longer than this crosses itself many times over and is drawn finer, as in pictures, px. */
const LONG = 6000;

/** Samples closer than this on the canvas are one, px. */
const CLOSE = 0.4;

interface Look {
  readonly stroke: string;
  readonly width: number;
  readonly opacity: number;
}

/** How far a path has been drawn. */
interface Progress {
  readonly version: number;
  readonly nSamples: number;
  readonly isFine: boolean;
}

const isFine = (trace: Trace, camera: Camera): boolean => trace.length * camera.scale > LONG;

export class TraceLayer {
  private readonly canvas = document.createElement("canvas");
  private readonly context = this.canvas.getContext("2d");
  private camera: Camera | undefined;
  private look = "";
  private progress: Progress[] = [];

  /** The layer with all paths on it; none if there are none. */
  draw(
    traces: Traces,
    camera: Camera,
    mark: number,
    isDark: boolean,
  ): HTMLCanvasElement | undefined {
    const { context } = this;
    if (context === null || traces.list.length === 0) {
      this.progress = [];
      return undefined;
    }
    const look = `${mark} ${isDark}`;
    if (!this.isContinued(traces, camera, look)) this.begin(context, camera, look);
    for (const [k, trace] of traces.list.entries()) {
      const { stroke, width, opacity } = lookOf(trace, camera, mark, isDark);
      context.strokeStyle = stroke;
      context.lineWidth = width;
      context.globalAlpha = opacity;
      const nDrawn = this.progress[k]?.nSamples ?? 0;
      drawFrom(context, trace, Math.max(nDrawn - 1, 0), camera);
      this.progress[k] = {
        version: trace.version,
        nSamples: trace.at.length / 2,
        isFine: isFine(trace, camera),
      };
    }
    return this.canvas;
  }

  private isContinued(traces: Traces, camera: Camera, look: string): boolean {
    return (
      this.camera?.equals(camera) === true &&
      this.look === look &&
      this.progress.length <= traces.list.length &&
      this.progress.every((drawn, k) => {
        const trace = traces.list[k];
        return trace?.version === drawn.version && isFine(trace, camera) === drawn.isFine;
      })
    );
  }

  private begin(context: CanvasRenderingContext2D, camera: Camera, look: string): void {
    this.camera = camera;
    this.look = look;
    this.progress = [];
    this.canvas.width = Math.round(camera.width * camera.density);
    this.canvas.height = Math.round(camera.height * camera.density);
    context.setTransform(camera.density, 0, 0, camera.density, 0, 0);
    context.lineJoin = "round";
    context.lineCap = "round";
  }
}

function lookOf(trace: Trace, camera: Camera, mark: number, isDark: boolean): Look {
  const stroke = onPaper(trace.colour, isDark);
  const [width, opacity] = isFine(trace, camera) ? [0.9, 0.85] : [1.7, 1];
  return { stroke, width: Math.max(width * mark, 0.5), opacity };
}

/** Draws a path from a sample on; dotted where frames missed their tolerance. */
function drawFrom(
  context: CanvasRenderingContext2D,
  trace: Trace,
  first: number,
  camera: Camera,
): void {
  const n = trace.at.length / 2;
  if (n - first < 2) return;
  const x = (k: number): number =>
    camera.width / 2 + ((trace.at[2 * k] ?? 0) - camera.centre.x) * camera.scale;
  const y = (k: number): number =>
    camera.height / 2 - ((trace.at[2 * k + 1] ?? 0) - camera.centre.y) * camera.scale;
  let isDotted = trace.missed.has(first + 1);
  const begin = (k: number): void => {
    context.setLineDash(isDotted ? [2, 4] : []);
    context.beginPath();
    context.moveTo(x(k), y(k));
  };
  begin(first);
  let [lastX, lastY] = [x(first), y(first)];
  for (let k = first + 1; k < n; k++) {
    if (trace.missed.has(k) !== isDotted) {
      context.stroke();
      isDotted = !isDotted;
      begin(k - 1);
    }
    const [px, py] = [x(k), y(k)];
    if (k === n - 1 || Math.abs(px - lastX) + Math.abs(py - lastY) > CLOSE) {
      context.lineTo(px, py);
      [lastX, lastY] = [px, py];
    }
  }
  context.stroke();
}
