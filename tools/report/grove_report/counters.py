# SPDX-License-Identifier: MIT
"""What the search did: the counters of the runs of each line."""
from collections import defaultdict
from typing import NamedTuple

from .metrics import by_line

SPLITS = "splits_"
KINDS = {"bar": "place or move", "no_traversal": "corridor", "rest_by": "coming to rest", "no_rest_by": "cost",
         "stop_is_not": "next stop"}
LABELS = {
    "bypasses": "bypasses: another way as short",
    "pair_expansions": "nodes in searches over pairs and groups of agents",
    "group_states": "states of pairs and groups together",
    "joint_states": "states of all agents together",
    "lagrangian_rounds": "rounds of prices",
    "prices_of_ranks": "prices that other ranks have found",
    "joint_pairs": "pairs of places in two sets of optimal paths",
    "low_level_expanded": "labels of single-agent searches",
    "prices": "costs under one constraint more",
    "path_sets": "sets of all optimal paths",
    "nodes_generated": "nodes generated", "nodes_evicted": "nodes given up for want of memory",
    "primal_attempts": "plans: orders of priority tried",
    "primal_joint_steps": "plans: joint steps of configurations",
    "primal_neighborhoods": "plans: neighbourhoods planned anew",
    "primal_steps": "plans: turns of the search for them",
    "primal_low_level_calls": "plans: single-agent searches",
    "primal_low_level_expanded": "plans: labels of single-agent searches"}


class Counters(NamedTuple):
    """Of the runs of a line that tell."""
    runs: int
    totals: dict  # {name: sum over the runs}

    def mean(self, name):
        return self.totals.get(name, 0) / self.runs

    def splits(self):
        """{kind: number}, of those there are"""
        return {name.removeprefix(SPLITS): total for name, total in self.totals.items()
                if name.startswith(SPLITS) and total > 0}

    def remembered(self, what):
        """The share of `what` asked for that was known; None: nothing was."""
        asked = self.totals.get(f"{what}_asked")
        return self.totals.get(f"{what}_known", 0) / asked if asked else None


def counters_by_line(rows):
    """{line: Counters}; a line of which no run tells is not there."""
    found = {}
    for line, group in by_line(row for row in rows if row.counts).items():
        totals = defaultdict(int)
        for row in group:
            for name, number in row.counts.items():
                totals[name] += number
        found[line] = Counters(len(group), dict(totals))
    return found


def kind_label(kind):
    return KINDS.get(kind, kind.replace("_", " "))


def split_kinds(counters):
    """Of all lines: those that have a name first, in its order."""
    found = {kind for each in counters.values() for kind in each.splits()}
    return [kind for kind in KINDS if kind in found] + sorted(found - KINDS.keys())


def remembered_things(counters):
    """What is asked for and remembered, of all lines."""
    return sorted({name.removesuffix("_asked") for each in counters.values() for name in each.totals
                   if name.endswith("_asked")})


def label(name):
    for start, meaning in (("plans_", "better plans by "), ("gain_", "cost saved by plans by ")):
        if name.startswith(start):
            return meaning + name.removeprefix(start)
    return LABELS.get(name, name.replace("_", " "))


def other_names(counters):
    """Of all lines, the names that are no splits and nothing remembered: those that have a label first."""
    found = {name for each in counters.values() for name in each.totals
             if not name.startswith(SPLITS) and not name.endswith(("_asked", "_known"))}
    return [name for name in LABELS if name in found] + sorted(found - LABELS.keys())
