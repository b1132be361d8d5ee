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
      ++heat[track.places[0]];
      for (let run = 0; run < track.runs; ++run) {
        const delta = track.deltas[run];
        const steps = track.times[run + 1] - track.times[run];
        if (delta !== 0) for (let k = 1; k <= steps; ++k) ++heat[track.places[run] + k * delta];
      }
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
