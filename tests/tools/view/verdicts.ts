// SPDX-License-Identifier: MIT
// Reads pages of grove view by their names on standard input, a line each; writes a line of JSON
// for each: what the page finds wrong with its first plan, or why it cannot be shown.

import { readFileSync } from "node:fs";
import { createInterface } from "node:readline";
import { check } from "../../../tools/view/page/check";
import { readModel } from "../../../tools/view/page/read";

const kData = /<script type="application\/json" id="grove-data">(.*?)<\/script>/s;

function verdict(file: string): object {
  try {
    const found = kData.exec(readFileSync(file, "utf8"));
    if (!found) return { error: "a page without data" };
    const model = readModel(found[1]);
    return { violations: check(model, model.plans[0]) };
  } catch (error) {
    return { error: String(error) };
  }
}

createInterface({ input: process.stdin }).on("line", (file) => console.log(JSON.stringify(verdict(file))));
