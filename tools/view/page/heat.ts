// SPDX-License-Identifier: MIT
// Heat of each place: the square root of its share of the maximum, from 0 to 1.

import type { PlanView } from "./app";
import { Doing } from "./facts";
import type { Model } from "./model";

export type Heat = "none" | "traffic" | "waits" | "yields";

export function heatMap(model: Model, viewed: PlanView, kind: Heat): Float32Array {
  const heat = new Float32Array(model.world.places);
  if (kind === "traffic") addTraffic(heat, viewed);
  else if (kind === "waits") addWaits(heat, viewed);
  else addYields(heat, viewed);
  const most = heat.reduce((a, b) => Math.max(a, b), 0);
  if (most > 0) for (let i = 0; i < heat.length; ++i) heat[i] = Math.sqrt(heat[i] / most);
  return heat;
}

function addTraffic(heat: Float32Array, { plan }: PlanView): void {
  for (const { track } of plan.agents)
    if (!track.isEmpty) for (const place of track.visited()) ++heat[place];
}

function addWaits(heat: Float32Array, { plan, facts }: PlanView): void {
  plan.agents.forEach(({ track }, index) => {
    if (track.isEmpty) return;
    for (const span of facts.spans[index])
      if (span.doing === Doing.kWaiting) heat[track.place(span.begin)] += span.end - span.begin;
  });
}

// Counts, for each place, the waits that avoid a meeting there: without the wait, the robot would have met another
// robot for the first time at this place.
function addYields(heat: Float32Array, { waits }: PlanView): void {
  for (const wait of waits.all) if (wait.firstMeetingPlace >= 0) ++heat[wait.firstMeetingPlace];
}
