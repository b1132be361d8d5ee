// SPDX-License-Identifier: MIT
// A plan in which all robots stay at their starts, to display an instance without a plan.

import type { Agent, Model, Plan } from "./model";
import { Track, TurnTrack } from "./track";

function still(value: number): Int32Array {
  return Int32Array.of(value);
}

function turns({ turnSteps, startAngle }: Agent): TurnTrack | null {
  if (turnSteps === 0) return null;
  return new TurnTrack(still(0), still(startAngle.steps), new Int8Array(0),
    Int8Array.of(startAngle.direction), new Uint8Array(0), turnSteps);
}

export function standing({ agents }: Model): Plan {
  return {
    name: "",
    claims: {},
    agents: agents.map((agent) => ({
      cost: null,
      track: new Track(still(0), still(agent.start), new Int32Array(0), new Uint8Array(0)),
      turns: turns(agent),
      tasks: null,
      work: [],
    })),
    end: 0,
  };
}
