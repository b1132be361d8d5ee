// SPDX-License-Identifier: MIT
// The proof as an outline, with a row for each visible step: the constraint that leads to it and, at the end,
// a note on how it is proven. Creates the rows again when a step is folded or unfolded.

import { el } from "../../page/dom";
import type { ProofApp } from "../app";
import { constraintOf, type Step } from "../certificate";
import { noteText, stepText } from "../words";

const kMostDepth = 60; // deeper rows are not indented further
const kWidest = 16; // maximum indentation per level, in pixels
const kRoom = 200; // maximum indentation of the deepest row, in pixels, if each level still gets kNarrowest
const kNarrowest = 3;

export class Tree {
  readonly element = el("div", {
    class: "rows tree", role: "tree", "aria-label": "The proof", keydown: (event) => this.key(event as KeyboardEvent),
  });
  private rows: Step[] = [];
  private elements: HTMLElement[] = [];
  private shown: Step | null = null;

  constructor(private readonly app: ProofApp) {
    app.onChange(() => this.update());
    this.update();
  }

  private update(): void {
    const { rows } = this.app;
    const isSame = rows.length === this.rows.length && rows.every((step, i) => step === this.rows[i]);
    if (!isSame) this.make(rows);
    this.rows.forEach((step, i) => this.updateRow(step, this.elements[i]));
    if (this.app.step === this.shown) return;
    this.shown = this.app.step;
    this.bringIntoSight(this.elements[this.rows.indexOf(this.shown)]);
  }

  // Scrolls a row into view. Scrolls only the list, never the page.
  private bringIntoSight(row: HTMLElement | undefined): void {
    if (!row) return;
    const inside = row.getBoundingClientRect();
    const outside = this.element.getBoundingClientRect();
    if (inside.top < outside.top) this.element.scrollTop += inside.top - outside.top;
    if (inside.bottom > outside.bottom) this.element.scrollTop += inside.bottom - outside.bottom;
  }

  private make(rows: Step[]): void {
    const hadFocus = this.element.contains(document.activeElement);
    this.rows = rows;
    const deepest = Math.min(kMostDepth, Math.max(1, ...rows.map(({ depth }) => depth)));
    const width = Math.max(kNarrowest, Math.min(kWidest, kRoom / deepest));
    this.elements = rows.map((step) => this.row(step, width * Math.min(step.depth, kMostDepth)));
    this.element.replaceChildren(...this.elements);
    if (hadFocus) this.focus();
  }

  private row(step: Step, inset: number): HTMLElement {
    const { app } = this;
    const hasMore = step.children.length > 0;
    const twist = el("span", {
      class: "twist", "aria-hidden": true, click: (event) => {
        event.stopPropagation();
        if (hasMore) app.unfold(step, !app.open.has(step));
      },
    }, !hasMore ? "•" : app.open.has(step) ? "▾" : "▸");
    const row = el("div", {
      role: "treeitem", class: "row", "aria-level": step.depth + 1, style: `padding-left: ${inset}px`,
      click: () => app.select(step),
    }, twist, el("span", { class: "what" }, stepText(app.model, app.statement, step)),
      el("span", { class: "faint note" }, noteText(step)));
    if (hasMore) row.setAttribute("aria-expanded", String(app.open.has(step)));
    return row;
  }

  private updateRow(step: Step, row: HTMLElement): void {
    const { app } = this;
    const isChosen = step === app.step;
    row.setAttribute("aria-selected", String(isChosen));
    row.tabIndex = isChosen ? 0 : -1;
    row.classList.toggle("of", app.marked >= 0 && constraintOf(step)?.agent === app.marked);
  }

  private focus(): void {
    this.elements[this.rows.indexOf(this.app.step)]?.focus({ preventScroll: true });
  }

  // Handles the keys of an outline: up and down go through the rows, right unfolds a step or enters it, left
  // folds it or leaves it.
  private key(event: KeyboardEvent): void {
    const { app, rows } = this;
    const { step } = app;
    const at = rows.indexOf(step);
    const isOpen = app.open.has(step);
    const acts: Record<string, () => void> = {
      ArrowDown: () => app.select(rows[Math.min(at + 1, rows.length - 1)]),
      ArrowUp: () => app.select(rows[Math.max(at - 1, 0)]),
      Home: () => app.select(rows[0]),
      End: () => app.select(rows[rows.length - 1]),
      ArrowRight: () => {
        if (isOpen) app.select(step.children[0]);
        else if (step.children.length > 0) app.unfold(step, true);
      },
      ArrowLeft: () => {
        if (isOpen) app.unfold(step, false);
        else if (step.above) app.select(step.above.step);
      },
    };
    const act = event.ctrlKey || event.metaKey || event.altKey ? undefined : acts[event.key];
    if (!act) return;
    event.preventDefault();
    act();
    this.focus();
  }
}
