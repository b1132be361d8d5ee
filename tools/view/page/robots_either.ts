// SPDX-License-Identifier: MIT
// Paints robots on a 2D canvas, which is always available, or by WebGL if the canvas takes too long and
// there is a graphics card. WebGL is requested only then, because browsers report a warning where it is
// emulated in software.

import type { Camera } from "./camera";
import type { Colors } from "./colors";
import type { World } from "./model";
import type { RobotPainter } from "./robots";
import { CanvasRobots } from "./robots_canvas";
import { GlRobots } from "./robots_gl";
import type { RobotsNow } from "./robots_now";

const kSlow = 6; // milliseconds per frame
const kFrames = 30; // frames over which the mean is taken

export class EitherRobots implements RobotPainter {
  private painter: RobotPainter;
  private isSettled = false;
  private frames = 0;
  private spent = 0;

  // One of the two canvases stays empty: a canvas has only one kind of context.
  constructor(
    private readonly plain: HTMLCanvasElement,
    private readonly fast: HTMLCanvasElement,
    private readonly world: World,
  ) {
    this.painter = new CanvasRobots(plain, world);
  }

  paint(camera: Camera, frame: RobotsNow, colors: Colors, ratio: number): void {
    const begin = performance.now();
    this.painter.paint(camera, frame, colors, ratio);
    if (this.isSettled) return;
    this.spent += performance.now() - begin;
    if (++this.frames < kFrames) return;
    if (this.spent > kSlow * kFrames) this.change(frame.count);
    this.frames = this.spent = 0;
  }

  private change(count: number): void {
    this.isSettled = true;
    const gl = GlRobots.isFast() ? GlRobots.on(this.fast, this.world, count) : null;
    if (!gl) return;
    this.painter = gl;
    this.plain.getContext("2d")!.resetTransform();
    this.plain.getContext("2d")!.clearRect(0, 0, this.plain.width, this.plain.height);
  }
}
