# SPDX-License-Identifier: MIT
"""Sums search counters over the runs of each line."""
from collections import defaultdict
from typing import NamedTuple

from .metrics import by_line

SPLITS = "splits_"
KINDS = {"vertex_edge": "vertex or edge", "corridor": "corridor", "target": "target", "cost": "cost",
         "sequence": "sequence"}
LABELS = {
    "bypasses": "bypasses: another path of the same cost",
    "pair_expansions": "nodes in searches over pairs and groups of agents",
    "group_states": "joint states of pairs and groups",
    "joint_states": "joint states of all agents",
    "cores": "unsatisfiable cores",
    "cores_conflicts": "cores: conflicts of the SAT solver",
    "cores_path_conflicts": "cores: conflicts of paths that became clauses",
    "lagrangian_rounds": "rounds of the Lagrangian bound",
    "remote_pricings": "Lagrangian subproblems that other ranks solved",
    "joint_mdd_nodes": "nodes of joint MDDs",
    "low_level_expanded": "labels of single-agent searches",
    "branching_cost": "costs with one more constraint (strong branching)",
    "mdd": "MDDs",
    "nodes_generated": "nodes generated", "nodes_evicted": "nodes evicted because memory was full",
    "primal_attempts": "primal: priority orders tried",
    "primal_lacam_steps": "primal: LaCAM steps",
    "primal_lns_iterations": "primal: LNS iterations",
    "primal_steps": "primal: work items",
    "primal_low_level_calls": "primal: single-agent searches",
    "primal_low_level_expanded": "primal: labels of single-agent searches"}


class Counters(NamedTuple):
    """Sums of counters over the runs of a line that report counters."""
    runs: int
    totals: dict  # {name: sum over the runs}

    def mean(self, name):
        return self.totals.get(name, 0) / self.runs

    def splits(self):
        """Returns {kind: number of splits} for the kinds that occurred."""
        return {name.removeprefix(SPLITS): total for name, total in self.totals.items()
                if name.startswith(SPLITS) and total > 0}

    def hit_share(self, what):
        """Returns the share of cache hits among the queries for `what`. Returns None if there were no queries."""
        queries = self.totals.get(f"{what}_queries")
        return self.totals.get(f"{what}_hits", 0) / queries if queries else None


def counters_by_line(rows):
    """Returns {line: Counters} for the lines with at least one run that reports counters."""
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
    """Returns the kinds of splits that occur in any line: first those in KINDS, in that order, then the others by name.
    """
    found = {kind for each in counters.values() for kind in each.splits()}
    return [kind for kind in KINDS if kind in found] + sorted(found - KINDS.keys())


def cache_names(counters):
    """Returns the names of all caches for which any line has a query counter."""
    return sorted({name.removesuffix("_queries") for each in counters.values() for name in each.totals
                   if name.endswith("_queries")})


def label(name):
    """Returns the text that the page shows for a counter."""
    for start, meaning in (("plans_", "better plans of "), ("gain_", "cost saved by plans of ")):
        if name.startswith(start):
            return meaning + name.removeprefix(start)
    return LABELS.get(name, name.replace("_", " "))


def other_names(counters):
    """Returns the names of all other counters (neither splits nor caches), first those in LABELS."""
    found = {name for each in counters.values() for name in each.totals
             if not name.startswith(SPLITS) and not name.endswith(("_queries", "_hits"))}
    return [name for name in LABELS if name in found] + sorted(found - LABELS.keys())
