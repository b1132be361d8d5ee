// SPDX-License-Identifier: MIT
// All robots of a plan at one moment: position, heading, activity, and whether the robot collides or violates
// a rule. An update takes O(robots) time during playing, independent of the length of the plan.

import type { Violation } from "./check";
import { Doing, type PlanFacts } from "./facts";
import { Faults } from "./faults";
import type { Model, Plan } from "./model";
import type { RobotsNow } from "./robots_now";

export class Frame implements RobotsNow {
  time = 0;
  readonly count: number;
  readonly xs: Float32Array; // in world units
  readonly ys: Float32Array;
  readonly angles: Float32Array; // clockwise from up, in radians; NaN: turns freely
  readonly doing: Uint8Array;
  readonly colliding: Uint8Array; // 1 if the robot collides or has another fault
  readonly missing: Uint8Array; // 1 if the robot has no path; it is not drawn

  private readonly runs: Int32Array; // by agent: the last used run of its track
  private readonly spanAt: Int32Array; // by agent: the last used span
  private readonly before: Int32Array; // places one step before `step`, at `step`, and one step after it
  private readonly here: Int32Array;
  private readonly next: Int32Array;
  private readonly occupant: Int32Array; // by place; valid if its stamp is current
  private readonly stamp: Int32Array;
  private stamps = 0;
  private step = -1; // the whole step at or before `time`
  private readonly faults: Faults;

  constructor(
    private readonly model: Model,
    readonly plan: Plan,
    private readonly facts: PlanFacts,
    private readonly violations: Violation[] = [],
  ) {
    const count = plan.agents.length;
    this.count = count;
    this.xs = new Float32Array(count);
    this.ys = new Float32Array(count);
    this.angles = new Float32Array(count);
    this.doing = new Uint8Array(count);
    this.colliding = new Uint8Array(count);
    this.missing = Uint8Array.from(plan.agents, (agent) => (agent.track.isEmpty ? 1 : 0));
    this.runs = new Int32Array(count);
    this.spanAt = new Int32Array(count);
    this.before = new Int32Array(count);
    this.here = new Int32Array(count);
    this.next = new Int32Array(count);
    this.occupant = new Int32Array(model.world.places);
    this.stamp = new Int32Array(model.world.places);
    this.faults = new Faults(count);
  }

  mark(): string {
    return "";
  }

  update(time: number): void {
    this.time = time;
    const step = Math.floor(time);
    if (step !== this.step) this.enter(step);
    const progress = time - step;
    const { xs, ys } = this.model.world;
    for (let i = 0; i < this.count; ++i) {
      if (this.missing[i]) continue;
      const a = this.here[i];
      const b = this.next[i];
      this.xs[i] = xs[a] + (xs[b] - xs[a]) * progress;
      this.ys[i] = ys[a] + (ys[b] - ys[a]) * progress;
      const { turns } = this.plan.agents[i];
      this.angles[i] = turns ? (turns.angle(time) * Math.PI) / (2 * turns.turnSteps) : NaN;
    }
    this.findCollisions(progress);
    this.faults.mark(this.violations, time, this.colliding);
  }

  private enter(step: number): void {
    const isNext = step === this.step + 1 && step > 0;
    if (isNext) this.before.set(this.here);
    this.step = step;
    for (let i = 0; i < this.count; ++i) {
      const { track } = this.plan.agents[i];
      if (track.isEmpty) continue;
      this.runs[i] = track.run(step, this.runs[i]);
      if (!isNext) this.before[i] = track.place(Math.max(0, step - 1));
      this.here[i] = track.place(step, this.runs[i]);
      this.next[i] = track.place(step + 1, this.runs[i]);
      this.doing[i] = this.doingAt(i, step);
    }
  }

  private doingAt(agent: number, step: number): Doing {
    const spans = this.facts.spans[agent];
    let at = this.spanAt[agent];
    if (spans[at].begin > step) at = 0;
    while (spans[at].end <= step) ++at;
    this.spanAt[agent] = at;
    return spans[at].doing;
  }

  // Marks robots that are on the same place at `step`, robots that swap places on the way to the next step
  // and, in the second half of that way, robots that come to the same place. At a whole step it marks robots
  // that swapped places on the way to it.
  private findCollisions(progress: number): void {
    this.colliding.fill(0);
    this.meet(this.here);
    if (progress === 0) this.findSwaps(this.before, this.here);
    else this.findSwaps(this.here, this.next);
    if (progress >= 0.5) this.meet(this.next);
  }

  private meet(places: Int32Array): void {
    const mark = ++this.stamps;
    for (let i = 0; i < this.count; ++i) {
      if (this.missing[i]) continue;
      const place = places[i];
      if (this.stamp[place] === mark) {
        this.colliding[i] = 1;
        this.colliding[this.occupant[place]] = 1;
      }
      this.stamp[place] = mark;
      this.occupant[place] = i;
    }
  }

  private findSwaps(from: Int32Array, to: Int32Array): void {
    const mark = ++this.stamps;
    for (let i = 0; i < this.count; ++i) {
      if (this.missing[i]) continue;
      this.stamp[from[i]] = mark;
      this.occupant[from[i]] = i;
    }
    for (let i = 0; i < this.count; ++i) {
      if (this.missing[i] || from[i] === to[i]) continue;
      const other = this.stamp[to[i]] === mark ? this.occupant[to[i]] : -1;
      if (other >= 0 && other !== i && to[other] === from[i])
        this.colliding[i] = this.colliding[other] = 1;
    }
  }
}
