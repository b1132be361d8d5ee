// SPDX-License-Identifier: MIT
// Tests the causes of waits: the robots that a waiting robot would otherwise have met.
import assert from "node:assert/strict";
import { test } from "node:test";
import { App } from "../../../tools/view/page/app";
import { eventsOf } from "../../../tools/view/page/events";
import { heatMap } from "../../../tools/view/page/heat";
import { kGrid, model, type AgentData } from "./models";

function shown(agents: AgentData[], plan: object[]): App {
  const app = new App(model(kGrid, agents, [], plan));
  while (app.viewed.some(({ checker, waits }) => !checker.done || !waits.done)) app.work(1000);
  return app;
}

// Returns the waits as texts such as "a 0-3 for b, c".
function waits(app: App): string[] {
  const name = (agent: number) => app.model.agents[agent].id;
  return app.viewed[0].waits.all.map((wait) =>
    `${name(wait.agent)} ${wait.begin}-${wait.end} for ${wait.met.map(name).join(", ") || "no robot"}`);
}

const kA: AgentData = { id: "a", start: 0 };
const kB: AgentData = { id: "b", start: 2 };

test("a robot waits for one on its next place", () => {
  assert.deepEqual(waits(shown([kA, { id: "b", start: 1 }], [{ path: "@0;2.2E" }, { path: "@1;.2E" }])),
    ["a 0-2 for b", "b 0-1 for no robot"]);
});

test("a robot waits for one that passes later", () => {
  // Without waiting, a would be on 2 at time 2, when b passes from 6 to 2.
  assert.deepEqual(waits(shown([kA, { id: "b", start: 10 }], [{ path: "@0;.3E" }, { path: "@10;2NE" }])),
    ["a 0-1 for b"]);
});

test("a robot waits for one that would swap with it", () => {
  assert.deepEqual(waits(shown([{ id: "a", start: 4 }, { id: "b", start: 2 }], [{ path: "@4;3.N2E" }, { path: "@2;2WSN" }])),
    ["a 0-3 for b"], "head on in the row above");
  assert.deepEqual(waits(shown([{ id: "a", start: 4 }, { id: "b", start: 1 }], [{ path: "@4;.NE" }, { path: "@1;WS" }])),
    ["a 0-1 for b"]);
});

test("waits may have no cause", () => {
  assert.deepEqual(waits(shown([kA, { id: "b", start: 11 }], [{ path: "@0;5.E" }, { path: "@11;3W" }])),
    ["a 0-5 for no robot"]);
});

test("several causes are listed in order of time", () => {
  // First b and then c pass cell 2; a enters after them.
  const app = shown([{ id: "a", start: 1 }, { id: "b", start: 3 }, { id: "c", start: 7 }],
    [{ path: "@1;2.E" }, { path: "@3;W2S" }, { path: "@7;NWS" }]);
  const [wait] = app.viewed[0].waits.byAgent[0];
  assert.deepEqual(wait.met, [1, 2]);
  assert.equal(wait.firstMeetingPlace, 2);
});

test("long waits are events with their causes", () => {
  const app = shown([kA, { id: "b", start: 1 }], [{ path: "@0;5.E" }, { path: "@1;4.2E" }]);
  const found = eventsOf(app).filter(({ kind }) => kind === "wait");
  assert.deepEqual(found.map(({ text, time, agents }) => [text, time, agents]), [
    ["a waits 5 steps for b to pass", 0, [0]],
    ["b waits 4 steps, although no robot is in its way", 0, [1]],
  ]);
  assert.deepEqual(eventsOf(shown([kA, kB], [{ path: "@0;2.E" }, { path: "@2;E" }]))
    .filter(({ kind }) => kind === "wait"), [], "short ones are not");
});

test("avoided conflicts are heat on their places", () => {
  const app = shown([kA, { id: "b", start: 1 }], [{ path: "@0;2.2E" }, { path: "@1;.2E" }]);
  const heat = heatMap(app.model, app.viewed[0], "yields");
  assert.deepEqual([...heat].flatMap((value, place) => (value > 0 ? [place] : [])), [1]);
});
