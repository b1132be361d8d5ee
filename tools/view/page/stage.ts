// SPDX-License-Identifier: MIT
// Displays a scene on stacked canvases (scenery, robots, labels) with a common camera and, if only a part of
// the world is visible, a small map.

import { Camera } from "./camera";
import type { Colors } from "./colors";
import { el } from "./dom";
import { listen } from "./gestures";
import { Minimap } from "./minimap";
import type { Model, Point } from "./model";
import { Labels, type RobotPainter } from "./robots";
import { AdaptiveRobotPainter } from "./robots_adaptive";
import { nearest, type RobotsNow } from "./robots_now";
import { Scenery, type DisplayOptions, type PathPainter, type SceneFacts } from "./scenery";

// The selection and display options of a page, as a stage needs them.
export interface PageState {
  readonly model: Model;
  readonly player: { readonly time: number };
  readonly chosen: number; // the selected robot; -1: none
  readonly chosenTask: number;
  readonly labels: boolean;
  following: boolean;
  choose(agent: number): void;
  chooseTask(task: number): void;
}

// The objects that a stage displays.
export interface Scene {
  readonly frame: RobotsNow;
  readonly facts: SceneFacts | null; // null: without a plan
  readonly paths: PathPainter | null;
  readonly label: string; // description for screen readers
  readonly caption: string; // empty: none
  heat(): Float32Array | null; // by place, from 0 to 1; null: none
  elsewhere(robot: number, time: number): Point | null; // position in the other plan; null: none
}

export class Stage {
  readonly element: HTMLElement;
  readonly camera: Camera;
  private readonly canvases: HTMLCanvasElement[];
  private readonly scenery: Scenery;
  private readonly robots: RobotPainter;
  private readonly labels: Labels;
  private readonly minimap: Minimap;
  private dirty = true; // something other than time has changed
  private step = -1; // the whole step that the scenery shows

  constructor(private readonly app: PageState, private readonly scene: Scene) {
    const { model } = app;
    const { world } = model;
    this.camera = new Camera(world.width, world.height, world.unit);
    const [ground, plain, fast] = [el("canvas"), el("canvas"), el("canvas")];
    const top = el("canvas", { tabindex: 0 });
    this.canvases = [ground, plain, fast, top];
    this.scenery = new Scenery(ground, model, scene.facts);
    this.robots = new AdaptiveRobotPainter(plain, fast, world);
    this.labels = new Labels(top, model, (robot, time) => scene.elsewhere(robot, time));
    this.minimap = new Minimap(model, this.camera, () => this.cameraMoved());
    top.setAttribute("aria-label", scene.label);
    top.setAttribute("role", "img");
    const caption = scene.caption === "" ? null : el("div", { class: "caption" }, scene.caption);
    this.element = el("div", { class: "stage" }, ...this.canvases, caption, this.minimap.element);
    listen(top, this.camera, {
      moved: () => this.cameraMoved(),
      clicked: (x, y) => this.click(x, y),
    });
  }

  get frame(): RobotsNow {
    return this.scene.frame;
  }

  onCamera: () => void = () => {};

  touch(): void {
    this.dirty = true;
  }

  private cameraMoved(): void {
    this.app.following = false;
    this.dirty = true;
    this.onCamera();
  }

  // Selects the nearest robot within reach of this point. If there is none, selects a task there, otherwise a
  // robot whose destination is there, otherwise the only robot that may choose a destination there, otherwise
  // nothing.
  private click(x: number, y: number): void {
    const { model } = this.app;
    const { world } = model;
    const p = this.camera.toWorld(x, y);
    const reach = Math.max(0.5 * world.unit, 10 / this.camera.scale);
    const robot = nearest(this.frame, p.x, p.y, reach);
    if (robot >= 0) return this.app.choose(robot);
    const isHere = (place: number) =>
      place >= 0 && Math.hypot(world.xs[place] - p.x, world.ys[place] - p.y) < reach;
    const task = model.tasks.findIndex(({ place }) => isHere(place));
    if (task >= 0) this.app.chooseTask(task);
    else this.app.choose(this.robotThatEnds(isHere));
  }

  private robotThatEnds(isHere: (place: number) => boolean): number {
    const { agents } = this.app.model;
    const destinations = this.scene.facts?.destinations ?? agents.map(({ goal }) => goal);
    const owner = destinations.findIndex(isHere);
    if (owner >= 0) return owner;
    const may = [...agents.keys()].filter((agent) => agents[agent].goals.some(isHere));
    return may.length === 1 ? may[0] : -1;
  }

  resize(): void {
    this.camera.resize(this.element.clientWidth, this.element.clientHeight);
    this.minimap.resize();
    this.dirty = true;
  }

  // Draws the scene if something has changed. `ratio`: device pixels per CSS pixel.
  draw(colors: Colors, ratio: number): void {
    const { player, chosen, following } = this.app;
    if (!this.dirty && this.frame.time === player.time) return;
    const { frame } = this;
    frame.update(player.time);
    if (following && chosen >= 0) {
      this.camera.show(frame.xs[chosen], frame.ys[chosen]);
      this.dirty = true;
    }
    const shown = this.shown();
    this.fit(ratio);
    // If only the time has changed, repaints the scenery once per step (in an execution: per second).
    if (this.dirty || Math.floor(player.time) !== this.step)
      this.scenery.paint(this.camera, player.time, shown, colors, ratio);
    this.step = Math.floor(player.time);
    this.dirty = false;
    this.robots.paint(this.camera, frame, colors, ratio);
    this.labels.paint(this.camera, frame, shown, colors, ratio);
    this.minimap.paint(frame, shown, colors, ratio);
  }

  private fit(ratio: number): void {
    const width = Math.round(this.camera.width * ratio);
    const height = Math.round(this.camera.height * ratio);
    for (const canvas of this.canvases) {
      if (canvas.width === width && canvas.height === height) continue;
      canvas.width = width;
      canvas.height = height;
      this.dirty = true;
    }
  }

  private shown(): DisplayOptions {
    const { chosen, chosenTask, labels } = this.app;
    return { chosen, chosenTask, labels, heat: this.scene.heat(), paths: this.scene.paths };
  }
}
