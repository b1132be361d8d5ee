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

function differenceText(app: App, difference: Difference): HTMLElement {
  const { costChange, hasOtherOrder, hasOtherTasks, firstDifference } = difference;
  if (Number.isNaN(costChange)) return el("p", {}, "One of the plans has no path for this robot.");
  const cost = costChange === 0 ? "It costs the same in both plans."
    : `It costs ${signed(costChange)} in the second plan.`;
  const visits = hasOtherTasks ? " It visits different tasks."
    : hasOtherOrder ? " It visits its tasks in a different order." : "";
  return el("p", {}, `${cost}${visits} They differ from step `,
    momentButton(firstDifference, () => app.go(firstDifference)), " on. Dashed: its path in the other plan.");
}

// Returns a table of the visits in the order of the first plan, followed by those of the second plan only. If the
// robot visits the same tasks in both, shows the position of a visit in the order of the second plan if it differs.
function visitsInBoth(app: App, agent: number): HTMLElement[] {
  const { model, viewed } = app;
  const [first, second] = viewed.map(({ plan }) =>
    visitsOf(model, plan.agents[agent], model.agents[agent]));
  const all = [...new Set([...first, ...second].map(({ task }) => task))];
  if (all.length === 0) return [];
  const isSame = first.length === all.length && second.length === all.length;
  const heads = viewed.map(({ plan }) => el("th", { scope: "col", title: plan.name }, plan.name));
  const rows = all.map((index, i) => {
    const [one, other] = [first, second].map((visits) => visits.find(({ task }) => task === index));
    const at = second.findIndex(({ task }) => task === index);
    const place = at === i || !isSame ? null
      : el("b", { title: "Its place in the order" }, ` ${ordinal(at + 1)}`);
    return el("tr", {},
      el("th", { scope: "row", dir: "auto" }, model.tasks[index].name),
      el("td", {}, moment(app, one)), el("td", {}, moment(app, other), place));
  });
  return [el("table", { class: "visits" },
    el("thead", {}, el("tr", {}, el("th", { scope: "col" }, "Visits"), ...heads)),
    el("tbody", {}, ...rows))];
}

function moment(app: App, visit: Visit | undefined): HTMLElement {
  if (!visit) return el("span", { class: "faint" }, "not its task");
  const { begin, time } = visit;
  return time === Infinity ? el("span", { class: "bad" }, "never")
    : momentButton(begin, () => app.go(begin));
}

// Returns an ordinal number, such as "2nd".
function ordinal(place: number): string {
  const ends = ["th", "st", "nd", "rd"];
  const last = place % 100 > 10 && place % 100 < 14 ? 0 : place % 10;
  return `${place}${ends[last] ?? "th"}`;
}
