// SPDX-License-Identifier: MIT
// Small models for tests, in the data format of the page.

import { readModel } from "../../../tools/view/page/read";
import type { Model } from "../../../tools/view/page/model";

export interface AgentData {
  id: string;
  start: number;
  [key: string]: unknown;
}

// A grid of 4 x 3 cells, all of them free except cell 5.
export const kGrid = { kind: "grid", width: 4, height: 3, free: "5 1 6" };
// A -3-> B: one-way, with two places between. B = C: two-way, two steps.
export const kRoads = {
  kind: "roadmap",
  vertices: [["A", 0, 0], ["B", 3, 0], ["C", 3, 2]],
  roads: [[0, 1, 3, 1], [1, 2, 2, 0]],
};

export function data(world: object, agents: AgentData[], tasks: object[], plan: object[], claims = {}) {
  return {
    format: "grove view 1", instance: "test", world, agents, tasks,
    plans: [{ name: "plan", claims, agents: plan }],
  };
}

export function model(...parts: Parameters<typeof data>): Model {
  return readModel(JSON.stringify(data(...parts)));
}
