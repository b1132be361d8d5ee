// SPDX-License-Identifier: MIT
// Paints the objects that rarely change, on a 2D canvas: the world (once per camera position), heat,
// destinations, tasks, vertex names, and the path of the selected robot.

import { shapes } from "../palette.json";
import type { Camera } from "./camera";
import type { Colors } from "./colors";
import { visitsBy, type PlanFacts } from "./facts";
import { hasChoice, type Model, type Point, type World } from "./model";
import { cutInTheMiddle, labelsOf } from "./names";
import { dashesOf, paintTasks } from "./tasks_canvas";
import { outlined } from "./text";

const kLeastOwned = 34; // pixels per step, from which on destinations show the ids of their robots
const kMaxOwnerLabelLength = 9;
const kMaxTaskLabelLength = 16; // the label is cut further to fit its cell

export interface PathPainter {
  paint(
    c: CanvasRenderingContext2D, camera: Camera, agent: number, time: number, colors: Colors,
  ): void;
}

// Facts about the plan that the scenery shows.
export type SceneFacts = Pick<PlanFacts, "tasks" | "destinations">;

export interface DisplayOptions {
  chosen: number; // the selected robot; -1: none
  chosenTask: number;
  heat: Float32Array | null; // by place, from 0 to 1
  paths: PathPainter | null; // paints the path of the selected robot
  labels: boolean;
}

export class Scenery {
  private readonly ground: HTMLCanvasElement = document.createElement("canvas");
  private groundKey = "";
  private mapImage: HTMLCanvasElement | null = null;
  private mapColors: Colors | null = null;

  private readonly tasksByPlace = new Map<number, number[]>();
  private readonly goals: Set<number>; // destinations, and places that are destinations by choice
  private readonly free: number[]; // places that a robot may choose as its destination, but no robot does
  private readonly destinations: number[]; // by robot; -1: none, or not known
  private readonly owners: string[]; // by robot: label of its destination
  private readonly taskLabels: string[]; // by task

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly model: Model,
    private readonly facts: SceneFacts | null,
  ) {
    this.goals = new Set(model.agents.flatMap(({ goal, goals }) => [goal, ...goals]));
    this.destinations = facts?.destinations ?? model.agents.map(({ goal }) => goal);
    const taken = new Set(this.destinations);
    this.free = [...new Set(model.agents.flatMap(({ goals }) => goals))].filter((place) => !taken.has(place));
    this.owners = labelsOf(model.agents.map(({ name }) => name), kMaxOwnerLabelLength);
    this.taskLabels = model.tasks.map(({ name }) => cutInTheMiddle(name, kMaxTaskLabelLength));
    model.tasks.forEach(({ place }, index) => {
      const others = this.tasksByPlace.get(place);
      if (others) others.push(index);
      else this.tasksByPlace.set(place, [index]);
    });
  }

  paint(camera: Camera, time: number, shown: DisplayOptions, colors: Colors, ratio: number): void {
    const width = Math.round(camera.width * ratio);
    const height = Math.round(camera.height * ratio);
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    const c = this.canvas.getContext("2d")!;
    c.setTransform(1, 0, 0, 1, 0, 0);
    this.paintGround(camera, colors, ratio, width, height);
    c.drawImage(this.ground, 0, 0);
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    if (shown.heat) this.paintHeat(c, camera, shown.heat, colors);
    this.paintPlaces(c, camera, time, shown, colors);
    if (this.model.world.kind === "roadmap" && shown.labels) this.paintNames(c, camera, colors);
    if (shown.paths && shown.chosen >= 0) shown.paths.paint(c, camera, shown.chosen, time, colors);
  }

  // Paints the world, but only if camera, size or colours have changed.
  private paintGround(
    camera: Camera, colors: Colors, ratio: number, width: number, height: number,
  ): void {
    const { center, scale } = camera;
    const key = [center.x, center.y, scale, width, height, ratio, colors.name].join();
    if (key === this.groundKey) return;
    this.groundKey = key;
    this.ground.width = width;
    this.ground.height = height;
    const c = this.ground.getContext("2d")!;
    const { world } = this.model;
    c.fillStyle = world.kind === "grid" ? colors.outside : colors.floor;
    c.fillRect(0, 0, width, height);
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    if (world.kind === "grid") this.paintGrid(c, camera, world, colors);
    else paintRoads(c, camera, world, colors);
  }

  private paintGrid(
    c: CanvasRenderingContext2D, camera: Camera, world: World, colors: Colors,
  ): void {
    if (!this.mapImage || this.mapColors !== colors) {
      this.mapImage = imageOfGrid(world, colors);
      this.mapColors = colors;
    }
    const at = camera.toView(0, 0);
    c.imageSmoothingEnabled = camera.scale < 1;
    c.drawImage(this.mapImage, at.x, at.y, world.width * camera.scale, world.height * camera.scale);
    if (camera.scale >= 12) paintLines(c, camera, world, colors);
  }

  private paintHeat(
    c: CanvasRenderingContext2D, camera: Camera, heat: Float32Array, colors: Colors,
  ): void {
    const { world } = this.model;
    const size = Math.max(2, world.unit * camera.scale);
    c.fillStyle = colors.heat;
    for (let place = 0; place < world.places; ++place) {
      if (heat[place] === 0) continue;
      const p = camera.toView(world.xs[place], world.ys[place]);
      if (isOutside(p.x, p.y, size, camera)) continue;
      c.globalAlpha = 0.1 + 0.75 * heat[place];
      c.fillRect(p.x - size / 2, p.y - size / 2, size, size);
    }
    c.globalAlpha = 1;
  }

  // Paints destinations and tasks.
  private paintPlaces(
    c: CanvasRenderingContext2D, camera: Camera, time: number, shown: DisplayOptions, colors: Colors,
  ): void {
    const { world, agents, tasks } = this.model;
    const step = world.unit * camera.scale;
    if (step < 3) return;
    const r = Math.max(2, shapes.goalRadius * step);
    const paintSquare = (place: number): Point | null => {
      const p = camera.toView(world.xs[place], world.ys[place]);
      if (isOutside(p.x, p.y, step, camera)) return null;
      c.strokeRect(p.x - r, p.y - r, 2 * r, 2 * r);
      return p;
    };
    c.strokeStyle = colors.goal;
    c.lineWidth = 1.25;
    c.setLineDash(dashesOf(step));
    this.free.forEach(paintSquare);
    c.setLineDash([]);
    this.destinations.forEach((place, index) => {
      if (place < 0) return;
      c.strokeStyle = index === shown.chosen ? colors.chosen : colors.goal;
      c.lineWidth = index === shown.chosen ? 2.5 : 1.25;
      const p = paintSquare(place);
      if (p && step >= kLeastOwned && shown.labels) this.paintOwner(c, p.x, p.y + r, index, step, colors);
    });
    c.strokeStyle = colors.chosen;
    c.lineWidth = 1.5;
    c.setLineDash(dashesOf(step));
    for (const place of agents[shown.chosen]?.goals ?? [])
      if (place !== this.destinations[shown.chosen]) paintSquare(place);
    c.setLineDash([]);
    for (const [place, indices] of this.tasksByPlace) {
      const p = camera.toView(world.xs[place], world.ys[place]);
      if (isOutside(p.x, p.y, step, camera)) continue;
      const states = indices.map((index) => ({
        label: this.taskLabels[index],
        begun: this.facts !== null && this.facts.tasks[index].begin <= time,
        visits: this.facts ? visitsBy(this.facts.tasks[index], time) : 0,
        need: tasks[index].need,
        isChoice: hasChoice(tasks[index]),
      }));
      paintTasks(c, p.x, p.y, step, states, indices.includes(shown.chosenTask), colors);
    }
  }

  // Paints the id at the lower edge of the destination's square, so that it is visible while other robots
  // pass.
  private paintOwner(
    c: CanvasRenderingContext2D, x: number, y: number, robot: number, step: number, colors: Colors,
  ): void {
    c.font = `${Math.min(15, Math.max(9, 0.13 * step))}px system-ui, sans-serif`;
    c.textAlign = "center";
    c.textBaseline = "bottom";
    outlined(c, this.owners[robot], x, y - 1, colors.faint, colors.floor);
  }

  // Paints vertex names below the objects on the vertices. If names would overlap, paints only the first of
  // them. Paints none if the view is too small for all visible names.
  private paintNames(c: CanvasRenderingContext2D, camera: Camera, colors: Colors): void {
    const { world } = this.model;
    const step = world.unit * camera.scale;
    const seen = world.vertexNames
      .map((name, v) => ({ name, v, at: camera.toView(world.xs[v], world.ys[v]) }))
      .filter(({ at }) => !isOutside(at.x, at.y, 20, camera));
    if (seen.length * shapes.areaPerName > camera.width * camera.height) return;
    c.font = "11px system-ui, sans-serif";
    c.textAlign = "center";
    c.textBaseline = "top";
    const taken: { x: number; y: number; half: number }[] = [];
    const isTaken = (x: number, y: number, half: number) => taken.some((other) =>
      Math.abs(other.x - x) < other.half + half + 3 && Math.abs(other.y - y) < 13);
    for (const { name, v, at } of seen) {
      const half = c.measureText(name).width / 2;
      const y = at.y + this.reachOf(v, step) + 2;
      if (isTaken(at.x, y, half)) continue;
      taken.push({ x: at.x, y, half });
      outlined(c, name, at.x, y, colors.faint, colors.floor);
    }
  }

  // Returns the distance from a vertex to the lower edge of the objects on it, in pixels.
  private reachOf(vertex: number, step: number): number {
    if (this.tasksByPlace.has(vertex)) return Math.max(2.5, shapes.taskRadius * step);
    if (this.goals.has(vertex)) return Math.max(2, shapes.goalRadius * step);
    return vertexRadius(step);
  }
}

export function isOutside(x: number, y: number, size: number, camera: Camera): boolean {
  return x < -size || y < -size || x > camera.width + size || y > camera.height + size;
}

// Returns an image of the grid, with one pixel per cell.
function imageOfGrid(world: World, colors: Colors): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = world.columns;
  canvas.height = world.places / world.columns;
  const c = canvas.getContext("2d")!;
  const image = c.createImageData(canvas.width, canvas.height);
  const pixels = new Uint32Array(image.data.buffer);
  const free = packed(colors.floor);
  const blocked = packed(colors.wall);
  for (let place = 0; place < world.places; ++place)
    pixels[place] = world.free[place] ? free : blocked;
  c.putImageData(image, 0, 0);
  return canvas;
}

// Converts "#rrggbb" to a pixel of image data, on a little-endian machine.
function packed(color: string): number {
  const value = parseInt(color.slice(1), 16);
  const [r, g, b] = [value >> 16, (value >> 8) & 255, value & 255];
  return ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;
}

function paintLines(
  c: CanvasRenderingContext2D, camera: Camera, world: World, colors: Colors,
): void {
  const from = camera.toWorld(0, 0);
  const to = camera.toWorld(camera.width, camera.height);
  c.strokeStyle = colors.lines;
  c.lineWidth = 1;
  c.beginPath();
  for (let x = Math.max(0, Math.floor(from.x)); x <= Math.min(world.width, to.x); ++x) {
    const a = camera.toView(x, Math.max(0, from.y));
    const b = camera.toView(x, Math.min(world.height, to.y));
    c.moveTo(Math.round(a.x) + 0.5, a.y);
    c.lineTo(Math.round(a.x) + 0.5, b.y);
  }
  for (let y = Math.max(0, Math.floor(from.y)); y <= Math.min(world.height, to.y); ++y) {
    const a = camera.toView(Math.max(0, from.x), y);
    const b = camera.toView(Math.min(world.width, to.x), y);
    c.moveTo(a.x, Math.round(a.y) + 0.5);
    c.lineTo(b.x, Math.round(a.y) + 0.5);
  }
  c.stroke();
}

function paintRoads(
  c: CanvasRenderingContext2D, camera: Camera, world: World, colors: Colors,
): void {
  const step = world.unit * camera.scale;
  c.lineCap = "round";
  c.strokeStyle = colors.road;
  c.lineWidth = Math.max(1.5, Math.min(14, 0.55 * step));
  c.beginPath();
  for (const road of world.roads) {
    const a = camera.toView(world.xs[road.from], world.ys[road.from]);
    c.moveTo(a.x, a.y);
    for (let k = 0; k < road.steps - 1; ++k) {
      const p = camera.toView(world.xs[road.first + k], world.ys[road.first + k]);
      c.lineTo(p.x, p.y);
    }
    const b = camera.toView(world.xs[road.to], world.ys[road.to]);
    c.lineTo(b.x, b.y);
  }
  c.stroke();
  if (step >= 4) paintArrows(c, camera, world, step, colors);
  c.fillStyle = colors.vertex;
  c.beginPath();
  const r = vertexRadius(step);
  for (let v = 0; v < world.vertexNames.length; ++v) {
    const p = camera.toView(world.xs[v], world.ys[v]);
    c.moveTo(p.x + r, p.y);
    c.arc(p.x, p.y, r, 0, 2 * Math.PI);
  }
  c.fill();
}

function vertexRadius(step: number): number {
  return Math.max(1, Math.min(7, 0.2 * step));
}

// Paints an arrow in the middle of each one-way road, in its direction.
function paintArrows(
  c: CanvasRenderingContext2D, camera: Camera, world: World, step: number, colors: Colors,
): void {
  c.fillStyle = colors.arrow;
  const size = Math.max(3, Math.min(8, 0.3 * step));
  c.beginPath();
  for (const road of world.roads) {
    if (!road.oneWay) continue;
    const places = [road.from];
    for (let k = 0; k < road.steps - 1; ++k) places.push(road.first + k);
    places.push(road.to);
    const middle = (places.length - 1) >> 1;
    const a = camera.toView(world.xs[places[middle]], world.ys[places[middle]]);
    const b = camera.toView(world.xs[places[middle + 1]], world.ys[places[middle + 1]]);
    const length = Math.hypot(b.x - a.x, b.y - a.y) || 1;
    const [dx, dy] = [((b.x - a.x) / length) * size, ((b.y - a.y) / length) * size];
    const [x, y] = [(a.x + b.x) / 2, (a.y + b.y) / 2];
    if (isOutside(x, y, 10, camera)) continue;
    c.moveTo(x + dx, y + dy);
    c.lineTo(x - dx - dy, y - dy + dx);
    c.lineTo(x - dx + dy, y - dy - dx);
    c.closePath();
  }
  c.fill();
}
