// SPDX-License-Identifier: MIT
// Who is red when: those who collide, and those who do what they may not.
import assert from "node:assert/strict";
import { test } from "node:test";
import { check } from "../../../tools/view/page/check";
import { planFacts } from "../../../tools/view/page/facts";
import { Frame } from "../../../tools/view/page/frame";
import { kGrid, kRoads, model } from "./models";

// {time: robots that are red then}, in half steps; times without any are left out.
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

test("nobody in a good plan", () => {
  assert.deepEqual(red(kGrid, kTwo, [], [{ path: "@0;E" }, { path: "@3;W" }]), {});
});

test("two on one place, while they are", () => {
  assert.deepEqual(red(kGrid, kTwo, [], [{ path: "@0;2ES" }, { path: "@3;.W.W" }]),
    { 1.5: "ab", 2: "ab", 2.5: "ab" });
});

test("an exchange of places, in its step and at its end", () => {
  assert.deepEqual(red(kGrid, kTwo, [], [{ path: "@0;3E" }, { path: "@3;3W" }]), { 1.5: "ab", 2: "ab" });
});

test("an exchange of places on a road", () => {
  assert.deepEqual(red(kRoads, [{ id: "a", start: 1 }, { id: "b", start: 5 }], [], [{ path: "@1;@5;" }, { path: "@5;@1;" }]),
    { 0.5: "ab", 1: "ab" });
});

test("who jumps, in that step alone", () => {
  assert.deepEqual(red(kGrid, kTwo, [], [{ path: "@0;@2;5." }, { path: "@3;" }]), { 0.5: "a", 1: "a" });
});

test("who goes where it does not look", () => {
  assert.deepEqual(red(kGrid, [{ id: "a", start: 0, turn: 1, angle: "0" }], [], [{ path: "@0;.E2.", turns: "@0;4." }]),
    { 1.5: "a", 2: "a" });
});

test("who ends on the wrong place, from then on", () => {
  assert.deepEqual(red(kGrid, [{ id: "a", start: 0, goal: 2 }], [], [{ path: "@0;E" }]),
    { 1: "a", 1.5: "a", 2: "a", 2.5: "a", 3: "a" });
});
