// SPDX-License-Identifier: MIT
// The line at the top: what is shown, what each plan claims, and what the page found.

import type { App, Viewed } from "../app";
import { el, plural, setText } from "../dom";
import type { Plan } from "../model";

export class Strip {
  readonly element: HTMLElement;
  private readonly verdicts: HTMLElement[] = [];

  constructor(private readonly app: App) {
    const { model } = app;
    const counts = `${plural(model.agents.length, "robot")}, ${plural(model.tasks.length, "task")}`;
    this.element = el(
      "header",
      { class: "strip" },
      el("h1", {}, model.instance),
      el("span", { class: "faint" }, counts),
      ...model.plans.map((plan) => this.planCard(plan)),
    );
  }

  private planCard(plan: Plan): HTMLElement {
    const verdict = el("span", { class: "verdict" }, "checking …");
    this.verdicts.push(verdict);
    return el(
      "div",
      { class: "plan" },
      el("strong", {}, plan.name),
      ...claimsOf(plan).map(([name, value]) =>
        el("span", { class: "claim" }, el("span", { class: "faint" }, name), " ", value),
      ),
      plan.agents.length > 0 ? verdict : el("span", { class: "verdict" }, "no plan in this file"),
    );
  }

  update(): void {
    this.app.model.plans.forEach((plan, index) => {
      const viewed = this.app.viewed.find((v) => v.plan === plan);
      if (viewed) this.showVerdict(this.verdicts[index], viewed);
    });
  }

  private showVerdict(element: HTMLElement, viewed: Viewed): void {
    const { checker } = viewed;
    const found = checker.violations.length;
    const text = found > 0
      ? `✗ ${plural(found, "problem")}${checker.done ? "" : " so far"}`
      : checker.done ? "✓ valid, checked by this page" : "checking …";
    setText(element, text);
    element.classList.toggle("bad", found > 0);
    element.classList.toggle("good", found === 0 && checker.done);
  }
}

// What the file says of the plan, for people.
function claimsOf(plan: Plan): [string, string][] {
  const { status, cost, lower_bound, omega } = plan.claims;
  const claims: [string, string][] = [];
  if (status !== undefined) claims.push(["status", status]);
  if (cost !== undefined) claims.push(["cost", cost.toLocaleString("en")]);
  if (lower_bound !== undefined && lower_bound > 0) {
    claims.push(["bound", lower_bound.toLocaleString("en")]);
    if (cost !== undefined) claims.push(["gap", gapText(cost, lower_bound)]);
  }
  if (omega !== undefined && status === "bounded") claims.push(["omega", omega]);
  return claims;
}

function gapText(cost: number, bound: number): string {
  return `${((100 * (cost - bound)) / bound).toFixed(2)} %`;
}
