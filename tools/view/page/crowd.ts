// SPDX-License-Identifier: MIT
// Positions of all robots over time, and the robot on each place. A step of a robot is an addition; its
// track is read only where a run of equal steps ends.

import type { Plan } from "./model";

export type ReportCollision = (kind: "vertex" | "swap", time: number, a: number, b: number) => void;

const kNever = 0x7fffffff;

export class Crowd {
  readonly here: Int32Array; // by agent; -1: no path
  readonly before: Int32Array; // one step earlier
  private readonly delta: Int32Array;
  private readonly until: Int32Array; // end of the run of delta
  private readonly runs: Int32Array; // the next run
  private readonly occupant: Int32Array; // by place; valid if the stamp of the place is the current one
  private readonly stamp: Int32Array;
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

  // Goes to the next moment; the first call goes to 0.
  advance(report: ReportCollision): void {
    const time = ++this.now;
    const { here, before, occupant, stamp } = this;
    if (time > 0) this.move(time);
    // Until they are stamped for this moment, occupants are those of the moment before.
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
        // Once for each encounter, whatever its duration.
        const other = occupant[place];
        if (time === 0 || before[other] !== before[i]) report("vertex", time, other, i);
      }
      stamp[place] = time;
      occupant[place] = i;
    }
  }

  // Returns the robot on a place now; -1: none.
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
