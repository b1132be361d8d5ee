// SPDX-License-Identifier: MIT
// What shapes and colours mean, and which heat is shown.

import type { App } from "../app";
import { el } from "../dom";
import type { Heat } from "../heat";

const kRobots: [string, string][] = [
  ["moving", "moving"], ["waiting", "waiting"], ["working", "at work"], ["resting", "at rest"],
  ["collision", "collision or wrong"],
];
const kTasks: [string, string][] = [
  ["task", "open task"], ["task begun", "begun"], ["task done", "done"],
];
const kHeats: [Heat, string][] = [
  ["none", "no heat map"],
  ["traffic", "heat: traffic"],
  ["waits", "heat: waits"],
  ["yields", "heat: conflicts avoided"],
];

// Of what there is nothing of, nothing is said.
function entriesOf({ model, viewed }: App): [string, string][] {
  const hasWork = model.tasks.some(({ duration }) => duration > 0);
  return [
    ...(viewed.length > 0 ? kRobots.filter(([kind]) => kind !== "working" || hasWork) : []),
    ...(model.tasks.length > 0 ? kTasks : []),
    ...(model.agents.some(({ goal }) => goal >= 0) ? [["goal", "destination"] as [string, string]] : []),
  ];
}

export function legend(app: App): HTMLElement {
  const heat: HTMLSelectElement = el("select", {
    "aria-label": "Heat map", change: () => app.set({ heat: heat.value as Heat }),
  }, ...kHeats.map(([value, text]) => el("option", { value }, text)));
  return el("section", { class: "legend", "aria-label": "Legend" },
    ...entriesOf(app).map(([kind, text]) => el("span", { class: "entry" }, el("i", { class: kind }), text)),
    ...(app.viewed.length > 0 ? [heat] : []));
}
