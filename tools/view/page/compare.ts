// SPDX-License-Identifier: MIT
// Differences between two plans for the same instance, robot by robot.

import type { PlanView } from "./app";
import { visitsOf } from "./facts";
import type { AgentPlan, Model } from "./model";
import type { Track, TurnTrack } from "./track";

export interface Difference {
  agent: number;
  costs: [number, number]; // in the first and second plan; NaN: no path
  costChange: number; // second cost minus first cost; NaN: one plan has no path
  firstDifference: number; // first time at which the plans differ for this robot; Infinity: never
  hasOtherTasks: boolean; // whether the robot visits other tasks
  hasOtherOrder: boolean; // whether it visits the same tasks in another order
}

export interface Comparison {
  all: Difference[]; // only robots that differ, by ascending number
  costs: [number, number];
  costChange: number; // second cost minus first cost; NaN: a robot has no path in one of the plans
}

export function compare(model: Model, one: PlanView, other: PlanView): Comparison {
  const all: Difference[] = [];
  const costs: [number, number] = [one.facts.cost, other.facts.cost];
  let complete = true;
  model.agents.forEach((agent, index) => {
    const [a, b] = [one.plan.agents[index], other.plan.agents[index]];
    if (a.track.isEmpty || b.track.isEmpty) complete = false;
    const cost = (viewed: PlanView) =>
      viewed.plan.agents[index].track.isEmpty ? NaN : viewed.facts.finish[index];
    const both: [number, number] = [cost(one), cost(other)];
    const costChange = both[1] - both[0];
    const firstDifference = partingTime(a, b);
    if (firstDifference === Infinity && a.track.isEmpty === b.track.isEmpty) return;
    const [first, second] = [a, b].map((plan) => visitsOf(model, plan, agent).map((v) => v.task));
    const known = new Set(first);
    const hasOtherTasks = first.length !== second.length || second.some((task) => !known.has(task));
    const hasOtherOrder = !hasOtherTasks && first.join() !== second.join();
    all.push({ agent: index, costs: both, costChange, firstDifference, hasOtherTasks, hasOtherOrder });
  });
  return { all, costs, costChange: complete ? costs[1] - costs[0] : NaN };
}

// Returns the first time at which places, headings or task executions differ; Infinity: never.
export function partingTime(a: AgentPlan, b: AgentPlan): number {
  if (a.track.isEmpty || b.track.isEmpty) return a.track.isEmpty && b.track.isEmpty ? Infinity : 0;
  const turns = a.turns && b.turns ? parting(a.turns, b.turns, (t, at) => t.heading(at)) : Infinity;
  const places = parting(a.track, b.track, (t, at) => t.place(at));
  return Math.min(places, turns, partingOfWork(a, b));
}

// Returns the first time at which the values of two tracks differ; Infinity: never. Compares only where
// a run starts: until the next run starts, equal values with equal steps stay equal.
function parting<T extends Track | TurnTrack>(
  a: T, b: T, value: (track: T, time: number) => number,
): number {
  let [i, j] = [0, 0];
  for (let time = 0; ; ) {
    if (value(a, time) !== value(b, time)) return time;
    if (stepOf(a, i) !== stepOf(b, j)) return time + 1;
    const endA = i < a.runs ? a.times[i + 1] : Infinity;
    const endB = j < b.runs ? b.times[j + 1] : Infinity;
    time = Math.min(endA, endB);
    if (time === Infinity) return Infinity;
    if (endA === time) ++i;
    if (endB === time) ++j;
  }
}

// Returns the change per step in a run; 0 after the last run, because the robot rests.
function stepOf(track: Track | TurnTrack, run: number): number {
  return run < track.runs && !(track.jumps[run] && !track.deltas[run]) ? track.deltas[run] : 0;
}

function partingOfWork(a: AgentPlan, b: AgentPlan): number {
  const key = (work: { task: number; begin: number; end: number }) =>
    `${work.task} ${work.begin} ${work.end}`;
  const begins = (of: AgentPlan, without: AgentPlan) => {
    const known = new Set(without.work.map(key));
    return of.work.filter((work) => !known.has(key(work))).map((work) => Math.max(0, work.begin));
  };
  return [...begins(a, b), ...begins(b, a)].reduce((x, y) => Math.min(x, y), Infinity);
}
