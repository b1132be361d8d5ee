// SPDX-License-Identifier: MIT
// Play, pause, step, speed, loop; the time as a slider and as a number.

import type { App } from "../app";
import { el, icon, setText } from "../dom";

const kIcons = {
  play: "M4 2l10 6-10 6z",
  pause: "M3 2h4v12H3zM9 2h4v12H9z",
  begin: "M2 2h2v12H2zM14 2v12L5 8z",
  end: "M12 2h2v12h-2zM2 2v12l9-6z",
  back: "M11 2v12L3 8z",
  on: "M5 2v12l8-6z",
  loop: "M8 2a6 6 0 1 0 6 6h-2a4 4 0 1 1-4-4v3l5-4-5-4z",
};

export class Controls {
  readonly element: HTMLElement;
  private readonly playButton: HTMLButtonElement;
  private readonly playFace: SVGPathElement;
  private readonly slider: HTMLInputElement;
  private readonly clock: HTMLElement;
  private readonly speed: HTMLElement;
  private readonly loop: HTMLButtonElement;

  constructor(private readonly app: App, help: () => void) {
    const { player } = app;
    const button = (face: SVGElement | string, title: string, act: () => void) =>
      el("button", { type: "button", title, "aria-label": title, click: () => this.act(act) }, face);
    this.playButton = button(icon(kIcons.play), "Play or pause (space)", () => player.toggle());
    this.playFace = this.playButton.querySelector("path")!;
    this.loop = button(icon(kIcons.loop), "Begin again at the end (L)", () => (player.loop = !player.loop));
    this.slider = el("input", {
      type: "range", min: 0, max: player.end, step: "any", value: 0, class: "time",
      "aria-label": "Time in steps",
      input: () => this.act(() => player.go(Number(this.slider.value))),
    });
    this.clock = el("output", { class: "clock" });
    this.speed = el("span", { class: "speed" });
    this.element = el(
      "div",
      { class: "controls" },
      button(icon(kIcons.begin), "To the beginning (Home)", () => player.go(0)),
      button(icon(kIcons.back), "A step back (left arrow)", () => player.step(-1)),
      this.playButton,
      button(icon(kIcons.on), "A step on (right arrow)", () => player.step(1)),
      button(icon(kIcons.end), "To the end (End)", () => player.go(player.end)),
      this.slider,
      this.clock,
      button("−", "Slower (comma)", () => player.faster(-1)),
      this.speed,
      button("+", "Faster (full stop)", () => player.faster(1)),
      this.loop,
      el("button", { type: "button", title: "All keys (?)", "aria-label": "All keys", click: help }, "?"),
    );
  }

  private act(act: () => void): void {
    act();
    this.app.changed();
  }

  update(): void {
    const { player } = this.app;
    this.playFace.setAttribute("d", player.playing ? kIcons.pause : kIcons.play);
    const whole = player.playing || Number.isInteger(player.time);
    setText(this.clock, `${whole ? Math.floor(player.time) : player.time.toFixed(1)} / ${player.end}`);
    setText(this.speed, `${player.speed} /s`);
    this.loop.setAttribute("aria-pressed", String(player.loop));
    if (document.activeElement !== this.slider || player.playing)
      this.slider.value = String(player.time);
    this.slider.setAttribute("aria-valuetext", `step ${Math.floor(player.time)} of ${player.end}`);
  }
}
