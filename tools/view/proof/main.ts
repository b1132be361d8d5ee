// SPDX-License-Identifier: MIT
// Page of a certificate: its tree, and a map with the places and agents of the selected step.

import { kDark, kLight } from "../page/colors";
import { el } from "../page/dom";
import { entriesOf, legendOf } from "../page/panels/legend";
import { instanceScene } from "../page/plan_scene";
import { readModel } from "../page/read";
import { Stage } from "../page/stage";
import { ProofApp } from "./app";
import { readCertificate } from "./certificate";
import { Marks, multiplierHeat } from "./marks";
import { Details } from "./panels/details";
import { Lists } from "./panels/lists";
import { strip } from "./panels/strip";

function textOf(id: string): string {
  return document.getElementById(id)!.textContent!;
}

function begin(): void {
  try {
    const model = readModel(textOf("grove-data"));
    show(new ProofApp(model, readCertificate(textOf("grove-proof"), model)));
  } catch (error) {
    const why = error instanceof Error ? error.message : String(error);
    document.body.replaceChildren(el("main", { class: "failure" },
      el("h1", {}, "This certificate cannot be shown"), el("p", {}, why)));
  }
}

function show(app: ProofApp): void {
  const stage = new Stage(app, {
    ...instanceScene(app), paths: new Marks(app), label: "Where the step chosen is", heat: () => multiplierHeat(app),
  });
  const hasMultipliers = app.certificate.theorem.root.kind === "prices";
  const marks: [string, string][] = hasMultipliers ? [["heat", "multipliers, of all times together"]]
    : [["mark", "the place in question, with its times"], ["way", "who is concerned, as the crow flies"]];
  const legend = legendOf([["resting", "an agent's start"], ...entriesOf(app.model, []).filter(isOpen), ...marks]);
  document.body.replaceChildren(
    strip(app, document.title),
    el("main", { class: "stages" }, stage.element),
    el("aside", { class: "side" }, new Details(app).element, new Lists(app).element),
    el("footer", { class: "foot" }, legend));
  const scheme = matchMedia("(prefers-color-scheme: dark)");
  app.onChange(() => stage.touch());
  scheme.addEventListener("change", () => stage.touch());
  new ResizeObserver(() => stage.resize()).observe(stage.element);
  stage.resize();
  const tick = () => {
    stage.draw(scheme.matches ? kDark : kLight, Math.min(2, devicePixelRatio));
    requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
  // For tests: the state of the page.
  Object.assign(window, { grove: { app, stages: [stage] } });
}

// Whether the legend of this page has this entry. At time 0, no task has begun or is done.
function isOpen([kind]: [string, string]): boolean {
  return kind === "task" || kind === "goal";
}

begin();
