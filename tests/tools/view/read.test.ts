// SPDX-License-Identifier: MIT
// Tests that invalid data are refused with their position, and that ids are always text.
import assert from "node:assert/strict";
import { test } from "node:test";
import { readModel } from "../../../tools/view/page/read";
import { data, kGrid, kRoads } from "./models";

const good = () => structuredClone(data(
  kGrid,
  [{ id: "<b>a</b>", start: 0, goal: 3, turn: 2, angle: "0", goalAngle: 2, working: [0, 1] }],
  [{ id: "t", place: 0, agents: [0], need: 1, duration: 3 }],
  [{ cost: 7, path: "@0;7.", turns: "@0;7.", tasks: [0], work: [[0, -1, 2]] }],
  { status: "optimal", cost: 7, lower_bound: 7, omega: "0" },
)) as any;

test("valid data are read", () => {
  const model = readModel(JSON.stringify(good()));
  assert.equal(model.agents[0].id, "<b>a</b>");
  assert.deepEqual(model.agents[0].tasks, [0]);
  assert.equal(model.plans[0].end, 7);
  assert.equal(model.world.place(6), "[2, 1]");
});

test("roadmaps are read", () => {
  const { world } = readModel(JSON.stringify(data(kRoads, [{ id: "a", start: 3 }], [], [{ path: "@3;" }])));
  assert.equal(world.places, 6);
  assert.equal(world.place(0), "A");
  assert.equal(world.place(4), "A–B 2");
  assert.ok(world.xs[0] < world.xs[3] && world.xs[3] < world.xs[4] && world.xs[4] < world.xs[1]);
  assert.ok(world.ys[2] < world.ys[1], "north is up");
});

type Break = [string, (d: any) => void];
const breaks: Break[] = [
  ["format", (d) => (d.format = "grove view 2")],
  ["format", (d) => delete d.format],
  ["world", (d) => delete d.world],
  ["world.kind", (d) => (d.world.kind = "sphere")],
  ["world.width", (d) => (d.world.width = 0)],
  ["world.width", (d) => (d.world.width = 1e12)],
  ["world.width", (d) => (d.world.width = "4")],
  ["world.height", (d) => (d.world.height = 1.5)],
  ["world.height", (d) => (d.world.height = 1e9)],
  ["world.free", (d) => (d.world.free = "5 1")],
  ["world.free", (d) => (d.world.free = "5 1 7")],
  ["world.free", (d) => (d.world.free = "5 -1 8")],
  ["world.free", (d) => (d.world.free = 12)],
  ["agents", (d) => (d.agents = {})],
  ["agents[0]", (d) => (d.agents = [7])],
  ["agents[0].id", (d) => (d.agents[0].id = 7)],
  ["agents[0].start", (d) => (d.agents[0].start = 12)],
  ["agents[0].start", (d) => (d.agents[0].start = -1)],
  ["agents[0].goal", (d) => (d.agents[0].goal = null)],
  ["agents[0].goals", (d) => (d.agents[0].goals = [1])],
  ["agents[0].goals", (d) => (delete d.agents[0].goal, d.agents[0].goals = [])],
  ["agents[0].goals", (d) => (delete d.agents[0].goal, d.agents[0].goals = "*")],
  ["agents[0].goals[1]", (d) => (delete d.agents[0].goal, d.agents[0].goals = [1, 12])],
  ["agents[0].turn", (d) => (d.agents[0].turn = 0)],
  ["agents[0].turn", (d) => (d.agents[0].turn = 1e9)],
  ["agents[0].angle", (d) => (d.agents[0].angle = "north")],
  ["agents[0].angle", (d) => delete d.agents[0].angle],
  ["agents[0].goalAngle", (d) => (d.agents[0].goalAngle = 8)],
  ["agents[0].working", (d) => (d.agents[0].working = [0])],
  ["agents[0].working[0]", (d) => (d.agents[0].working = [1, 0])],
  ["tasks[0].place", (d) => (d.tasks[0].place = 99)],
  ["tasks[0].agents[0]", (d) => (d.tasks[0].agents = [1])],
  ["tasks[0].agents", (d) => (d.tasks[0].agents = "all")],
  ["tasks[0].need", (d) => (d.tasks[0].need = 0)],
  ["tasks[0].need", (d) => (d.tasks[0].need = 2)],
  ["tasks[0].need", (d) => (d.tasks[0].need = null)],
  ["tasks[0].duration", (d) => (d.tasks[0].duration = -3)],
  ["tasks[0].id", (d) => (d.tasks[0].id = null)],
  ["plans", (d) => (d.plans = "none")],
  ["plans[0].name", (d) => (d.plans[0].name = [])],
  ["plans[0].claims", (d) => delete d.plans[0].claims],
  ["plans[0].claims.cost", (d) => (d.plans[0].claims.cost = "7")],
  ["plans[0].claims.omega", (d) => (d.plans[0].claims.omega = 0)],
  ["plans[0].agents", (d) => d.plans[0].agents.push({ path: "" })],
  ["plans[0].agents[0].path", (d) => (d.plans[0].agents[0].path = "7.")],
  ["plans[0].agents[0].path", (d) => delete d.plans[0].agents[0].path],
  ["plans[0].agents[0].path", (d) => (d.plans[0].agents[0].path = "@0;99999999.")],
  ["plans[0].agents[0].turns", (d) => delete d.plans[0].agents[0].turns],
  ["plans[0].agents[0].turns", (d) => (d.plans[0].agents[0].turns = "@0;.")],
  ["plans[0].agents[0].cost", (d) => (d.plans[0].agents[0].cost = 0.5)],
  ["plans[0].agents[0].tasks[0]", (d) => (d.plans[0].agents[0].tasks = [1])],
  ["plans[0].agents[0].work[0]", (d) => (d.plans[0].agents[0].work = [[0, 1]])],
  ["plans[0].agents[0].work[0][2]", (d) => (d.plans[0].agents[0].work = [[0, 1, null]])],
  ["instance", (d) => (d.instance = 3)],
  ["the data", (d) => (d.plan = [])],
  ["world", (d) => (d.world.blocked = "")],
  ["agents[0]", (d) => (d.agents[0].gaol = 3)],
  ["agents[0]", (d) => delete d.agents[0].turn],
  ["tasks[0]", (d) => (d.tasks[0].durations = 3)],
  ["plans[0]", (d) => (d.plans[0].paths = [])],
  ["plans[0].claims", (d) => (d.plans[0].claims.bound = 3)],
  ["plans[0].claims.cost", (d) => (d.plans[0].claims.cost = 7.5)],
  ["plans[0].agents[0]", (d) => (d.plans[0].agents[0].order = [0])],
  ["plans[0].agents[0].path", (d) => (d.plans[0].agents[0].path = "@0;0E7.")],
  ["plans[0].agents[0].work[0][1]", (d) => (d.plans[0].agents[0].work = [[0, -(2 ** 31), 2]])],
];

test("wrong data are refused with their position", () => {
  for (const [place, spoil] of breaks) {
    const spoilt = good();
    spoil(spoilt);
    assert.throws(() => readModel(JSON.stringify(spoilt)), (error: Error) => error.message.startsWith(`${place}:`),
      `${place}: ${spoil.toString()}`);
  }
  assert.ok(breaks.length >= 40);
});

test("claims may be as large as in plan files", () => {
  const huge = good();
  huge.plans[0].claims = { status: "optimal", cost: 2 ** 60, lower_bound: -(2 ** 63), omega: "inf" };
  huge.plans[0].agents[0].cost = 2 ** 30;
  huge.plans[0].agents[0].work = [[0, -(2 ** 30), 2 ** 30]];
  assert.equal(readModel(JSON.stringify(huge)).plans[0].claims.cost, 2 ** 60);
});

test("invalid JSON is refused", () => {
  for (const text of ["", "{", "[1,2", "null", "7", "[]", "[".repeat(100000)])
    assert.throws(() => readModel(text), Error);
});

test("keys of the language are not keys of the data", () => {
  const spoilt = good();
  delete spoilt.agents[0].id;
  const text = JSON.stringify(spoilt).replace('"start"', '"__proto__":{"id":"x"},"start"');
  assert.throws(() => readModel(text), /agents\[0\]\.id/);
});
