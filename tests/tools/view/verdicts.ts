// SPDX-License-Identifier: MIT
// Reads file names of grove view pages from standard input, one per line. For each page it
// writes one line of JSON: the violations that the page finds in its first plan, or an error if it
// cannot show the plan.

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
