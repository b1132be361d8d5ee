// SPDX-License-Identifier: MIT
// Page of an execution. Shows the log that the page contains or, during the execution, the growing log that
// the server sends.

import { kDark, kLight } from "../page/colors";
import { el } from "../page/dom";
import { destinationsOf } from "../page/facts";
import { listenToKeys } from "../page/keys";
import { linkPage } from "../page/link";
import type { Model } from "../page/model";
import { Controls } from "../page/panels/controls";
import { Help } from "../page/panels/help";
import { Paths } from "../page/paths";
import { readModel } from "../page/read";
import { Stage } from "../page/stage";
import { Follower } from "../run/follow";
import { DriveApp } from "./app";
import { readDrive } from "./columns";
import { Log } from "./log";
import { DriveNow } from "./now";
import { Order } from "./order";
import { Details } from "./panels/details";
import { legend } from "./panels/legend";
import { Robots } from "./panels/robots";
import { Strip } from "./panels/strip";
import { kSeconds, troubleText } from "./words";

const kPause = 300; // milliseconds between requests for new data

function textOf(id: string): string {
  return document.getElementById(id)!.textContent!;
}

function begin(): void {
  try {
    run();
  } catch (error) {
    const why = error instanceof Error ? error.message : String(error);
    document.body.replaceChildren(el("main", { class: "failure" },
      el("h1", {}, "This execution cannot be shown"), el("p", {}, why)));
  }
}

function run(): void {
  const model = readModel(textOf("grove-data"));
  const order = Order.read(textOf("grove-order"), model);
  if (document.body.hasAttribute("data-follow")) follow(model, order);
  else {
    const app = new DriveApp(model, order, readDrive(textOf("grove-drive"), model, order), false);
    show(app, new Strip(app));
    linkPage(app);
  }
}

function follow(model: Model, order: Order): void {
  let log = new Log(model, order);
  const app = new DriveApp(model, order, log.drive, true);
  const strip = new Strip(app);
  const update = () => {
    strip.fail(troubleText(log));
    app.setDrive(log.drive);
  };
  show(app, strip);
  let isLinked = false;
  void new Follower({
    begin: () => {
      log = new Log(model, order);
      update();
    },
    add: (text, isAll) => {
      log.add(text);
      update();
      // Applies the link only now, because it can name any moment of the log so far.
      if (isAll && !isLinked) linkPage(app);
      isLinked ||= isAll;
    },
    state: (isAnswering) => strip.answers(isAnswering),
  }, kPause).run();
}

function show(app: DriveApp, strip: Strip): void {
  const help = new Help(kSeconds.unit);
  const live = el("button", {
    type: "button", class: "golive", title: "Go to the current moment", click: () => {
      app.player.goLive();
      app.changed();
    },
  }, "● Live");
  live.hidden = !app.player.isFollowed;
  const controls = new Controls(app, kSeconds, () => help.toggle(), live);
  const details = new Details(app);
  const robots = new Robots(app);
  const now = new DriveNow(app.model, app.drive);
  const stage = new Stage(app, sceneOf(app, now));
  document.body.replaceChildren(
    strip.element,
    el("main", { class: "stages" }, stage.element),
    el("aside", { class: "side" }, details.element, robots.element),
    el("footer", { class: "foot" }, controls.element, legend(app)),
    help.element);
  const scheme = matchMedia("(prefers-color-scheme: dark)");
  const touch = () => {
    now.drive = app.drive;
    stage.touch();
  };
  app.onChange(touch);
  scheme.addEventListener("change", touch);
  new ResizeObserver(() => stage.resize()).observe(stage.element);
  stage.resize();
  listenToKeys({ app, cameras: [stage.camera], search: robots.search, help });
  let last = performance.now();
  const tick = (time: number) => {
    app.player.advance((time - last) / 1000);
    last = time;
    stage.draw(scheme.matches ? kDark : kLight, Math.min(2, devicePixelRatio));
    for (const panel of [strip, controls, details, robots]) panel.update();
    live.setAttribute("aria-pressed", String(app.player.live));
    requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
  // For tests: the state of the page.
  Object.assign(window, { grove: { app, stages: [stage] } });
}

// Returns the scene of the execution. On the planned path of the selected robot, the part ahead starts after
// its last completed action.
function sceneOf(app: DriveApp, frame: DriveNow) {
  const [plan] = app.model.plans;
  const paths = new Paths(app.model, { plan }, null);
  return {
    frame,
    facts: { tasks: app.tasks, destinations: destinationsOf(app.model, plan) },
    paths: {
      paint: (c: CanvasRenderingContext2D, ...[camera, agent, time, colors]: Painted) =>
        paths.paint(c, camera, agent, app.order.planTime(agent, app.drive.actionsAt(agent, time)), colors),
    },
    label: "The execution",
    caption: "",
    heat: () => null,
    elsewhere: () => null,
  };
}

type Painted = Parameters<Paths["paint"]> extends [unknown, ...infer Rest] ? Rest : never;

begin();
