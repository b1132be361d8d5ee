// SPDX-License-Identifier: MIT
// Paints robots on a 2D canvas: for most views, for browsers without WebGL, and for the small map.

import { shapes } from "../palette.json";
import type { Camera } from "./camera";
import type { Colors } from "./colors";
import { Doing } from "./facts";
import type { World } from "./model";
import type { RobotPainter } from "./robots";
import type { RobotsNow } from "./robots_now";
import { isOutside } from "./scenery";

export class CanvasRobots implements RobotPainter {
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly world: World,
    private readonly least = 1.5, // minimum radius, in pixels
  ) {}

  paint(camera: Camera, frame: RobotsNow, colors: Colors, ratio: number): void {
    const c = this.canvas.getContext("2d")!;
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.clearRect(0, 0, this.canvas.width, this.canvas.height);
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    const step = this.world.unit * camera.scale;
    const radius = Math.max(this.least, shapes.robotRadius * step);
    // Paints all robots with the same activity as one path, because a fill for each robot takes far longer.
    for (let doing = Doing.kMoving; doing <= Doing.kResting; ++doing) {
      c.fillStyle = colors.doing[doing];
      c.beginPath();
      for (let i = 0; i < frame.count; ++i) {
        if (frame.missing[i] || frame.doing[i] !== doing || frame.colliding[i]) continue;
        const p = camera.toView(frame.xs[i], frame.ys[i]);
        if (!isOutside(p.x, p.y, radius, camera)) addRobot(c, p.x, p.y, radius);
      }
      c.fill();
    }
    for (let i = 0; i < frame.count; ++i) {
      const turns = step >= 10 && !Number.isNaN(frame.angles[i]);
      if (frame.missing[i] || (!turns && !frame.colliding[i])) continue;
      const p = camera.toView(frame.xs[i], frame.ys[i]);
      if (isOutside(p.x, p.y, 2 * radius, camera)) continue;
      if (frame.colliding[i]) paintCollision(c, p.x, p.y, radius, colors);
      if (turns) paintHeading(c, p.x, p.y, radius, frame.angles[i], colors);
    }
  }
}

function addRobot(c: CanvasRenderingContext2D, x: number, y: number, radius: number): void {
  if (radius < 3) {
    c.rect(x - radius, y - radius, 2 * radius, 2 * radius);
  } else {
    c.moveTo(x + radius, y);
    c.arc(x, y, radius, 0, 2 * Math.PI);
  }
}

// Paints a colliding robot larger and as a star, because some people cannot distinguish red.
function paintCollision(
  c: CanvasRenderingContext2D, x: number, y: number, radius: number, colors: Colors,
): void {
  const r = Math.max(7, 1.15 * radius);
  c.fillStyle = colors.collision;
  c.beginPath();
  for (let k = 0; k < 16; ++k) {
    const length = k % 2 === 0 ? r : 0.7 * r;
    const angle = (k * Math.PI) / 8;
    c.lineTo(x + length * Math.cos(angle), y + length * Math.sin(angle));
  }
  c.closePath();
  c.fill();
}

function paintHeading(
  c: CanvasRenderingContext2D, x: number, y: number, radius: number, angle: number, colors: Colors,
): void {
  const [dx, dy] = [Math.sin(angle), -Math.cos(angle)];
  const tip = shapes.headingTip * radius;
  const base = shapes.headingBase;
  const half = shapes.headingTip - shapes.headingBase;
  c.fillStyle = colors.heading;
  c.beginPath();
  c.moveTo(x + dx * tip, y + dy * tip);
  c.lineTo(x + dx * base * radius - dy * half * radius, y + dy * base * radius + dx * half * radius);
  c.lineTo(x + dx * base * radius + dy * half * radius, y + dy * base * radius - dx * half * radius);
  c.closePath();
  c.fill();
}
