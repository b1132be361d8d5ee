// SPDX-License-Identifier: MIT
// Where it is crowded: for each place 0 .. 1, the most being 1.

import { Doing, waits, type PlanFacts } from "./facts";
import type { Model, Plan } from "./model";

export function heatMap(model: Model, plan: Plan, facts: PlanFacts, kind: string): Float32Array {
  const heat = new Float32Array(model.world.places);
  plan.agents.forEach((agent, index) => {
    const { track } = agent;
    if (track.isEmpty) return;
    if (kind === "traffic") {
      for (const place of track.visited()) ++heat[place];
    } else if (kind === "waits") {
      for (const span of facts.spans[index])
        if (span.doing === Doing.kWaiting) heat[track.place(span.begin)] += span.end - span.begin;
    } else {
      // Conflicts avoided: where somebody stands that others pass.
      for (const wait of waits(plan, index, facts.spans[index]))
        if (wait.for.length > 0) heat[track.place(wait.end + 1)] += 1;
    }
  });
  const most = heat.reduce((a, b) => Math.max(a, b), 0);
  if (most > 0) for (let i = 0; i < heat.length; ++i) heat[i] = Math.sqrt(heat[i] / most);
  return heat;
}
