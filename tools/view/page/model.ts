// SPDX-License-Identifier: MIT
// Data of the page: the world, robots, tasks and plans. Places are numbers (README.md); time is in
// steps; angles are in steps of a turn, clockwise from north.

export interface Point {
  x: number;
  y: number;
}

export interface Road {
  from: number; // vertices
  to: number;
  steps: number;
  oneWay: boolean;
  first: number; // its first inner place; it has steps - 1
}

// Positions in the world's own units: cells on a grid (y down), metres on a roadmap (y up in the file,
// down here).
export interface World {
  kind: "grid" | "roadmap";
  places: number;
  width: number; // extent of the drawing: x and y go from 0 to this
  height: number;
  unit: number; // the length of a step; robots are drawn relative to it
  xs: Float64Array; // by place
  ys: Float64Array;
  free: Uint8Array; // by place
  columns: number; // of a grid
  roads: Road[];
  vertexNames: string[];
  mayMove(from: number, to: number): boolean; // in one step
  place(place: number): string; // name of a place
  drawn(x: number, y: number): Point; // position of cells (centres are integers) or of metres of the file
}

export interface Agent {
  id: string;
  name: string; // the id as displayed
  start: number;
  goal: number; // -1: none
  turnSteps: number; // 0: turns freely
  startAngle: Angle;
  goalAngle: number; // -1: any
  working: { task: number; done: number } | null;
  tasks: number[];
}

export interface Task {
  id: string;
  name: string;
  place: number;
  agents: number[];
  duration: number;
}

// direction: within a turn, 1 clockwise, -1 the other way; 0: at rest on a heading.
export interface Angle {
  steps: number;
  direction: number;
}

export interface WorkTime {
  task: number;
  begin: number;
  end: number;
}

export interface AgentPlan {
  cost: number | null; // claimed
  track: Track;
  turns: TurnTrack | null;
  tasks: number[] | null; // the order of completion claimed
  work: WorkTime[];
}

export interface Claims {
  status?: string;
  cost?: number;
  lower_bound?: number;
  omega?: string;
}

export interface Plan {
  name: string;
  claims: Claims;
  agents: AgentPlan[]; // empty: no plan
  end: number; // the last time at which anything changes
}

export interface Model {
  instance: string;
  world: World;
  agents: Agent[];
  tasks: Task[];
  plans: Plan[];
}

import type { Track, TurnTrack } from "./track";
