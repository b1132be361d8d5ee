#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests each rule of docs/proof.md with hand-made certificates: the checker verifies what a rule proves, and refuses
each violated condition with the number of its line.

    rules_test.py GROVE_VERIFY
"""
import unittest

import checkers
from worlds import Agent, Instance, World


def grid(*rows):
    return World(list(rows))


# Two agents cross in the middle of a room at time 1; one must wait.
CROSS = Instance(grid("...", "...", "..."), [Agent((3,), 5), Agent((1,), 7)])
CROSSED = ["split 0 bar 4 1 1 | 1 bar 4 1 1", "leaf", "leaf"]
# Three straight paths of four steps through one common cell, so that each pair is in conflict.
STAR = Instance(grid(*["....."] * 5), [Agent((10,), 14), Agent((2,), 22), Agent((14,), 10)])
# The straight paths, for a formula: variables 1 to 18, of which 18 counts, and two cores.
STRAIGHT = [*(f"agent {agent} 0" for agent in range(3)), *(f"within {agent} 0" for agent in range(3)),
            *(f"visit 0 {10 + time} {time}" for time in range(4)), "last 0 14 4",
            *(f"visit 1 {2 + 5 * time} {time}" for time in range(4)), "last 1 22 4",
            *(f"visit 2 {14 - time} {time}" for time in range(4)), "last 2 10 4",
            "sum -1 -2", "count 0 0 2 2", "sum -3 19"]
CORES = ["core 0", "clause -1 -3", "clause -2 -3", "core 1"]
# The same paths, if agent 1 must visit the common cell: nodes take the place of its visits.
ERRAND = Instance(STAR.world, STAR.agents, [(12, 0, [1])])
NODES = ["node 1 0 2 0 0", "node 1 1 7 0 0", "node 1 2 12 0 1", "node 1 3 17 0 1", "node 1 4 22 0 1 since 4"]
# One agent follows the other.
ROW = Instance(grid("...."), [Agent((1,), 3), Agent((0,), 2)])
# Two agents exchange places; a detour takes three steps.
SWAP = Instance(grid("..", ".."), [Agent((0,), 1), Agent((1,), 0)])
STUCK = Instance(grid(".."), [Agent((0,), 1), Agent((1,), 0)])
# Agent 1 must pass the goal of agent 0.
PASSER = Instance(grid("....."), [Agent((1,), 2), Agent((0,), 4)])
# Two rooms and a corridor of two cells (8 and 9) between cells 7 and 10.
HALL = Instance(grid("..@@..", "......"), [Agent((6,), 11), Agent((11,), 6)])
ERRANDS = Instance(grid("....."), [Agent((2,), 2), Agent((3,), 3)],
                   [(0, 0, [0]), (4, 0, [0]), (4, 0, [0]), (1, 2, [0])])


# Task 0 is in the middle, and one of two agents must visit it. Each of them then takes two steps more.
SHARED = Instance(grid("....."), [Agent((1,), 0), Agent((3,), 4)], [(2, 0, [0, 1])], {0: 1})
# Both agents can end on cell 0 or 2. Agent 1 cannot pass agent 0.
QUEUE = Instance(grid("....."), [Agent((3,), goals=[2, 0]), Agent((4,), goals=[0, 2])])


def certificate(instance, *lines, following="yes"):
    return "\n".join(["grove-proof 1", f"instance {instance.checksum()}", f"following {following}", *lines,
                      "end"]) + "\n"


class Rules(unittest.TestCase):
    def verified(self, instance, *lines, following="yes"):
        bound = next(line.split(" ")[1] for line in lines if line.startswith("theorem"))
        claim = "there is no plan" if bound == "inf" else f"no plan costs less than {bound}"
        claim += checkers.following_note(following == "yes")
        found = checkers.verify(instance, certificate(instance, *lines, following=following))
        self.assertEqual((found.code, found.text), (0, f"verified: {claim}\n"), lines)

    def refused(self, line, reason, instance, *lines, following="yes"):
        """Asserts that the certificate is refused at `line`, where the first of `lines` is line 1 after the head."""
        found = checkers.verify(instance, certificate(instance, *lines, following=following))
        self.assertEqual(found.code, 1, (lines, found.text))
        self.assertRegex(found.text, f"^refused: line {line + 3}: .*{reason}", lines)

    def refused_splits(self, instance, *splits, following="yes"):
        for one in splits:
            self.refused(2, "may satisfy neither", instance, "theorem 1", f"split {one}", "leaf", "leaf",
                         following=following)

    def test_leaf_proves_the_sum_of_costs(self):
        self.verified(CROSS, "theorem 4", "leaf")
        self.refused(2, "costs 4 and 0 by lemmas; expected 5", CROSS, "theorem 5", "leaf")
        self.refused(2, "expected inf", CROSS, "theorem inf", "leaf")

    def test_bar_split_needs_one_place_and_time(self):
        self.verified(CROSS, "theorem 5", *CROSSED)
        self.refused(3, "costs 5", CROSS, "theorem 6", *CROSSED)
        self.refused_splits(CROSS, "0 bar 4 1 1 | 1 bar 5 1 1", "0 bar 4 1 1 | 1 bar 4 2 2",
                            "0 bar 4 1 2 | 1 bar 4 1 2",
                            "0 bar 4 1 1 | 0 bar 4 1 1", "0 bar 4 1 inf | 1 bar 4 1 inf",
                            "0 bar 4 1 1 | 1 move 4 5 1 1",
                            "0 bar 4 1 1 | 1 bar 4 0 0")
        self.refused(2, "agent 2 is not among", CROSS, "theorem 1", "split 0 bar 4 1 1 | 2 bar 4 1 1", "leaf", "leaf")
        self.refused(2, "no place 9", CROSS, "theorem 1", "split 0 bar 9 1 1 | 1 bar 9 1 1", "leaf", "leaf")

    def test_each_side_of_a_split_has_its_own_constraint(self):
        # Agent 0 is barred at its start and therefore has no path. Agent 1 is not barred.
        self.refused(4, "costs 4 ", CROSS, "theorem 9", "split 0 bar 3 0 0 | 1 bar 3 0 0", "leaf", "leaf")
        self.refused(3, "costs 4 ", CROSS, "theorem 9", "split 1 bar 3 0 0 | 0 bar 3 0 0", "leaf", "leaf")

    def test_following_split_needs_forbidden_following(self):
        split = "split 0 bar 1 0 0 | 1 bar 1 1 1"
        self.verified(ROW, "theorem 5", split, "leaf", "leaf", following="no")
        self.verified(ROW, "theorem 5", "split 1 bar 1 1 1 | 0 bar 1 0 0", "leaf", "leaf", following="no")
        self.refused_splits(ROW, split.removeprefix("split "))
        self.refused_splits(ROW, "0 bar 1 0 0 | 1 bar 1 2 2", following="no")
        self.refused(2, "joint search finds a plan", ROW, "theorem 5", "joint")
        self.verified(ROW, "theorem 5", "joint", following="no")
        self.refused(2, "joint search finds a plan", ROW, "theorem 6", "joint", following="no")

    def test_move_split_needs_opposite_moves(self):
        self.verified(SWAP, "theorem 3", "split 0 move 0 1 1 1 | 1 move 1 0 1 1", "leaf", "leaf")
        self.refused(3, "costs 3", SWAP, "theorem 4", "split 0 move 0 1 1 1 | 1 move 1 0 1 1", "leaf", "leaf")
        self.refused_splits(SWAP, "0 move 0 1 1 1 | 1 move 0 1 1 1", "0 move 0 1 1 1 | 1 move 1 0 2 2",
                            "0 move 0 1 1 2 | 1 move 1 0 1 2", "0 move 0 1 1 1 | 0 move 1 0 1 1",
                            "0 move 0 1 1 1 | 1 move 1 3 1 1",
                            "0 move 0 1 1 inf | 1 move 1 0 1 inf")
        self.refused(2, "expected two different places", SWAP, "theorem 1", "split 0 move 0 0 1 1 | 1 move 0 0 1 1",
                     "leaf", "leaf")

    def test_rest_split_needs_one_agent_place_and_time(self):
        self.verified(PASSER, "theorem 7", "split 0 norest 2 2 | 0 rest 2 2", "leaf", "leaf")
        self.verified(PASSER, "theorem 7", "split 0 rest 2 2 | 0 norest 2 2", "leaf", "leaf")
        self.refused(3, "costs 7", PASSER, "theorem 8", "split 0 norest 2 2 | 0 rest 2 2", "leaf", "leaf")
        self.refused_splits(PASSER, "0 norest 2 2 | 1 rest 2 2", "0 norest 2 2 | 0 rest 2 3",
                            "0 norest 2 2 | 0 rest 3 2",
                            "0 norest 2 2 | 0 norest 2 2", "0 rest 2 2 | 0 rest 2 2")

    def test_rest_bars_other_agents(self):
        lemma = ["lemma inf 1", "demand 1 bar 2 2 inf", "leaf"]
        self.verified(PASSER, *lemma, "theorem 7", "split 0 norest 2 2 | 0 rest 2 2", "leaf", "leaf 0")
        self.refused(6, "constraint 0 of lemma 0 is not in force", PASSER, *lemma, "theorem 7",
                     "split 0 norest 2 2 | 0 rest 2 2", "leaf 0")
        # A rest among the constraints of a lemma implies no bars for other agents, and neither does the norest side of
        # a split.
        self.refused(3, "costs 5", PASSER, "lemma 7 0 1", "demand 0 rest 2 2", "leaf")
        self.refused(4, "costs 7", PASSER, "theorem 8", "split 0 rest 2 2 | 0 norest 2 2", "leaf", "leaf")

    def test_pass_split_needs_a_chain_and_matching_times(self):
        good = "0 pass 9 10 4 7 | 1 pass 8 7 4 7"
        self.verified(HALL, "theorem 14", f"split {good}", "leaf", "leaf")
        self.refused(3, "costs 14", HALL, "theorem 15", f"split {good}", "leaf", "leaf")
        self.refused_splits(HALL, "0 pass 9 10 4 8 | 1 pass 8 7 4 7", "0 pass 9 10 4 7 | 1 pass 8 7 3 7",
                            "0 pass 9 10 4 7 | 1 pass 8 7 4 8", "0 pass 9 10 3 7 | 1 pass 8 7 4 7",
                            "0 pass 9 10 4 7 | 1 pass 9 10 4 7",
                            "0 pass 9 10 4 7 | 0 pass 8 7 4 7", "0 pass 9 10 4 inf | 1 pass 8 7 4 inf",
                            "0 pass 9 10 4 inf | 1 pass 8 7 4 7",
                            "0 pass 9 10 4 7 | 1 pass 1 7 4 7")
        for wrong in ("8 10", "9 8", "7 8", "9 3", "9 9"):
            self.refused(2, "the last place of a chain", HALL, "theorem 1",
                         f"split 0 pass {wrong} 4 7 | 1 pass 8 7 4 7", "leaf", "leaf")

    def test_agent_that_turns_back_does_not_traverse(self):
        # An agent that may not traverse the chain in either direction can still enter and leave it, here for task 0 on
        # cell 8.
        visitor = Instance(HALL.world, [Agent((7,), 7)], [(8, 0, [0])])
        constraints = ["demand 0 pass 8 7 0 inf", "demand 0 pass 9 10 0 inf"]
        self.refused(4, "costs 2 ", visitor, "lemma 3 0", *constraints, "leaf")
        self.verified(visitor, "lemma 2 0", *constraints, "leaf", "theorem 2", "leaf")

    def test_stop_split_needs_an_existing_stop(self):
        # Cell 1, on the way to cell 0, has a task of two steps. Cell 4 is a single stop with two tasks.
        self.verified(ERRANDS, "theorem 10", "leaf")
        self.verified(ERRANDS, "theorem 10", "split 0 stop 0 0 | 0 nostop 0 0", "leaf", "leaf")
        self.verified(ERRANDS, "theorem 10", "split 0 nostop 2 1 | 0 stop 2 1", "leaf", "leaf")
        self.verified(ERRANDS, "lemma 12 0", "demand 0 stop 0 3", "demand 0 stop 1 1", "leaf", "theorem 1", "leaf")
        self.refused(4, "costs 12", ERRANDS, "lemma 13 0", "demand 0 stop 0 3", "demand 0 stop 1 1", "leaf")
        self.verified(ERRANDS, "lemma inf 0", "demand 0 stop 0 3", "demand 0 stop 1 3", "leaf", "theorem 1", "leaf")
        self.refused_splits(ERRANDS, "0 stop 0 0 | 0 nostop 1 0", "0 stop 0 0 | 0 nostop 0 1",
                            "0 stop 0 0 | 0 stop 0 0",
                            "0 nostop 0 0 | 0 nostop 0 0")
        for wrong in ("0 stop 3 0 | 0 nostop 3 0", "0 stop 0 2 | 0 nostop 0 2", "0 stop 0 4 | 0 nostop 0 4",
                      "1 stop 0 0 | 1 nostop 0 0"):
            self.refused(2, "no such stop", ERRANDS, "theorem 1", f"split {wrong}", "leaf", "leaf")

    def test_leaf_needs_earlier_lemmas_of_its_agents(self):
        lemma = ["lemma 5 0 1", *CROSSED]
        self.verified(CROSS, *lemma, "theorem 5", "leaf 0")
        self.verified(CROSS, *lemma, "lemma 5 0 1", "leaf 0", "theorem 5", "leaf 1 0")
        self.refused(6, "expected 6", CROSS, *lemma, "theorem 6", "leaf 0")
        self.refused(6, "no lemma 1", CROSS, *lemma, "theorem 5", "leaf 1")
        self.refused(2, "no lemma 0", CROSS, "lemma 5 0 1", "leaf 0")
        self.refused(6, "lemma 0 is also about agent 1", CROSS, *lemma, "lemma 3 0", "leaf 0")
        self.refused(1, "must ascend", CROSS, "lemma 4 1 0", "leaf")
        self.refused(1, "must ascend", CROSS, "lemma 4 1 1", "leaf")
        self.refused(1, "no agent 2", CROSS, "lemma 4 1 2", "leaf")
        self.refused(2, "agent 1 is not among", CROSS, "lemma 2 0", "demand 1 bar 4 1 1", "leaf")
        self.refused(2, "agent 1 is not among", CROSS, "lemma 2 0", "split 0 bar 4 1 1 | 1 bar 4 1 1", "leaf", "leaf")

    def test_constraints_of_lemmas_match_literally(self):
        lemma = ["lemma 5 0 1", "demand 0 bar 4 1 1", "leaf"]
        self.verified(CROSS, *lemma, "theorem 5", "split 0 bar 4 1 1 | 1 bar 4 1 1", "leaf 0", "leaf")
        self.refused(6, "not in force", CROSS, *lemma, "theorem 5", "split 1 bar 4 1 1 | 0 bar 4 1 1", "leaf 0")
        self.refused(7, "not in force", CROSS, *lemma, "theorem 5", "split 0 bar 4 1 1 | 1 bar 4 1 1", "leaf 0",
                     "leaf 0")
        for other in ("0 bar 4 0 1", "0 bar 4 1 2", "0 bar 4 1 inf", "1 bar 4 1 1", "0 bar 1 1 1"):
            self.refused(6, "not in force", CROSS, "lemma 4 0 1", f"demand {other}", "leaf", "theorem 4",
                         "split 0 bar 4 1 1 | 1 bar 4 1 1", "leaf 0")
        # The constraints of a lemma apply only within its proof.
        self.refused(5, "costs 4", CROSS, "lemma 5 0 1", "demand 0 bar 4 1 1", "leaf", "theorem 5", "leaf")

    def test_lemmas_are_combined_by_an_integer_cover(self):
        lemmas = [line for pair in ("0 1", "0 2", "1 2") for line in (f"lemma 9 {pair}", "joint")]
        self.verified(STAR, *lemmas, "theorem 14", "leaf 0 1 2")  # a fractional cover would prove only 13.5
        self.refused(8, "costs 12 and 2 by lemmas; expected 15", STAR, *lemmas, "theorem 15", "leaf 0 1 2")
        self.refused(8, "costs 12 and 1 by lemmas", STAR, *lemmas, "theorem 14", "leaf 0 1")
        self.refused(8, "costs 12 and 1 by lemmas", STAR, *lemmas, "theorem 14", "leaf 0 0 0 1")
        self.verified(STAR, "lemma 10 0 2", "joint", "theorem 14", "leaf 0")
        self.refused(4, "costs 12 and 2 by", STAR, "lemma 10 0 2", "joint", "theorem 15", "leaf 0")

    def test_later_needs_a_lemma_of_both_agents(self):
        lemma = ["lemma 5 0 1", *CROSSED]
        self.verified(CROSS, *lemma, "theorem 5", "later 0 2 1 2 0", "leaf", "leaf")
        self.verified(CROSS, *lemma, "theorem 5", "later 1 2 0 2 0", "leaf", "leaf")
        self.refused(7, "costs 5", CROSS, *lemma, "theorem 6", "later 0 2 1 2 0", "leaf", "leaf")
        for wrong in ("0 3 1 2", "0 2 1 3", "0 2 0 2"):
            self.refused(6, "not about these two agents, or its bound", CROSS, *lemma, "theorem 5", f"later {wrong} 0",
                         "leaf", "leaf")
        self.refused(6, "no lemma", CROSS, *lemma, "theorem 5", "later 0 2 1 2 1", "leaf", "leaf")
        self.refused(4, "not about these two agents", STAR, "lemma 9 0 1", "joint", "theorem 13", "later 0 4 2 4 0",
                     "leaf", "leaf")
        self.refused(5, "not in force", CROSS, "lemma 5 0 1", "demand 0 bar 4 1 1", "leaf", "theorem 5",
                     "later 0 2 1 2 0")
        self.refused(4, "lemma 0 is also about agent 2", STAR, "lemma 12 0 1 2", "leaf", "lemma 8 0 1",
                     "later 0 3 1 3 0")

    def test_later_needs_plain_goals(self):
        ends = {"without a goal": ([Agent((3,)), Agent((1,), 7)], [(5, 0, [0])]),
                "who works there": ([Agent((3,), 5), Agent((1,), 7)], [(5, 1, [0])]),
                "with a heading": ([Agent((3, "E"), 5, 1, "E"), Agent((1,), 7)], [])}
        for name, (agents, tasks) in ends.items():
            with self.subTest(name):
                instance = Instance(CROSS.world, agents, tasks)
                self.refused(4, "agent 0 has no plain goal", instance, "lemma 1 0 1", "leaf", "theorem 1",
                             "later 0 0 1 0 0", "leaf", "leaf")
                self.refused(4, "agent 0 has no plain goal", instance, "lemma 1 0 1", "leaf", "theorem 1",
                             "later 1 0 0 0 0", "leaf", "leaf")
        turner = Instance(CROSS.world, [Agent((3, "E"), 5, 1), Agent((1,), 7)])
        self.verified(turner, "lemma 5 0 1", "joint", "theorem 5", "later 0 2 1 2 0", "leaf", "leaf")

    def test_joint_search_proves_the_optimum(self):
        self.verified(CROSS, "theorem 5", "joint")
        self.refused(2, "finds a plan that costs less", CROSS, "theorem 6", "joint")
        self.verified(STUCK, "theorem inf", "joint")
        self.refused(2, "finds a plan", CROSS, "theorem inf", "joint")
        self.verified(CROSS, "lemma 6 0 1", "demand 0 bar 4 1 2", "joint", "theorem 4", "leaf")
        self.refused(3, "finds a plan", CROSS, "lemma 7 0 1", "demand 0 bar 4 1 2", "joint")

    def test_prices_prove_the_sum_of_priced_costs(self):
        place = ["prices", "place 4 1 1024", "end"]
        self.verified(CROSS, "theorem 5", *place)
        self.refused(4, "prices prove 5; expected 6", CROSS, "theorem 6", *place)
        self.refused(4, "prices prove 3", CROSS, "theorem 5", "prices", "place 4 2 1024", "end")
        self.verified(CROSS, "theorem 5", "prices", "place 4 1 1", "end")  # rounded up
        self.refused(3, "prices prove 4", CROSS, "theorem 5", "prices", "end")
        self.refused(4, "prices prove 4", CROSS, "theorem 5", "prices", "place 5 2 600", "end")  # paid once, on arrival
        self.verified(CROSS, "theorem 5", "prices", "finish 0 2 1 2 1024", "end")
        self.refused(3, "both agents may have finished", CROSS, "theorem 5", "prices", "finish 0 3 1 2 1024", "end")
        self.refused(3, "", CROSS, "theorem 5", "prices", "finish 1 2 0 2 1024", "end")
        self.verified(SWAP, "theorem 3", "prices", "edge 0 1 1 1024", "end")
        self.refused(4, "prices prove 3", SWAP, "theorem 4", "prices", "edge 0 1 1 1024", "end")
        self.refused(3, "must ascend", SWAP, "theorem 3", "prices", "edge 1 0 1 1024", "end")
        self.refused(2, "prices require all agents", CROSS, "lemma 2 0", *place)
        self.refused(3, "without constraints", CROSS, "lemma 4 0 1", "demand 0 bar 4 1 1", *place)
        self.refused(3, "without constraints", CROSS, "theorem 5", CROSSED[0], *place, "leaf")

    def test_agent_that_stays_on_the_lower_place_uses_the_edge(self):
        # Agent 0 goes to cell 1 and back. Agent 1 is far away and takes seven steps.
        instance = Instance(grid("............"), [Agent((0,), 0), Agent((4,), 11)], [(1, 0, [0])])
        self.verified(instance, "theorem 9", "prices", "end")
        # If agent 0 came back at time 2, it would pay for the edge at time 3. It therefore comes back at time 4.
        self.verified(instance, "theorem 9", "prices", "edge 0 1 3 2048", "end")
        self.refused(4, "prices prove 8", instance, "theorem 9", "prices", "edge 0 1 3 3072", "end")

    def refused_formula(self, reason, instance, bound, *lines, at):
        """Asserts that a formula is refused at its line `at`, which is line 1 for the first of `lines`."""
        self.refused(2 + at, reason, instance, f"theorem {bound}", "formula", *lines, "end")

    def test_formula_proves_the_sum_of_cores(self):
        # Variables 1 to 3: an agent takes its straight path. Each two of these paths meet on cell 12 at time 2.
        self.verified(STAR, "theorem 14", "formula", *STRAIGHT, *CORES, "end")
        self.verified(STAR, "theorem 13", "formula", *STRAIGHT, CORES[0], "end")
        self.verified(STAR, "theorem 12", "formula", "end")
        end = len(STRAIGHT) + len(CORES) + 1
        self.refused_formula("the formula proves 14; expected 15", STAR, 15, *STRAIGHT, *CORES, at=end)
        self.refused_formula("the formula proves 14; expected inf", STAR, "inf", *STRAIGHT, *CORES, at=end)
        self.refused_formula("the formula proves 12; expected 13", STAR, 13, at=1)
        self.refused(2, "a formula requires all agents", STAR, "lemma 9 0 1", "formula", "end")
        self.refused(3, "a formula requires all agents, without", STAR, "theorem 13",
                     "split 0 bar 12 2 2 | 1 bar 12 2 2", "formula", "end", "leaf")

    def test_formula_needs_the_variables_of_all_choices(self):
        first = len(STRAIGHT) + 1
        for line in ("visit 0 12 2", "visit 1 12 2", "visit 1 7 1", "visit 1 2 0", "agent 1 0"):
            rest = ["active 1" if known == line else known for known in STRAIGHT]
            if line == "agent 1 0":
                rest.remove("active 1")
            self.refused_formula("the core does not follow", STAR, 14, *rest, CORES[0],
                                 at=first - (line == "agent 1 0"))

    def test_formula_needs_paths_of_least_cost(self):
        # Another time, place or agent of a node breaks the path, and a greater excess permits detours.
        first = len(STRAIGHT) + 1
        for old, new in (("visit 1 12 2", "visit 1 12 3"), ("visit 1 12 2", "visit 1 11 2"),
                         ("visit 1 12 2", "visit 2 12 3"), ("visit 1 12 2", "last 1 12 2"),
                         ("within 1 0", "within 1 1"), ("within 1 0", "within 1 7")):
            wrong = [new if line == old else line for line in STRAIGHT]
            self.refused_formula("the core does not follow", STAR, 14, *wrong, CORES[0], at=first)
        self.verified(STAR, "theorem 14", "formula",
                      *[line.replace("agent 1 0", "agent 1 2") for line in STRAIGHT], *CORES, "end")

    def test_nodes_take_the_place_of_presences_without_variables(self):
        nodes = dict(zip((line for line in STRAIGHT if line.startswith(("visit 1", "last 1"))), NODES))
        lines = [nodes.get(line, line) for line in STRAIGHT]
        self.verified(ERRAND, "theorem 14", "formula", *lines, *CORES, "end")
        # With a variable, the presence follows from the node.
        own = ["visit 1 12 2", "last 1 22 4"]
        self.verified(ERRAND, "theorem 14", "formula", *lines, *own, "clause -11 20", "clause -13 21", *CORES, "end")
        self.refused_formula("the clause does not follow", ERRAND, 14, *lines, *own, "clause -10 20",
                             at=len(lines) + 3)
        # Nodes of other times and stops are no part of the straight path.
        for wrong in ("node 1 3 12 0 1", "node 1 2 12 0 0", "node 1 2 12 0 1 since 2", "node 1 2 12 0 1 since 1"):
            self.refused_formula("the core does not follow", ERRAND, 14,
                                 *(wrong if line == NODES[2] else line for line in lines), CORES[0], at=len(lines) + 1)

    def test_choices_prove_the_sum_of_prices(self):
        self.verified(SHARED, "theorem 4", "choices", "task 0 2", "formula", "end")
        self.verified(SHARED, "theorem 3", "choices", "task 0 1", "formula", "end")
        # If both agents prefer to visit the task, one visit is paid too often.
        self.verified(SHARED, "theorem 3", "choices", "task 0 3", "formula", "end")
        self.refused(5, "the formula proves 4; expected 5", SHARED, "theorem 5", "choices", "task 0 2", "formula", "end")
        self.refused(5, "the formula proves 3; expected 4", SHARED, "theorem 4", "choices", "task 0 3", "formula", "end")
        self.refused(4, "the formula proves 2; expected 4", SHARED, "theorem 4", "choices", "formula", "end")
        self.verified(QUEUE, "theorem 5", "choices", "goal 2 2", "formula", "end")
        self.refused(5, "the formula proves 5; expected 6", QUEUE, "theorem 6", "choices", "goal 2 2", "formula", "end")
        # Without an agent that ends on cell 2, its price is not paid.
        self.refused(5, "the formula proves 3; expected 4", QUEUE, "theorem 4", "choices", "goal 2 4", "formula", "end")

    def test_tasks_with_durations_and_obligations_have_prices(self):
        work = Instance(SHARED.world, SHARED.agents, [(2, 5, [0, 1]), (1, 0, [0])], {0: 1})
        self.verified(work, "theorem 9", "choices", "task 0 7", "formula", "end")
        self.refused(5, "the formula proves 9", work, "theorem 10", "choices", "task 0 7", "formula", "end")
        # An agent without a goal that must visit nothing ends where it likes, here on the task.
        spare = Instance(SHARED.world, [Agent((1,), 0), Agent((4,))], [(2, 0, [0, 1])], {0: 1})
        self.verified(spare, "theorem 3", "choices", "task 0 2", "formula", "end")
        self.refused(5, "the formula proves 3", spare, "theorem 4", "choices", "task 0 2", "formula", "end")
        # Cell 4 is the goal of agent 0, so agent 1 must go to cell 0.
        taken = Instance(grid(".....", "....."), [Agent((3,), 4), Agent((5,), goals=[4, 0])])
        self.verified(taken, "theorem 2", "choices", "formula", "end")
        self.refused(3, "no agent chooses this goal", taken, "theorem 2", "choices", "goal 4 1", "formula", "end")

    def test_limits_of_visits_are_those_of_the_task(self):
        def refused(*lines, price=1, reason="more inputs of the sum may be true"):
            head = ["theorem 5", "choices", *(["task 0 1"] if price else []), "formula"]
            self.refused(len(head) + len(lines), reason, three, *head, *lines, "end")

        three = Instance(grid("......"), [Agent((1,), 0), Agent((3,), 4), Agent((5,), 5)],
                         [(2, 0, [0, 1, 2]), (3, 0, [0, 1])], {0: 1, 1: 1})
        counts, skips = [f"counts {agent} 0" for agent in range(3)], [f"skips {agent} 0" for agent in range(3)]
        for limit in (0, 1):
            refused(*counts, "sum -1 -2 -3", f"atmost 0 {limit}")
        refused(*skips, "sum -1 -2 -3", "atmost 0 0")
        refused(*skips, "sum -1 -2 -3", "atmost 0 2", price=0)  # without a price, surplus visits count
        refused(*counts, "sum -1 -2 -2", "atmost 0 2")
        refused(*counts, "sum -1 -2 3", "atmost 0 2")
        refused(*counts, "counts 0 1", "sum -4 -2", "atmost 0 2")
        refused(*counts, *skips, "sum -1 -5", "atmost 0 2")
        refused("within 0 0", "sum -1", "atmost 0 2")
        refused("counts 2 1", reason="no choice whether to visit")
        refused("skips 2 1", reason="no choice whether to visit")
        refused(*counts, "counts 0 0", reason="this variable exists")
        for lines in ([*counts, "sum -1 -2 -3", "atmost 0 2", "clause 1 2 3"],
                      [*skips, "sum -1 -2 -3", "atmost 0 1", "count 0 0 3 2", "clause -4"]):
            self.verified(three, "theorem 0", "choices", "task 0 1", "formula", *lines, "end")

    def test_used_goals_have_agents_that_rest_there(self):
        meets = ["meets 0 rest 2 inf", "meets 1 rest 2 inf"]
        head = ["theorem 6", "choices", "goal 2 2", "formula"]
        last = "expected 6"  # all steps follow
        good = ["used 2 1", "used 2 0", *meets]
        self.refused(11, last, QUEUE, *head, *good, "clause -1 2", "clause -1 3 4", "end")
        self.refused(9, "does not follow", QUEUE, *head, *good, "clause -1 3", "end")
        self.refused(8, "does not follow", QUEUE, *head, *good[:3], "clause -1 3", "end")
        self.refused(9, "does not follow", QUEUE, *head, "used 2 1", "used 2 0", meets[0], "meets 1 rest 2 9",
                     "clause -1 3 4", "end")
        self.refused(5, "its price is less", QUEUE, *head, "used 2 3", "end")
        self.refused(5, "no agent chooses this goal", QUEUE, *head, "used 1 0", "end")
        self.refused(6, "this variable exists", QUEUE, *head, "used 2 1", "used 2 1", "end")
        self.refused(7, "does not deny a soft literal", QUEUE, *head, "used 2 0", "sum -1", "core 0", "end")
        self.refused(7, "the core does not follow", QUEUE, *head, "used 2 1", "sum -1", "core 0", "end")

    def test_prices_are_those_of_choices(self):
        for line in ("task 0 0", "task 0 1048577", "goal 0 1", "task 1 1"):
            self.refused(3, "", SHARED, "theorem 4", "choices", line, "formula", "end")
        self.refused(4, "has a price", SHARED, "theorem 4", "choices", "task 0 2", "task 0 2", "formula", "end")
        self.refused(4, "has a price", QUEUE, "theorem 5", "choices", "goal 2 2", "goal 2 2", "formula", "end")
        self.refused(2, "the instance has no choices", ERRAND, "theorem 4", "choices", "task 0 2", "formula", "end")
        self.refused(2, "the instance has no choices", CROSS, "theorem 4", "choices", "formula", "end")
        self.refused(2, "choices require all agents", SHARED, "lemma 1 0", "choices", "formula", "end")

    def test_no_other_rule_covers_choices(self):
        for rule in ("leaf", "joint", "prices", "formula", "split 0 bar 4 1 1 | 1 bar 4 1 1"):
            for instance in (SHARED, QUEUE):
                self.refused(2, "an instance with choices requires", instance, "theorem 2", rule, "end")
                self.refused(2, "an instance with choices requires", instance, "lemma 2 0", rule, "end")

    def test_agents_that_choices_do_not_cover(self):
        world, plain = SHARED.world, Agent((1,), 0)
        both, one = [(2, 0, [0, 1])], {0: 1}
        for reason, instance in (
                ("needs time to turn", Instance(world, [plain, Agent((3, "E"), 4, 1)], both, one)),
                ("needs time to turn", Instance(world, [Agent((3, "E"), None, 1, goals=[1])])),
                ("executes a task of its choice", Instance(
                    world, [plain, Agent((2,), 4, working=(0, 1))], [(2, 3, [0, 1])], one)),
                ("several tasks on one place", Instance(world, [plain, Agent((3,), 4)], [*both, (2, 0, [1])], one)),
                ("several tasks on one place", Instance(world, [plain, Agent((3,), 4)], both * 2, {0: 1, 1: 1})),
                ("no goal, but must visit tasks", Instance(world, [plain, Agent((3,))], [*both, (4, 0, [1])], one))):
            self.refused(2, f"agent . has a choice and {reason}", instance, "theorem 0", "choices", "formula", "end")

    def test_variables_are_defined_once(self):
        for line in ("within 0 0", "active 0", "visit 0 10 0", "last 0 14 4", "rests 0 14 inf", "rests 0 14 5",
                     "count 0 0 2 1", NODES[0], NODES[4]):
            self.refused_formula("this variable exists", ERRAND, 14, "within 0 9", "within 1 9", "sum -1 -2", line,
                                 line, at=5)
        for line in ("inside 0 9 10 2", "ends 0 9 10 2"):
            self.refused_formula("this variable exists", HALL, 14, line, line, at=2)

    def test_cores_consist_of_soft_literals(self):
        first = len(STRAIGHT) + 1
        soft = "does not deny a soft literal"
        self.refused_formula(soft, STAR, 14, *STRAIGHT, "core 1", at=first)
        self.refused_formula(soft, STAR, 14, *STRAIGHT, CORES[0], CORES[0], at=first + 1)
        for wrong in ("sum -1 -1", "sum 1 -2", "sum -1 -4", "sum -1 -2 -5"):
            self.refused_formula(soft, STAR, 14, *STRAIGHT, wrong, "core 2", at=first + 1)
        self.refused_formula("the core does not follow", STAR, 14, *STRAIGHT, "sum -1", "core 2", at=first + 1)
        self.refused_formula("no sum 2", STAR, 14, *STRAIGHT, "core 2", at=first)
        # A count of one input or more says no more than the core.
        one = [line.replace("count 0 0 2 2", "count 0 0 2 1") for line in STRAIGHT]
        self.refused_formula(soft, STAR, 14, *one, *CORES, at=first + 3)

    def test_clauses_follow_by_unit_propagation(self):
        first = len(STRAIGHT) + 1
        self.verified(STAR, "theorem 14", "formula", *STRAIGHT, "clause -1 -2", "clause -3 -1", "drop 0", *CORES, "end")
        for wrong in ("clause -1", "clause 1 2", "clause", "clause -1 2", "clause 4 5"):
            self.refused_formula("the clause does not follow", STAR, 14, *STRAIGHT, wrong, at=first)
        self.refused_formula("no clause 0", STAR, 14, *STRAIGHT, "drop 0", at=first)
        for wrong in ("clause 0", "clause 99", "clause -99"):
            self.refused_formula("there is no variable", STAR, 14, *STRAIGHT, wrong, at=first)

    def test_splits_of_formulas_are_permitted_pairs(self):
        bars = ["meets 0 bar 12 2 2", "meets 1 bar 12 2 2"]
        self.verified(STAR, "theorem 14", "formula", *STRAIGHT, *bars, "split 20 21", "clause 20 21", *CORES, "end")
        self.refused_formula("the clause does not follow", STAR, 14, *STRAIGHT, *bars, "clause 20 21",
                             at=len(STRAIGHT) + 3)
        for wrong, split in (("meets 1 bar 12 3 3", "20 21"), ("meets 1 bar 11 2 2", "20 21"),
                             ("meets 0 bar 12 2 2", "20 21"), ("meets 1 bar 12 2 3", "20 21"),
                             (bars[1], "20 20"), (bars[1], "20 -21"), (bars[1], "-20 21"), (bars[1], "20 1")):
            self.refused_formula("may satisfy neither", STAR, 13, *STRAIGHT, bars[0], wrong, f"split {split}",
                                 at=len(STRAIGHT) + 4)
        self.refused_formula("expected a constraint on places", ERRANDS, 11, "meets 0 stop 0 0", at=1)

    def test_constraints_in_formulas_exclude_what_violates_them(self):
        # Variable 2: agent 1 takes its straight path.
        first = len(STRAIGHT) + 1
        for good, wrong in (("bar 12 2 2", "bar 12 3 3"), ("bar 12 0 inf", "bar 12 0 1"),
                            ("move 7 12 2 2", "move 7 12 3 3"), ("move 12 17 3 3", "move 17 12 3 3"),
                            ("norest 22 4", "norest 22 3"), ("rest 22 3", "rest 22 4"), ("rest 21 9", "rest 22 9"),
                            ("bar 22 9 9", "bar 22 9 8")):
            self.verified(STAR, "theorem 14", "formula", *STRAIGHT, f"meets 1 {good}", "clause -2 -20", *CORES, "end")
            self.refused_formula("the clause does not follow", STAR, 14, *STRAIGHT, f"meets 1 {wrong}",
                                 "clause -2 -20", at=first + 1)

    def test_rest_bars_other_agents_in_formulas(self):
        rest, first = "meets 1 rest 22 4", len(STRAIGHT) + 1
        for bar in ("0 bar 22 4 inf", "2 bar 22 5 inf"):
            self.verified(STAR, "theorem 14", "formula", *STRAIGHT, rest, f"meets {bar}", "clause -20 21", *CORES, "end")
        for bar in ("0 bar 22 3 inf", "0 bar 22 4 9", "0 bar 21 4 inf", "1 bar 22 4 inf"):
            self.refused_formula("the clause does not follow", STAR, 14, *STRAIGHT, rest, f"meets {bar}",
                                 "clause -20 21", at=first + 2)

    def test_agents_that_rest_stay(self):
        first = len(STRAIGHT) + 1
        for good, wrong in ((("rests 1 22 4", "visit 0 22 4", "clause -2 -21"), ("rests 1 22 3", "visit 0 22 3")),
                            (("rests 1 22 inf", "rests 0 22 inf", "clause -2 -21"), ("rests 1 22 inf", "rests 0 21 inf")),
                            (("rests 1 22 6", "visit 2 22 6", "clause -2 -21"), ("rests 1 22 6", "visit 2 22 7"))):
            self.verified(STAR, "theorem 14", "formula", *STRAIGHT, *good, *CORES, "end")
            self.refused_formula("the clause does not follow", STAR, 14, *STRAIGHT, *wrong, "clause -2 -21",
                                 at=first + 2)

    def test_traversals_in_formulas_are_those_of_the_corridor(self):
        # Agent 0 goes through cells 8 and 9, from 7 at time 1 to 10 at time 4. Variable 1: it costs 5.
        begin = ["agent 0 0", "within 0 0", "visit 0 6 0", "visit 0 7 1", "visit 0 8 2", "visit 0 9 3", "visit 0 10 4",
                 "last 0 11 5"]
        way = ["inside 0 9 10 2", "inside 0 9 10 3", "ends 0 9 10 4"]
        first = len(begin) + len(way) + 1
        self.refused_formula("the clause does not follow", HALL, 14, *begin, *way, "meets 0 pass 9 10 4 4",
                             "clause -1 10", "clause -1 -11", "clause -1 -10", at=first + 3)
        for old, new in (("inside 0 9 10 2", "inside 0 9 10 1"), ("inside 0 9 10 3", "inside 0 8 7 3"),
                         ("visit 0 7 1", "visit 0 10 1"), ("ends 0 9 10 4", "ends 0 8 7 4")):
            wrong = [new if line == old else line for line in [*begin, *way]]
            self.refused_formula("the clause does not follow", HALL, 14, *wrong, "clause -1 10", at=first)

    def test_names_in_formulas_exist(self):
        for wrong, reason in (("within 3 0", "no agent 3"), ("visit 0 25 0", "no place 25"),
                              ("node 0 0 10 0 0", "needs no nodes"), ("inside 0 12 13 1", "last place of a chain"),
                              ("count 0 0 2 2", "no sum 0"), ("sum 1", "no variable 1"), ("split 1 1", "no variable 1"),
                              ("meets 3 bar 1 1 1", "agent 3 is not among")):
            self.refused_formula(reason, STAR, 13, wrong, at=1)
        self.refused_formula("this variable exists", STAR, 13, "within 0 0", "within 0 0", at=2)
        for wrong in ("count 0 0 1 1", "count 0 0 3 1", "count 0 0 2 3", "count 0 0 2 0", "count 0 1 0 1"):
            self.refused_formula("expected two inputs or more", STAR, 13, "within 0 0", "sum -1 -1", wrong, at=3)
        for wrong, reason in (("node 0 0 2 1 0", "no such pose"), ("node 0 0 2 0 8", "no such stop"),
                              ("node 0 0 2 0 0 work 0 1", "no such stop"), ("node 1 0 3 0 0", "needs no nodes")):
            self.refused_formula(reason, ERRANDS, 11, wrong, at=1)

    def test_traversals_enter_at_the_other_end(self):
        # Cell 4 is the only inner place of a corridor with the ends 1 and 7.
        gate = Instance(grid("...", "@.@", "..."), [Agent((1,), 7)])
        begin = ["visit 0 1 0", "visit 0 7 0", "visit 0 4 1", "inside 0 4 7 1", "clause -1 -3 4"]
        self.refused_formula("the clause does not follow", gate, 9, *begin, "clause -2 -3 4", at=6)
        self.refused_formula("the clause does not follow", gate, 9, *begin[1:4], "clause -1 -2 3", at=4)

    def test_certificate_of_another_instance_is_refused(self):
        text = certificate(CROSS, "theorem 4", "leaf")
        others = [STAR, Instance(CROSS.world, CROSS.agents, [(0, 0, [0])]),
                  Instance(CROSS.world, [Agent((3,), 5), Agent((1,), 8)]),
                  Instance(grid("..@", "...", "..."), CROSS.agents),
                  Instance(CROSS.world, [Agent((3, "E"), 5, 1), Agent((1,), 7)])]
        for other in others:
            found = checkers.verify(other, text)
            self.assertEqual((found.code, found.text), (1, "refused: line 2: it is of another instance\n"))


if __name__ == "__main__":
    checkers.main(unittest)
