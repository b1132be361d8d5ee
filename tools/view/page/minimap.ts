// SPDX-License-Identifier: MIT
// A small map of the whole world that marks the visible part. It is shown while only a part is visible.

import { Camera } from "./camera";
import type { Colors } from "./colors";
import { el } from "./dom";
import type { Model } from "./model";
import { CanvasRobots } from "./robots_canvas";
import type { RobotsNow } from "./robots_now";
import { Scenery, type DisplayOptions } from "./scenery";

const kLonger = 140; // length of the longer side, in pixels
const kLeastRobot = 0.6; // minimum radius of a robot, in pixels

export class Minimap {
  readonly element: HTMLElement;
  private readonly ground = el("canvas");
  private readonly top = el("canvas");
  private readonly camera: Camera;
  private readonly scenery: Scenery;
  private readonly robots: CanvasRobots;

  constructor(
    private readonly model: Model,
    private readonly seen: Camera, // the camera of the large view
    private readonly moved: () => void,
  ) {
    const { world } = model;
    this.camera = new Camera(world.width, world.height, world.unit);
    this.scenery = new Scenery(this.ground, model, null);
    this.robots = new CanvasRobots(this.top, world, kLeastRobot);
    this.element = el("div", { class: "minimap", "aria-hidden": true }, this.ground, this.top);
    this.element.addEventListener("pointerdown", (event) => this.go(event));
    this.element.addEventListener("pointermove", (event) => {
      if (event.buttons & 1) this.go(event);
    });
  }

  private go(event: PointerEvent): void {
    const box = this.element.getBoundingClientRect();
    const p = this.camera.toWorld(event.clientX - box.left, event.clientY - box.top);
    const { center, scale } = this.seen;
    this.seen.pan((center.x - p.x) * scale, (center.y - p.y) * scale);
    this.moved();
  }

  resize(): void {
    const { world } = this.model;
    const scale = kLonger / Math.max(world.width, world.height);
    this.camera.resize(world.width * scale, world.height * scale);
    this.camera.fit();
    this.element.style.width = `${world.width * scale}px`;
    this.element.style.height = `${world.height * scale}px`;
  }

  paint(frame: RobotsNow, shown: DisplayOptions, colors: Colors, ratio: number): void {
    this.element.hidden = this.seen.isFitted;
    if (this.element.hidden) return;
    for (const canvas of [this.ground, this.top]) {
      const width = Math.round(this.camera.width * ratio);
      const height = Math.round(this.camera.height * ratio);
      if (canvas.width !== width) canvas.width = width;
      if (canvas.height !== height) canvas.height = height;
    }
    const few = { ...shown, heat: null, paths: null, labels: false };
    this.scenery.paint(this.camera, frame.time, few, colors, ratio);
    this.robots.paint(this.camera, frame, colors, ratio);
    const c = this.top.getContext("2d")!;
    const a = this.seen.toWorld(0, 0);
    const b = this.seen.toWorld(this.seen.width, this.seen.height);
    const from = this.camera.toView(a.x, a.y);
    const to = this.camera.toView(b.x, b.y);
    c.strokeStyle = colors.chosen;
    c.lineWidth = 1.5;
    c.strokeRect(from.x, from.y, to.x - from.x, to.y - from.y);
  }
}
