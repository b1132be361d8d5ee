// SPDX-License-Identifier: MIT
// Tests which robots are red at a time: those that collide or violate a rule.
import assert from "node:assert/strict";
import { test } from "node:test";
import { check } from "../../../tools/view/page/check";
import { planFacts } from "../../../tools/view/page/facts";
import { Frame } from "../../../tools/view/page/frame";
import { kGrid, kRoads, model } from "./models";

// Returns the red robots by time, in half steps. Times without red robots are omitted.
function red(...parts: Parameters<typeof model>): Record<number, string> {
  const m = model(...parts);
  const [plan] = m.plans;
  const frame = new Frame(m, plan, planFacts(m, plan), check(m, plan));
  const found: Record<number, string> = {};
  for (let time = 0; time <= plan.end + 2; time += 0.5) {
    frame.update(time);
    const names = m.agents.filter((_, i) => frame.colliding[i]).map(({ id }) => id);
    if (names.length > 0) found[time] = names.join("");
  }
  return found;
}

const kTwo = [{ id: "a", start: 0 }, { id: "b", start: 3 }];

test("no robot is red in a valid plan", () => {
  assert.deepEqual(red(kGrid, kTwo, [], [{ path: "@0;E" }, { path: "@3;W" }]), {});
});

test("two robots on one place are red while they are there", () => {
  assert.deepEqual(red(kGrid, kTwo, [], [{ path: "@0;2ES" }, { path: "@3;.W.W" }]),
    { 1.5: "ab", 2: "ab", 2.5: "ab" });
});

test("a swap is red during its step and at its end", () => {
  assert.deepEqual(red(kGrid, kTwo, [], [{ path: "@0;3E" }, { path: "@3;3W" }]), { 1.5: "ab", 2: "ab" });
});

test("a swap on a road is red", () => {
  assert.deepEqual(red(kRoads, [{ id: "a", start: 1 }, { id: "b", start: 5 }], [], [{ path: "@1;@5;" }, { path: "@5;@1;" }]),
    { 0.5: "ab", 1: "ab" });
});

test("a jump is red only in its step", () => {
  assert.deepEqual(red(kGrid, kTwo, [], [{ path: "@0;@2;5." }, { path: "@3;" }]), { 0.5: "a", 1: "a" });
});

test("a move against the heading is red", () => {
  assert.deepEqual(red(kGrid, [{ id: "a", start: 0, turn: 1, angle: "0" }], [], [{ path: "@0;.E2.", turns: "@0;4." }]),
    { 1.5: "a", 2: "a" });
});

test("a wrong end is red from then on", () => {
  assert.deepEqual(red(kGrid, [{ id: "a", start: 0, goal: 2 }], [], [{ path: "@0;E" }]),
    { 1: "a", 1.5: "a", 2: "a", 2.5: "a", 3: "a" });
});
