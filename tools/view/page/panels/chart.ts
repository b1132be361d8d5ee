// SPDX-License-Identifier: MIT
// Gantt chart of the activities: a row for each robot, with a lane for each plan, and time from left to
// right. A click or drag in the chart sets the time. A click on a name selects the robot.

import type { App, PlanView } from "../app";
import type { Colors } from "../colors";
import { el, setText } from "../dom";
import { Doing } from "../facts";

const kLeastLane = 3; // pixels: minimum height of a lane, the part of a row for one plan
const kMostLane = 22;
const kLeastNamed = 9; // pixels: minimum height of rows with names
const kWidestName = 110;
const kWords = ["moves", "waits", "works", "rests"]; // by Doing

// Layout of rows and of the time axis, in pixels.
interface Layout {
  first: number; // the robot of the first visible row
  rows: number;
  row: number; // height of a row
  left: number; // position of time 0
  width: number; // of the time axis
}

export class Chart {
  readonly element: HTMLElement;
  private readonly canvas = el("canvas", { "aria-hidden": true });
  private readonly cursor = el("div", { class: "cursor" });
  private readonly note = el("div", { class: "chart-note faint" });
  private layout: Layout = { first: 0, rows: 0, row: 1, left: 0, width: 1 };
  private first = 0; // requested first row
  private shownChoice = -1;
  private key = "";

  constructor(private readonly app: App) {
    this.element = el("div", { class: "chart" }, this.canvas, this.cursor, this.note);
    this.element.addEventListener("pointerdown", (event) => this.press(event));
    this.element.addEventListener("pointermove", (event) => this.hover(event));
    this.element.addEventListener("wheel", (event) => this.scroll(event), { passive: false });
  }

  private press(event: PointerEvent): void {
    const { robot, time } = this.at(event);
    if (time === null) {
      if (robot >= 0) this.app.choose(robot);
      return;
    }
    this.element.setPointerCapture(event.pointerId);
    this.app.go(time);
  }

  private hover(event: PointerEvent): void {
    const { robot, time } = this.at(event);
    if (event.buttons & 1 && this.element.hasPointerCapture(event.pointerId) && time !== null)
      this.app.go(time);
    this.element.title = robot < 0 ? "" : this.describeRow(robot, time);
  }

  private scroll(event: WheelEvent): void {
    const count = this.app.model.agents.length;
    if (this.layout.rows >= count) return;
    event.preventDefault();
    this.first += Math.sign(event.deltaY) * Math.max(1, this.layout.rows >> 2);
    this.first = Math.min(count - this.layout.rows, Math.max(0, this.first));
  }

  // Returns the robot and the time at the pointer. `robot`: -1: none; `time`: null if the pointer is on the
  // names.
  private at(event: PointerEvent): { robot: number; time: number | null } {
    const box = this.canvas.getBoundingClientRect();
    const { first, left, row, rows, width } = this.layout;
    const index = Math.floor((event.clientY - box.top) / row);
    const robot = index >= 0 && index < rows ? first + index : -1;
    const x = event.clientX - box.left - left;
    if (x < 0 && !this.element.hasPointerCapture(event.pointerId)) return { robot, time: null };
    const fraction = Math.min(1, Math.max(0, x / width));
    return { robot, time: Math.round(fraction * this.app.player.end) };
  }

  private describeRow(robot: number, time: number | null): string {
    const { name } = this.app.model.agents[robot];
    if (time === null) return name;
    const what = this.app.viewed.map(({ facts }) => {
      const span = facts.spans[robot].find((s) => s.end > time);
      if (!span) return "";
      const until = span.end === Infinity ? "" : ` until ${span.end}`;
      return `${kWords[span.doing]} from ${span.begin}${until}`;
    });
    return `${name} ${what.join(" / ")}`;
  }

  update(colors: Colors, ratio: number): void {
    const { player, chosen, viewed } = this.app;
    const width = this.element.clientWidth;
    const height = this.element.clientHeight;
    const wrong = viewed.map(({ checker }) => checker.violations.length);
    const key = [width, height, ratio, chosen, colors.name, this.first, ...wrong].join();
    if (key !== this.key) {
      this.key = key;
      this.paint(colors, width, height, ratio);
    }
    const { left, width: span } = this.layout;
    const at = left + (player.end > 0 ? (player.time / player.end) * span : 0);
    this.cursor.style.transform = `translateX(${at.toFixed(1)}px)`;
  }

  // Scrolls to the selected robot if the selection has changed.
  private bringIntoSight(robot: number, rows: number): void {
    if (robot === this.shownChoice) return;
    this.shownChoice = robot;
    if (robot < 0 || (robot >= this.first && robot < this.first + rows)) return;
    this.first = robot - (rows >> 1);
  }

  private paint(colors: Colors, width: number, height: number, ratio: number): void {
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    const c = this.canvas.getContext("2d")!;
    c.scale(ratio, ratio);
    this.computeLayout(c, width, height);
    const { first, row, rows } = this.layout;
    const lanes = this.app.viewed;
    const gap = row >= 5 ? 1 : 0;
    for (let i = 0; i < rows; ++i)
      lanes.forEach((viewed, lane) => {
        const lines = (row - gap) / lanes.length;
        this.paintLane(c, viewed, first + i, i * row + lane * lines, lines, colors);
      });
    if (this.layout.left > 0) this.paintNames(c, colors);
    this.paintChosen(c, colors, gap);
    const count = this.app.model.agents.length;
    const seen = `${first + 1}–${first + rows} of ${count.toLocaleString("en")} robots`;
    setText(this.note, rows < count ? seen : "");
  }

  // Computes the layout: all robots if there is enough height for each, otherwise some of them.
  private computeLayout(c: CanvasRenderingContext2D, width: number, height: number): void {
    const lanes = this.app.viewed.length;
    const count = this.app.model.agents.length;
    const rows = Math.min(count, Math.max(1, Math.floor(height / (kLeastLane * lanes))));
    const row = Math.min(kMostLane * lanes, height / rows);
    this.bringIntoSight(this.app.chosen, rows);
    const first = Math.min(count - rows, Math.max(0, this.first));
    c.font = fontOf(row);
    const names = row >= kLeastNamed ? this.app.model.agents.slice(first, first + rows) : [];
    const widest = names.reduce((most, { name }) => Math.max(most, c.measureText(name).width), 0);
    const left = names.length > 0 ? Math.ceil(Math.min(widest, kWidestName, width / 5)) + 6 : 0;
    this.layout = { first, rows, row, left, width: Math.max(1, width - left) };
  }

  private paintLane(
    c: CanvasRenderingContext2D, { checker, facts, plan }: PlanView, robot: number, y: number,
    height: number, colors: Colors,
  ): void {
    if (plan.agents[robot].track.isEmpty) return;
    const { left, width } = this.layout;
    const { end } = this.app.player;
    const scale = end > 0 ? width / end : 0;
    let painted = -1; // half pixel at which the last painted span ends; further spans that end there are skipped
    for (const span of facts.spans[robot]) {
      const until = Math.min(span.end, end);
      const last = Math.floor(2 * until * scale);
      if (until <= span.begin || last === painted) continue;
      painted = last;
      c.fillStyle = colors.doing[span.doing];
      c.globalAlpha = span.doing === Doing.kResting ? 0.35 : 1;
      c.fillRect(left + span.begin * scale, y, Math.max(0.5, (until - span.begin) * scale), height);
    }
    c.globalAlpha = 1;
    c.fillStyle = colors.collision;
    for (const { agents, time } of checker.violations)
      if (agents.includes(robot)) c.fillRect(left + Math.min(end, time) * scale - 2, y, 4, height);
  }

  private paintNames(c: CanvasRenderingContext2D, colors: Colors): void {
    const { first, left, row, rows } = this.layout;
    const { model, chosen } = this.app;
    c.font = fontOf(row);
    c.textBaseline = "middle";
    for (let i = 0; i < rows; ++i) {
      c.fillStyle = first + i === chosen ? colors.chosen : colors.text;
      c.fillText(model.agents[first + i].name, 0, (i + 0.5) * row, left - 4);
    }
  }

  private paintChosen(c: CanvasRenderingContext2D, colors: Colors, gap: number): void {
    const { first, left, row, rows, width } = this.layout;
    const at = this.app.chosen - first;
    if (this.app.chosen < 0 || at < 0 || at >= rows) return;
    c.strokeStyle = colors.chosen;
    const line = row < 8 ? 1 : 2; // thin for low rows, which would otherwise be hidden
    c.lineWidth = line;
    c.strokeRect(left + line / 2, at * row - line / 2, width - line, row - gap + line);
  }
}

function fontOf(row: number): string {
  return `${Math.min(14, Math.max(9, 0.6 * row))}px system-ui, sans-serif`;
}
