// SPDX-License-Identifier: MIT
// Finds the causes of waits: for each wait, the robots that the waiting robot would have met if it had not
// waited. For this, it simulates ghosts of the robot that leave at different times of the wait, and follows
// each of them until it meets another robot, for at most kAhead steps.

import { Occupancy } from "./occupancy";
import { Doing, type PlanFacts } from "./facts";
import type { Model, Plan } from "./model";

export interface Wait {
  agent: number;
  begin: number;
  end: number;
  place: number;
  met: number[]; // robots that its ghosts meet, in order of time
  firstMeetingPlace: number; // place where a ghost first meets a robot; -1: none
}

const kMostGhosts = 8; // maximum number of ghosts per wait
const kAhead = 40; // steps for which a ghost is followed
const kGhostsAtOnce = 8192; // steps of ghosts between two checks of the elapsed time

// A ghost takes the steps that its robot takes after the wait, `earlier` steps earlier.
interface Ghost {
  wait: Wait;
  earlier: number;
  from: number; // time at which it leaves
  place: number;
  run: number; // current run of the robot's track
  delta: number; // change of place per step in this run
  until: number; // end of this run, in time of the robot, not of the ghost
}

export class Waits {
  readonly all: Wait[]; // in order of time
  readonly byAgent: Wait[][];
  done = false;
  private readonly parts: Generator<void>;

  constructor(
    private readonly model: Model,
    private readonly plan: Plan,
    facts: PlanFacts,
  ) {
    this.byAgent = plan.agents.map((_, agent) => waitsOf(plan, facts, agent));
    this.all = this.byAgent.flat().sort((a, b) => a.begin - b.begin || a.agent - b.agent);
    this.parts = this.find();
  }

  // Continues the simulation for about this time. Returns whether it is complete.
  step(milliseconds: number): boolean {
    const until = performance.now() + milliseconds;
    while (!this.done && performance.now() < until) this.done = this.parts.next().done ?? false;
    return this.done;
  }

  private *find(): Generator<void> {
    const occupancy = new Occupancy(this.plan, this.model.world.places);
    const waiting = this.all.flatMap((wait) => this.ghostsOf(wait)).sort((a, b) => a.from - b.from);
    let next = 0;
    const ghosts: Ghost[] = [];
    for (let time = 0; next < waiting.length || ghosts.length > 0; ++time) {
      occupancy.advance(() => {});
      let left = 0;
      for (let i = 0; i < ghosts.length; ++i) {
        if (this.continues(ghosts[i], time, occupancy)) ghosts[left++] = ghosts[i];
        if (i % kGhostsAtOnce === kGhostsAtOnce - 1) yield;
      }
      ghosts.length = left;
      while (next < waiting.length && waiting[next].from === time) ghosts.push(waiting[next++]);
      yield;
    }
  }

  // Moves a ghost to `time`. Returns false if it meets a robot or has been followed for kAhead steps.
  private continues(ghost: Ghost, time: number, occupancy: Occupancy): boolean {
    const { wait } = ghost;
    const before = ghost.place;
    if (time + ghost.earlier > ghost.until) this.enter(ghost, ghost.run + 1);
    ghost.place += ghost.delta;
    const other = occupancy.on(ghost.place);
    const swapped = ghost.place === before ? -1 : comingFrom(occupancy, ghost.place, before);
    const met = other >= 0 && other !== wait.agent ? other : swapped;
    if (met < 0 || met === wait.agent) return time - ghost.from < kAhead;
    if (wait.firstMeetingPlace < 0) wait.firstMeetingPlace = ghost.place;
    if (!wait.met.includes(met)) wait.met.push(met);
    return false;
  }

  private enter(ghost: Ghost, run: number): void {
    const { track } = this.plan.agents[ghost.wait.agent];
    const isAtRest = run >= track.runs;
    ghost.run = run;
    ghost.delta = isAtRest ? 0 : track.deltas[run];
    ghost.until = isAtRest ? Infinity : track.times[run + 1];
  }

  // Returns the ghosts of a wait. They leave at times that are spread evenly over the wait, the first of
  // them at its start.
  private ghostsOf(wait: Wait): Ghost[] {
    const { track } = this.plan.agents[wait.agent];
    const steps = wait.end - wait.begin;
    const count = Math.min(steps, kMostGhosts);
    return Array.from({ length: count }, (_, i) => {
      const from = wait.begin + Math.floor((i * steps) / count);
      const { end, place } = wait;
      const ghost = { wait, from, earlier: end - from, place, run: 0, delta: 0, until: 0 };
      this.enter(ghost, track.run(wait.end));
      return ghost;
    });
  }
}

// Returns the robot that moved from `from` to `to` in the current step; -1: none.
function comingFrom(occupancy: Occupancy, from: number, to: number): number {
  const other = occupancy.on(to);
  return other >= 0 && occupancy.before[other] === from ? other : -1;
}

function waitsOf(plan: Plan, facts: PlanFacts, agent: number): Wait[] {
  const { track } = plan.agents[agent];
  if (track.isEmpty) return [];
  return facts.spans[agent]
    .filter((span) => span.doing === Doing.kWaiting)
    .map(({ begin, end }) =>
      ({ agent, begin, end, place: track.place(begin), met: [], firstMeetingPlace: -1 }));
}
