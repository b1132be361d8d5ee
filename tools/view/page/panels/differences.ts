// SPDX-License-Identifier: MIT
// List of the robots that differ between the two plans: both costs, their difference, and the first time at
// which the plans differ.

import type { App } from "../app";
import type { Comparison, Difference } from "../compare";
import { el, plural } from "../dom";
import { momentButton, type Row } from "./rows";

type Order = "cost" | "moment" | "name";
const kOrders: [Order, string][] = [
  ["cost", "largest difference first"],
  ["moment", "earliest difference first"],
  ["name", "by number"],
];

export class Differences {
  readonly filters: HTMLElement;
  private readonly order: HTMLSelectElement;

  constructor(
    private readonly app: App,
    private readonly comparison: Comparison,
    changed: () => void,
  ) {
    this.order = el("select", { "aria-label": "Sort order", change: () => changed() },
      ...kOrders.map(([value, text]) => el("option", { value }, text)));
    this.filters = el("div", {}, el("p", {}, this.summary()),
      ...(comparison.all.length > 0 ? [el("div", { class: "filter" }, this.order)] : []));
  }

  private summary(): string {
    const { all, costChange } = this.comparison;
    const total = plural(this.app.model.agents.length, "robot");
    const verb = all.length === 1 ? "differs" : "differ";
    const robots = `${all.length.toLocaleString("en")} of ${total} ${verb}.`;
    const [first, second] = this.app.viewed.map(({ plan }) => plan.name);
    if (Number.isNaN(costChange)) return `${robots} The costs cannot be compared because paths are missing.`;
    if (costChange === 0) return `${robots} Both plans cost the same.`;
    const more = `${Math.abs(costChange).toLocaleString("en")} ${costChange > 0 ? "more" : "less"}`;
    return `${robots} ${second} costs ${more} than ${first}.`;
  }

  rows(): Row[] {
    const { app } = this;
    return sorted(this.comparison.all, this.order.value as Order).map((difference) => {
      const { agent, firstDifference } = difference;
      const { id, name } = app.model.agents[agent];
      const go = () => app.show(firstDifference, agent);
      return {
        key: id.toLowerCase(),
        text: name,
        note: () => costsText(difference),
        act: () => app.choose(agent),
        more: Number.isFinite(firstDifference)
          ? momentButton(firstDifference, go, `Go to step ${firstDifference}, the first difference`) : undefined,
      };
    });
  }
}

function sorted(all: Difference[], order: Order): Difference[] {
  const size = ({ costChange }: Difference) => (Number.isNaN(costChange) ? Infinity : Math.abs(costChange));
  switch (order) {
    case "cost":
      return [...all].sort((a, b) => compareNumbers(size(b), size(a)) || a.firstDifference - b.firstDifference);
    case "moment": return [...all].sort((a, b) => compareNumbers(a.firstDifference, b.firstDifference));
    case "name": return all;
  }
}

// Compares numbers for sorting. A difference would not do, because it is NaN for two infinite values.
function compareNumbers(a: number, b: number): number {
  return a < b ? -1 : a > b ? 1 : 0;
}

// Returns a text such as "96 → 97 (+1), different order".
export function costsText({ costs, costChange, hasOtherOrder, hasOtherTasks }: Difference): string {
  const [a, b] = costs.map((cost) => (Number.isNaN(cost) ? "no path" : String(cost)));
  const change = Number.isNaN(costChange) ? "" : ` (${signed(costChange)})`;
  const visits = hasOtherTasks ? ", different tasks" : hasOtherOrder ? ", different order" : "";
  return `${a} → ${b}${change}${visits}`;
}

export function signed(difference: number): string {
  const sign = difference > 0 ? "+" : difference < 0 ? "−" : "±";
  return sign + Math.abs(difference).toLocaleString("en");
}
