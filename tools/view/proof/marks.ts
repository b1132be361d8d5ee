// SPDX-License-Identifier: MIT
// On the map: where what the step speaks of is, with its times; and of the agents that it is about
// starts and goals, with the ways there and on, dashed, as the crow flies.

import type { Camera } from "../page/camera";
import type { Colors } from "../page/colors";
import type { Point } from "../page/model";
import type { PathPainter } from "../page/scenery";
import { outlined } from "../page/text";
import type { ProofApp } from "./app";
import { demandOf, type Demand } from "./certificate";

const kDashes = [[7, 4], [2, 4]]; // of the first agent, and the second
const kHalf = 0.46; // of the square on a place, in steps
const kLeastWritten = 24; // pixels of that, from which on times are written in it

// What the map marks: both sides of a split, else what leads to the step.
export function demandsShown({ step, statement }: ProofApp): Demand[] {
  if (step.sides.length > 0) return step.sides;
  const demand = demandOf(step);
  return demand ? [demand] : statement.demands;
}

function timesText({ begin, end, stop }: Demand): string {
  if (stop >= 0) return `stop ${stop + 1}`;
  return begin === end ? String(begin) : end === Infinity ? `${begin}…` : `${begin}–${end}`;
}

export class Marks implements PathPainter {
  constructor(private readonly app: ProofApp) {}

  paint(c: CanvasRenderingContext2D, camera: Camera, ...[, , colors]: [number, number, Colors]): void {
    const demands = demandsShown(this.app);
    const size = Math.max(5, kHalf * this.app.model.world.unit * camera.scale);
    c.strokeStyle = c.fillStyle = colors.chosen;
    this.app.agents.slice(0, kDashes.length).forEach((agent, i) => {
      c.setLineDash(kDashes[i]);
      this.paintWay(c, camera, agent, demands.find((demand) => demand.agent === agent));
    });
    c.setLineDash([]);
    const texts = new Map<number, Set<string>>();
    for (const demand of demands) {
      const places = this.placesOf(demand);
      if (places.length === 2) this.paintMove(c, camera, places);
      const last = places[places.length - 1];
      for (const place of places) this.paintSquare(c, this.at(camera, place), size, colors);
      if (!texts.has(last)) texts.set(last, new Set());
      texts.get(last)!.add(timesText(demand));
    }
    c.font = "700 13px system-ui, sans-serif";
    for (const [place, words] of texts)
      paintText(c, camera, this.at(camera, place), [...words].join(", "), size, colors);
  }

  private at(camera: Camera, place: number): Point {
    const { xs, ys } = this.app.model.world;
    return camera.toView(xs[place], ys[place]);
  }

  private placesOf({ places, task }: Demand): number[] {
    return task >= 0 ? [this.app.model.tasks[task].place] : places;
  }

  private paintWay(
    c: CanvasRenderingContext2D, camera: Camera, agent: number, demand: Demand | undefined,
  ): void {
    const { start, goal } = this.app.model.agents[agent];
    const places = [start, ...(demand ? this.placesOf(demand) : []), ...(goal >= 0 ? [goal] : [])];
    c.lineWidth = 1.5;
    c.beginPath();
    places.forEach((place, i) => {
      const { x, y } = this.at(camera, place);
      if (i === 0) c.moveTo(x, y);
      else c.lineTo(x, y);
    });
    c.stroke();
    c.setLineDash([]);
    const ring = Math.max(7, 0.42 * this.app.model.world.unit * camera.scale);
    const { x, y } = this.at(camera, start);
    c.beginPath();
    c.arc(x, y, ring, 0, 2 * Math.PI);
    if (goal >= 0) {
      const end = this.at(camera, goal);
      c.rect(end.x - ring, end.y - ring, 2 * ring, 2 * ring);
    }
    c.stroke();
  }

  private paintMove(c: CanvasRenderingContext2D, camera: Camera, places: number[]): void {
    const [a, b] = places.map((place) => this.at(camera, place));
    c.lineWidth = 3;
    c.beginPath();
    c.moveTo(a.x, a.y);
    c.lineTo(b.x, b.y);
    c.stroke();
  }

  private paintSquare(
    c: CanvasRenderingContext2D, { x, y }: Point, half: number, colors: Colors,
  ): void {
    c.globalAlpha = 0.25;
    c.fillStyle = colors.chosen;
    c.fillRect(x - half, y - half, 2 * half, 2 * half);
    c.globalAlpha = 1;
    c.lineWidth = 2.5;
    c.strokeRect(x - half, y - half, 2 * half, 2 * half);
  }
}

// In the square, above who stands there; beside it if that is small, on the side that has room.
function paintText(
  c: CanvasRenderingContext2D, camera: Camera, { x, y }: Point, text: string, half: number, colors: Colors,
): void {
  const isLarge = half >= kLeastWritten;
  const isLeft = x + half + 3 + c.measureText(text).width > camera.width;
  c.textAlign = isLarge ? "center" : isLeft ? "right" : "left";
  c.textBaseline = "middle";
  const aside = isLarge ? 0 : isLeft ? -half - 3 : half + 3;
  outlined(c, text, x + aside, isLarge ? y - half + 1 : y, colors.chosen, colors.floor);
}

// By place: what the prices there come to, over all times, as a part of the most.
export function priceHeat({ model, step }: ProofApp): Float32Array | null {
  if (step.kind !== "prices") return null;
  const heat = new Float32Array(model.world.places);
  for (const { kind, numbers, price } of step.rows) {
    if (kind === "place") heat[numbers[0]] += price;
    if (kind === "edge") for (const place of numbers.slice(0, 2)) heat[place] += price / 2;
  }
  const most = heat.reduce((a, b) => Math.max(a, b), 0);
  return most > 0 ? heat.map((value) => value / most) : heat;
}
