// SPDX-License-Identifier: MIT
// Displays the constraint trees of a small search, with zoom and pan, details of the selected node, and
// playback of the expansions.

import { el, setText } from "../page/dom";
import type { Placed } from "./layout";
import { layout } from "./layout";
import type { Run, TreeNode } from "./model";
import { kOutcomes, kSplits, number, seconds } from "./words";

const kColumn = 34; // pixels at zoom 1
const kRow = 46;
const kRadius = 9;

export class TreeView {
  readonly element: HTMLElement;
  private readonly canvas = el("canvas", { tabindex: 0, role: "application",
    "aria-label": "The search tree: arrow keys go to parent, children and neighbours, n and p to the next and previous expansion" });
  private readonly details = el("div", { class: "node", "aria-live": "polite" });
  private readonly slider = el("input", { type: "range", min: 0, value: 0, "aria-label": "Expansions shown" });
  private readonly progress = el("span", { class: "faint" });
  private placed = new Map<TreeNode, Placed>();
  private run: Run | null = null;
  private chosen: TreeNode | null = null;
  private shown = 0; // number of expansions shown
  private zoom = 1;
  private row = kRow; // height of a row, in pixels at zoom 1
  private isFitted = true; // no pan or zoom since the last fit()
  private x = 0; // point of the drawing in the middle of the canvas, in pixels at zoom 1
  private y = 0;

  constructor() {
    const button = (text: string, title: string, act: () => void) =>
      el("button", { type: "button", title, click: act }, text);
    this.element = el("div", { class: "tree" },
      el("div", { class: "controls" },
        button("−", "Zoom out", () => this.zoomBy(0.7)), button("+", "Zoom in", () => this.zoomBy(1.4)),
        button("Fit", "Show the whole tree", () => this.fit()),
        button("‹", "Previous expansion", () => this.play(this.shown - 1)),
        this.slider,
        button("›", "Next expansion", () => this.play(this.shown + 1)), this.progress),
      this.canvas, this.details);
    this.slider.addEventListener("input", () => this.play(Number(this.slider.value)));
    this.listen();
  }

  show(run: Run): void {
    const isNew = this.run !== run;
    const atEnd = isNew || this.shown === Number(this.slider.max);
    this.run = run;
    this.placed = layout(run.roots);
    this.slider.max = String(run.expanded.length);
    if (atEnd) this.shown = run.expanded.length;
    if (isNew) {
      this.chosen = run.expanded[0] ?? run.roots[0] ?? null;
      this.fit();
    }
    this.play(this.shown);
  }

  private play(shown: number): void {
    if (!this.run) return;
    const before = this.shown;
    this.shown = Math.min(this.run.expanded.length, Math.max(0, shown));
    this.slider.value = String(this.shown);
    setText(this.progress, this.extent());
    if (this.shown !== before && this.shown > 0) this.chosen = this.run.expanded[this.shown - 1];
    this.describeChosen();
    this.paint();
  }

  private extent(): string {
    const { expanded, rows } = this.run!;
    const all = rows.length > 0 ? rows[rows.length - 1].nodes : 0;
    const text = `${number(this.shown)} of ${number(expanded.length)} expansions`;
    return all > expanded.length ? `${text}, the first of ${number(all)}` : text;
  }

  // --- the selected node ---

  private describeChosen(): void {
    const node = this.chosen;
    if (!node) return this.details.replaceChildren();
    const lines = [
      `Bound ${number(node.bound)}, cost of its paths ${number(node.cost)}` +
        (node.conflicts === null ? "" : `, ${number(node.conflicts)} conflicts`),
      node.constraint && `Constraint: ${node.constraint}`,
      ...this.whatBecame(node),
    ];
    this.details.replaceChildren(el("h3", {}, `Node ${node.number}${node.parent ? "" : `, root of tree ${node.tree}`}`),
      ...lines.filter((line) => line).map((line) => el("p", {}, line)));
  }

  private whatBecame(node: TreeNode): string[] {
    const e = node.expanded;
    if (!e) return [this.ofOpen(node)];
    const who = `Expanded as number ${number(e.order)} at ${seconds(e.time)} by worker ${e.worker}: ${kOutcomes[e.outcome]}` +
      (e.outcome === "plan" ? ` of cost ${number(e.planCost)}` : "");
    return [who, e.conflict && `Conflict: ${e.conflict}`,
      e.split && `Split ${e.split}: ${kSplits[e.split] ?? ""}`];
  }

  private ofOpen(node: TreeNode): string {
    const cost = this.run!.summary?.cost ?? null;
    if (cost !== null && node.bound >= cost)
      return `Never expanded: no plan below it is cheaper than the one of ${number(cost)}`;
    return this.run!.summary ? "Not expanded, according to the log"
      : "Not expanded yet, according to the log";
  }

  // --- painting ---

  resize(): void {
    if (this.isFitted) this.fit();
    else this.resizeCanvas();
  }

  // Adapts the resolution of the canvas to its displayed size, and paints it.
  private resizeCanvas(): void {
    const ratio = window.devicePixelRatio || 1;
    const width = this.canvas.clientWidth;
    const height = this.canvas.clientHeight;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.paint();
  }

  private fit(): void {
    let [right, bottom] = [0, 0];
    for (const { x, y } of this.placed.values()) {
      right = Math.max(right, x);
      bottom = Math.max(bottom, y);
    }
    const width = this.canvas.clientWidth || 600;
    const height = this.canvas.clientHeight || 400;
    this.zoom = Math.min(2, width / ((right + 1.5) * kColumn), height / ((bottom + 1.2) * kRow));
    // Moves the rows of a wide tree apart, so that they fill the height.
    this.row = Math.max(kRow, height / ((bottom + 1.2) * this.zoom));
    this.x = (right / 2) * kColumn;
    this.y = (bottom / 2) * this.row;
    this.isFitted = true;
    this.resizeCanvas();
  }

  private zoomBy(factor: number): void {
    this.zoom = Math.min(4, Math.max(0.005, this.zoom * factor));
    this.isFitted = false;
    this.paint();
  }

  private at({ x, y }: Placed): [number, number] {
    return [this.canvas.clientWidth / 2 + (x * kColumn - this.x) * this.zoom,
      this.canvas.clientHeight / 2 + (y * this.row - this.y) * this.zoom];
  }

  private isMade(node: TreeNode): boolean {
    const e = node.parent?.expanded;
    return !e || e.order <= this.shown;
  }

  private paint(): void {
    const c = this.canvas.getContext("2d")!;
    const ratio = window.devicePixelRatio || 1;
    const style = getComputedStyle(this.element);
    const color = (name: string) => style.getPropertyValue(name);
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, this.canvas.clientWidth, this.canvas.clientHeight);
    c.strokeStyle = color("--line-strong");
    c.lineWidth = Math.max(0.6, this.zoom);
    c.beginPath();
    for (const place of this.placed.values()) {
      const parent = place.node.parent && this.placed.get(place.node.parent);
      if (!parent || !this.isMade(place.node)) continue;
      c.moveTo(...this.at(parent));
      c.lineTo(...this.at(place));
    }
    c.stroke();
    for (const place of this.placed.values())
      if (this.isMade(place.node)) this.paintNode(c, place, color);
  }

  private paintNode(c: CanvasRenderingContext2D, place: Placed, color: (name: string) => string): void {
    const [x, y] = this.at(place);
    const radius = Math.max(1.5, kRadius * this.zoom);
    const expanded = place.node.expanded;
    const isExpanded = expanded !== null && expanded.order <= this.shown;
    c.fillStyle = color(isExpanded ? `--${expanded.outcome}` : "--panel");
    c.strokeStyle = color(place.node === this.chosen ? "--chosen" : "--text");
    c.lineWidth = place.node === this.chosen ? 3 : Math.min(1, radius / 5);
    c.beginPath();
    if (isExpanded && expanded.outcome === "plan") c.rect(x - radius, y - radius, 2 * radius, 2 * radius);
    else c.arc(x, y, radius, 0, 2 * Math.PI);
    c.fill();
    c.stroke();
    if (kColumn * this.zoom < 30) return;
    c.fillStyle = color("--text");
    c.font = `${Math.round(11 * Math.min(1.3, this.zoom))}px system-ui, sans-serif`;
    c.textAlign = "center";
    c.fillText(String(place.node.bound), x, y + radius + 12 * Math.min(1.3, this.zoom));
  }

  // --- input ---

  private listen(): void {
    let [fromX, fromY, moved] = [0, 0, false];
    this.canvas.addEventListener("pointerdown", (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      [fromX, fromY, moved] = [event.clientX, event.clientY, false];
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (!(event.buttons & 1)) return;
      const [dx, dy] = [event.clientX - fromX, event.clientY - fromY];
      if (!moved && Math.hypot(dx, dy) < 4) return;
      [fromX, fromY, moved] = [event.clientX, event.clientY, true];
      this.isFitted = false;
      this.x -= dx / this.zoom;
      this.y -= dy / this.zoom;
      this.paint();
    });
    this.canvas.addEventListener("pointerup", (event) => {
      if (!moved) this.chooseAt(event);
    });
    this.canvas.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && document.activeElement !== this.canvas) return; // the page scrolls
      event.preventDefault();
      this.zoomBy(Math.exp(-event.deltaY / 400));
    }, { passive: false });
    this.canvas.addEventListener("keydown", (event) => this.key(event));
  }

  private chooseAt(event: PointerEvent): void {
    const box = this.canvas.getBoundingClientRect();
    let [nearest, least]: [TreeNode | null, number] = [null, 20];
    for (const place of this.placed.values()) {
      const [x, y] = this.at(place);
      const distance = Math.hypot(x - (event.clientX - box.left), y - (event.clientY - box.top));
      if (distance >= least || !this.isMade(place.node)) continue;
      [nearest, least] = [place.node, distance];
    }
    if (nearest) this.choose(nearest);
  }

  private choose(node: TreeNode): void {
    this.chosen = node;
    this.describeChosen();
    this.paint();
  }

  private key(event: KeyboardEvent): void {
    const node = this.chosen;
    const siblings = node?.parent?.children ?? this.run?.roots ?? [];
    const aside = (by: number) => node && siblings[siblings.indexOf(node) + by];
    const next: Record<string, () => TreeNode | null | undefined> = {
      ArrowUp: () => node?.parent,
      ArrowDown: () => node?.children[0],
      ArrowLeft: () => aside(-1),
      ArrowRight: () => aside(1),
    };
    const acts: Record<string, () => void> = {
      "+": () => this.zoomBy(1.4), "-": () => this.zoomBy(0.7), "0": () => this.fit(),
      n: () => this.play(this.shown + 1), p: () => this.play(this.shown - 1),
    };
    if (!next[event.key] && !acts[event.key]) return;
    event.preventDefault();
    const to = next[event.key]?.();
    if (to && this.isMade(to)) this.choose(to);
    acts[event.key]?.();
  }
}
