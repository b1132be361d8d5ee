// SPDX-License-Identifier: MIT
// Positions of all robots of an execution at one moment. Between two observations, a moving robot is assumed
// to move in a straight line, and a standing robot to stand until shortly before the next observation.

import { Doing } from "../page/facts";
import type { Model } from "../page/model";
import type { RobotsNow } from "../page/robots_now";
import { kStates, markOf, needsHelp, type Drive, type State } from "./drive";

// The log records a change of state within kBrief seconds, and a moving robot at least every kLongest seconds.
// Therefore the motion before an observation is assumed to take at most kLongest seconds if the robot was
// moving at the observation before, and at most kBrief seconds otherwise.
const kBrief = 0.15;
const kLongest = 10;

const kDoing: Record<State, Doing> = {
  waiting: Doing.kWaiting, moving: Doing.kMoving, working: Doing.kWorking, done: Doing.kResting,
  lifted: Doing.kWaiting, lost: Doing.kWaiting,
};

export class DriveNow implements RobotsNow {
  time = 0;
  readonly count: number;
  readonly xs: Float32Array;
  readonly ys: Float32Array;
  readonly angles: Float32Array;
  readonly doing: Uint8Array;
  readonly colliding: Uint8Array; // 1 if the robot needs help
  readonly missing: Uint8Array; // always 0: robots without an observation are drawn at their starts

  constructor(private readonly model: Model, public drive: Drive) {
    this.count = model.agents.length;
    this.xs = new Float32Array(this.count);
    this.ys = new Float32Array(this.count);
    this.angles = new Float32Array(this.count);
    this.doing = new Uint8Array(this.count);
    this.colliding = new Uint8Array(this.count);
    this.missing = new Uint8Array(this.count);
  }

  update(time: number): void {
    this.time = time;
    for (let i = 0; i < this.count; ++i) {
      if (this.drive.robots[i].count > 0) this.place(i, time);
      else this.placeAtStart(i);
      const state = this.drive.stateAt(i, time);
      this.doing[i] = kDoing[kStates[state]];
      this.colliding[i] = needsHelp(state) ? 1 : 0;
    }
  }

  mark(robot: number): string {
    return markOf(this.drive.stateAt(robot, this.time));
  }

  private place(i: number, time: number): void {
    const robot = this.drive.robots[i];
    const at = robot.at(time);
    const next = Math.min(at + 1, robot.count - 1);
    const progress = next > at ? this.progress(i, at, time) : 0;
    this.xs[i] = robot.xs[at] + (robot.xs[next] - robot.xs[at]) * progress;
    this.ys[i] = robot.ys[at] + (robot.ys[next] - robot.ys[at]) * progress;
    const turn = turnBetween(robot.angles[at], robot.angles[next]);
    this.angles[i] = robot.angles[at] + (Number.isNaN(turn) ? 0 : turn * progress);
  }

  // Returns the completed fraction of the way from observation `at` to the next one, from 0 to 1.
  private progress(i: number, at: number, time: number): number {
    const { times, states } = this.drive.robots[i];
    const end = times[at + 1];
    const longest = kStates[states[at]] === "moving" ? kLongest : kBrief;
    const begin = Math.max(times[at], end - longest);
    // `time` may be before the first observation, where `begin` and `end` can be equal.
    if (time <= begin) return 0;
    return Math.min(1, (time - begin) / (end - begin));
  }

  private placeAtStart(i: number): void {
    const { start, turnSteps, startAngle } = this.model.agents[i];
    this.xs[i] = this.model.world.xs[start];
    this.ys[i] = this.model.world.ys[start];
    this.angles[i] = turnSteps > 0 ? (startAngle.steps * Math.PI) / (2 * turnSteps) : NaN;
  }
}

// Returns the smaller of the two turns from one angle to the other, in radians; NaN if an angle is unknown.
function turnBetween(from: number, to: number): number {
  const turn = (to - from) % (2 * Math.PI);
  return turn > Math.PI ? turn - 2 * Math.PI : turn < -Math.PI ? turn + 2 * Math.PI : turn;
}
