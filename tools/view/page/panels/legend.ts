// SPDX-License-Identifier: MIT
// What shapes and colours mean, and which heat is shown.

import type { App } from "../app";
import { el } from "../dom";
import type { Heat } from "../heat";

const kEntries: [string, string][] = [
  ["moving", "moving"], ["waiting", "waiting"], ["working", "at work"], ["resting", "at rest"],
  ["collision", "collision or wrong"],
  ["task", "open task"], ["task begun", "begun"], ["task done", "done"],
  ["goal", "destination"],
];
const kHeats: [Heat, string][] = [
  ["none", "no heat map"],
  ["traffic", "heat: traffic"],
  ["waits", "heat: waits"],
  ["yields", "heat: conflicts avoided"],
];

export function legend(app: App): HTMLElement {
  const heat: HTMLSelectElement = el("select", {
    "aria-label": "Heat map", change: () => app.set({ heat: heat.value as Heat }),
  }, ...kHeats.map(([value, text]) => el("option", { value }, text)));
  return el("section", { class: "legend", "aria-label": "Legend" },
    ...kEntries.map(([kind, text]) => el("span", { class: "entry" }, el("i", { class: kind }), text)),
    ...(app.viewed.length > 0 ? [heat] : []));
}
