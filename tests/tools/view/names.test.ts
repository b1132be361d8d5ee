// SPDX-License-Identifier: MIT
// Ids as they are shown.
import assert from "node:assert/strict";
import { test } from "node:test";
import { nameOf } from "../../../tools/view/page/names";

test("most ids are shown as they are", () => {
  for (const id of ["a4", "<b>x</b>", "Ünïcödé 机器人 🤖", "a b", "&amp;"]) assert.equal(nameOf(id), id);
});

test("what is not seen, or turns the text around it, is shown as a box", () => {
  assert.equal(nameOf("a\u202Eb\u0000c\nd"), "a▯b▯c▯d");
  assert.equal(nameOf("\u200b\u2067"), "▯▯");
});

test("long ids are cut between characters", () => {
  const name = nameOf("🤖".repeat(1000));
  assert.equal([...name].length, 60);
  assert.ok(name.endsWith("🤖…"));
});

test("from right to left, by itself", () => {
  assert.equal(nameOf("רובוט"), "\u2068רובוט\u2069");
});

test("none at all", () => {
  assert.equal(nameOf(""), "(no name)");
});
