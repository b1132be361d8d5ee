// SPDX-License-Identifier: MIT
// Who waits for whom: for each wait, whom the robot would have met had it gone on instead. That is
// played through: ghosts of it leave during the wait, and each is followed until it meets somebody.

import { Crowd } from "./crowd";
import { Doing, type PlanFacts } from "./facts";
import type { Model, Plan } from "./model";

export interface Wait {
  agent: number;
  begin: number;
  end: number;
  place: number;
  for: number[]; // whom it would have met, in order of time
  meets: number; // where it would have met the first of them; -1: nobody
}

const kMostGhosts = 8; // of one wait
const kAhead = 40; // steps that a ghost is followed

interface Ghost {
  wait: Wait;
  left: number; // how many steps earlier than the robot itself
  from: number; // the step at which it leaves
  place: number;
  run: number; // of the robot's track, for the next look
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

  // Works for about so long; true when all is known.
  step(milliseconds: number): boolean {
    const until = performance.now() + milliseconds;
    while (!this.done && performance.now() < until) this.done = this.parts.next().done ?? false;
    return this.done;
  }

  private *find(): Generator<void> {
    const crowd = new Crowd(this.plan, this.model.world.places);
    const waiting = this.all.flatMap(ghostsOf).sort((a, b) => a.from - b.from);
    let next = 0;
    let ghosts: Ghost[] = [];
    for (let time = 0; next < waiting.length || ghosts.length > 0; ++time) {
      crowd.advance(() => {});
      ghosts = ghosts.filter((ghost) => this.goesOn(ghost, time, crowd));
      while (next < waiting.length && waiting[next].from === time) ghosts.push(waiting[next++]);
      yield;
    }
  }

  // A ghost takes its step to `time`; false: it has met somebody, or has gone far enough.
  private goesOn(ghost: Ghost, time: number, crowd: Crowd): boolean {
    const { wait } = ghost;
    const { track } = this.plan.agents[wait.agent];
    const before = ghost.place;
    ghost.run = track.run(time + ghost.left, ghost.run);
    ghost.place = track.place(time + ghost.left, ghost.run);
    const other = crowd.on(ghost.place);
    const swapped = ghost.place === before ? -1 : comingFrom(crowd, ghost.place, before);
    const met = other >= 0 && other !== wait.agent ? other : swapped;
    if (met < 0 || met === wait.agent) return time - ghost.from < kAhead;
    if (wait.meets < 0) wait.meets = ghost.place;
    if (!wait.for.includes(met)) wait.for.push(met);
    return false;
  }
}

// Who has just gone from the one place to the other; -1: nobody.
function comingFrom(crowd: Crowd, from: number, to: number): number {
  const other = crowd.on(to);
  return other >= 0 && crowd.before[other] === from ? other : -1;
}

function waitsOf(plan: Plan, facts: PlanFacts, agent: number): Wait[] {
  const { track } = plan.agents[agent];
  if (track.isEmpty) return [];
  return facts.spans[agent]
    .filter((span) => span.doing === Doing.kWaiting)
    .map(({ begin, end }) => ({ agent, begin, end, place: track.place(begin), for: [], meets: -1 }));
}

// They leave at moments spread evenly over the wait.
function ghostsOf(wait: Wait): Ghost[] {
  const steps = wait.end - wait.begin;
  const count = Math.min(steps, kMostGhosts);
  return Array.from({ length: count }, (_, i) => {
    const from = wait.begin + Math.floor((i * steps) / count);
    return { wait, from, left: wait.end - from, place: wait.place, run: 0 };
  });
}
