// SPDX-License-Identifier: MIT
// The step chosen: what it says, why, and what is demanded there.

import { el } from "../../page/dom";
import type { ProofApp } from "../app";
import { demandsAt, usersOf, type Statement, type Step } from "../certificate";
import { agentsText, closedText, demandText, lemmaText, stepText, whyText } from "../words";

export class Details {
  readonly element = el("section", { class: "details", "aria-label": "Selected step" });

  constructor(private readonly app: ProofApp) {
    app.onChange(() => this.update());
    this.update();
  }

  private update(): void {
    const { app } = this;
    this.element.replaceChildren(
      ...this.statement(app.statement), ...this.step(app.step), ...this.demands(app.statement, app.step),
      ...this.marked());
  }

  private statement(statement: Statement): HTMLElement[] {
    const { app } = this;
    if (statement.number < 0) return [el("h2", {}, "The theorem")];
    const users = usersOf(app.certificate, statement.number).map((user) => this.link(user));
    const meeting = statement.demands.length > 0 ? "In plans that satisfy its constraints" : "In all plans";
    return [
      el("div", { class: "head" }, el("h2", {}, `Lemma ${statement.number}`),
        el("button", { type: "button", click: () => app.show(app.certificate.theorem) }, "Back to the theorem")),
      el("p", {}, `${meeting} ${lemmaText(app.model, statement)}.`),
      el("p", { class: "faint" }, "Used by ", ...joined(users), "."),
    ];
  }

  private link(statement: Statement): HTMLElement {
    const name = statement.number < 0 ? "the theorem" : `lemma ${statement.number}`;
    return el("button", { type: "button", class: "link", click: () => this.app.show(statement) }, name);
  }

  private step(step: Step): HTMLElement[] {
    const { model, statement, certificate } = this.app;
    const heading = el("h3", {}, step.sides.length > 0 ? "Each plan here satisfies one of these" : "Proven without a split",
      el("span", { class: "faint line" }, ` line ${step.line}`));
    if (step.sides.length === 0)
      return [heading, el("p", {}, closedText(model, statement, step)), ...this.lemmas(step)];
    const why = whyText(model, certificate.following, step);
    return [heading,
      el("ul", { class: "moments" }, ...step.children.map((child) => el("li", {},
        el("button", { type: "button", class: "link", click: () => this.app.select(child) },
          stepText(model, statement, child))))),
      why === "" ? el("p", { class: "bad" }, "✗ docs/proof.md does not permit this split.") : el("p", {}, why),
      ...this.lemmas(step)];
  }

  // Those that the step names, in words.
  private lemmas(step: Step): HTMLElement[] {
    const { model, certificate } = this.app;
    if (step.lemmas.length === 0) return [];
    return [el("ul", { class: "moments" }, ...step.lemmas.map((number) => {
      const lemma = certificate.lemmas[number];
      return el("li", {}, this.link(lemma), `: ${lemmaText(model, lemma)}`);
    }))];
  }

  private demands(statement: Statement, step: Step): HTMLElement[] {
    const { model } = this.app;
    const demands = [...statement.demands, ...demandsAt(step)];
    if (demands.length === 0) return [];
    const items = demands.flatMap((demand) => {
      const text = el("li", {}, demandText(model, demand));
      if (demand.kind !== "rest") return [text];
      const place = model.world.place(demand.places[0]);
      return [text, el("li", { class: "faint" },
        `so no other agent of ${agentsText(model, statement.agents)} is on ${place} from ${demand.end} on`)];
    });
    return [el("h3", {}, "Constraints here"), el("ul", { class: "moments" }, ...items)];
  }

  // What was chosen on the map.
  private marked(): HTMLElement[] {
    const { marked, chosenTask, model } = this.app;
    const { world } = model;
    if (chosenTask >= 0) {
      const { name, place, agents } = model.tasks[chosenTask];
      return [el("h3", {}, name), el("p", {}, `A task of ${agentsText(model, agents)} on ${world.place(place)}.`)];
    }
    if (marked < 0) return [];
    const { name, start, goal } = model.agents[marked];
    return [el("h3", {}, name), el("p", {}, `Starts on ${world.place(start)}` +
      `${goal >= 0 ? `, ends on ${world.place(goal)}` : ""}. Constraints on it are bold in the tree.`)];
  }
}

function joined(elements: HTMLElement[]): (HTMLElement | string)[] {
  return elements.flatMap((element, i) => (i === 0 ? [element] : [", ", element]));
}
