// SPDX-License-Identifier: MIT
// Data of the page: the world, robots, tasks and plans. Places are numbers (README.md), times are in steps,
// and angles are in steps of a turn, clockwise from north.

export interface Point {
  x: number;
  y: number;
}

export interface Road {
  from: number; // vertices
  to: number;
  steps: number;
  oneWay: boolean;
  first: number; // its first inner place; the road has steps - 1 inner places
}

// World units are cells on a grid, and metres on a roadmap. y points down, although it points up in roadmap
// files.
export interface World {
  kind: "grid" | "roadmap";
  places: number;
  width: number; // of the drawing: x from 0 to width, y from 0 to height
  height: number;
  unit: number; // length of a step in world units; sizes of robots are relative to it
  xs: Float64Array; // position by place, in world units
  ys: Float64Array;
  free: Uint8Array; // by place: 1 if passable
  columns: number; // of a grid
  roads: Road[];
  vertexNames: string[]; // of a roadmap
  mayMove(from: number, to: number): boolean; // whether this is a possible move of one step
  place(place: number): string; // the name of a place, for texts
  drawn(x: number, y: number): Point; // world position of a point in cells (integers: centres) or metres of the file
}

export interface Agent {
  id: string;
  name: string; // the id as displayed
  start: number;
  goal: number; // destination; -1: none, or a choice
  goals: number[]; // the places of which it chooses its destination
  turnSteps: number; // 0: turns freely
  startAngle: Angle;
  goalAngle: number; // at the destination; -1: any
  working: { task: number; done: number } | null;
  tasks: number[]; // tasks that it must visit
  hasOptions: boolean; // whether there are tasks that it may visit
}

export interface Task {
  id: string;
  name: string;
  place: number;
  agents: number[]; // the robots that must visit it or, if it needs fewer, may visit it
  need: number; // at least this many of them must visit it
  duration: number;
}

// An angle and, within a turn, the direction of the turn: 1 clockwise, -1 counterclockwise; 0: not within a
// turn.
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
  cost: number | null; // as claimed; null: not claimed
  track: Track;
  turns: TurnTrack | null;
  tasks: number[] | null; // claimed order of completion; null: not claimed
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
  end: number; // the last time at which something changes
}

// Returns whether robots choose to visit the task.
export function hasChoice({ agents, need }: Task): boolean {
  return need < agents.length;
}

// Returns whether a plan states the visits of the task, in `work`. Otherwise a robot visits the task by being on
// its place.
export function hasStatedVisits(task: Task): boolean {
  return task.duration > 0 || hasChoice(task);
}

export function hasDestination({ goal, goals }: Agent): boolean {
  return goal >= 0 || goals.length > 0;
}

export interface Model {
  instance: string;
  world: World;
  agents: Agent[];
  tasks: Task[];
  plans: Plan[];
}

import type { Track, TurnTrack } from "./track";
