// SPDX-License-Identifier: MIT
// Makes the scene of a plan, or of an instance without a plan.

import type { App, PlanView } from "./app";
import { planFacts } from "./facts";
import { Frame } from "./frame";
import { heatMap } from "./heat";
import type { Point } from "./model";
import { Paths } from "./paths";
import type { Scene } from "./stage";
import { standing } from "./standing";

export function planScene(app: App, viewed: PlanView): Scene {
  const { model } = app;
  const other = app.viewed.find((v) => v !== viewed) ?? null;
  let known: { key: string; map: Float32Array } | null = null;
  const heat = () => {
    if (app.heat === "none") return null;
    const key = `${app.heat} ${viewed.waits.done}`;
    if (known?.key !== key) known = { key, map: heatMap(model, viewed, app.heat) };
    return known.map;
  };
  return {
    frame: new Frame(model, viewed.plan, viewed.facts, viewed.checker.violations),
    facts: viewed.facts,
    paths: new Paths(model, viewed, other),
    label: `The plan ${viewed.plan.name}`,
    caption: other ? viewed.plan.name : "",
    heat,
    elsewhere: (robot, time) => (other ? positionIn(app, other, robot, time) : null),
  };
}

export function instanceScene({ model }: Pick<App, "model">): Scene {
  const plan = standing(model);
  return {
    frame: new Frame(model, plan, planFacts(model, plan)),
    facts: null,
    paths: null,
    label: "The instance",
    caption: "",
    heat: () => null,
    elsewhere: () => null,
  };
}

function positionIn({ model }: App, { plan }: PlanView, robot: number, time: number): Point | null {
  const { track } = plan.agents[robot];
  if (track.isEmpty) return null;
  const { xs, ys } = model.world;
  const step = Math.floor(time);
  const [a, b] = [track.place(step), track.place(step + 1)];
  const progress = time - step;
  return { x: xs[a] + (xs[b] - xs[a]) * progress, y: ys[a] + (ys[b] - ys[a]) * progress };
}
