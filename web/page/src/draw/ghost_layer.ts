//! A layer for the poses of the past: each as a whole shines through, not its parts one by one.

import type { Camera } from "../camera.ts";
import type { Painter } from "./painter.ts";

export class GhostLayer {
  private readonly all = document.createElement("canvas");
  private readonly one = document.createElement("canvas");
  private painter: Painter | undefined;
  private camera: Camera | undefined;

  /** The layer with all ghosts on it; none if there are none. */
  draw(painter: Painter, camera: Camera): HTMLCanvasElement | undefined {
    if (painter.ghosts.length === 0) return undefined;
    if (this.painter !== painter || this.camera?.equals(camera) !== true) {
      this.painter = painter;
      this.camera = camera;
      this.redraw(painter, camera);
    }
    return this.all;
  }

  private redraw(painter: Painter, camera: Camera): void {
    const [all, one] = [this.all.getContext("2d"), this.one.getContext("2d")];
    if (all === null || one === null) return;
    const [width, height] = [camera.width, camera.height].map((side) =>
      Math.round(side * camera.density),
    ) as [number, number];
    // A size that is set empties a canvas, whether it is another or not.
    this.all.width = width;
    this.all.height = height;
    for (const { opacity, figures } of painter.ghosts) {
      this.one.width = width;
      this.one.height = height;
      one.lineCap = "round";
      one.lineJoin = "round";
      painter.paintGhost(one, camera, figures);
      all.globalAlpha = opacity;
      all.drawImage(this.one, 0, 0);
    }
  }
}
