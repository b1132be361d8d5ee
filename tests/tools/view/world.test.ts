// SPDX-License-Identifier: MIT
// Tests positions and names of places, and possible steps.
import assert from "node:assert/strict";
import { test } from "node:test";
import { parse } from "../../../tools/view/page/json";
import type { World } from "../../../tools/view/page/model";
import { readWorld } from "../../../tools/view/page/world";
import { kGrid } from "./models";

const world = (data: object): World => readWorld(parse(JSON.stringify(data)));
const roads = (vertices: [string, number, number][], list: number[][]) =>
  world({ kind: "roadmap", vertices, roads: list });

// Returns all possible moves as texts such as "0>1", in order of places.
function moves(w: World): string[] {
  const all: string[] = [];
  for (let from = 0; from < w.places; ++from)
    for (let to = 0; to < w.places; ++to) if (w.mayMove(from, to)) all.push(`${from}>${to}`);
  return all;
}

test("moves on a grid join free neighbours", () => {
  const w = world(kGrid); // 4 x 3, number 5 blocked
  const expected: string[] = [];
  for (let from = 0; from < 12; ++from)
    for (let to = 0; to < 12; ++to) {
      const far = Math.abs((from % 4) - (to % 4)) + Math.abs(Math.floor(from / 4) - Math.floor(to / 4));
      if (far === 1 && to !== 5) expected.push(`${from}>${to}`);
    }
  assert.deepEqual(moves(w), expected);
});

test("cells have centres, and names as in plan files", () => {
  const w = world(kGrid);
  assert.deepEqual([w.width, w.height, w.unit], [4, 3, 1]);
  assert.deepEqual([w.xs[6], w.ys[6]], [2.5, 1.5]);
  assert.equal(w.place(6), "[2, 1]");
  assert.deepEqual([...w.free], [1, 1, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1]);
  assert.equal(world({ ...kGrid, free: "0 3 9" }).free[2], 0, "blocked from the first cell on");
});

test("grids of one column or row have their moves", () => {
  assert.deepEqual(moves(world({ kind: "grid", width: 1, height: 3, free: "3" })), ["0>1", "1>0", "1>2", "2>1"]);
  assert.deepEqual(moves(world({ kind: "grid", width: 3, height: 1, free: "3" })), ["0>1", "1>0", "1>2", "2>1"]);
});

test("moves on a roadmap follow roads and directions", () => {
  const w = roads([["A", 0, 0], ["B", 3, 0], ["C", 3, 2]], [[0, 1, 3, 1], [1, 2, 2, 0], [0, 2, 1, 1]]);
  assert.equal(w.places, 6);
  assert.deepEqual(moves(w), ["0>2", "0>3", "1>5", "2>5", "3>4", "4>1", "5>1", "5>2"]);
});

test("inner places of different roads are not joined", () => {
  const w = roads([["A", 0, 0], ["B", 1, 0]], [[0, 1, 2, 0], [0, 1, 1, 0], [1, 0, 3, 0]]);
  assert.deepEqual(moves(w), ["0>1", "0>2", "0>4", "1>0", "1>2", "1>3", "2>0", "2>1", "3>1", "3>4", "4>0", "4>3"]);
  assert.deepEqual([2, 3, 4].map(w.place), ["A–B 1", "B–A 1", "B–A 2"]);
});

test("inner places are evenly spaced, and north is up", () => {
  const w = roads([["A", 10, 10], ["B", 10, 16]], [[0, 1, 3, 0]]);
  assert.equal(w.unit, 2);
  assert.ok(Math.abs(w.xs[2] - w.xs[0]) < 1e-9 && Math.abs(w.xs[3] - w.xs[0]) < 1e-9);
  assert.ok(Math.abs(w.ys[0] - w.ys[2] - 2) < 1e-9 && Math.abs(w.ys[2] - w.ys[3] - 2) < 1e-9);
  for (let place = 0; place < w.places; ++place)
    assert.ok(w.xs[place] > 0 && w.xs[place] < w.width && w.ys[place] > 0 && w.ys[place] < w.height);
});

test("parallel roads are apart in both directions", () => {
  const w = roads([["A", 0, 0], ["B", 4, 0]], [[0, 1, 4, 0], [1, 0, 4, 0], [0, 1, 4, 1]]);
  const middles = [3, 6, 9].map((place) => w.ys[place]);
  for (const [i, j] of [[0, 1], [1, 2], [0, 2]]) assert.ok(Math.abs(middles[i] - middles[j]) > 0.3 * w.unit);
});

test("roadmaps without roads or without extent can be drawn", () => {
  for (const w of [roads([["A", 5, 5]], []), roads([["A", 1, 1], ["B", 1, 1]], [[0, 1, 2, 0]])]) {
    assert.ok(w.width > 0 && w.height > 0 && w.unit > 0);
    assert.ok([...w.xs, ...w.ys].every(Number.isFinite));
  }
});

test("a large grid is read", () => {
  const w = world({ kind: "grid", width: 1000, height: 1000, free: "500000 1 499999" });
  assert.equal(w.free.length, 1_000_000);
  assert.equal(w.free[499_999], 1);
  assert.equal(w.free[500_000], 0);
  assert.equal(w.free[500_001], 1);
});
