// SPDX-License-Identifier: MIT
// The selected robot in two plans: the differences, and the times of its visits in both plans.

import type { App } from "../app";
import type { Difference } from "../compare";
import { el } from "../dom";
import { visitsOf, type Visit } from "../facts";
import { signed } from "./differences";
import { momentButton } from "./rows";

export function comparedDetails(app: App, agent: number): HTMLElement[] {
  const { comparison } = app;
  if (!comparison) return [];
  const found = comparison.all.find((difference) => difference.agent === agent);
  const text = found ? differenceText(app, found)
    : el("p", { class: "faint" }, "It behaves the same in both plans.");
  return [text, ...visitsInBoth(app, agent)];
}

function differenceText(app: App, { costChange, hasOtherOrder, firstDifference }: Difference): HTMLElement {
  if (Number.isNaN(costChange)) return el("p", {}, "One of the plans has no path for this robot.");
  const cost = costChange === 0 ? "It costs the same in both plans."
    : `It costs ${signed(costChange)} in the second plan.`;
  const order = hasOtherOrder ? " It visits its tasks in a different order." : "";
  return el("p", {}, `${cost}${order} They differ from step `,
    momentButton(firstDifference, () => app.go(firstDifference)), " on. Dashed: its path in the other plan.");
}

// Returns a table of the visits in the order of the first plan. Shows the position of a visit in the order of
// the second plan if it differs.
function visitsInBoth(app: App, agent: number): HTMLElement[] {
  const { model, viewed } = app;
  const [first, second] = viewed.map(({ plan }) =>
    visitsOf(model, plan.agents[agent], model.agents[agent]));
  if (first.length === 0) return [];
  const heads = viewed.map(({ plan }) => el("th", { scope: "col", title: plan.name }, plan.name));
  const rows = first.map((visit, i) => {
    const at = second.findIndex(({ task }) => task === visit.task);
    const place = at === i ? null
      : el("b", { title: "Its place in the order" }, ` ${ordinal(at + 1)}`);
    return el("tr", {},
      el("th", { scope: "row", dir: "auto" }, `${visit.task + 1}: ${model.tasks[visit.task].name}`),
      el("td", {}, moment(app, visit)), el("td", {}, moment(app, second[at]), place));
  });
  return [el("table", { class: "visits" },
    el("thead", {}, el("tr", {}, el("th", { scope: "col" }, "Visits"), ...heads)),
    el("tbody", {}, ...rows))];
}

function moment(app: App, { begin, time }: Visit): HTMLElement {
  return time === Infinity ? el("span", { class: "bad" }, "never")
    : momentButton(begin, () => app.go(begin));
}

// Returns an ordinal number, such as "2nd".
function ordinal(place: number): string {
  const ends = ["th", "st", "nd", "rd"];
  const last = place % 100 > 10 && place % 100 < 14 ? 0 : place % 10;
  return `${place}${ends[last] ?? "th"}`;
}
