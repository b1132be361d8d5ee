// SPDX-License-Identifier: MIT
// Whoever paints robots, and what is painted over them: their ids, and a ring around the one chosen.

import type { Camera } from "./camera";
import type { Colors } from "./colors";
import type { Frame } from "./frame";
import type { Model } from "./model";
import { isOutside, type Shown } from "./scenery";

export const kRadius = 0.34; // of a robot, in steps
const kLeastLabeled = 22; // pixels of a step from which on robots have their ids

// Paints all robots of a frame on a canvas of its own, which lies over the scenery.
export interface RobotPainter {
  paint(camera: Camera, frame: Frame, colors: Colors, ratio: number): void;
}

export class Labels {
  private isClear = true;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly model: Model,
  ) {}

  paint(camera: Camera, frame: Frame, shown: Shown, colors: Colors, ratio: number): void {
    const step = this.model.world.unit * camera.scale;
    const labeled = shown.labels && step >= kLeastLabeled;
    const nothing = !labeled && shown.chosen < 0;
    if (nothing && this.isClear) return;
    const c = this.canvas.getContext("2d")!;
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.isClear = nothing;
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    const radius = Math.max(1.5, kRadius * step);
    if (labeled) this.paintIds(c, camera, frame, step, radius, colors);
    if (shown.chosen >= 0 && !frame.missing[shown.chosen]) {
      const p = camera.toView(frame.xs[shown.chosen], frame.ys[shown.chosen]);
      paintRing(c, p.x, p.y, radius, colors);
    }
  }

  private paintIds(
    c: CanvasRenderingContext2D, camera: Camera, frame: Frame, step: number, radius: number,
    colors: Colors,
  ): void {
    c.fillStyle = colors.onRobot;
    c.font = `600 ${Math.min(15, Math.max(8, 0.3 * step))}px system-ui, sans-serif`;
    c.textAlign = "center";
    c.textBaseline = "middle";
    for (let i = 0; i < frame.count; ++i) {
      if (frame.missing[i]) continue;
      const p = camera.toView(frame.xs[i], frame.ys[i]);
      if (isOutside(p.x, p.y, radius, camera)) continue;
      const { id } = this.model.agents[i];
      c.fillText(id.length > 6 ? id.slice(0, 5) + "…" : id, p.x, p.y + 0.5, 2.4 * radius);
    }
  }
}

function paintRing(
  c: CanvasRenderingContext2D, x: number, y: number, radius: number, colors: Colors,
): void {
  c.strokeStyle = colors.chosen;
  c.lineWidth = 3;
  c.beginPath();
  c.arc(x, y, Math.max(7, radius + 3), 0, 2 * Math.PI);
  c.stroke();
}
