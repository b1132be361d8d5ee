// SPDX-License-Identifier: MIT
// Builds the plan page and runs its display loop.

import { App } from "./app";
import { kDark, kLight } from "./colors";
import { el } from "./dom";
import { listenToKeys } from "./keys";
import { linkPage } from "./link";
import { Chart } from "./panels/chart";
import { Controls, kSteps } from "./panels/controls";
import { Details } from "./panels/details";
import { Help } from "./panels/help";
import { legend } from "./panels/legend";
import { Lists } from "./panels/lists";
import { Strip } from "./panels/strip";
import { instanceScene, planScene } from "./plan_scene";
import { readModel } from "./read";
import { Stage } from "./stage";

const kWorkBudget = 6; // milliseconds per frame while the plan plays
const kLong = 300_000; // characters of data, from which on a message is shown before they are read

function begin(): void {
  const data = document.getElementById("grove-data")?.textContent ?? null;
  if (data === null) fail("this page contains no data");
  else if (data.length < kLong) start(data);
  else {
    say("Reading the plan …", document.title, "failure reading");
    // Starts only when the message has been painted.
    requestAnimationFrame(() => setTimeout(() => start(data)));
  }
}

function start(data: string): void {
  try {
    run(new App(readModel(data)));
  } catch (error) {
    fail(error instanceof Error ? error.message : String(error));
  }
}

function fail(why: string): void {
  say("This plan cannot be shown", why);
}

function say(title: string, text: string, kind = "failure"): void {
  document.body.replaceChildren(
    el("main", { class: kind }, el("h1", {}, title), el("p", {}, text)));
}

function run(app: App): void {
  const help = new Help(kSteps.unit);
  const strip = new Strip(app);
  const controls = new Controls(app, kSteps, () => help.toggle());
  const chart = new Chart(app);
  const details = new Details(app);
  const lists = new Lists(app);
  const stages = app.viewed.length > 0
    ? app.viewed.map((viewed) => new Stage(app, planScene(app, viewed)))
    : [new Stage(app, instanceScene(app))];
  const side = el("aside", { class: "side" }, details.element, lists.element);
  const time = app.viewed.length > 0 ? [controls.element, chart.element] : [];
  const foot = el("footer", { class: "foot" }, ...time, legend(app));
  document.body.replaceChildren(
    strip.element,
    el("main", { class: "stages" }, ...stages.map((stage) => stage.element)),
    side,
    foot,
    help.element,
  );

  const scheme = matchMedia("(prefers-color-scheme: dark)");
  const touch = () => {
    for (const stage of stages) stage.touch();
  };
  app.onChange(touch);
  scheme.addEventListener("change", touch);
  const resize = () => stages.forEach((stage) => stage.resize());
  new ResizeObserver(resize).observe(stages[0].element.parentElement!);
  resize();
  joinCameras(stages);
  listenToKeys({ app, cameras: stages.map((stage) => stage.camera), search: lists.search, help });
  linkPage(app);

  const frames: number[] = [];
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
    strip.update();
    frames.push(performance.now() - before);
    if (frames.length > 600) frames.shift();
    app.work(app.player.playing ? kWorkBudget : 2 * kWorkBudget);
    requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
  // For tests: the state, and the milliseconds that the page took for each of the last frames.
  Object.assign(window, { grove: { app, stages, frames } });
}

// Keeps the cameras of two plans at the same position and scale.
function joinCameras(stages: Stage[]): void {
  stages.forEach((stage, i) => {
    stage.onCamera = () => {
      const other = stages[1 - i];
      if (!other) return;
      const { center, scale } = stage.camera;
      Object.assign(other.camera, { center: { ...center }, scale });
      other.touch();
    };
  });
}

begin();
