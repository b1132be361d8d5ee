// SPDX-License-Identifier: MIT
// Tests how ids are displayed.
import assert from "node:assert/strict";
import { test } from "node:test";
import { labelsOf, nameOf } from "../../../tools/view/page/names";

test("most ids are shown unchanged", () => {
  for (const id of ["a4", "<b>x</b>", "Ünïcödé 机器人 🤖", "a b", "&amp;"]) assert.equal(nameOf(id), id);
});

test("invisible and direction characters are shown as boxes", () => {
  assert.equal(nameOf("a\u202Eb\u0000c\nd"), "a▯b▯c▯d");
  assert.equal(nameOf("\u200b\u2067"), "▯▯");
});

test("long ids are cut between characters", () => {
  const name = nameOf("🤖".repeat(1000));
  assert.equal([...name].length, 60);
  assert.ok(name.endsWith("🤖…"));
});

test("right-to-left ids are isolated", () => {
  assert.equal(nameOf("רובוט"), "\u2068רובוט\u2069");
});

test("an empty id is shown", () => {
  assert.equal(nameOf(""), "(no name)");
});

test("labels keep the parts that differ", () => {
  assert.deepEqual(labelsOf(["a1", "a10", "b"], 6), ["a1", "a10", "b"]);
  assert.deepEqual(labelsOf(["robot-17", "robot-170"], 6), ["17", "170"]);
  assert.deepEqual(labelsOf(["agent12", "agent130"], 6), ["12", "130"]);
  assert.deepEqual(labelsOf(["lift left", "lift lower"], 6), ["left", "lower"]);
  assert.deepEqual(labelsOf(["robot", "robot-2"], 6), ["robot", "robot…"]);
  assert.deepEqual(labelsOf(["forklift"], 6), ["forkl…"]);
  assert.deepEqual(labelsOf([], 6), []);
});
