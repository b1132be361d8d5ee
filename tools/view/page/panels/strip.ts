// SPDX-License-Identifier: MIT
// The line at the top: the instance and, for each plan, its cost, its claims and the verdict of the page.

import type { App, PlanView } from "../app";
import { el, plural, setText } from "../dom";
import type { Plan } from "../model";
import { signed } from "./differences";

export class Strip {
  readonly element: HTMLElement;
  private readonly verdicts: { viewed: PlanView; element: HTMLElement }[] = [];

  constructor(private readonly app: App) {
    const { model } = app;
    const counts = `${plural(model.agents.length, "robot")}, ${plural(model.tasks.length, "task")}`;
    const many = model.plans.length > 1 ? "plans several" : "plans";
    this.element = el("header", { class: "strip" },
      el("h1", {}, model.instance),
      el("span", { class: "faint" }, counts),
      el("div", { class: many }, ...model.plans.map((plan) => this.row(plan))));
  }

  update(): void {
    for (const { viewed, element } of this.verdicts) showVerdict(element, viewed);
  }

  // Returns the row of a plan. All plans have the same cells, so that these are aligned.
  private row(plan: Plan): HTMLElement {
    const viewed = this.app.viewed.find((v) => v.plan === plan);
    const { status, lower_bound: bound, omega } = plan.claims;
    const cost = plan.claims.cost ?? foundCost(viewed);
    const isBounded = bound !== undefined && bound > 0;
    return el("div", { class: "plan" },
      el("strong", { title: plan.name }, plan.name),
      cell("status", status === "bounded" ? `${status}, omega ${omega}` : status),
      cell("cost", costText(cost, foundCost(viewed)), this.difference(viewed)),
      cell("bound", isBounded ? bound.toLocaleString("en") : undefined),
      cell("gap", isBounded && cost !== undefined ? gapText(cost, bound) : undefined),
      this.verdict(plan, viewed));
  }

  // Returns the difference between the costs of the second and the first plan, as computed by the page; empty
  // for the first plan.
  private difference(viewed: PlanView | undefined): string {
    const { comparison } = this.app;
    if (!comparison || viewed !== this.app.viewed[1]) return "";
    const { costChange, costs } = comparison;
    if (Number.isNaN(costChange)) return "";
    if (costs[0] === 0 || costChange === 0) return ` (${signed(costChange)})`;
    return ` (${signed(costChange)}, ${signed(Number(((100 * costChange) / costs[0]).toFixed(2)))} %)`;
  }

  private verdict(plan: Plan, viewed: PlanView | undefined): HTMLElement {
    if (plan.agents.length === 0) return el("span", { class: "verdict" }, "no plan in this file");
    if (!viewed) return el("span", { class: "faint" }, "not shown: the page shows two plans");
    const element = el("span", { class: "verdict", role: "status" }, "checking …");
    this.verdicts.push({ viewed, element });
    return element;
  }
}

// Returns the cost that the page has computed; undefined if a path is missing.
function foundCost(viewed: PlanView | undefined): number | undefined {
  if (!viewed || viewed.plan.agents.some(({ track }) => track.isEmpty)) return undefined;
  return viewed.facts.cost;
}

function costText(cost: number | undefined, found: number | undefined): string | undefined {
  const text = cost?.toLocaleString("en");
  if (found === undefined || found === cost) return text;
  return `${text} claimed, ${found.toLocaleString("en")} found`;
}

// Creates a cell with name and value; empty if the plan does not claim the value.
function cell(name: string, value: string | undefined, more = ""): HTMLElement {
  if (value === undefined) return el("span", { class: "claim" });
  return el("span", { class: "claim" }, el("span", { class: "faint" }, name), ` ${value}`,
    more === "" ? null : el("b", {}, more));
}

function showVerdict(element: HTMLElement, { checker }: PlanView): void {
  const found = checker.violations.length;
  const text = found > 0
    ? `✗ ${plural(found, "problem")}${checker.done ? "" : " so far"}`
    : checker.done ? "✓ valid, checked by this page" : "checking …";
  setText(element, text);
  element.classList.toggle("bad", found > 0);
  element.classList.toggle("good", found === 0 && checker.done);
}

function gapText(cost: number, bound: number): string {
  return `${((100 * (cost - bound)) / bound).toFixed(2)} %`;
}
