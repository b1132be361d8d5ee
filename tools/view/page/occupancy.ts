// SPDX-License-Identifier: MIT
// Places of all robots over time, and the robot on each place. A step costs one addition per robot: a track
// is read only where a run of equal steps ends.

import type { Plan } from "./model";

export type ReportCollision = (kind: "vertex" | "swap", time: number, a: number, b: number) => void;

const kNever = 0x7fffffff;

export class Occupancy {
  readonly here: Int32Array; // place by agent; -1: no path
  readonly before: Int32Array; // `here` one step earlier
  private readonly delta: Int32Array; // by agent: change of place per step
  private readonly until: Int32Array; // by agent: time at which the run of `delta` ends
  private readonly runs: Int32Array; // by agent: index of the next run
  private readonly occupant: Int32Array; // by place; the robot there at the time `stamp`
  private readonly stamp: Int32Array; // by place: the last time at which a robot was there; -1: never
  private now = -1;

  constructor(
    private readonly plan: Plan,
    places: number,
  ) {
    const { agents } = plan;
    this.here = Int32Array.from(agents, ({ track }) => (track.isEmpty ? -1 : track.places[0]));
    this.before = Int32Array.from(this.here);
    this.delta = new Int32Array(agents.length);
    this.until = new Int32Array(agents.length);
    this.runs = new Int32Array(agents.length);
    this.occupant = new Int32Array(places);
    this.stamp = new Int32Array(places).fill(-1);
  }

  // Advances to the next time, and reports the collisions then. The first call goes to time 0.
  advance(report: ReportCollision): void {
    const time = ++this.now;
    const { here, before, occupant, stamp } = this;
    if (time > 0) this.move(time);
    // Occupants are still those of the previous time, because no place has the new stamp yet.
    for (let i = 0; i < here.length; ++i) {
      const to = here[i];
      if (to === before[i] || stamp[to] !== time - 1) continue;
      const other = occupant[to];
      if (other < i && before[other] === to && here[other] === before[i])
        report("swap", time, other, i);
    }
    for (let i = 0; i < here.length; ++i) {
      const place = here[i];
      if (place < 0) continue;
      if (stamp[place] === time) {
        // Reports a collision only when it starts, not for robots that stay together.
        const other = occupant[place];
        if (time === 0 || before[other] !== before[i]) report("vertex", time, other, i);
      }
      stamp[place] = time;
      occupant[place] = i;
    }
  }

  // Returns the robot that is on a place at the current time; -1: none.
  on(place: number): number {
    return this.stamp[place] === this.now ? this.occupant[place] : -1;
  }

  private move(time: number): void {
    const { here, before, delta, until } = this;
    before.set(here);
    for (let i = 0; i < here.length; ++i) {
      if (time > until[i]) this.beginRun(i);
      here[i] += delta[i];
    }
  }

  private beginRun(agent: number): void {
    const { track } = this.plan.agents[agent];
    const run = this.runs[agent]++;
    const isAtRest = run >= track.runs;
    this.delta[agent] = isAtRest ? 0 : track.deltas[run];
    this.until[agent] = isAtRest ? kNever : track.times[run + 1];
  }
}
