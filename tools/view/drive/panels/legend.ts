// SPDX-License-Identifier: MIT
// What shapes and colours mean.

import { entriesOf, legendOf } from "../../page/panels/legend";
import type { DriveApp } from "../app";

export function legend({ model }: DriveApp): HTMLElement {
  return legendOf(entriesOf(model, [
    ["moving", "moving"], ["waiting", "waiting"], ["working", "at work"], ["resting", "done"],
    ["collision", "lifted off or lost"],
  ]));
}
