// SPDX-License-Identifier: MIT
// The visible part of the world and its scale. Converts world units to pixels of the view and back.

import type { Point } from "./model";

export class Camera {
  // The world point in the middle of the view, and the number of pixels per world unit.
  center: Point = { x: 0, y: 0 };
  scale = 1;
  width = 1; // of the view, in pixels
  height = 1;
  private leastScale = 1;
  private mostScale = 1;

  constructor(
    private readonly worldWidth: number,
    private readonly worldHeight: number,
    private readonly unit: number, // length of a step in world units
  ) {}

  // Sets the size of the view in pixels. If the whole world was visible, it stays visible. Otherwise the
  // world point in the middle of the view stays there.
  resize(width: number, height: number): void {
    const fitted = this.scale <= this.leastScale * 1.001;
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
    const whole = Math.min(this.width / this.worldWidth, this.height / this.worldHeight);
    this.leastScale = Math.min(whole, kLargestStep / this.unit);
    this.mostScale = Math.max(this.leastScale, kLargestStep / this.unit);
    if (fitted) this.fit();
    else this.set(this.center, this.scale);
  }

  // Shows the whole world.
  fit(): void {
    this.set({ x: this.worldWidth / 2, y: this.worldHeight / 2 }, this.leastScale);
  }

  get isFitted(): boolean {
    return this.scale <= this.leastScale * 1.001;
  }

  toView(x: number, y: number): Point {
    return {
      x: (x - this.center.x) * this.scale + this.width / 2,
      y: (y - this.center.y) * this.scale + this.height / 2,
    };
  }

  toWorld(x: number, y: number): Point {
    return {
      x: (x - this.width / 2) / this.scale + this.center.x,
      y: (y - this.height / 2) / this.scale + this.center.y,
    };
  }

  // Moves the world by (dx, dy) pixels in the view.
  pan(dx: number, dy: number): void {
    const { center, scale } = this;
    this.set({ x: center.x - dx / scale, y: center.y - dy / scale }, scale);
  }

  // Zooms by `factor`. The world point at (x, y), in pixels of the view, stays there.
  zoom(factor: number, x: number, y: number): void {
    const fixed = this.toWorld(x, y);
    const scale = Math.min(this.mostScale, Math.max(this.leastScale, this.scale * factor));
    this.set(
      { x: fixed.x - (x - this.width / 2) / scale, y: fixed.y - (y - this.height / 2) / scale },
      scale,
    );
  }

  // Moves a world point to the middle of the view, and zooms in if the scale is small.
  show(x: number, y: number): void {
    this.set({ x, y }, Math.max(this.scale, Math.min(this.mostScale, kNear / this.unit)));
  }

  // Sets centre and scale. Keeps the middle of the view within the world, and centres the world in each
  // dimension in which it fits into the view.
  private set(center: Point, scale: number): void {
    this.scale = scale;
    const keep = (value: number, size: number, view: number) =>
      size * scale <= view ? size / 2 : Math.min(size, Math.max(0, value));
    this.center = {
      x: keep(center.x, this.worldWidth, this.width),
      y: keep(center.y, this.worldHeight, this.height),
    };
  }
}

const kLargestStep = 200; // pixels per step at the greatest zoom
const kNear = 28;
