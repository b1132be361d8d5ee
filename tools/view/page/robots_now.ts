// SPDX-License-Identifier: MIT
// All robots at one moment, as painters need them. They come from a plan (frame.ts) or an execution
// (drive/now.ts).

export interface RobotsNow {
  readonly time: number;
  readonly count: number;
  readonly xs: Float32Array; // in world units
  readonly ys: Float32Array;
  readonly angles: Float32Array; // clockwise from up, in radians; NaN: unknown, or turns freely
  readonly doing: Uint8Array; // values of Doing (facts.ts)
  readonly colliding: Uint8Array; // 1 if the robot is marked: it collides or has another problem
  readonly missing: Uint8Array; // 1 if the robot is not drawn
  mark(robot: number): string; // sign of its state, drawn beside it; empty: none
  update(time: number): void;
}

// Returns the robot that is nearest to a world point, closer than `reach` (in world units); -1: none.
export function nearest(robots: RobotsNow, x: number, y: number, reach: number): number {
  let best = -1;
  let least = reach;
  for (let i = 0; i < robots.count; ++i) {
    if (robots.missing[i]) continue;
    const distance = Math.hypot(robots.xs[i] - x, robots.ys[i] - y);
    if (distance < least) [best, least] = [i, distance];
  }
  return best;
}
