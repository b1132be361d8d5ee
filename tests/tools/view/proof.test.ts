// SPDX-License-Identifier: MIT
// Tests the tree of a certificate, its texts, and the navigation in it.

import assert from "node:assert/strict";
import { test } from "node:test";
import { ProofApp } from "../../../tools/view/proof/app";
import { constraintsAt, readCertificate, usersOf } from "../../../tools/view/proof/certificate";
import { constraintsShown, multiplierHeat } from "../../../tools/view/proof/marks";
import {
  closedText, constraintText, howText, lemmaText, noteText, planText, stepText, theoremText, whyText,
} from "../../../tools/view/proof/words";
import { kGrid, kRoads, model } from "./models";

const kAgents = [{ id: "a", start: 0, goal: 3 }, { id: "b", start: 3, goal: 0 }, { id: "c", start: 8 }];
const kTasks = [{ id: "t", place: 4, agents: [0] }];
const kModel = model(kGrid, kAgents, kTasks, kAgents.map(({ start }) => ({ path: `@${start};` })));

function read(...lines: string[]) {
  return readCertificate(["grove-proof 1", "instance 0123456789abcdef", ...lines, "end", ""].join("\n"), kModel);
}

const kLemma = ["lemma 9 0 1", "demand 0 bar 4 2 inf", "split 0 bar 2 2 2 | 1 bar 2 2 2", "leaf", "leaf"];
const kWhole = read("following yes", ...kLemma, "theorem 12",
  "split 0 norest 3 5 | 0 rest 3 5", "leaf 0", "later 0 4 1 5 0", "leaf", "split 1 move 1 2 3 3 | 0 move 2 1 3 3",
  "leaf", "leaf 0");

test("trees are read in order, with their lines", () => {
  const { theorem, lemmas } = kWhole;
  assert.deepEqual(theorem.steps.map(({ kind, line, depth, leaves }) => [kind, line, depth, leaves]), [
    ["split", 10, 0, 4], ["leaf", 11, 1, 1], ["later", 12, 1, 3], ["leaf", 13, 2, 1], ["split", 14, 2, 2],
    ["leaf", 15, 3, 1], ["leaf", 16, 3, 1]]);
  assert.deepEqual(lemmas.map(({ bound, agents, constraints, root }) => [bound, agents, constraints.length, root.leaves]),
    [[9, [0, 1], 1, 2]]);
  assert.deepEqual(usersOf(kWhole, 0).map(({ number }) => number), [-1]);
  const last = theorem.steps[6];
  assert.deepEqual(constraintsAt(last).map((constraint) => constraintText(kModel, constraint)), [
    "a comes to rest on [3, 0] by 5", "b does not come to rest on [0, 0] by 5",
    "a does not go from [2, 0] to [1, 0], arriving at 3"]);
});

test("texts of theorem and plan state bound and gap", () => {
  assert.equal(theoremText(kWhole), "No plan costs less than 12");
  assert.equal(howText(kWhole), "proven by 3 splits, 4 leaves and 1 lemma");
  const none = read("following no", "theorem inf", "leaf");
  assert.equal(theoremText(none), "There is no plan in which no agent enters a place as another leaves it");
  assert.equal(howText(none), "proven by 0 splits, 1 leaf and 0 lemmas");
  assert.match(howText(read("following yes", "theorem 9", "joint")), /by a search of all agents' joint paths/);
  assert.equal(planText(12, 12), "so it is optimal");
  assert.equal(planText(15, 12), "so it costs at most 25.00 % more than the best");
  assert.match(planText(11, 12), /one of the two is wrong/);
  assert.match(planText(3, 0), /gives no gap/);
});

test("each kind of constraint has a text", () => {
  const said = (line: string) => {
    const { theorem } = read("following yes", "theorem 1", `split ${line} | 2 bar 0 0 0`, "leaf", "leaf");
    return constraintText(kModel, theorem.root.sides[0]);
  };
  assert.equal(said("0 bar 4 1 1"), "a is not on [0, 1] at 1");
  assert.equal(said("0 bar 4 1 3"), "a is not on [0, 1] from 1 to 3");
  assert.equal(said("1 bar 4 1 inf"), "b is not on [0, 1] from 1 on");
  assert.equal(said("0 move 4 8 2 2"), "a does not go from [0, 1] to [0, 2], arriving at 2");
  assert.equal(said("0 norest 3 7"), "a does not come to rest on [3, 0] by 7");
  assert.equal(said("0 rest 3 7"), "a comes to rest on [3, 0] by 7");
  assert.equal(said("0 pass 1 2 3 inf"), "a does not pass through the corridor and leave it from [1, 0] to [2, 0], arriving from 3 on");
  assert.equal(said("0 stop 0 0"), "a does t as its stop 1");
  assert.equal(said("0 nostop 1 0"), "a does another task than t as its stop 2");
});

test("places on roads are named", () => {
  const roads = model(kRoads, [{ id: "a", start: 0 }], [], [{ path: "@0;" }]);
  const lines = ["grove-proof 1", "instance 0", "following yes", "theorem 1", "split 0 bar 0 1 1 | 0 bar 4 1 1", "leaf", "leaf", "end"];
  const { sides } = readCertificate(lines.join("\n"), roads).theorem.root;
  assert.deepEqual(sides.map((constraint) => constraintText(roads, constraint)), ["a is not on A at 1", "a is not on A–B 2 at 1"]);
});

test("splits have their reasons", () => {
  const why = (line: string, following = "yes") => {
    const certificate = read(`following ${following}`, ...kLemma, "theorem 1", line, "leaf", "leaf");
    return whyText(kModel, certificate.following, certificate.theorem.root);
  };
  assert.equal(why("split 0 bar 4 1 1 | 1 bar 4 1 1"), "Otherwise a and b are on [0, 1] at 1.");
  assert.equal(why("split 0 bar 4 1 1 | 1 bar 4 2 2", "no"),
    "Otherwise one of a and b enters [0, 1] at 2, as the other leaves it, or they meet there.");
  assert.equal(why("split 0 move 1 2 3 3 | 1 move 2 1 3 3"), "Otherwise a and b swap [1, 0] and [2, 0], arriving at 3.");
  assert.match(why("split 0 pass 1 2 3 4 | 1 pass 1 0 3 4"), /pass through one corridor in opposite directions/);
  assert.match(why("split 0 norest 3 7 | 0 rest 3 7"), /no other agent is on \[3, 0\] from 7 on/);
  assert.equal(why("split 0 stop 0 0 | 0 nostop 0 0"), "Each is the negation of the other.");
  assert.match(why("later 0 4 1 4 0"), /together cost at most 8, and by lemma 0 they cost more/);
  for (const none of ["0 bar 4 1 1 | 0 bar 4 1 1", "0 bar 4 1 1 | 1 rest 4 1", "0 norest 3 7 | 1 rest 3 7"])
    assert.equal(why(`split ${none}`), "", none);
  // The rules of docs/proof.md require the same places and times on both sides.
  for (const none of ["0 bar 4 1 1 | 1 bar 5 1 1", "0 bar 4 1 2 | 1 bar 4 1 2", "0 bar 4 1 1 | 1 bar 4 2 2",
    "0 move 1 2 3 3 | 1 move 1 2 3 3", "0 norest 3 7 | 0 rest 3 8", "0 stop 0 0 | 0 nostop 1 0"])
    assert.equal(why(`split ${none}`), "", none);
});

test("steps without a split have their reasons", () => {
  const { theorem, lemmas } = kWhole;
  assert.deepEqual(theorem.steps.map(noteText),
    ["4 leaves", "lemma 0", "3 leaves", "individual costs", "2 leaves", "individual costs", "lemma 0"]);
  assert.equal(closedText(kModel, theorem, theorem.steps[1]),
    "By the agents' individual costs, and the excess by lemma 0: together 12 or more.");
  assert.equal(closedText(kModel, theorem, theorem.steps[3]), "By the agents' individual costs: together 12 or more.");
  assert.equal(lemmaText(kModel, lemmas[0]), "a and b together cost 9 or more");
  assert.equal(stepText(kModel, lemmas[0], lemmas[0].root), "All plans that satisfy its constraints");
  assert.equal(stepText(kModel, theorem, theorem.steps[3]), "a costs more than 4");
  const none = read("following yes", "lemma inf 0 2", "joint", "theorem inf", "leaf 0");
  assert.equal(lemmaText(kModel, none.lemmas[0]), "there is no path for a and c");
  assert.match(closedText(kModel, none.lemmas[0], none.lemmas[0].root), /joint paths of a and c .*: there are none/);
});

test("multipliers are heat on their places", () => {
  const certificate = read("following yes", "theorem 7", "prices", "place 4 2 100", "edge 0 1 3 40", "place 4 3 60",
    "finish 0 4 1 5 9", "end");
  assert.equal(howText(certificate), "proven by 4 multipliers of places, moves and finish times");
  const heat = multiplierHeat(new ProofApp(kModel, certificate))!;
  assert.deepEqual([heat[4], heat[0], heat[1], heat[2]], [1, 0.125, 0.125, 0]);
});

test("steps can be selected, folded and unfolded", () => {
  const app = new ProofApp(kModel, kWhole);
  assert.equal(app.rows.length, 7);
  assert.deepEqual(app.agents, [0]);
  app.unfoldAll(false);
  assert.equal(app.rows.length, 1);
  app.select(kWhole.theorem.steps[5]);
  assert.equal(app.rows.length, 7); // all nodes above it are unfolded
  assert.deepEqual([app.agents, app.chosen], [[1], 1]);
  assert.equal(constraintsShown(app).length, 1);
  app.choose(2);
  assert.equal(app.chosen, 2);
  app.unfold(kWhole.theorem.steps[1], false); // elsewhere in the tree
  assert.equal(app.step, kWhole.theorem.steps[5]);
  app.unfold(kWhole.theorem.steps[2], false); // above the selected step
  assert.equal(app.step, kWhole.theorem.steps[2]);
  app.show(kWhole.lemmas[0]);
  assert.deepEqual([app.rows.length, app.chosen], [3, 0]);
  app.unfold(app.step, false);
  assert.equal(app.rows.length, 1);
});

test("a proof may be as deep as it is long", () => {
  const lines = ["following yes", "theorem 5"];
  for (let i = 0; i < 20_000; ++i) lines.push("split 0 bar 4 1 1 | 1 bar 4 1 1", "leaf");
  const certificate = read(...lines, "leaf");
  assert.equal(certificate.theorem.root.leaves, 20_001);
  const app = new ProofApp(kModel, certificate);
  assert.ok(app.rows.length < 100);
  app.unfoldAll(true);
  assert.equal(app.rows.length, 40_001);
});

test("wrong certificates are refused with the line", () => {
  assert.throws(() => read("following yes", "theorem 1", "leaf 0"), /^Error: line 5: expected a valid number/);
  assert.throws(() => read("following yes", "theorem 1", "split 0 bar 4 1 1", "leaf"), /line 5: expected another word/);
  assert.throws(() => read("following yes", "theorem 1", "split 9 bar 4 1 1 | 0 bar 4 1 1"), /line 5/);
  assert.throws(() => read("following yes", "theorem 1", "split 0 bar 4 1 1 | 1 bar 4 1 1", "leaf"), /line 7: expected leaf/);
  assert.throws(() => read("following yes", "theorem 1", "later 2 1 0 1 0"), /line 5/);
});
