// SPDX-License-Identifier: MIT
// Who does what when: a row for each robot, time from left to right. It is a slider as well.

import type { App, Viewed } from "../app";
import type { Colors } from "../colors";
import { el } from "../dom";

const kLeastRow = 3; // pixels

export class Chart {
  readonly element: HTMLElement;
  private readonly canvas = el("canvas", { "aria-hidden": true });
  private readonly cursor = el("div", { class: "cursor" });
  private key = "";

  constructor(private readonly app: App) {
    this.element = el("div", { class: "chart", title: "Who does what when: moving, waiting, at work, at rest" },
      this.canvas, this.cursor);
    const go = (event: PointerEvent) => this.goTo(event);
    this.element.addEventListener("pointerdown", (event) => {
      this.element.setPointerCapture(event.pointerId);
      go(event);
    });
    this.element.addEventListener("pointermove", (event) => {
      if (event.buttons & 1) go(event);
    });
  }

  private goTo(event: PointerEvent): void {
    const box = this.canvas.getBoundingClientRect();
    const part = (event.clientX - box.left) / box.width;
    this.app.go(Math.round(part * this.app.player.end));
  }

  update(colors: Colors, ratio: number): void {
    const { player, chosen } = this.app;
    const width = this.element.clientWidth;
    const height = this.element.clientHeight;
    const key = [width, height, ratio, chosen, colors.name].join();
    if (key !== this.key) {
      this.key = key;
      this.paint(colors, width, height, ratio);
    }
    const at = player.end > 0 ? (player.time / player.end) * width : 0;
    this.cursor.style.transform = `translateX(${at.toFixed(1)}px)`;
  }

  // All robots if each row has a few pixels, else those around the one chosen, or the first.
  private paint(colors: Colors, width: number, height: number, ratio: number): void {
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    const c = this.canvas.getContext("2d")!;
    c.scale(ratio, ratio);
    const plans = this.app.viewed;
    plans.forEach((viewed, i) => {
      const top = (i * height) / plans.length;
      this.paintPlan(c, viewed, top, height / plans.length - (i + 1 < plans.length ? 3 : 0), width, colors);
    });
  }

  private paintPlan(
    c: CanvasRenderingContext2D, viewed: Viewed, top: number, height: number, width: number, colors: Colors,
  ): void {
    const count = viewed.plan.agents.length;
    const rows = Math.min(count, Math.max(1, Math.floor(height / kLeastRow)));
    const first = Math.min(count - rows, Math.max(0, this.app.chosen - (rows >> 1)));
    const row = Math.min(14, height / rows);
    const scale = this.app.player.end > 0 ? width / this.app.player.end : 0;
    const gap = row >= 5 ? 1 : 0;
    for (let i = 0; i < rows; ++i) {
      const y = top + i * row;
      for (const span of viewed.facts.spans[first + i]) {
        const end = Math.min(span.end, this.app.player.end);
        if (end <= span.begin) continue;
        c.fillStyle = colors.doing[span.doing];
        c.globalAlpha = span.doing === 3 ? 0.35 : 1;
        c.fillRect(span.begin * scale, y, Math.max(0.5, (end - span.begin) * scale), row - gap);
      }
      c.globalAlpha = 1;
      if (first + i === this.app.chosen) {
        c.strokeStyle = colors.chosen;
        c.lineWidth = 2;
        c.strokeRect(1, y, width - 2, Math.max(2, row - gap));
      }
    }
  }
}
