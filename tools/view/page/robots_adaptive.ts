// SPDX-License-Identifier: MIT
// Paints robots on a 2D canvas, which is always available. Changes to WebGL if the canvas takes too long and
// there is a graphics card. It requests WebGL only then, because browsers that emulate WebGL in software
// print a warning.

import type { Camera } from "./camera";
import type { Colors } from "./colors";
import type { World } from "./model";
import type { RobotPainter } from "./robots";
import { CanvasRobots } from "./robots_canvas";
import { GlRobots } from "./robots_gl";
import type { RobotsNow } from "./robots_now";

const kSlow = 6; // milliseconds per frame, above which the canvas takes too long
const kFrames = 30; // number of frames whose mean time is compared with kSlow

export class AdaptiveRobotPainter implements RobotPainter {
  private painter: RobotPainter;
  private isSettled = false;
  private frames = 0;
  private spent = 0;

  // `plain` is for 2D, `fast` for WebGL, because a canvas can have only one kind of context. The unused
  // canvas is empty.
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
