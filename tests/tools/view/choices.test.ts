// SPDX-License-Identifier: MIT
// Tests tasks that only some of their robots visit, and choices of destinations: data, violations and facts.
import assert from "node:assert/strict";
import { test } from "node:test";
import { check } from "../../../tools/view/page/check";
import { compare } from "../../../tools/view/page/compare";
import { doneTime, planFacts, visitsBy, visitsOf } from "../../../tools/view/page/facts";
import type { PlanView } from "../../../tools/view/page/app";
import { hasChoice, hasStatedVisits, type Model, type Plan } from "../../../tools/view/page/model";
import { kGrid, model, type AgentData } from "./models";

// a may end on 3 or 8; b ends on 4; c has no destination. The grid has 4 x 3 cells, and 5 is blocked.
const kAgents: AgentData[] = [
  { id: "a", start: 0, goals: [3, 8] }, { id: "b", start: 4, goal: 4 }, { id: "c", start: 11 },
];
// One robot must do "any", two robots must visit "two", and c must visit "own".
const kTasks = [
  { id: "any", place: 1, agents: "*", need: 1, duration: 2 },
  { id: "two", place: 10, agents: [0, 1, 2], need: 2 },
  { id: "own", place: 11, agents: [2] },
];

// a does "any" and goes to 3; b visits "two" at 6 and returns; c visits "own" at the start, then "two", where it meets
// b.
const kPlan = [
  { path: "@0;E2.2E", cost: 5, tasks: [0], work: [[0, 1, 3]] },
  { path: "@4;3.S2E2WN", cost: 9, tasks: [1], work: [[1, 6, 6]] },
  { path: "@11;W", cost: 1, tasks: [2, 1], work: [[1, 1, 1]] },
];

function of(change: (plan: any[], agents: AgentData[], tasks: any[]) => void): Model {
  const [agents, tasks, plan] = [kAgents, kTasks, kPlan].map((part) => structuredClone(part)) as any[];
  change(plan, agents, tasks);
  return model(kGrid, agents, tasks, plan);
}

function found(change: (plan: any[], agents: AgentData[], tasks: any[]) => void): string[] {
  const m = of(change);
  return check(m, m.plans[0]).map(({ kind, time }) => `${kind} ${time}`);
}

const kMeeting = /^vertex/;

test("choices are read", () => {
  const m = of(() => {});
  assert.deepEqual(m.agents.map(({ goals }) => goals), [[3, 8], [], []]);
  assert.deepEqual(m.agents.map(({ tasks, hasOptions }) => [tasks, hasOptions]), [[[], true], [[], true], [[2], true]]);
  assert.deepEqual(m.tasks.map(({ agents, need }) => [agents, need]), [[[0, 1, 2], 1], [[0, 1, 2], 2], [[2], 1]]);
  assert.deepEqual(m.tasks.map(hasChoice), [true, true, false]);
  assert.deepEqual(m.tasks.map(hasStatedVisits), [true, true, false]);
  const all = model(kGrid, kAgents, [{ id: "t", place: 1, agents: "*" }], [{ path: "" }, { path: "" }, { path: "" }]);
  assert.deepEqual([all.tasks[0].need, hasChoice(all.tasks[0])], [3, false]);
});

// The violations of a plan in which c returns from "two" before b arrives.
function faults(change: (plan: any[], agents: AgentData[], tasks: any[]) => void): string[] {
  return found((plan, agents, tasks) => {
    plan[2] = { ...plan[2], path: "@11;WE", cost: 2 };
    change(plan, agents, tasks);
  });
}

test("a valid plan with choices", () => {
  assert.deepEqual(faults(() => {}), []);
});

test("only stated visits of different robots count for a need", () => {
  assert.deepEqual(faults((plan) => (plan[2].work = [], plan[2].tasks = [2])), ["need 9"]);
  assert.deepEqual(faults((plan) => (plan[2].work.push([1, 1, 1]))), ["work 1"], "one robot twice");
  assert.deepEqual(faults((plan) => {
    plan[2] = { ...plan[2], work: [], tasks: [2] };
    plan[1] = { ...plan[1], work: [[1, 6, 6], [1, 6, 6]] };
  }), ["work 6", "need 9"]);
  assert.deepEqual(faults((plan) => (plan[0].work = [], plan[0].tasks = [])), ["need 9"]);
  assert.deepEqual(faults((_, __, tasks) => (tasks[1].agents = [0, 1], tasks[1].need = 1)), ["work 1"]);
  assert.deepEqual(faults((_, __, tasks) => (tasks[0].agents = [1, 2])), ["work 1", "need 9"], "a visit by a");
  assert.deepEqual(faults((plan) => (plan[2].work = [], plan[2].tasks = [2], plan[0].path = "")),
    ["path 0", "need 9"], "a robot has no path");
});

test("a need that is not met names its task", () => {
  const m = of((plan) => (plan[0].work = [], plan[0].tasks = []));
  const [violation] = check(m, m.plans[0]).filter(({ kind }) => kind === "need");
  assert.equal(violation.text, "any is visited by 0 of its 3 robots, but needs 1");
  assert.deepEqual([violation.task, violation.place, violation.agents], [0, 1, []]);
});

test("stated visits are on the place of the task, in one state", () => {
  assert.deepEqual(faults((plan) => (plan[1].work = [[1, 5, 5]])), ["work 5"], "elsewhere");
  assert.deepEqual(faults((plan) => (plan[1].work = [[1, 6, 7]])), ["work 6", "work 7"], "begin..end is the duration");
  assert.deepEqual(faults((plan) => (plan[0].work = [[0, 2, 4]])), ["work 4"], "leaves");
  assert.deepEqual(faults((plan) => (plan[0].work = [[0, 1, 1]])), ["work 1"]);
  assert.deepEqual(faults((plan) => (plan[0].work = [[0, -1, 1]])), ["work 0", "work 0", "work 1"]);
  assert.deepEqual(faults((plan) => (plan[2].work.push([2, 0, 0]))), ["work 0"], "a visit that is not stated");
});

test("visits without a duration may coincide with others", () => {
  const same = (duration: number, end: number) => found((plan, _, tasks) => {
    plan[2] = { ...plan[2], path: "@11;WE", cost: 2 };
    tasks.push({ id: "also", place: 1, agents: [0, 2], need: 1, duration });
    plan[0].work.push([3, 2, end]);
    plan[0].tasks.push(3);
  });
  assert.deepEqual(same(0, 2).filter((text) => !text.startsWith("order")), []);
  assert.deepEqual(same(1, 3), ["work 2"]);
});

test("a robot ends on one of its possible destinations", () => {
  assert.deepEqual(faults((plan) => (plan[0].path = "@0;E2.E", plan[0].cost = 4)), ["end 4"]);
  assert.deepEqual(faults((plan) => (plan[0].path = "@0;E2.W2S", plan[0].cost = 6)).filter((text) =>
    !kMeeting.test(text)), []);
  assert.deepEqual(found((plan, agents) => {
    plan[2] = { ...plan[2], path: "@11;WE", cost: 2 };
    agents[0] = { ...agents[0], turn: 1, angle: "1", goalAngle: 0 };
    plan[0].turns = "@1;5.";
  }), ["end 5"]);
});

test("a robot with possible destinations need not rest on its last task", () => {
  const m = model(kGrid, [{ id: "a", start: 0, goals: [3] }], [{ id: "t", place: 1, agents: [0] }],
    [{ path: "@0;3E", tasks: [0] }]);
  assert.deepEqual(check(m, m.plans[0]), []);
});

test("a robot without a destination rests on a task that it has visited", () => {
  // c may rest on "two", which it visits by choice, but then meets b.
  assert.deepEqual(found(() => {}), ["vertex 6"]);
  assert.deepEqual(found((plan) => (plan[2] = { ...plan[2], path: "@11;WE.N", cost: 4 })), ["end 4"]);
  assert.deepEqual(found((plan) => {
    plan[2] = { path: "@11;2W4.2E", cost: 8, tasks: [2], work: [] }; // passes "two" without visiting it
  }).filter((text) => !kMeeting.test(text) && !/^swap/.test(text)), ["need 9"]);
  assert.deepEqual(faults((plan, _, tasks) => {
    tasks.pop();
    plan[2] = { ...plan[2], path: "@11;WE.N", cost: 4, tasks: [1] };
  }), [], "without tasks that it must visit, it rests anywhere");
});

test("a robot with optional tasks only does not rest within a turn", () => {
  const turning = (tasks: object[]) => {
    const m = model(kGrid, [{ id: "a", start: 0, turn: 2, angle: "0" }, { id: "b", start: 3 }], tasks,
      [{ path: "@0;.", turns: "@0;r" }, { path: "@3;", work: [[0, 0, 0]].slice(0, tasks.length) }]);
    return check(m, m.plans[0]).map(({ kind, time }) => `${kind} ${time}`);
  };
  assert.deepEqual(turning([]), []);
  assert.deepEqual(turning([{ id: "t", place: 3, agents: "*", need: 1 }]), ["end 1"]);
});

test("the order has the tasks that a robot must visit and those with a stated visit", () => {
  assert.deepEqual(faults((plan) => (plan[2].tasks = [2])), ["order 0"]);
  assert.deepEqual(faults((plan) => (plan[1].tasks = [])), ["order 0"]);
  assert.deepEqual(faults((plan) => (plan[1].tasks = [1, 0])), ["order 0"]);
  assert.deepEqual(faults((plan) => (plan[2].tasks = [1, 2])), [], "it is on the place of own again at 2");
  assert.deepEqual(found((plan) => {
    plan[2] = { ...plan[2], path: "@11;W..E", cost: 4, work: [[1, 3, 3]], tasks: [1, 2] };
  }), []);
  assert.deepEqual(found((plan) => {
    plan[2] = { ...plan[2], path: "@11;WEW", cost: 3, work: [[1, 3, 3]], tasks: [1, 2] };
  }), ["order 3", "vertex 6"], "not the first time on the place, but the stated visit counts");
});

test("the finish is not before the end of a stated visit", () => {
  const m = of((plan) => (plan[2] = { ...plan[2], path: "@11;W", work: [[1, 3, 3]], cost: 3 }));
  assert.equal(planFacts(m, m.plans[0]).finish[2], 3);
  assert.deepEqual(check(m, m.plans[0]).map(({ kind }) => kind), ["vertex"]);
});

test("facts name the robots that visit a task by choice", () => {
  const m = of((plan) => (plan[2] = { ...plan[2], path: "@11;WE", cost: 2 }));
  const facts = planFacts(m, m.plans[0]);
  assert.deepEqual(facts.tasks.map(({ agents, times }) => [agents, times]), [[[0], [3]], [[2, 1], [1, 6]], [[2], [0]]]);
  assert.deepEqual(facts.tasks.map(({ begin }) => begin), [1, 1, 0]);
  assert.deepEqual(facts.tasks.map((task, i) => doneTime(m.tasks[i], task)), [3, 6, 0]);
  assert.deepEqual([0, 1, 5, 6].map((time) => visitsBy(facts.tasks[1], time)), [0, 1, 1, 2]);
  assert.deepEqual(facts.destinations, [3, 4, -1]);
  assert.deepEqual(visitsOf(m, m.plans[0].agents[2], m.agents[2]).map(({ task }) => task), [2, 1]);
  const open = of((plan) => (plan[1].work = []));
  const [, two] = planFacts(open, open.plans[0]).tasks;
  assert.deepEqual([two.agents, doneTime(open.tasks[1], two)], [[2], Infinity]);
});

test("plans in which a robot visits different tasks are compared", () => {
  const view = (m: Model): PlanView => ({ plan: m.plans[0], facts: planFacts(m, m.plans[0]) } as unknown as PlanView);
  const one = of(() => {});
  const other = of((plan) => (plan[1] = { path: "@4;", cost: 0, tasks: [], work: [] }));
  const { all } = compare(one, view(one), view(other));
  assert.deepEqual(all.map(({ agent, hasOtherTasks, hasOtherOrder }) => [agent, hasOtherTasks, hasOtherOrder]),
    [[1, true, false]]);
});

test("thousands of tasks for any of many robots are checked and counted", () => {
  const wide = { kind: "grid", width: 1000, height: 100, free: "100000" };
  const agents = Array.from({ length: 100 }, (_, y) => ({ id: `a${y}`, start: 1000 * y, goals: [1000 * y + 999, 0] }));
  const tasks = Array.from({ length: 5000 }, (_, k) =>
    ({ id: `t${k}`, place: 1000 * (k % 100) + Math.floor(k / 100), agents: "*", need: 1 }));
  const plan = agents.map(({ start }, y) => ({ path: `@${start};999E`,
    work: Array.from({ length: 50 }, (_, x) => [100 * x + y, x, x]) }));
  const m = model(wide, agents, tasks, plan);
  assert.deepEqual(check(m, m.plans[0] as Plan), []);
  assert.ok(planFacts(m, m.plans[0]).tasks.every(({ agents: [agent] }, k) => agent === k % 100));
});
