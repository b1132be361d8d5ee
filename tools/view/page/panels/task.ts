// SPDX-License-Identifier: MIT
// Details of the selected task: its place, its visits with their times, and its progress.

import type { App } from "../app";
import { el, plural } from "../dom";
import { visitsBy } from "../facts";
import { moments } from "./moments";

export function taskDetails(app: App, index: number): HTMLElement[] {
  const { model } = app;
  const task = model.tasks[index];
  const takes = task.duration > 0 ? `; takes ${plural(task.duration, "step")}` : "";
  const rows = app.viewed.flatMap(({ facts, plan }) => {
    const { agents, times } = facts.tasks[index];
    const title = app.viewed.length > 1 ? [el("h3", {}, plan.name)] : [];
    const describe = (i: number) => ({ time: times[i], text: model.agents[agents[i]].name });
    return [...title, moments(app, [...times.keys()], describe)];
  });
  const who = task.duration > 0 ? "Work ends, by" : "Visited, by";
  const order = task.agents.length > 1 ? " (in this order)" : "";
  return [
    el("p", { class: "faint" }, `On ${model.world.place(task.place)}${takes}`),
    el("h4", {}, app.viewed.length > 0 ? who + order : "To be visited by"),
    ...(app.viewed.length > 0 ? rows : [el("p", {}, names(app, task.agents))]),
  ];
}

function names(app: App, agents: number[]): string {
  const some = agents.slice(0, 20).map((agent) => app.model.agents[agent].name).join(", ");
  return agents.length > 20 ? `${some} and ${plural(agents.length - 20, "more")}` : some;
}

// Returns a text such as "2 of 3": 2 of the 3 robots that must visit the task have visited it. For two plans
// it has one number for each: "2 / 1 of 3".
export function progressText(app: App, task: number): string {
  const total = app.model.tasks[task].agents.length;
  const counts = app.viewed.map(({ facts }) => visitsBy(facts.tasks[task], app.player.time));
  return `${counts.length > 0 ? counts.join(" / ") : 0} of ${total}`;
}
