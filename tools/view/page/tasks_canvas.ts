// SPDX-License-Identifier: MIT
// Paints tasks on a 2D canvas: a stack of diamonds for each place with tasks, with the number of tasks or, where
// there is space, the id and progress of each task.

import { shapes } from "../palette.json";
import type { Colors } from "./colors";
import { fitted, outlined } from "./text";

const kLeastCounted = 12; // pixels per step, from which on the number of tasks is shown
const kLeastDashed = 12; // pixels per step, from which on a choice of robots is shown
const kLeastListed = 30; // pixels per step, from which on each task is listed
const kMostListed = 3;

export interface TaskState {
  label: string; // its id, shortened
  begun: boolean; // a robot has visited it or started to execute it
  visits: number;
  need: number; // number of visits that it needs
  isChoice: boolean; // whether more robots may visit it than it needs
}

// Returns the dashes of an outline that marks a choice, in pixels.
export function dashesOf(step: number): number[] {
  const length = Math.max(2, Math.min(6, 0.12 * step));
  return [length, 0.8 * length];
}

// Paints the tasks on one place: pale at first, yellow after the first one has begun, grey when all are done. The
// outline is dashed if robots choose to visit one of them.
export function paintTasks(
  c: CanvasRenderingContext2D, x: number, y: number, step: number, tasks: TaskState[],
  isChosen: boolean, colors: Colors,
): void {
  const done = tasks.every(({ visits, need }) => visits >= need);
  const begun = tasks.some((task) => task.begun);
  const r = Math.max(2.5, shapes.taskRadius * step);
  c.fillStyle = done ? colors.taskDone : begun ? colors.taskBegun : colors.taskOpen;
  c.strokeStyle = isChosen ? colors.chosen : done ? colors.goal : colors.task;
  c.lineWidth = isChosen ? 3 : 1.25;
  const isDashed = step >= kLeastDashed && tasks.some(({ isChoice }) => isChoice);
  c.setLineDash(isDashed ? dashesOf(step) : []);
  const apart = Math.max(1.5, shapes.stackOffset * step);
  for (let k = Math.min(shapes.maxStacked, tasks.length) - 1; k >= 0; --k)
    paintDiamond(c, x + k * apart, y - k * apart, r);
  c.setLineDash([]);
  const color = done ? colors.faint : colors.text;
  if (step >= kLeastListed) return paintLabels(c, x, y, step, tasks, color, colors);
  if (tasks.length > 1 && step >= kLeastCounted) {
    c.font = `600 ${Math.min(16, 0.36 * step)}px system-ui, sans-serif`;
    c.textAlign = "center";
    c.textBaseline = "middle";
    c.fillStyle = done ? colors.faint : colors.onTask;
    c.fillText(String(tasks.length), x, y + 0.5, 1.3 * r);
  }
}

function paintDiamond(c: CanvasRenderingContext2D, x: number, y: number, r: number): void {
  c.beginPath();
  c.moveTo(x, y - r);
  c.lineTo(x + r, y);
  c.lineTo(x, y + r);
  c.lineTo(x - r, y);
  c.closePath();
  c.fill();
  c.stroke();
}

// Returns the lines of the labels of tasks on one place, such as "shelf" or, if several robots must visit the
// task, "press 1/3".
export function labelsOfTasks(tasks: TaskState[]): string[] {
  const texts = tasks.slice(0, kMostListed).map(({ label, visits, need }) =>
    need > 1 ? `${label} ${visits}/${need}` : label);
  if (tasks.length > kMostListed) texts.push(`+ ${(tasks.length - kMostListed).toLocaleString("en")}`);
  return texts;
}

// Writes the label of a single task at the upper edge of the cell, and the labels of several tasks one below the
// other in its middle. They are no wider than the cell, because they would be hard to read on walls and on other
// labels.
function paintLabels(
  c: CanvasRenderingContext2D, x: number, y: number, step: number, tasks: TaskState[],
  color: string, colors: Colors,
): void {
  const size = Math.min(18, Math.max(9, 0.16 * step));
  c.font = `${size}px system-ui, sans-serif`;
  c.textAlign = "center";
  c.textBaseline = "top";
  const width = step - 4;
  const labels = labelsOfTasks(tasks);
  const top = labels.length === 1 ? y - step / 2 + 2 : y - 0.55 * size * labels.length;
  labels.forEach((label, i) => {
    const text = fitted(label, width, (part) => c.measureText(part).width);
    outlined(c, text, x, top + 1.1 * size * i, color, colors.floor, width);
  });
}
