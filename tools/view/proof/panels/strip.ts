// SPDX-License-Identifier: MIT
// The line at the top: the theorem, what it implies for the plan, and the command that verifies the
// certificate.

import { el } from "../../page/dom";
import { planFacts } from "../../page/facts";
import { nameOf } from "../../page/names";
import type { ProofApp } from "../app";
import { howText, numberText, planText, theoremText } from "../words";

export function strip({ model, certificate }: ProofApp, file: string): HTMLElement {
  const [plan] = model.plans.filter(({ agents }) => agents.length > 0);
  const command = `grove-verify ${model.instance} ${nameOf(file)}`;
  return el("header", { class: "strip" },
    el("h1", {}, theoremText(certificate)),
    el("span", {}, howText(certificate)),
    plan ? planLine(plan.name, planFacts(model, plan).cost, certificate.theorem.bound) : null,
    el("span", { class: "faint" }, "This page shows the certificate; ",
      el("code", {}, command), " verifies it."));
}

function planLine(name: string, cost: number, bound: number): HTMLElement {
  return el("span", { class: cost < bound ? "verdict bad" : "verdict" },
    `${name} costs ${numberText(cost)}, ${planText(cost, bound)}`);
}
