// SPDX-License-Identifier: MIT
// Paints tasks on a 2D canvas: a stack of diamonds for each place with tasks, with the number of tasks and,
// where there is space, the number and progress of each task.

import { shapes } from "../palette.json";
import type { Colors } from "./colors";
import { outlined } from "./text";

const kLeastCounted = 12; // pixels per step, from which on the number of tasks is shown
const kLeastDashed = 12; // pixels per step, from which on a choice of robots is shown
const kLeastListed = 30; // pixels per step, from which on each task is listed
const kMostListed = 3;

export interface TaskState {
  index: number;
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
  if (tasks.length > 1 && step >= kLeastCounted) {
    c.font = `600 ${Math.min(16, 0.36 * step)}px system-ui, sans-serif`;
    c.textAlign = "center";
    c.textBaseline = "middle";
    c.fillStyle = done ? colors.faint : colors.onTask;
    c.fillText(String(tasks.length), x, y + 0.5, 1.3 * r);
  }
  if (step >= kLeastListed) paintTaskList(c, x, y, step, tasks, color, colors);
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

// Writes a line such as "2: 1 of 3" for each task, one above the other.
function paintTaskList(
  c: CanvasRenderingContext2D, x: number, y: number, step: number, tasks: TaskState[],
  color: string, colors: Colors,
): void {
  const size = Math.min(18, Math.max(9, 0.16 * step));
  const texts = tasks.slice(0, kMostListed).map(({ index, visits, need }) =>
    `${index + 1}${need > 1 ? `: ${visits} of ${need}` : ""}`);
  if (tasks.length > kMostListed) texts.push(`+ ${(tasks.length - kMostListed).toLocaleString("en")}`);
  c.font = `${size}px system-ui, sans-serif`;
  c.textAlign = "left";
  c.textBaseline = "bottom";
  const r = 0.6 * shapes.taskRadius * step;
  texts.forEach((text, i) => outlined(c, text, x + r, y - r - 1.1 * size * i, color, colors.floor));
}
