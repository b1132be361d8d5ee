// SPDX-License-Identifier: MIT
// Details of the selected step: its statement, why it holds, and the constraints in force there.

import { el } from "../../page/dom";
import { hasChoice } from "../../page/model";
import { listed } from "../../page/names";
import { needText } from "../../page/panels/task";
import type { ProofApp } from "../app";
import { constraintsAt, usersOf, type Statement, type Step } from "../certificate";
import { agentsText, closedText, constraintText, lemmaText, stepText, whyText } from "../words";

export class Details {
  readonly element = el("section", { class: "details", "aria-label": "Selected step" });

  constructor(private readonly app: ProofApp) {
    app.onChange(() => this.update());
    this.update();
  }

  private update(): void {
    const { app } = this;
    this.element.replaceChildren(
      ...this.statement(app.statement), ...this.step(app.step), ...this.constraints(app.statement, app.step),
      ...this.marked());
  }

  private statement(statement: Statement): HTMLElement[] {
    const { app } = this;
    if (statement.number < 0) return [el("h2", {}, "The theorem")];
    const users = usersOf(app.certificate, statement.number).map((user) => this.link(user));
    const meeting = statement.constraints.length > 0 ? "In plans that satisfy its constraints" : "In all plans";
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

  // Returns a list of the lemmas that a step uses, in words.
  private lemmas(step: Step): HTMLElement[] {
    const { model, certificate } = this.app;
    if (step.lemmas.length === 0) return [];
    return [el("ul", { class: "moments" }, ...step.lemmas.map((number) => {
      const lemma = certificate.lemmas[number];
      return el("li", {}, this.link(lemma), `: ${lemmaText(model, lemma)}`);
    }))];
  }

  private constraints(statement: Statement, step: Step): HTMLElement[] {
    const { model } = this.app;
    const constraints = [...statement.constraints, ...constraintsAt(step)];
    if (constraints.length === 0) return [];
    const items = constraints.flatMap((constraint) => {
      const text = el("li", {}, constraintText(model, constraint));
      if (constraint.kind !== "rest") return [text];
      const place = model.world.place(constraint.places[0]);
      return [text, el("li", { class: "faint" },
        `so no other agent of ${agentsText(model, statement.agents)} is on ${place} from ${constraint.end} on`)];
    });
    return [el("h3", {}, "Constraints here"), el("ul", { class: "moments" }, ...items)];
  }

  // Returns the description of the task or agent that is selected on the map.
  private marked(): HTMLElement[] {
    const { marked, chosenTask, model } = this.app;
    const { world } = model;
    if (chosenTask >= 0) {
      const task = model.tasks[chosenTask];
      const whose = hasChoice(task) ? needText(model, task) : `Of ${agentsText(model, task.agents)}.`;
      return [el("h3", {}, task.name), el("p", {}, `A task on ${world.place(task.place)}. ${whose}`)];
    }
    if (marked < 0) return [];
    const { name, start, goal, goals } = model.agents[marked];
    const end = goal >= 0 ? `, ends on ${world.place(goal)}`
      : goals.length > 0 ? `, ends on one of ${listed(goals.map((place) => world.place(place)))}` : "";
    return [el("h3", {}, name),
      el("p", {}, `Starts on ${world.place(start)}${end}. Constraints on it are bold in the tree.`)];
  }
}

function joined(elements: HTMLElement[]): (HTMLElement | string)[] {
  return elements.flatMap((element, i) => (i === 0 ? [element] : [", ", element]));
}
