// SPDX-License-Identifier: MIT
// Shows the proof tree of the selected statement, or the list of all lemmas.

import { el } from "../../page/dom";
import { rowElement } from "../../page/panels/rows";
import type { ProofApp } from "../app";
import { lemmaText } from "../words";
import { Tree } from "./tree";

export class Lists {
  readonly element = el("section", { class: "lists" });
  private readonly tree: Tree;
  private readonly lemmas = el("div", { class: "rows" });
  private readonly buttons: HTMLElement[];
  private readonly folds: HTMLElement;

  constructor(private readonly app: ProofApp) {
    this.tree = new Tree(app);
    const { lemmas } = app.certificate;
    this.lemmas.append(...lemmas.map((lemma) => rowElement({
      key: "", text: `${lemma.number}: ${lemmaText(app.model, lemma)}`, note: () => "",
      act: () => app.show(lemma),
    }).element));
    const tab = (text: string, shows: boolean) => el("button", {
      type: "button", role: "tab", click: () => this.turn(shows),
    }, text);
    this.buttons = [tab("Tree", false), ...(lemmas.length > 0 ? [tab(`Lemmas (${lemmas.length})`, true)] : [])];
    const fold = (text: string, isOpen: boolean) => el("button", {
      type: "button", click: () => app.unfoldAll(isOpen),
    }, text);
    this.folds = el("span", { class: "folds" }, fold("Unfold all", true), fold("Fold all", false));
    this.element.append(
      el("div", { class: "tabs", role: "tablist" }, ...this.buttons, this.folds),
      this.tree.element, this.lemmas);
    let shown = app.statement;
    app.onChange(() => {
      if (app.statement !== shown) this.turn(false);
      shown = app.statement;
    });
    this.turn(false);
  }

  private turn(showsLemmas: boolean): void {
    this.buttons.forEach((button, i) => button.setAttribute("aria-selected", String((i === 1) === showsLemmas)));
    this.tree.element.hidden = showsLemmas;
    this.folds.hidden = showsLemmas || this.app.statement.root.children.length === 0;
    this.lemmas.hidden = !showsLemmas;
  }
}
