# SPDX-License-Identifier: MIT
"""Finds claims that contradict each other, and claims of other solvers that a checked plan or bound refutes.

The cause of a contradiction is an error in a solver, or rows of different instances with the same name.
"""
import itertools
from typing import NamedTuple, Optional

from .groups import grouped, values_by
from .lines import method_name
from .metrics import best_bounds, best_costs, has_plan
from .rows import CLAIMED, INVALID


class Contradiction(NamedTuple):
    problem: str
    instance: str
    what: str


def _said(rows, value):
    """Returns the values and the methods that claim them as text, such as '1070 (a, b), 1071 (c)'."""
    groups = values_by(rows, value, lambda row: method_name(row.method) + (f" ω={row.omega}" if row.omega else ""))
    return ", ".join(f"{found} ({', '.join(sorted(who))})" for found, who in sorted(groups.items()))


def _of_instance(everything):
    rows = [row for row in everything if row.bound_holds_for_all_plans]
    optimal = [row for row in rows if row.status == "optimal" and row.cost is not None]
    if len({row.cost for row in optimal}) > 1:
        yield "optimal costs differ: " + _said(optimal, lambda row: row.cost)
    plans = [row for row in everything if has_plan(row)]
    if not plans:
        return
    least = min(row.cost for row in plans)
    cheapest = _said([row for row in plans if row.cost == least], lambda row: row.cost)
    above = [row for row in rows if row.lower_bound is not None and row.lower_bound > least
             and row.status != "infeasible"]
    if above:
        yield (f"a plan costs {cheapest}, below a proven lower bound: "
               + _said(above, lambda row: row.lower_bound))
    costlier = [row for row in optimal if row.cost > least]
    if costlier and len({row.cost for row in optimal}) == 1:
        yield (f"a plan costs {cheapest}, less than the optimal cost: "
               + _said(costlier, lambda row: row.cost))
    roots = [row for row in rows if row.root_cost is not None and row.root_cost > least]
    if roots:
        yield (f"a plan costs {cheapest}, below the root cost: "
               + _said(roots, lambda row: row.root_cost))
    infeasible = [row for row in rows if row.status == "infeasible"]
    if infeasible:
        yield f"a plan costs {cheapest}; but: " + _said(infeasible, lambda row: row.status)


class FalseClaim(NamedTuple):
    problem: str
    instance: str
    method: str
    omega: str
    seed: Optional[int]
    kind: str             # "plan", "cost", "lower bound"
    claimed: Optional[int]
    checked: Optional[int]  # the checked value that refutes the claim
    what: str


class _Checked(NamedTuple):
    """Best checked plan and best proven bound of an instance. None: there is none."""
    plan: Optional[int]   # cost of the cheapest plan
    bound: Optional[int]  # highest proven lower bound
    planner: str          # methods that found the plan
    prover: str           # methods that proved the bound


def _checked(rows, plan, bound):
    def who(found):
        return ", ".join(sorted({method_name(row.method) for row in found})) or "MAPF Tracker"
    return _Checked(plan, bound, who(row for row in rows if has_plan(row) and row.cost == plan),
                    who(row for row in rows if row.lower_bound == bound and row.bound_holds_for_all_plans))


def _false_claims_of(row, checked):
    """Yields (kind, claimed, checked, what) for each claim of a row that the checked plan or bound refutes."""
    plan, bound = checked.plan, checked.bound
    if row.status == INVALID:
        yield "plan", row.claimed_cost, None, row.error or "the plan is invalid"
    if row.claimed_cost is not None and has_plan(row) and row.claimed_cost < row.cost:
        yield ("cost", row.claimed_cost, row.cost,
               f"says that its plan costs {row.claimed_cost}; recounted: {row.cost}")
    if row.status == CLAIMED and None not in (row.claimed_cost, bound) and row.claimed_cost < bound:
        yield ("cost", row.claimed_cost, bound,
               f"says that it has a plan of cost {row.claimed_cost}, and shows none; "
               f"proven lower bound: {bound} ({checked.prover})")
    cheaper = [point for point in row.trace if row.solver and has_plan(row) and point.cost < row.cost]
    if cheaper:
        yield ("cost", cheaper[0].cost, row.cost, f"says that after {cheaper[0].seconds:g} s it had a plan of cost "
               f"{cheaper[0].cost}; the plan it shows in the end costs {row.cost}")
    if None not in (row.claimed_lower_bound, plan) and row.claimed_lower_bound > plan:
        yield ("lower bound", row.claimed_lower_bound, plan,
               f"says that no plan costs less than {row.claimed_lower_bound}; a checked plan costs {plan} "
               f"({checked.planner})")


def false_claims(rows, known_costs=()):
    """Returns the FalseClaims among all rows. `known_costs`: costs of further known plans, see best_costs()."""
    rows = [row for row in rows if row.status != "error"]
    plans, bounds = best_costs(rows, known_costs), best_bounds(rows)
    return [FalseClaim(*key, row.method, row.omega, row.seed, *claim)
            for key, group in grouped(rows, lambda row: (row.problem, row.instance)).items()
            for checked in [_checked(group, plans.get(key), bounds.get(key))]
            for row in group for claim in _false_claims_of(row, checked)]


def _against(rows, known):
    """Yields the contradictions between the rows of an instance and its entry in MAPF Tracker."""
    plans = [row for row in rows if has_plan(row)]
    if plans and known.bound is not None and min(row.cost for row in plans) < known.bound:
        cheaper = [row for row in plans if row.cost < known.bound]
        yield f"MAPF Tracker has a lower bound of {known.bound}; a plan costs " + _said(cheaper, lambda row: row.cost)
    above = [row for row in rows if row.lower_bound is not None and known.cost is not None
             and row.lower_bound > known.cost and row.status != "infeasible" and row.bound_holds_for_all_plans]
    if above:
        yield (f"MAPF Tracker has a plan of cost {known.cost}, below a proven lower bound: "
               + _said(above, lambda row: row.lower_bound))


def contradictions(rows, known=None):
    """Returns the Contradictions among all rows.

    Ignores the claims of rows with status "error", and bounds that hold only for plans without following conflicts
    (--no-following). known: {(problem, instance): tracker.Known}.
    """
    groups = grouped((row for row in rows if row.status != "error"), lambda row: (row.problem, row.instance))
    return [Contradiction(*key, what) for key, group in sorted(groups.items())
            for what in itertools.chain(_of_instance(group),
                                        _against(group, known[key]) if key in (known or {}) else ())]


def optimal_agreements(rows):
    """Returns the number of instances for which at least two methods prove an optimal cost."""
    optimal = (row for row in rows if row.status == "optimal" and row.cost is not None)
    methods = values_by(optimal, lambda row: (row.problem, row.instance), lambda row: row.method)
    return sum(len(found) > 1 for found in methods.values())
