// SPDX-License-Identifier: MIT
// One plan on its canvas, with its camera and, where not all of the world is seen, a map of it.

import type { App, Heat, Viewed } from "./app";
import { Camera } from "./camera";
import { Painter, type Shown } from "./canvas";
import type { Colors } from "./colors";
import { el } from "./dom";
import { Frame } from "./frame";
import { listen } from "./gestures";
import { heatMap } from "./heat";

const kMinimap = 140; // pixels, the longer side

export class Stage {
  readonly element: HTMLElement;
  readonly camera: Camera;
  readonly frame: Frame | null;
  private readonly canvas = el("canvas", { tabindex: 0 });
  private readonly painter: Painter;
  private readonly miniCanvas = el("canvas", { class: "minimap", "aria-hidden": true });
  private readonly miniPainter: Painter;
  private readonly miniCamera: Camera;
  private heat: { kind: Heat; map: Float32Array } | null = null;
  private path: { agent: number; places: number[] } | null = null;
  private dirty = true;

  constructor(private readonly app: App, readonly viewed: Viewed | null) {
    const { world } = app.model;
    this.camera = new Camera(world.width, world.height, world.unit);
    this.miniCamera = new Camera(world.width, world.height, world.unit);
    this.frame = viewed ? new Frame(app.model, viewed.plan, viewed.facts) : null;
    const facts = viewed ? viewed.facts : null;
    this.painter = new Painter(this.canvas, app.model, facts);
    this.miniPainter = new Painter(this.miniCanvas, app.model, facts);
    this.canvas.setAttribute("aria-label", viewed ? `The plan ${viewed.plan.name}` : "The instance");
    this.canvas.setAttribute("role", "img");
    this.element = el("div", { class: "stage" }, this.canvas, this.miniCanvas);
    listen(this.canvas, this.camera, {
      moved: () => this.cameraMoved(),
      clicked: (x, y) => this.click(x, y),
    });
    this.listenToMinimap();
  }

  onCamera: () => void = () => {};

  // Something other than time has changed.
  touch(): void {
    this.dirty = true;
  }

  private cameraMoved(): void {
    this.app.following = false;
    this.dirty = true;
    this.onCamera();
  }

  private listenToMinimap(): void {
    const go = (event: PointerEvent) => {
      const box = this.miniCanvas.getBoundingClientRect();
      const p = this.miniCamera.toWorld(event.clientX - box.left, event.clientY - box.top);
      this.camera.pan((this.camera.center.x - p.x) * this.camera.scale, (this.camera.center.y - p.y) * this.camera.scale);
      this.cameraMoved();
    };
    this.miniCanvas.addEventListener("pointerdown", go);
    this.miniCanvas.addEventListener("pointermove", (event) => {
      if (event.buttons & 1) go(event);
    });
  }

  // The nearest robot, else the task there, else nothing.
  private click(x: number, y: number): void {
    const { model } = this.app;
    const { world } = model;
    const p = this.camera.toWorld(x, y);
    const reach = Math.max(0.5 * world.unit, 10 / this.camera.scale);
    let best = -1;
    let least = reach;
    if (this.frame)
      for (let i = 0; i < this.frame.count; ++i) {
        if (this.frame.missing[i]) continue;
        const distance = Math.hypot(this.frame.xs[i] - p.x, this.frame.ys[i] - p.y);
        if (distance < least) [best, least] = [i, distance];
      }
    if (best >= 0) return this.app.choose(best);
    const task = model.tasks.findIndex(
      ({ place }) => Math.hypot(world.xs[place] - p.x, world.ys[place] - p.y) < reach,
    );
    if (task >= 0) this.app.chooseTask(task);
    else this.app.choose(-1);
  }

  resize(): void {
    this.camera.resize(this.element.clientWidth, this.element.clientHeight);
    const { world } = this.app.model;
    const scale = kMinimap / Math.max(world.width, world.height);
    this.miniCamera.resize(world.width * scale, world.height * scale);
    this.miniCamera.fit();
    this.miniCanvas.style.width = `${world.width * scale}px`;
    this.miniCanvas.style.height = `${world.height * scale}px`;
    this.dirty = true;
  }

  // Draws if something has changed. True if it did.
  draw(colors: Colors, ratio: number): boolean {
    const { player, chosen, following } = this.app;
    if (!this.dirty && this.frame?.time === player.time) return false;
    this.dirty = false;
    this.frame?.update(player.time);
    if (following && chosen >= 0 && this.frame)
      this.camera.show(this.frame.xs[chosen], this.frame.ys[chosen]);
    this.painter.paint(this.camera, this.frame, this.shown(), colors, ratio);
    this.drawMinimap(colors, ratio);
    return true;
  }

  private drawMinimap(colors: Colors, ratio: number): void {
    const hidden = this.camera.isFitted;
    if (this.miniCanvas.hidden !== hidden) this.miniCanvas.hidden = hidden;
    if (hidden) return;
    const shown: Shown = { ...this.shown(), heat: null, labels: false };
    this.miniPainter.paint(this.miniCamera, this.frame, shown, colors, ratio);
    const c = this.miniCanvas.getContext("2d")!;
    const a = this.camera.toWorld(0, 0);
    const b = this.camera.toWorld(this.camera.width, this.camera.height);
    const from = this.miniCamera.toView(a.x, a.y);
    const to = this.miniCamera.toView(b.x, b.y);
    c.strokeStyle = colors.chosen;
    c.lineWidth = 1.5;
    c.strokeRect(from.x, from.y, to.x - from.x, to.y - from.y);
  }

  private shown(): Shown {
    const { chosen, chosenTask, labels } = this.app;
    return { chosen, chosenTask, labels, heat: this.heatNow(), path: this.pathOf(chosen) };
  }

  private heatNow(): Float32Array | null {
    const kind = this.app.heat;
    if (kind === "none" || !this.viewed) return null;
    if (this.heat?.kind !== kind)
      this.heat = { kind, map: heatMap(this.app.model, this.viewed.plan, this.viewed.facts, kind) };
    return this.heat.map;
  }

  private pathOf(agent: number): number[] | null {
    if (agent < 0 || !this.viewed) return null;
    if (this.path?.agent === agent) return this.path.places;
    const { track } = this.viewed.plan.agents[agent];
    const places: number[] = [];
    for (let run = 0; run < track.runs; ++run) {
      const steps = track.times[run + 1] - track.times[run];
      if (places.length === 0) places.push(track.places[run]);
      if (track.jumps[run]) places.push(track.places[run + 1]);
      else if (track.deltas[run] !== 0)
        for (let k = 1; k <= steps; ++k) places.push(track.places[run] + k * track.deltas[run]);
    }
    this.path = { agent, places };
    return places;
  }
}
