// SPDX-License-Identifier: MIT
// Puts the page together, and keeps it going.

import { App, type Heat } from "./app";
import { kDark, kLight } from "./colors";
import { el } from "./dom";
import { listenToKeys } from "./keys";
import { linkOf, readLink } from "./link";
import { Chart } from "./panels/chart";
import { Controls } from "./panels/controls";
import { Lists } from "./panels/lists";
import { Details } from "./panels/robot";
import { Strip } from "./panels/strip";
import { readModel } from "./read";
import { Stage } from "./stage";

const kCheckBudget = 6; // milliseconds of a frame

function start(): void {
  const data = document.getElementById("grove-data");
  try {
    if (!data) throw new Error("this page holds no data");
    run(new App(readModel(data.textContent ?? "")));
  } catch (error) {
    const text = error instanceof Error ? error.message : String(error);
    document.body.replaceChildren(
      el("main", { class: "failure" }, el("h1", {}, "This plan cannot be shown"), el("p", {}, text)),
    );
  }
}

function run(app: App): void {
  const strip = new Strip(app);
  const controls = new Controls(app);
  const chart = new Chart(app);
  const details = new Details(app);
  const lists = new Lists(app);
  const stages = app.viewed.length > 0
    ? app.viewed.slice(0, 2).map((viewed) => new Stage(app, viewed))
    : [new Stage(app, null)];
  const side = el("aside", { class: "side" }, legend(app), details.element, lists.element);
  const foot = el("footer", { class: "foot" }, controls.element, chart.element);
  if (app.viewed.length === 0) foot.hidden = true;
  document.body.replaceChildren(
    strip.element,
    el("main", { class: "stages" }, ...stages.map((stage) => stage.element)),
    side,
    foot,
  );

  const scheme = matchMedia("(prefers-color-scheme: dark)");
  const touch = () => {
    for (const stage of stages) stage.touch();
    keepLink(app);
  };
  app.onChange(touch);
  scheme.addEventListener("change", touch);
  const resize = () => stages.forEach((stage) => stage.resize());
  new ResizeObserver(resize).observe(stages[0].element.parentElement!);
  resize();
  // Two plans are looked at from one place.
  stages.forEach((stage, i) => {
    stage.onCamera = () => {
      const other = stages[1 - i];
      if (!other) return;
      Object.assign(other.camera, { center: { ...stage.camera.center }, scale: stage.camera.scale });
      other.touch();
    };
  });
  listenToKeys({ app, cameras: stages.map((stage) => stage.camera), search: lists.search });
  readLink(app, location.hash);
  addEventListener("hashchange", () => {
    if (location.hash !== linkOf(app)) readLink(app, location.hash);
  });

  let last = performance.now();
  const tick = (now: number) => {
    app.player.advance((now - last) / 1000);
    last = now;
    const colors = scheme.matches ? kDark : kLight;
    const ratio = Math.min(2, devicePixelRatio);
    const before = performance.now();
    for (const stage of stages) stage.draw(colors, ratio);
    controls.update();
    chart.update(colors, ratio);
    details.update();
    lists.update();
    measure(performance.now() - before);
    for (const { checker } of app.viewed)
      if (!checker.done) checker.step(kCheckBudget);
    strip.update();
    requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
}

// The page's own time in each frame, for whoever asks (tests do): window.groveFrames.
const frames: number[] = [];
function measure(milliseconds: number): void {
  frames.push(milliseconds);
  if (frames.length > 600) frames.shift();
}
Object.assign(window, { groveFrames: frames });

// The address follows what is looked at, but not every frame of what is played.
let linkTimer = 0;
function keepLink(app: App): void {
  clearTimeout(linkTimer);
  linkTimer = window.setTimeout(() => history.replaceState(null, "", linkOf(app)), 300);
}

function legend(app: App): HTMLElement {
  const entry = (name: string, text: string) =>
    el("span", { class: "entry" }, el("i", { class: name }), text);
  const heat: HTMLSelectElement = el("select", {
    "aria-label": "Heat map",
    change: () => app.set({ heat: heat.value as Heat }),
  },
    el("option", { value: "none" }, "no heat map"),
    el("option", { value: "traffic" }, "heat: traffic"),
    el("option", { value: "waits" }, "heat: waits"),
    el("option", { value: "yields" }, "heat: conflicts avoided"));
  return el("section", { class: "legend" },
    entry("moving", "moving"), entry("waiting", "waiting"), entry("working", "at work"),
    entry("resting", "at rest"), entry("collision", "collision"), entry("task", "task"),
    entry("goal", "destination"), heat);
}

start();
