// SPDX-License-Identifier: MIT
// Facts computed from the paths of a plan: activities of robots and visits of tasks, with their times.

import { hasChoice, hasStatedVisits } from "./model";
import type { Agent, AgentPlan, Model, Plan, Task } from "./model";

export enum Doing {
  kMoving,
  kWaiting,
  kWorking,
  kResting,
}

export interface Span {
  doing: Doing;
  begin: number;
  end: number; // Infinity: forever
  task: number; // the task that is executed; -1: none
}

// Returns the time at which the agent comes to rest: the end of its last move, turn or task execution.
export function finish(plan: AgentPlan): number {
  let time = lastChange(plan);
  for (const work of plan.work) time = Math.max(time, work.end);
  return time;
}

function lastChange(plan: AgentPlan): number {
  const { track, turns } = plan;
  let last = 0;
  for (let run = track.runs - 1; run >= 0; --run)
    if (track.deltas[run] !== 0) {
      last = track.times[run + 1];
      break;
    }
  if (turns)
    for (let run = turns.runs - 1; run >= 0; --run)
      if (turns.deltas[run] !== 0 || turns.jumps[run]) return Math.max(last, turns.times[run + 1]);
  return last;
}

// Returns the activities of an agent from time 0 on, as consecutive spans. The last one is rest forever.
export function spans(plan: AgentPlan): Span[] {
  const all: Span[] = [];
  const add = (doing: Doing, begin: number, end: number, task = -1) => {
    if (begin >= end) return;
    const last = all[all.length - 1];
    if (last && last.doing === doing && last.end === begin && last.task === task) last.end = end;
    else all.push({ doing, begin, end, task });
  };
  const rest = finish(plan);
  const works = [...plan.work].sort((a, b) => a.begin - b.begin);
  const moves = movingTimes(plan);
  let time = 0;
  let move = 0;
  // Adds moves, and waits between them, from `time` to `end`.
  const walk = (end: number) => {
    while (time < end) {
      while (move < moves.length && moves[move][1] <= time) ++move;
      const next = move < moves.length ? moves[move] : null;
      if (next && next[0] <= time) {
        const until = Math.min(end, next[1]);
        add(Doing.kMoving, time, until);
        time = until;
      } else {
        const until = Math.min(end, next ? next[0] : end);
        add(Doing.kWaiting, time, until);
        time = until;
      }
    }
  };
  for (const work of works) {
    walk(Math.min(rest, Math.max(0, work.begin)));
    const end = Math.max(time, work.end);
    add(Doing.kWorking, time, end, work.task);
    time = end;
  }
  walk(rest);
  all.push({ doing: Doing.kResting, begin: time, end: Infinity, task: -1 });
  return all;
}

// Returns the periods in which the agent moves or turns, in order.
function movingTimes(plan: AgentPlan): [number, number][] {
  const pieces: [number, number][] = [];
  const { track, turns } = plan;
  for (let run = 0; run < track.runs; ++run)
    if (track.deltas[run] !== 0) pieces.push([track.times[run], track.times[run + 1]]);
  if (turns)
    for (let run = 0; run < turns.runs; ++run)
      if (turns.deltas[run] !== 0 || turns.jumps[run])
        pieces.push([turns.times[run], turns.times[run + 1]]);
  pieces.sort((a, b) => a[0] - b[0]);
  const merged: [number, number][] = [];
  for (const piece of pieces) {
    const last = merged[merged.length - 1];
    if (last && last[1] >= piece[0]) last[1] = Math.max(last[1], piece[1]);
    else merged.push([piece[0], piece[1]]);
  }
  return merged;
}

// Returns the time of the agent's visit of a task: the end of the visit that the plan states or, for a task of
// which it states no visits, the first time on its place; Infinity: never.
export function visitTime(model: Model, plan: AgentPlan, index: number): number {
  const task = model.tasks[index];
  if (!hasStatedVisits(task)) return plan.track.firstTimeOn(task.place, 0);
  const work = plan.work.find((w) => w.task === index);
  return work ? work.end : Infinity;
}

export interface TaskFacts {
  agents: number[]; // in order of their visits; of a task with a choice of robots only those that visit it
  times: number[]; // of the visits, ascending; Infinity: never
  begin: number; // time of the first visit or, if earlier, start of the first execution; Infinity: never
}

export interface PlanFacts {
  finish: number[]; // by agent
  spans: Span[][]; // by agent
  tasks: TaskFacts[];
  destinations: number[]; // by agent; -1: none, or none of those that it may choose
  cost: number;
}

export function planFacts(model: Model, plan: Plan): PlanFacts {
  const finishes = plan.agents.map(finish);
  const workers = workersOf(model, plan);
  return {
    finish: finishes,
    spans: plan.agents.map(spans),
    tasks: model.tasks.map((task, index) => taskFacts(model, plan, task, index, workers[index])),
    destinations: destinationsOf(model, plan),
    cost: finishes.reduce((sum, time) => sum + time, 0),
  };
}

// Returns the destination of each agent or, if it has a choice, the one on which it rests; -1: none.
export function destinationsOf({ agents }: Model, plan: Plan): number[] {
  return plan.agents.map(({ track }, agent) => {
    const { goal, goals } = agents[agent];
    const end = track.isEmpty ? -1 : track.place(track.end);
    return goal >= 0 ? goal : goals.includes(end) ? end : -1;
  });
}

// Returns, for each task, the agents of which the plan states a visit.
function workersOf(model: Model, plan: Plan): Set<number>[] {
  const workers = model.tasks.map(() => new Set<number>());
  plan.agents.forEach(({ work }, agent) => work.forEach(({ task }) => workers[task].add(agent)));
  return workers;
}

function taskFacts(
  model: Model, plan: Plan, task: Task, index: number, workers: Set<number>,
): TaskFacts {
  const agents = task.agents.filter((agent) => !hasChoice(task) || workers.has(agent));
  const visits = agents
    .map((agent) => ({ agent, time: visitTime(model, plan.agents[agent], index) }))
    .sort((a, b) => a.time - b.time || a.agent - b.agent);
  const works = agents.filter((agent) => workers.has(agent))
    .flatMap((agent) => plan.agents[agent].work)
    .filter((work) => work.task === index).map((work) => work.begin);
  const begin = [...works, visits[0]?.time ?? Infinity].reduce((a, b) => Math.min(a, b));
  return { agents: visits.map((v) => v.agent), times: visits.map((v) => v.time), begin };
}

// Returns the time at which as many agents have visited the task as it needs; Infinity: never.
export function doneTime({ need }: Task, { times }: TaskFacts): number {
  return times[need - 1] ?? Infinity;
}

// Returns the number of agents that have visited the task by `time`.
export function visitsBy(facts: TaskFacts, time: number): number {
  let count = 0;
  while (count < facts.times.length && facts.times[count] <= time) ++count;
  return count;
}

export interface Visit {
  task: number;
  begin: number; // start of the execution, at least 0; without an execution, equal to `time`
  time: number; // of the visit; Infinity: never
}

// Returns the agent's visits of the tasks that it must visit, and of those that it visits by choice, in order of
// time.
export function visitsOf(model: Model, plan: AgentPlan, agent: Agent): Visit[] {
  return [...new Set([...agent.tasks, ...plan.work.map(({ task }) => task)])]
    .map((task) => {
      const time = visitTime(model, plan, task);
      const work = plan.work.find((w) => w.task === task);
      return { task, time, begin: work ? Math.max(0, work.begin) : time };
    })
    .sort((a, b) => a.time - b.time || a.task - b.task);
}
