// SPDX-License-Identifier: MIT
// Details of the selected task: its place, the robots that must or may visit it, its visits with their times, and
// its progress.

import type { App } from "../app";
import { el, plural } from "../dom";
import { visitsBy } from "../facts";
import { hasChoice, type Model, type Task } from "../model";
import { listed } from "../names";
import { moments } from "./moments";

export function taskDetails(app: App, index: number): HTMLElement[] {
  const { model } = app;
  const task = model.tasks[index];
  const takes = task.duration > 0 ? `; takes ${plural(task.duration, "step")}` : "";
  const rows = app.viewed.flatMap(({ facts, plan }) => {
    const { agents, times } = facts.tasks[index];
    const title = app.viewed.length > 1 ? [el("h3", {}, plan.name)] : [];
    const describe = (i: number) => ({ time: times[i], text: model.agents[agents[i]].name });
    const missing = task.need - times.length;
    return [...title, moments(app, [...times.keys()], describe),
      ...(missing > 0 ? [el("p", { class: "bad" }, `${plural(missing, "visit")} missing`)] : [])];
  });
  const who = task.duration > 0 ? "Work ends, by" : "Visited, by";
  const order = task.need > 1 ? " (in this order)" : "";
  return [
    el("p", { class: "faint" }, `On ${model.world.place(task.place)}${takes}`),
    ...(hasChoice(task) ? [el("p", {}, needText(model, task))] : []),
    ...(app.viewed.length > 0 ? [el("h4", {}, who + order), ...rows]
      : hasChoice(task) ? []
      : [el("h4", {}, "To be visited by"), el("p", {}, names(model, task.agents))]),
  ];
}

// Returns a text such as "Needs 1 of 12 robots: any." or "Needs 2 of 3 robots: a, b, c.".
export function needText(model: Model, { agents, need }: Task): string {
  const which = agents.length === model.agents.length ? "any" : names(model, agents);
  return `Needs ${need} of ${plural(agents.length, "robot")}: ${which}.`;
}

function names(model: Model, agents: number[]): string {
  return listed(agents.map((agent) => model.agents[agent].name));
}

// Returns a text such as "2 of 3": the task needs 3 visits, and 2 robots have visited it; with a choice of robots
// "0 of 1 (any of 12)". For two plans it has one number for each: "2 / 1 of 3".
export function progressText(app: App, index: number): string {
  const task = app.model.tasks[index];
  const counts = app.viewed.map(({ facts }) => visitsBy(facts.tasks[index], app.player.time));
  const choice = hasChoice(task) ? ` (any of ${task.agents.length})` : "";
  return `${counts.length > 0 ? counts.join(" / ") : 0} of ${task.need}${choice}`;
}
