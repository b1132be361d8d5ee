// SPDX-License-Identifier: MIT
// A drive's columns, its log, and where robots are between two sightings.

import assert from "node:assert/strict";
import { test } from "node:test";
import { DriveApp } from "../../../tools/view/drive/app";
import { Drive, kStates, Sightings } from "../../../tools/view/drive/drive";
import { Log } from "../../../tools/view/drive/log";
import { DriveNow } from "../../../tools/view/drive/now";
import { Order } from "../../../tools/view/drive/order";
import { DrivePlayer } from "../../../tools/view/drive/player";
import { clockText, doingText } from "../../../tools/view/drive/words";
import { readModel } from "../../../tools/view/page/read";

const kModel = JSON.stringify({
  format: "grove view 1", instance: "i", world: { kind: "grid", width: 5, height: 2, free: "10" },
  agents: [{ id: "a", start: 0 }, { id: "b", start: 5 }],
  tasks: [{ id: "t", place: 2, agents: [0] }, { id: "u", place: 0, agents: [0] }],
  plans: [{ name: "p", claims: {}, agents: [
    { cost: 3, path: "@0;3E", tasks: [1, 0] }, { cost: 2, path: "@5;2E", tasks: [] }] }],
});
const kOrder = JSON.stringify({ robots: [
  { ends: [1, 2, 3], waits: [[1, 1, 0]], visits: [[-1, 1], [1, 0]] }, { ends: [1, 2], waits: [], visits: [] }] });
const kHeader = { format: "grove drive 1", order: "o.json", robots: ["a", "b"], seconds_per_step: 1 };

function line(t: number, robot: string, at: [number, number], action: number, state: string, angle?: number) {
  return { t, robot, at, ...(angle === undefined ? {} : { angle }), action, state };
}

function log(...events: object[]): string {
  return events.map((event) => JSON.stringify(event) + "\n").join("");
}

function read(...events: object[]) {
  const model = readModel(kModel);
  const order = Order.read(kOrder, model);
  const one = new Log(model, order);
  one.add(log(kHeader, ...events));
  return { model, order, drive: one.drive };
}

test("the last sighting by a time, asked for in any order", () => {
  const sightings = new Sightings();
  const times: number[] = [];
  let time = 0;
  let state = 1;
  const draw = (below: number) => (state = (state * 48271) % 2147483647) % below;
  for (let i = 0; i < 500; ++i) {
    sightings.add(time, 0, 0, NaN, 0, 0);
    times.push(time);
    time += draw(3);
  }
  for (let i = 0; i < 3000; ++i) {
    const at = i % 3 === 0 ? draw(Math.ceil(time) + 2) : (i % 700) / 2;
    let last = 0;
    times.forEach((t, k) => { if (t <= at) last = k; });
    assert.equal(sightings.at(at), last);
  }
});

test("one that moves goes straight, one that stands does so until shortly before it is seen elsewhere", () => {
  const { model, drive } = read(
    line(0, "a", [0, 0], 0, "moving", 350), line(4, "a", [2, 0], 0, "waiting", 10),
    line(9, "a", [3, 0], 1, "done"));
  const now = new DriveNow(model, drive);
  const at = (time: number) => {
    now.update(time);
    return [now.xs[0], now.ys[0]].map((value) => Number(value.toFixed(3)));
  };
  assert.deepEqual(at(0), [0.5, 0.5]);
  assert.deepEqual(at(1), [1, 0.5]);
  assert.ok(Math.abs((now.angles[0] * 180) / Math.PI - 355) < 0.01); // the shorter way round
  assert.deepEqual(at(4), [2.5, 0.5]);
  assert.deepEqual(at(8.5), [2.5, 0.5]);
  assert.deepEqual(at(8.925), [3, 0.5]);
  assert.deepEqual(at(100), [3.5, 0.5]);
  assert.deepEqual([now.xs[1], now.ys[1]], [0.5, 1.5]); // not seen yet: at its start
});

test("what is visited when, and who waits for whom", () => {
  const { model, order, drive } = read(
    line(0.5, "a", [0, 0], 0, "moving"), line(1, "a", [1, 0], 1, "waiting"),
    line(2, "b", [0, 1], 0, "lost"), line(6, "b", [1, 1], 1, "moving"), line(8, "a", [2, 0], 2, "moving"));
  const app = new DriveApp(model, order, drive, false);
  assert.deepEqual(app.tasks.map(({ times }) => times), [[8], [0]]);
  assert.equal(doingText(app, 0, 3), "waiting for b");
  assert.equal(doingText(app, 0, 7), "waiting");
  assert.equal(doingText(app, 1, 3), "lost");
  assert.equal(drive.isOver, false);
  assert.equal(order.planTime(0, drive.actionsAt(0, 8)), 2);
});

test("logs that grow in pieces", () => {
  const text = log(kHeader, line(1, "a", [1, 0], 1, "moving"), line(2, "b", [1, 1], 2, "done"));
  const model = readModel(kModel);
  const one = new Log(model, Order.read(kOrder, model));
  for (const character of text) one.add(character);
  assert.deepEqual(one.drive.robots.map(({ count }) => count), [1, 1]);
  assert.equal(one.drive.end, 2);
});

test("logs that are wrong say where", () => {
  const wrong = (expected: RegExp, ...events: object[]) => assert.throws(() => read(...events), expected);
  const good = line(1, "a", [1, 0], 1, "moving");
  wrong(/^Error: line 2: robot: expected a robot that the first line names/, { ...good, robot: "z" });
  wrong(/line 2: state: expected one of waiting/, { ...good, state: "asleep" });
  wrong(/line 2: action: expected a whole number from 0 to 3/, { ...good, action: 4 });
  wrong(/line 2: at: expected a list of 2/, { ...good, at: [1] });
  wrong(/line 2: at\[0\]: expected a place in the world/, { ...good, at: [1e9, 0] });
  wrong(/line 3: t: expected seconds from 1 on/, good, { ...good, t: 0.5 });
  wrong(/line 2: t: expected a number/, { ...good, t: "1" });
  const model = readModel(kModel);
  const order = Order.read(kOrder, model);
  assert.throws(() => new Log(model, order).add("{}\n"), /line 1: format/);
  assert.throws(() => new Log(model, order).add(log({ ...kHeader, robots: ["z"] })), /robots\[0\]: expected a robot of the instance/);
  assert.throws(() => new Log(model, order).add("{\n"), /line 1: the data is no JSON/);
});

test("live time keeps near to what comes, and is left by going back", () => {
  const player = new DrivePlayer(true);
  player.end = 100;
  player.advance(0.1);
  assert.equal(player.time, 99);
  for (let i = 0; i < 50; ++i) {
    player.end += 0.1;
    player.advance(0.1);
  }
  assert.ok(Math.abs(player.time - (player.end - 1)) < 0.2);
  player.go(50);
  assert.equal(player.live, false);
  player.advance(1);
  assert.equal(player.time, 50);
  player.toggle();
  player.advance(0.2);
  assert.ok(player.time > 50);
  player.goLive();
  assert.equal(player.live && player.running, true);
  player.toggle();
  assert.equal(player.live || player.running, false);
  player.go(player.end);
  assert.equal(player.live, true);
});

test("times as they are read", () => {
  assert.deepEqual([0, 59.9, 61, 3661].map(clockText), ["0:00", "0:59", "1:01", "1:01:01"]);
  assert.equal(new Drive(readModel(kModel)).stateAt(0, 5), kStates.indexOf("waiting"));
});
