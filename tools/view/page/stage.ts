// SPDX-License-Identifier: MIT
// One plan in its place on the page: canvases one over the other (scenery, robots, labels), with
// their camera and, where not all of the world is seen, a map of it.

import type { App, Viewed } from "./app";
import { Camera } from "./camera";
import type { Colors } from "./colors";
import { el } from "./dom";
import { planFacts } from "./facts";
import { Frame } from "./frame";
import { listen } from "./gestures";
import { heatMap } from "./heat";
import { Minimap } from "./minimap";
import { Paths } from "./paths";
import { Labels, type RobotPainter } from "./robots";
import { EitherRobots } from "./robots_either";
import { Scenery, type Shown } from "./scenery";
import { standing } from "./standing";

export class Stage {
  readonly element: HTMLElement;
  readonly camera: Camera;
  readonly frame: Frame;
  private readonly canvases: HTMLCanvasElement[];
  private readonly scenery: Scenery;
  private readonly robots: RobotPainter;
  private readonly labels: Labels;
  private readonly minimap: Minimap;
  private readonly paths: Paths | null;
  private heat: { key: string; map: Float32Array } | null = null;
  private dirty = true; // something other than time has changed
  private step = -1; // the last one that the scenery shows

  constructor(private readonly app: App, readonly viewed: Viewed | null) {
    const { model } = app;
    const { world } = model;
    this.camera = new Camera(world.width, world.height, world.unit);
    const plan = viewed ? viewed.plan : standing(model);
    this.frame = new Frame(model, plan, viewed ? viewed.facts : planFacts(model, plan),
      viewed ? viewed.checker.violations : []);
    const other = app.viewed.find((v) => v !== viewed) ?? null;
    this.paths = viewed ? new Paths(model, viewed, other) : null;
    const [ground, plain, fast] = [el("canvas"), el("canvas"), el("canvas")];
    const top = el("canvas", { tabindex: 0 });
    this.canvases = [ground, plain, fast, top];
    this.scenery = new Scenery(ground, model, viewed ? viewed.facts : null);
    this.robots = new EitherRobots(plain, fast, world);
    this.labels = new Labels(top, model, viewed ? other : null);
    this.minimap = new Minimap(model, this.camera, () => this.cameraMoved());
    top.setAttribute("aria-label", viewed ? `The plan ${viewed.plan.name}` : "The instance");
    top.setAttribute("role", "img");
    const caption = viewed && other ? el("div", { class: "caption" }, viewed.plan.name) : null;
    this.element = el("div", { class: "stage" }, ...this.canvases, caption, this.minimap.element);
    listen(top, this.camera, {
      moved: () => this.cameraMoved(),
      clicked: (x, y) => this.click(x, y),
    });
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

  // The nearest robot, else the task there, else whose destination it is, else nothing.
  private click(x: number, y: number): void {
    const { model } = this.app;
    const { world } = model;
    const p = this.camera.toWorld(x, y);
    const reach = Math.max(0.5 * world.unit, 10 / this.camera.scale);
    const robot = this.frame.nearest(p.x, p.y, reach);
    if (robot >= 0) return this.app.choose(robot);
    const isHere = (place: number) =>
      place >= 0 && Math.hypot(world.xs[place] - p.x, world.ys[place] - p.y) < reach;
    const task = model.tasks.findIndex(({ place }) => isHere(place));
    if (task >= 0) this.app.chooseTask(task);
    else this.app.choose(model.agents.findIndex(({ goal }) => isHere(goal)));
  }

  resize(): void {
    this.camera.resize(this.element.clientWidth, this.element.clientHeight);
    this.minimap.resize();
    this.dirty = true;
  }

  // Draws if something has changed.
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
    // Tasks change with whole steps.
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

  private shown(): Shown {
    const { chosen, chosenTask, labels } = this.app;
    return { chosen, chosenTask, labels, heat: this.heatNow(), paths: this.paths };
  }

  private heatNow(): Float32Array | null {
    const { heat } = this.app;
    if (heat === "none" || !this.viewed) return null;
    const key = `${heat} ${this.viewed.waits.done}`;
    if (this.heat?.key !== key)
      this.heat = { key, map: heatMap(this.app.model, this.viewed, heat) };
    return this.heat.map;
  }
}
