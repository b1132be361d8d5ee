// SPDX-License-Identifier: MIT
// Controls: play, pause, step, speed and loop, and the time as a slider and as a number.

import { el, icon, setText } from "../dom";
import type { Player } from "../player";

const kIcons = {
  play: "M4 2l10 6-10 6z",
  pause: "M3 2h4v12H3zM9 2h4v12H9z",
  begin: "M2 2h2v12H2zM14 2v12L5 8z",
  end: "M12 2h2v12h-2zM2 2v12l9-6z",
  back: "M11 2v12L3 8z",
  on: "M5 2v12l8-6z",
  loop: "M8 2a6 6 0 1 0 6 6h-2a4 4 0 1 1-4-4v3l5-4-5-4z",
};

interface Played {
  readonly player: Player;
  changed(): void;
}

// Words for times: in steps for plans, in seconds for executions.
export interface TimeWords {
  readonly label: string;
  readonly unit: string;
  clock(player: Player): string;
  spoken(player: Player): string;
}

export const kSteps: TimeWords = {
  label: "Time in steps",
  unit: "step",
  clock: ({ playing, time, end }) => {
    const whole = playing || Number.isInteger(time);
    return `${whole ? Math.floor(time) : time.toFixed(1)} / ${end}`;
  },
  spoken: ({ time, end }) => `step ${Math.floor(time)} of ${end}`,
};

export class Controls {
  readonly element: HTMLElement;
  private readonly playButton: HTMLButtonElement;
  private readonly playFace: SVGPathElement;
  private readonly slider: HTMLInputElement;
  private readonly clock: HTMLElement;
  private readonly speed: HTMLElement;
  private readonly loop: HTMLButtonElement;

  constructor(
    private readonly app: Played, private readonly words: TimeWords, help: () => void,
    ...more: HTMLElement[]
  ) {
    const { player } = app;
    const button = (face: SVGElement | string, title: string, act: () => void) => {
      const click = () => this.act(act);
      return el("button", { type: "button", title, "aria-label": title, click }, face);
    };
    this.playButton = button(icon(kIcons.play), "Play or pause (space)", () => player.toggle());
    this.playFace = this.playButton.querySelector("path")!;
    this.loop = button(icon(kIcons.loop), "Loop: start again at the end (L)",
      () => (player.loop = !player.loop));
    this.slider = el("input", {
      type: "range", min: 0, max: player.end, step: "any", value: 0, class: "time",
      "aria-label": words.label,
      input: () => this.act(() => player.go(Number(this.slider.value))),
    });
    this.clock = el("output", { class: "clock" });
    this.speed = el("span", { class: "speed" });
    this.element = el(
      "div",
      { class: "controls" },
      button(icon(kIcons.begin), "To the beginning (Home)", () => player.go(0)),
      button(icon(kIcons.back), `One ${words.unit} back (left arrow)`, () => player.step(-1)),
      this.playButton,
      button(icon(kIcons.on), `One ${words.unit} forward (right arrow)`, () => player.step(1)),
      button(icon(kIcons.end), "To the end (End)", () => player.go(player.end)),
      this.slider,
      this.clock,
      button("−", "Slower (comma)", () => player.faster(-1)),
      this.speed,
      button("+", "Faster (full stop)", () => player.faster(1)),
      this.loop,
      ...more,
      button("?", "All keys (?)", help),
    );
  }

  private act(act: () => void): void {
    act();
    this.app.changed();
  }

  update(): void {
    const { player } = this.app;
    this.playFace.setAttribute("d", player.running ? kIcons.pause : kIcons.play);
    setText(this.clock, this.words.clock(player));
    setText(this.speed, `${player.speed} /s`);
    this.loop.setAttribute("aria-pressed", String(player.loop));
    if (this.slider.max !== String(player.end)) this.slider.max = String(player.end);
    if (document.activeElement !== this.slider || player.running)
      this.slider.value = String(player.time);
    this.slider.setAttribute("aria-valuetext", this.words.spoken(player));
  }
}
