// SPDX-License-Identifier: MIT
// Tests differences between two plans: costs, first time at which they differ, missing paths.
import assert from "node:assert/strict";
import { test } from "node:test";
import { App } from "../../../tools/view/page/app";
import { partingTime, type Comparison } from "../../../tools/view/page/compare";
import { readModel } from "../../../tools/view/page/read";
import { data, kGrid, model, type AgentData } from "./models";

// Returns the comparison of two plans for the same robots.
function comparison(agents: AgentData[], tasks: object[], one: object[], other: object[]): Comparison {
  const both = data(kGrid, agents, tasks, one);
  both.plans.push({ name: "other", claims: {}, agents: other });
  return new App(readModel(JSON.stringify(both))).comparison!;
}

const kFree: AgentData = { id: "a", start: 0 };
const kTurning: AgentData = { id: "a", start: 0, turn: 2, angle: "0" };
const parts = (one: object, other: object, agent = kFree, tasks: object[] = []) => {
  const [a, b] = [one, other].map((plan) => model(kGrid, [agent], tasks, [plan]).plans[0].agents[0]);
  assert.equal(partingTime(a, b), partingTime(b, a));
  return partingTime(a, b);
};

test("paths differ from the first different place on", () => {
  assert.equal(parts({ path: "@0;3E" }, { path: "@0;3E" }), Infinity);
  assert.equal(parts({ path: "@0;3E" }, { path: "@0;2EE5." }), Infinity, "however it is written");
  assert.equal(parts({ path: "@0;3E" }, { path: "@0;2E.E" }), 3);
  assert.equal(parts({ path: "@0;3E" }, { path: "@0;2E" }), 3, "the one rests");
  assert.equal(parts({ path: "@0;3E" }, { path: "@0;EW2E" }), 2);
  assert.equal(parts({ path: "@0;3E" }, { path: "@1;3." }), 0);
  assert.equal(parts({ path: "@0;E2." }, { path: "@0;E.@7;" }), 3, "a jump");
  assert.equal(parts({ path: "@0;2S2N" }, { path: "@0;2S@4;N" }), Infinity);
});

test("a missing path differs at once from a path", () => {
  assert.equal(parts({ path: "@0;3E" }, { path: "" }), 0);
  assert.equal(parts({ path: "" }, { path: "" }), Infinity);
});

test("different headings are differences", () => {
  const turn = (turns: string) => ({ path: "@0;6.", turns });
  assert.equal(parts(turn("@0;6."), turn("@0;4.2r"), kTurning), 5);
  assert.equal(parts(turn("@0;2r4."), turn("@0;2r4."), kTurning), Infinity);
  assert.equal(parts(turn("@0;2r4l"), turn("@0;2r2l2."), kTurning), 5);
});

test("different work on one place is a difference", () => {
  const tasks = [{ id: "t", place: 0, agents: [0], duration: 2 }];
  const work = (begin: number) => ({ path: "@0;6.", work: [[0, begin, begin + 2]] });
  assert.equal(parts(work(1), work(1), kFree, tasks), Infinity);
  assert.equal(parts(work(1), work(3), kFree, tasks), 1);
});

test("differences have costs and the order of visits", () => {
  const agents = [kFree, { id: "b", start: 11 }, { id: "c", start: 8 }];
  const tasks = [{ id: "t", place: 1, agents: [0] }, { id: "u", place: 4, agents: [0] }];
  const found = comparison(agents, tasks,
    [{ path: "@0;EWS" }, { path: "@11;W" }, { path: "@8;" }],
    [{ path: "@0;SNE" }, { path: "@11;W" }, { path: "@8;3.E" }]);
  assert.deepEqual(found.all, [
    { agent: 0, costs: [3, 3], costChange: 0, firstDifference: 1, hasOtherTasks: false, hasOtherOrder: true },
    { agent: 2, costs: [0, 4], costChange: 4, firstDifference: 4, hasOtherTasks: false, hasOtherOrder: false },
  ]);
  assert.deepEqual(found.costs, [4, 8]);
  assert.equal(found.costChange, 4);
});

test("costs are not compared if a path is missing", () => {
  const found = comparison([kFree, { id: "b", start: 11 }], [],
    [{ path: "@0;E" }, { path: "@11;W" }], [{ path: "" }, { path: "@11;W" }]);
  assert.deepEqual(found.all, [{ agent: 0, costs: [1, NaN], costChange: NaN, firstDifference: 0, hasOtherTasks: false, hasOtherOrder: false }]);
  assert.ok(Number.isNaN(found.costChange));
});

test("one plan alone is not compared", () => {
  assert.equal(new App(model(kGrid, [kFree], [], [{ path: "@0;E" }])).comparison, null);
});
