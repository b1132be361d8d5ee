// SPDX-License-Identifier: MIT
// Interface of robot painters, and the labels over robots: ids, a ring around the selected robot, and a
// dashed ring at its position in the other plan.

import { shapes } from "../palette.json";
import type { Camera } from "./camera";
import type { Colors } from "./colors";
import { Doing } from "./facts";
import type { Model, Point } from "./model";
import { labelsOf, shortened } from "./names";
import type { RobotsNow } from "./robots_now";
import { isOutside, type DisplayOptions } from "./scenery";
import { outlined } from "./text";

const kLeastLabeled = 22; // pixels per step, from which on ids are on the robots instead of above them
const kLongestLabel = 6;
const kLongestTag = 14;

// Paints all robots at one moment on a canvas of its own, which lies over the scenery.
export interface RobotPainter {
  paint(camera: Camera, frame: RobotsNow, colors: Colors, ratio: number): void;
}

export class Labels {
  private isClear = true;
  private readonly ids: string[]; // shortened

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly model: Model,
    private readonly elsewhere: (robot: number, time: number) => Point | null, // position in the other plan; null: none
  ) {
    this.ids = labelsOf(model.agents.map(({ name }) => name), kLongestLabel);
  }

  paint(camera: Camera, frame: RobotsNow, shown: DisplayOptions, colors: Colors, ratio: number): void {
    const step = this.model.world.unit * camera.scale;
    const seen = shown.labels ? this.inSight(camera, frame, step) : [];
    const nothing = seen.length === 0 && shown.chosen < 0;
    if (nothing && this.isClear) return;
    const c = this.canvas.getContext("2d")!;
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.isClear = nothing;
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    const radius = Math.max(1.5, shapes.robotRadius * step);
    if (step >= kLeastLabeled) this.paintIds(c, camera, frame, seen, step, radius, colors);
    else for (const robot of seen) this.paintTag(c, camera, frame, robot, radius, colors);
    if (shown.chosen >= 0) this.paintChosen(c, camera, frame, shown.chosen, step, colors);
  }

  // Returns the visible robots, whose ids are painted; none if there are too many of them for the space.
  private inSight(camera: Camera, frame: RobotsNow, step: number): number[] {
    const most = step >= kLeastLabeled ? Infinity : shapes.maxTags;
    const seen: number[] = [];
    for (let i = 0; i < frame.count; ++i) {
      if (frame.missing[i]) continue;
      const p = camera.toView(frame.xs[i], frame.ys[i]);
      if (isOutside(p.x, p.y, step, camera)) continue;
      if (seen.push(i) > most) return [];
    }
    return seen;
  }

  private paintIds(
    c: CanvasRenderingContext2D, camera: Camera, frame: RobotsNow, seen: number[], step: number,
    radius: number, colors: Colors,
  ): void {
    c.font = `600 ${Math.min(24, Math.max(8, 0.3 * step))}px system-ui, sans-serif`;
    c.textAlign = "center";
    c.textBaseline = "middle";
    for (const i of seen) {
      const p = camera.toView(frame.xs[i], frame.ys[i]);
      const isDark = frame.colliding[i] || frame.doing[i] === Doing.kMoving;
      c.fillStyle = isDark ? colors.onRobot : colors.onPale;
      c.fillText(this.ids[i], p.x, p.y + 0.5, 1.8 * radius);
    }
    for (const i of seen)
      paintMark(c, camera.toView(frame.xs[i], frame.ys[i]), frame.mark(i), radius, colors);
  }

  private paintTag(
    c: CanvasRenderingContext2D, camera: Camera, frame: RobotsNow, robot: number, radius: number,
    colors: Colors, color = colors.text,
  ): void {
    const p = camera.toView(frame.xs[robot], frame.ys[robot]);
    const mark = frame.mark(robot);
    const name = shortened(this.model.agents[robot].name, kLongestTag) + (mark && ` ${mark}`);
    c.font = `${color === colors.text ? "" : "700 "}10px system-ui, sans-serif`;
    c.textAlign = "center";
    c.textBaseline = "bottom";
    const half = c.measureText(name).width / 2 + 2;
    const x = Math.min(camera.width - half, Math.max(half, p.x));
    outlined(c, name, x, Math.max(12, p.y - radius - 2), color, colors.floor);
  }

  private paintChosen(
    c: CanvasRenderingContext2D, camera: Camera, frame: RobotsNow, robot: number, step: number,
    colors: Colors,
  ): void {
    const radius = Math.max(7, Math.max(1.5, shapes.robotRadius * step) + 3);
    const elsewhere = this.elsewhere(robot, frame.time);
    if (elsewhere)
      paintRing(c, camera.toView(elsewhere.x, elsewhere.y), radius, colors.text, [4, 3]);
    if (frame.missing[robot]) return;
    const p = camera.toView(frame.xs[robot], frame.ys[robot]);
    paintRing(c, p, radius, colors.chosen, []);
    if (step < kLeastLabeled) this.paintTag(c, camera, frame, robot, radius, colors, colors.chosen);
  }
}

// Paints the sign of a state on the upper right edge of a robot, away from its id.
function paintMark(
  c: CanvasRenderingContext2D, at: Point, mark: string, radius: number, colors: Colors,
): void {
  if (mark === "") return;
  const r = Math.min(14, Math.max(6, 0.36 * radius));
  const [x, y] = [at.x + 0.75 * radius, at.y - 0.75 * radius];
  c.beginPath();
  c.arc(x, y, r, 0, 2 * Math.PI);
  c.fillStyle = colors.floor;
  c.fill();
  c.strokeStyle = colors.text;
  c.lineWidth = 1;
  c.stroke();
  c.fillStyle = colors.text;
  c.font = `700 ${1.4 * r}px system-ui, sans-serif`;
  c.fillText(mark, x, y + 0.5);
}

function paintRing(
  c: CanvasRenderingContext2D, at: Point, radius: number, color: string, dashes: number[],
): void {
  c.strokeStyle = color;
  c.lineWidth = 3;
  c.setLineDash(dashes);
  c.beginPath();
  c.arc(at.x, at.y, radius, 0, 2 * Math.PI);
  c.stroke();
  c.setLineDash([]);
}
