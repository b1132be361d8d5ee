// SPDX-License-Identifier: MIT
// Marks on the map for the selected step: the places and times of its constraints and, for its first two
// agents, dashed straight lines from the start through the places of a constraint to the destination.

import type { Camera } from "../page/camera";
import type { Colors } from "../page/colors";
import type { Point } from "../page/model";
import type { PathPainter } from "../page/scenery";
import { outlined } from "../page/text";
import type { ProofApp } from "./app";
import { constraintOf, type Constraint } from "./certificate";

const kDashes = [[7, 4], [2, 4]]; // for the first and the second agent
const kHalf = 0.46; // half the side of the square on a place, in steps
const kLeastWritten = 24; // half side in pixels, from which on times are written in the square

// Returns the constraints that the map marks: both sides of a split, otherwise the constraint that leads to
// the step or, at the root, the constraints of the statement.
export function constraintsShown({ step, statement }: ProofApp): Constraint[] {
  if (step.sides.length > 0) return step.sides;
  const constraint = constraintOf(step);
  return constraint ? [constraint] : statement.constraints;
}

function timesText({ begin, end, stop }: Constraint): string {
  if (stop >= 0) return `stop ${stop + 1}`;
  return begin === end ? String(begin) : end === Infinity ? `${begin}…` : `${begin}–${end}`;
}

export class Marks implements PathPainter {
  constructor(private readonly app: ProofApp) {}

  paint(c: CanvasRenderingContext2D, camera: Camera, ...[, , colors]: [number, number, Colors]): void {
    const constraints = constraintsShown(this.app);
    const size = Math.max(5, kHalf * this.app.model.world.unit * camera.scale);
    c.strokeStyle = c.fillStyle = colors.chosen;
    this.app.agents.slice(0, kDashes.length).forEach((agent, i) => {
      c.setLineDash(kDashes[i]);
      this.paintWay(c, camera, agent, constraints.find((constraint) => constraint.agent === agent));
    });
    c.setLineDash([]);
    const texts = new Map<number, Set<string>>();
    for (const constraint of constraints) {
      const places = this.placesOf(constraint);
      if (places.length === 2) this.paintMove(c, camera, places);
      const last = places[places.length - 1];
      for (const place of places) this.paintSquare(c, this.at(camera, place), size, colors);
      if (!texts.has(last)) texts.set(last, new Set());
      texts.get(last)!.add(timesText(constraint));
    }
    c.font = "700 13px system-ui, sans-serif";
    for (const [place, words] of texts)
      paintText(c, camera, this.at(camera, place), [...words].join(", "), size, colors);
  }

  private at(camera: Camera, place: number): Point {
    const { xs, ys } = this.app.model.world;
    return camera.toView(xs[place], ys[place]);
  }

  private placesOf({ places, task }: Constraint): number[] {
    return task >= 0 ? [this.app.model.tasks[task].place] : places;
  }

  private paintWay(
    c: CanvasRenderingContext2D, camera: Camera, agent: number, constraint: Constraint | undefined,
  ): void {
    const { start, goal } = this.app.model.agents[agent];
    const places = [start, ...(constraint ? this.placesOf(constraint) : []), ...(goal >= 0 ? [goal] : [])];
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

// Writes a text at the upper edge of a square, above the agent there, or beside a small square, on the side
// with space.
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

// Returns, for each place, the sum of its multipliers over all times, relative to the maximum; null if the
// step has no multipliers. A multiplier of a move counts half at each end.
export function multiplierHeat({ model, step }: ProofApp): Float32Array | null {
  if (step.kind !== "prices") return null;
  const heat = new Float32Array(model.world.places);
  for (const { kind, numbers, multiplier } of step.rows) {
    if (kind === "place") heat[numbers[0]] += multiplier;
    if (kind === "edge") for (const place of numbers.slice(0, 2)) heat[place] += multiplier / 2;
  }
  const most = heat.reduce((a, b) => Math.max(a, b), 0);
  return most > 0 ? heat.map((value) => value / most) : heat;
}
