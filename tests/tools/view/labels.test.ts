// SPDX-License-Identifier: MIT
// Tests the labels of tasks on the map, which must not leave their cells.
import assert from "node:assert/strict";
import { test } from "node:test";
import { cutInTheMiddle } from "../../../tools/view/page/names";
import { labelsOfTasks, type TaskState } from "../../../tools/view/page/tasks_canvas";
import { fitted } from "../../../tools/view/page/text";

const widthOf = (text: string) => 10 * text.length;

test("a label is cut until it fits its cell when it is squeezed", () => {
  assert.equal(fitted("pick10", 60, widthOf), "pick10");
  assert.equal(fitted("pick10", 45, widthOf), "pick10", "squeezed to three quarters");
  assert.equal(fitted("pick10", 44, widthOf), "pi…10");
  assert.equal(fitted("warehouse-pick-000123", 90, widthOf), "wareho…00123");
  assert.equal(fitted("pick10", 1, widthOf), "…");
  assert.equal(fitted("", 1, widthOf), "");
});

test("a cut label keeps its begin and its end", () => {
  assert.equal(cutInTheMiddle("pick", 4), "pick");
  assert.equal(cutInTheMiddle("pick9", 4), "pi…9");
  assert.equal(cutInTheMiddle("pick9", 1), "…");
  assert.equal(cutInTheMiddle("🤖🤖🤖🤖", 3), "🤖…🤖");
});

test("a label has the id of the task, and its progress if several robots must visit it", () => {
  const task = (label: string, need: number): TaskState =>
    ({ label, need, visits: 1, begun: true, isChoice: true });
  assert.deepEqual(labelsOfTasks([task("shelf", 1), task("press", 3)]), ["shelf", "press 1/3"]);
  assert.deepEqual(labelsOfTasks([..."abcde"].map((id) => task(id, 1))), ["a", "b", "c", "+ 2"]);
});
