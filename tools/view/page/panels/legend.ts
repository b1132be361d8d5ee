// SPDX-License-Identifier: MIT
// Legend of shapes and colours, and a selector for the heat map.

import type { App } from "../app";
import { el } from "../dom";
import type { Heat } from "../heat";
import { hasChoice, hasDestination, type Model } from "../model";

type Entry = [string, string]; // CSS class and text

const kRobots: Entry[] = [
  ["moving", "moving"], ["waiting", "waiting"], ["working", "at work"], ["resting", "at rest"],
  ["collision", "collision or violation"],
];
const kTasks: Entry[] = [
  ["task", "open task"], ["task begun", "begun"], ["task done", "done"],
];
const kHeats: [Heat, string][] = [
  ["none", "no heat map"],
  ["traffic", "heat: traffic"],
  ["waits", "heat: waits"],
  ["yields", "heat: conflicts avoided"],
];
const kTaskChoice: Entry = ["task choice", "needs only some robots"];
const kGoal: Entry = ["goal", "destination"];
const kGoalChoice: Entry = ["goal choice", "possible destination"];

// Returns the legend entries for robots, tasks and destinations. Leaves out those that the instance does not
// have.
export function entriesOf(model: Model, robots: Entry[]): Entry[] {
  const hasWork = model.tasks.some(({ duration }) => duration > 0);
  return [
    ...robots.filter(([kind]) => kind !== "working" || hasWork),
    ...(model.tasks.length > 0 ? kTasks : []),
    ...(model.tasks.some(hasChoice) ? [kTaskChoice] : []),
    ...(model.agents.some(hasDestination) ? [kGoal] : []),
    ...(model.agents.some(({ goals }) => goals.length > 0) ? [kGoalChoice] : []),
  ];
}

export function legend(app: App): HTMLElement {
  const heat: HTMLSelectElement = el("select", {
    "aria-label": "Heat map", change: () => app.set({ heat: heat.value as Heat }),
  }, ...kHeats.map(([value, text]) => el("option", { value }, text)));
  const hasPlans = app.viewed.length > 0;
  return legendOf(entriesOf(app.model, hasPlans ? kRobots : []), ...(hasPlans ? [heat] : []));
}

export function legendOf(entries: Entry[], ...more: HTMLElement[]): HTMLElement {
  return el("section", { class: "legend", "aria-label": "Legend" },
    ...entries.map(([kind, text]) => el("span", { class: "entry" }, el("i", { class: kind }), text)),
    ...more);
}
