# SPDX-License-Identifier: MIT
"""Claims that cannot all be true: each is a bug in some solver, or rows of different instances under
one name."""
from typing import NamedTuple

from .groups import grouped, values_by
from .lines import method_name


class Contradiction(NamedTuple):
    problem: str
    instance: str
    what: str


def _said(rows, value):
    """'1070 (a, b), 1071 (c)': the values, and who says so."""
    groups = values_by(rows, value, lambda row: method_name(row.method) + (f" ω={row.omega}" if row.omega else ""))
    return ", ".join(f"{found} ({', '.join(sorted(who))})" for found, who in sorted(groups.items()))


def _of_instance(rows):
    optimal = [row for row in rows if row.status == "optimal" and row.cost is not None]
    if len({row.cost for row in optimal}) > 1:
        yield "optimal costs differ: " + _said(optimal, lambda row: row.cost)
    plans = [row for row in rows if row.cost is not None]
    if not plans:
        return
    least = min(row.cost for row in plans)
    cheapest = _said([row for row in plans if row.cost == least], lambda row: row.cost)
    above = [row for row in rows if row.lower_bound is not None and row.lower_bound > least
             and row.status != "infeasible"]
    if above:
        yield (f"a plan costs {cheapest}, below a proven lower bound: "
               + _said(above, lambda row: row.lower_bound))
    dearer = [row for row in optimal if row.cost > least]
    if dearer and len({row.cost for row in optimal}) == 1:
        yield (f"a plan costs {cheapest}, less than the optimal cost: "
               + _said(dearer, lambda row: row.cost))
    roots = [row for row in rows if row.root_cost is not None and row.root_cost > least]
    if roots:
        yield (f"a plan costs {cheapest}, below the root cost: "
               + _said(roots, lambda row: row.root_cost))
    infeasible = [row for row in rows if row.status == "infeasible"]
    if infeasible:
        yield f"a plan costs {cheapest}; but: " + _said(infeasible, lambda row: row.status)


def contradictions(rows):
    """Of all rows but those with status error: what these say is known to be worth nothing."""
    groups = grouped((row for row in rows if row.status != "error"), lambda row: (row.problem, row.instance))
    return [Contradiction(*key, what) for key, group in sorted(groups.items())
            for what in _of_instance(group)]


def optimal_agreements(rows):
    """How many instances have an optimal cost from at least two methods."""
    optimal = (row for row in rows if row.status == "optimal" and row.cost is not None)
    methods = values_by(optimal, lambda row: (row.problem, row.instance), lambda row: row.method)
    return sum(len(found) > 1 for found in methods.values())
