// SPDX-License-Identifier: MIT
// Events of a plan, for a list of times to jump to: violations, long waits and their causes, completed tasks,
// and robots that come to rest.

import type { App, PlanView } from "./app";
import { plural } from "./dom";
import { doneTime } from "./facts";
import { hasChoice, type Model } from "./model";
import type { Wait } from "./waiting";

export type EventKind = "wrong" | "wait" | "task" | "rest";

export interface PlanEvent {
  kind: EventKind;
  time: number;
  text: string;
  agents: number[];
  task?: number; // of an event without agents
}

const kLongWait = 3; // steps; shorter waits are listed only for the selected robot
const kMostNames = 3;

// Returns the events of all plans: first the violations, then all other events, both in order of time.
export function eventsOf(app: App): PlanEvent[] {
  const [first, second] = app.viewed.map((viewed) => eventsOfPlan(app.model, viewed));
  const all = second ? merged(app, first, second) : first ?? [];
  const rank = (event: PlanEvent) => (event.kind === "wrong" ? 0 : 1);
  return all.sort((a, b) => rank(a) - rank(b) || a.time - b.time);
}

// Merges the events of two plans. Lists an event of both plans once. Adds its plan, or "both plans", to each.
function merged(app: App, first: PlanEvent[], second: PlanEvent[]): PlanEvent[] {
  const key = ({ kind, text, time }: PlanEvent) => `${kind} ${time} ${text}`;
  const lists = [first, second];
  const keys = lists.map((events) => new Set(events.map(key)));
  return lists.flatMap((events, i) => events.flatMap((event): PlanEvent[] => {
    const isInBoth = keys[1 - i].has(key(event));
    if (isInBoth && i === 1) return [];
    const where = isInBoth ? "both plans" : app.viewed[i].plan.name;
    return [{ ...event, text: `${event.text} (${where})` }];
  }));
}

function eventsOfPlan(model: Model, { checker, facts, plan, waits }: PlanView): PlanEvent[] {
  const { agents, tasks } = model;
  const wrong = checker.violations.map(({ time, text, agents, task }): PlanEvent =>
    ({ kind: "wrong", time, text, agents, task }));
  const isLong = (wait: Wait) => wait.end - wait.begin >= kLongWait;
  const long = waits.all.filter(isLong).map((wait): PlanEvent =>
    ({ kind: "wait", time: wait.begin, agents: [wait.agent],
      text: `${agents[wait.agent].name} waits ${waitText(model, wait)}` }));
  const done = tasks.map((task, index): PlanEvent => {
    const last = facts.tasks[index].agents.slice(task.need - 1, task.need);
    const by = hasChoice(task) ? last.map((agent) => ` by ${agents[agent].name}`).join("") : "";
    return { kind: "task", time: doneTime(task, facts.tasks[index]), agents: last,
      text: `${task.name} is done${by}` };
  });
  const rest = facts.finish.map((time, agent): PlanEvent =>
    ({ kind: "rest", time: plan.agents[agent].track.isEmpty ? Infinity : time, agents: [agent],
      text: `${agents[agent].name} comes to rest` }));
  return [...wrong, ...long, ...done, ...rest].filter((event) => Number.isFinite(event.time));
}

// Returns the duration and cause of a wait, such as "6 steps for a7 to pass".
export function waitText(model: Model, wait: Wait): string {
  const steps = plural(wait.end - wait.begin, "step");
  const names = wait.met.slice(0, kMostNames).map((other) => model.agents[other].name);
  if (names.length === 0) return `${steps}, although no robot is in its way`;
  if (wait.met.length > kMostNames) return `${steps} for ${names.join(", ")} and others to pass`;
  const last = names.pop()!;
  return `${steps} for ${names.length > 0 ? `${names.join(", ")} and ${last}` : last} to pass`;
}
