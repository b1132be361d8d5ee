// SPDX-License-Identifier: MIT
// Palettes of the two colour schemes, after Okabe and Ito (2008): people with red-green colour blindness can
// distinguish the colours, which also differ in brightness for print.

import { dark, light } from "../palette.json";

export interface Colors {
  name: "light" | "dark";
  outside: string;
  floor: string;
  wall: string;
  lines: string;
  road: string;
  vertex: string;
  arrow: string;
  text: string;
  faint: string;
  doing: string[]; // indexed by Doing
  onRobot: string; // text on robots that move or collide
  onPale: string; // text on all other robots, whose colours are brighter
  heading: string;
  collision: string;
  chosen: string;
  goal: string;
  task: string;
  taskOpen: string;
  taskBegun: string;
  taskDone: string;
  onTask: string;
  heat: string;
}

export const kLight: Colors = { name: "light", ...light };
export const kDark: Colors = { name: "dark", ...dark };
