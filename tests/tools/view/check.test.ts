// SPDX-License-Identifier: MIT
// Tests each kind of violation, and valid plans.
import assert from "node:assert/strict";
import { test } from "node:test";
import { check, Checker } from "../../../tools/view/page/check";
import { kGrid, kRoads, model, type AgentData } from "./models";

type Parts = Parameters<typeof model>;

function found(...parts: Parts): string[] {
  const m = model(...parts);
  return check(m, m.plans[0]).map((violation) => `${violation.kind} ${violation.time}`);
}

const kOne: AgentData = { id: "a", start: 0, goal: 3 };
const one = (path: string, more: object = {}) => found(kGrid, [kOne], [], [{ path, ...more }]);

test("a valid plan on a grid", () => {
  assert.deepEqual(one("@0;3E", { cost: 3, tasks: [] }), []);
  assert.deepEqual(one("@0;.3E5.", { cost: 4 }), []);
});

test("collisions are found", () => {
  const two: AgentData[] = [{ id: "a", start: 0, goal: 3 }, { id: "b", start: 3, goal: 0 }];
  const meet = (a: string, b: string) => found(kGrid, two, [], [{ path: a }, { path: b }]);
  assert.deepEqual(meet("@0;3E", "@3;3W"), ["swap 2"]);
  assert.deepEqual(meet("@0;E.2E", "@3;3W"), ["vertex 2"]);
  // A robot rests on the path of another robot.
  assert.deepEqual(found(kGrid, [{ id: "a", start: 1, goal: 1 }, { id: "b", start: 0, goal: 3 }], [],
    [{ path: "@1;" }, { path: "@0;3E" }]), ["vertex 1"]);
  // Following is not a collision.
  assert.deepEqual(found(kGrid, [{ id: "a", start: 1, goal: 2 }, { id: "b", start: 0, goal: 1 }], [],
    [{ path: "@1;E" }, { path: "@0;E" }]), []);
});

test("a long collision is reported once", () => {
  const both: AgentData[] = [{ id: "a", start: 0 }, { id: "b", start: 3 }];
  assert.deepEqual(found(kGrid, both, [], [{ path: "@0;2E9." }, { path: "@3;2W8.E" }]), ["swap 2", "vertex 11"]);
  assert.deepEqual(found(kGrid, both, [], [{ path: "@0;2E9." }, { path: "@3;W4.E3.W" }]), ["vertex 2", "vertex 10"]);
  const three = [...both, { id: "c", start: 2 }];
  assert.deepEqual(found(kGrid, three, [], [{ path: "@0;2E" }, { path: "@3;.W" }, { path: "@2;5." }]),
    ["vertex 2", "vertex 2"]);
});

test("wrong starts, jumps and blocked cells are found", () => {
  assert.deepEqual(one("@1;2E"), ["start 0"]);
  assert.deepEqual(one("@0;@2;E"), ["jump 1"]);
  assert.deepEqual(one("@0;ESN2E"), ["jump 2"], "into the blocked cell");
  // From the right edge to the left edge of the next row: consecutive numbers, but not neighbours.
  assert.ok(found(kGrid, [{ id: "a", start: 3, goal: 4 }], [], [{ path: "@3;E" }]).includes("jump 1"));
});

test("wrong ends are found", () => {
  assert.deepEqual(one("@0;2E"), ["end 2"]);
  assert.deepEqual(found(kGrid, [{ id: "a", start: 0 }], [{ id: "t", place: 1, agents: [0] }],
    [{ path: "@0;2E" }]), ["end 2"]);
  assert.deepEqual(found(kGrid, [{ id: "a", start: 0 }], [], [{ path: "@0;2E" }]), [], "idle");
});

test("missing visits and wrong orders are found", () => {
  const tasks = [{ id: "t", place: 1, agents: [0] }, { id: "u", place: 6, agents: [0] }];
  const visit = (path: string, order: number[]) => found(kGrid, [kOne], tasks, [{ path, tasks: order }]);
  assert.deepEqual(visit("@0;2ESNE", [0, 1]), []);
  assert.deepEqual(visit("@0;2ESNE", [1, 0]), ["order 5"]);
  assert.deepEqual(visit("@0;2ESNE", [0]), ["order 0"]);
  assert.deepEqual(visit("@0;3E", [0, 1]), ["visit 3", "order 3"]);
});

test("wrong costs and claims are found", () => {
  assert.deepEqual(one("@0;3E", { cost: 4 }), ["cost 3"]);
  const claim = (claims: object) => found(kGrid, [kOne], [], [{ path: "@0;3E", cost: 3 }], claims);
  assert.deepEqual(claim({ cost: 3, status: "optimal", lower_bound: 3, omega: "0" }), []);
  assert.deepEqual(claim({ cost: 4 }), ["cost 3"]);
  assert.deepEqual(claim({ cost: 3, status: "optimal", lower_bound: 2, omega: "0" }), ["claim 3"]);
  assert.deepEqual(claim({ cost: 3, status: "bounded", lower_bound: 2, omega: "0.5" }), []);
  assert.deepEqual(claim({ cost: 3, status: "bounded", lower_bound: 2, omega: "0.499999999" }), ["claim 3"]);
  assert.deepEqual(claim({ cost: 3, status: "feasible", lower_bound: 2, omega: "inf" }), []);
  assert.deepEqual(claim({ cost: 3, status: "bounded", lower_bound: 2, omega: "1e+06" }), []);
  assert.deepEqual(claim({ cost: 3, status: "feasible", lower_bound: 0, omega: "1000000" }), []);
  assert.deepEqual(claim({ cost: 2 ** 60, status: "feasible", lower_bound: 2, omega: "0" }), ["cost 3"]);
  assert.deepEqual(claim({ cost: 3, status: "feasible", lower_bound: -1, omega: "0" }), ["claim 3"]);
  assert.deepEqual(claim({ cost: 3, status: "optimal", lower_bound: 4, omega: "0" }), ["claim 3"]);
});

test("omega is exact in all notations", () => {
  const cost = 100_001; // exceeds the bound of 100,000 by a hundred-thousandth
  const claim = (status: string, omega: string) => found(kGrid, [kOne], [],
    [{ path: `@0;${cost - 3}.3E`, cost }], { cost, status, lower_bound: cost - 1, omega });
  assert.deepEqual(claim("bounded", "1e-05"), []);
  assert.deepEqual(claim("bounded", "0.00001"), []);
  assert.deepEqual(claim("bounded", "1.5e-05"), []);
  assert.deepEqual(claim("feasible", "9.999e-06"), []);
  assert.deepEqual(claim("bounded", "9.999e-06"), [`claim ${cost}`]);
});

test("moves against one-way roads are found", () => {
  const go = (start: number, goal: number, path: string) =>
    found(kRoads, [{ id: "a", start, goal }], [], [{ path }]);
  assert.deepEqual(go(0, 2, "@0;@3;+@1;@5;@2;"), []);
  assert.deepEqual(go(1, 0, "@1;@4;-@0;"), ["jump 1", "jump 2", "jump 3"]); // against the direction
  assert.deepEqual(go(2, 1, "@2;@5;@1;"), []);
  assert.deepEqual(go(2, 2, "@2;@5;@2;"), [], "turning back on a road of both ways");
  assert.deepEqual(go(0, 1, "@0;@1;"), ["jump 1"], "no step of three");
});

const kTurning: AgentData = { id: "a", start: 0, goal: 3, turn: 2, angle: "0" };
const turning = (path: string, turns: string, more: object = {}) =>
  found(kGrid, [{ ...kTurning, ...more }], [], [{ path, turns }]);

test("wrong turns are found", () => {
  assert.deepEqual(turning("@0;2.3E", "@0;2r3."), []);
  assert.deepEqual(turning("@0;3E2.", "@0;3.2r"), ["turn 1", "turn 2", "turn 3"], "moves that are not ahead");
  assert.deepEqual(turning("@0;.3E.", "@0;r3.r"), ["turn 2", "turn 3", "turn 4"], "moves within a turn");
  assert.ok(turning("@0;.4E", "@0;rr3.").includes("turn 2"), "a move and a step of a turn at once");
  assert.deepEqual(turning("@0;4.3E", "@0;rl2r3."), ["turn 2"], "turns back");
  assert.deepEqual(turning("@0;2.3E", "@2;5.", { angle: "2" }), []);
  assert.deepEqual(turning("@0;2.3E", "@2;5."), ["start 0"]);
  assert.deepEqual(turning("@0;2.3E2.", "@0;2r5.", { goalAngle: 4 }), ["end 7"]);
  assert.deepEqual(turning("@0;2.3E2.", "@0;2r3.2r", { goalAngle: 4 }), []);
});

test("wrong work is found", () => {
  const tasks = [{ id: "t", place: 1, agents: [0], duration: 2 }, { id: "u", place: 2, agents: [0], duration: 1 }];
  const work = (path: string, pieces: number[][], more: object = {}) =>
    found(kGrid, [{ ...kOne, ...more }], tasks, [{ path, work: pieces }]);
  const good = [[0, 1, 3], [1, 4, 5]];
  assert.deepEqual(work("@0;E2.E.E", good), []);
  assert.deepEqual(work("@0;E2.E.E", [[0, 1, 3]]), ["visit 6"]);
  assert.deepEqual(work("@0;E2.E.E", [[0, 1, 4], [1, 4, 5]]), ["work 1", "work 4"], "too long, and away");
  assert.deepEqual(work("@0;E2.E.E", [[0, 2, 4], [1, 4, 5]]), ["work 4"], "leaves at work");
  assert.deepEqual(work("@0;E2.E.E", [...good, [0, 1, 3]]), ["work 1"], "twice");
  assert.deepEqual(work("@0;E2.E.E", [[0, 1, 3], [1, 2, 3]]), ["work 2", "work 2"], "two at once, elsewhere");
  assert.deepEqual(work("@0;E2.E.E", good, { working: [0, 1] }), ["work 0"], "does not continue its work");
});

test("agents without a path are found", () => {
  assert.deepEqual(one(""), ["path 0"]);
});

test("a long path with many tasks does not block the page", (context) => {
  const tasks = Array.from({ length: 64 }, (_, k) => ({ id: `t${k}`, place: k % 4, agents: [0] }));
  const m = model(kGrid, [kOne], tasks, [{ path: `@0;${"EW".repeat(200_000)}3E` }]);
  const checker = new Checker(m, m.plans[0]);
  // Each reading of the clock advances it by a millisecond, and the check reads it once per part.
  // Each call of step(5) must therefore end after a few parts.
  let time = 0;
  context.mock.method(performance, "now", () => time++);
  let steps = 1;
  for (; !checker.step(5); ++steps) {
    assert.ok(time <= 7, `${time} parts at once`);
    time = 0;
  }
  assert.deepEqual(checker.violations, []);
  assert.ok(steps > 50, `${steps} steps`);
});

test("many robots with long paths are checked", () => {
  const wide = { kind: "grid", width: 50, height: 10_000, free: "500000" };
  const agents = Array.from({ length: 10_000 }, (_, y) => ({ id: `a${y}`, start: 50 * y, goal: 50 * y }));
  const m = model(wide, agents, [], agents.map(({ start }) => ({ path: `@${start};${"20E5.20W5.".repeat(20)}` })));
  assert.deepEqual(check(m, m.plans[0]), []);
});
