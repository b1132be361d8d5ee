// SPDX-License-Identifier: MIT
// An execution as its log describes it (docs/drive-log.md): for each robot its observations over time, in
// typed arrays that grow.

import type { Model } from "../page/model";

export const kStates = ["waiting", "moving", "working", "lifted", "lost", "done"] as const;
export type State = (typeof kStates)[number];
export const kWaiting = 0;
export const kMoving = 1;
export const kDone = kStates.indexOf("done");

// Whether a robot in this state needs help from a person.
export function needsHelp(state: number): boolean {
  return kStates[state] === "lifted" || kStates[state] === "lost";
}

// Signs beside robots, so that states are recognisable without colours. A moving robot has none.
const kMarks: Record<State, string> = {
  waiting: "…", moving: "", working: "↻", lifted: "↑", lost: "?", done: "✓",
};

export function markOf(state: number): string {
  return kMarks[kStates[state]];
}

const kFirst = 64;

// The observations of one robot, in order of time.
export class Observations {
  count = 0;
  times = new Float64Array(kFirst); // seconds, ascending
  xs = new Float32Array(kFirst); // in world units
  ys = new Float32Array(kFirst);
  angles = new Float32Array(kFirst); // clockwise from up, radians; NaN: unknown
  actions = new Int32Array(kFirst); // number of completed actions
  states = new Uint8Array(kFirst); // indices into kStates
  private last = 0;

  add(time: number, x: number, y: number, angle: number, action: number, state: number): void {
    if (this.count === this.times.length) this.grow();
    const i = this.count++;
    this.times[i] = time;
    this.xs[i] = x;
    this.ys[i] = y;
    this.angles[i] = angle;
    this.actions[i] = action;
    this.states[i] = state;
  }

  // Returns the index of the last observation not after `time`, or 0 if all are later. Searches from the
  // previous result, which is usually near.
  at(time: number): number {
    const { times, count } = this;
    let low = this.last;
    if (low >= count || times[low] > time) low = 0;
    if (low + 1 >= count || times[low + 1] > time) return (this.last = low);
    let high = low + 1; // times[high] <= time
    let step = 1;
    while (high + step < count && times[high + step] <= time) {
      high += step;
      step *= 2;
    }
    let beyond = Math.min(count, high + step);
    while (high + 1 < beyond) {
      const middle = (high + beyond) >> 1;
      if (times[middle] <= time) high = middle;
      else beyond = middle;
    }
    return (this.last = high);
  }

  private grow(): void {
    const size = 2 * this.times.length;
    const larger = <T extends Float64Array | Float32Array | Int32Array | Uint8Array>(
      old: T, made: T,
    ): T => {
      made.set(old);
      return made;
    };
    this.times = larger(this.times, new Float64Array(size));
    this.xs = larger(this.xs, new Float32Array(size));
    this.ys = larger(this.ys, new Float32Array(size));
    this.angles = larger(this.angles, new Float32Array(size));
    this.actions = larger(this.actions, new Int32Array(size));
    this.states = larger(this.states, new Uint8Array(size));
  }
}

export class Drive {
  order = ""; // file name of the passing order; empty: the execution has not started
  secondsPerStep = 1;
  end = 0; // time of the last observation, in seconds
  readonly robots: Observations[]; // by agent
  readonly completedAt: number[][]; // by agent and action: time of completion, in seconds

  constructor(model: Model) {
    this.robots = model.agents.map(() => new Observations());
    this.completedAt = model.agents.map(() => []);
  }

  // Adds an observation. `angle` is in degrees, `action` is the number of completed actions.
  add(
    agent: number, time: number, x: number, y: number, angle: number, action: number, state: number,
  ): void {
    this.robots[agent].add(time, x, y, ((angle % 360) * Math.PI) / 180, action, state);
    this.end = Math.max(this.end, time);
    const completed = this.completedAt[agent];
    while (completed.length < action) completed.push(time);
  }

  actionsAt(agent: number, time: number): number {
    const robot = this.robots[agent];
    return robot.count > 0 && robot.times[0] <= time ? robot.actions[robot.at(time)] : 0;
  }

  // Returns the state of a robot; kWaiting before its first observation.
  stateAt(agent: number, time: number): number {
    const robot = this.robots[agent];
    return robot.count > 0 && robot.times[0] <= time ? robot.states[robot.at(time)] : kWaiting;
  }

  // Whether all robots are done.
  get isOver(): boolean {
    return this.robots.every(({ count, states }) => count > 0 && states[count - 1] === kDone);
  }
}
