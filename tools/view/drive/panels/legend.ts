// SPDX-License-Identifier: MIT
// Legend of the shapes and colours on the execution page.

import { entriesOf, legendOf } from "../../page/panels/legend";
import type { DriveApp } from "../app";
import { kStates, type State } from "../drive";
import { signedText } from "../words";

function entry(kind: string, state: State): [string, string] {
  return [kind, signedText(kStates.indexOf(state))];
}

export function legend({ model }: DriveApp): HTMLElement {
  return legendOf(entriesOf(model, [
    entry("moving", "moving"), entry("waiting", "waiting"), entry("working", "working"),
    entry("resting", "done"), entry("collision", "lifted"), entry("collision", "lost"),
  ]));
}
