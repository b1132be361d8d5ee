// SPDX-License-Identifier: MIT
// Robots that are drawn in red at a given time because of their own path: an impossible step, a task
// execution on the wrong place, or rest on the wrong place. (Frame detects collisions itself.)

import type { Kind, Violation } from "./check";

const kOfAMoment: Kind[] = ["start", "jump", "turn", "work"];
const kForEver: Kind[] = ["end", "visit"]; // shown from their time on

export class Faults {
  private known = -1; // number of violations used so far; the check may find more
  private readonly moments = new Map<number, number[]>(); // robots, by the end of the faulty step
  private readonly since: Float64Array; // by robot: time from which on it is red; Infinity: never

  constructor(robots: number) {
    this.since = new Float64Array(robots).fill(Infinity);
  }

  // Sets `red` for each robot that is at fault at `time`. A faulty step is marked from its beginning to its
  // end.
  mark(violations: Violation[], time: number, red: Uint8Array): void {
    if (violations.length !== this.known) this.learn(violations);
    if (this.known === 0) return;
    for (const robot of this.moments.get(Math.ceil(time)) ?? []) red[robot] = 1;
    for (let i = 0; i < red.length; ++i) if (time >= this.since[i]) red[i] = 1;
  }

  private learn(violations: Violation[]): void {
    this.known = violations.length;
    this.moments.clear();
    for (const { kind, time, agents } of violations) {
      if (kForEver.includes(kind))
        for (const robot of agents) this.since[robot] = Math.min(this.since[robot], time);
      if (!kOfAMoment.includes(kind)) continue;
      const others = this.moments.get(time);
      if (others) others.push(...agents);
      else this.moments.set(time, [...agents]);
    }
  }
}
