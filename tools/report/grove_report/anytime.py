# SPDX-License-Identifier: MIT
"""Computes quality over time: plan costs and lower bounds that runs have reached by a given time.

Only the last plan of a run was checked. Earlier plans are taken as the run reports them, except that reported plans
cheaper than the last one are ignored. A run that reports no earlier plan has its plan from its end on. Runs that differ
only in the seed share the weight of their instance.
"""
import itertools
from collections import Counter
from typing import NamedTuple, Optional

from .groups import grouped
from .metrics import by_line, cost_ratio, has_plan


class Step(NamedTuple):
    """Values from time `seconds` until the next step; None: unknown."""
    seconds: float
    with_plan: float             # share of the instances that have a plan by now
    common_with_plan: float      # share of the common instances that have a plan of known cost by now
    cost_ratio: Optional[float]  # mean of cost / best known cost over the common instances with such a plan
    cost_over_bound: Optional[float]  # mean of cost / best lower bound over the same instances, if they have a bound
    bound_ratio: Optional[float]  # mean of bound / best known cost over all common instances; None until all have one


class Curve(NamedTuple):
    steps: list  # Steps in ascending order of time

    def at(self, seconds):
        """Returns the Step that holds at this time. Returns None before the first step."""
        found = None
        for step in self.steps:
            if step.seconds > seconds:
                break
            found = step
        return found


class Panel(NamedTuple):
    """The Curves for one map, or for one number of agents if there is only one map."""
    title: str
    instances: int
    common: int    # number of instances that common_with_plans() returns
    curves: dict   # {line: Curve}


def plans_over_time(row):
    """Returns [(seconds, cost)] with decreasing costs; the last entry is the checked plan."""
    if not has_plan(row):
        return []
    found = []
    for point in row.trace:
        if point.cost >= row.cost and (not found or point.cost < found[-1][1]):
            found.append((point.seconds, point.cost))
    if not found or found[-1][1] > row.cost:
        # A solved run can end slightly after its limit; its plan then counts from the limit on. The plan of any other
        # run counts from the end of the run.
        found.append((min(row.ended_s, row.time_limit_s) if row.solved else row.ended_s, row.cost))
    return found


def first_plan(row):
    """Returns the time of the first plan, even if its cost is unknown. `row`: a row with a plan."""
    known = plans_over_time(row)[0][0]
    return known if row.first_plan_s is None else min(known, row.first_plan_s)


def bounds_over_time(row):
    """Returns [(seconds, bound)] with increasing bounds. Bounds of other solvers before the end are only claims."""
    points = [(point.seconds, point.lower_bound) for point in row.trace if point.lower_bound is not None]
    found = []
    for seconds, bound in [*points, *([] if row.lower_bound is None else [(row.ended_s, row.lower_bound)])]:
        if not found or bound > found[-1][1]:
            found.append((seconds, bound))
    return found


def is_anytime(rows):
    """Returns whether any run of a line is anytime or reports an improvement of its plan. `rows`: rows of the line."""
    return any(row.anytime or len(row.trace) > 1 for row in rows)


def common_with_plans(groups):
    """Returns the instances for which every run of every line has a plan. Lines without any plan do not count.

    groups: {line: rows}.
    """
    found = [{row.instance for row in rows} - {row.instance for row in rows if not has_plan(row)}
             for rows in groups.values() if any(map(has_plan, rows))]
    return set.intersection(*found) if found else set()


def _in_turn(what, values):
    """Returns [(seconds, what, previous value, new value)] for [(seconds, value)]; the first previous value is None."""
    befores = [None, *(value for _, value in values)]
    return [(seconds, what, before, value) for (seconds, value), before in zip(values, befores)]


def _changes(row, best, bounds, common):
    """Yields (seconds, what changes, previous value, new value) for each change in a run."""
    if not has_plan(row):
        return
    yield first_plan(row), "plan", None, 1
    if row.instance not in common:
        return
    key = row.problem, row.instance
    costs, proven = plans_over_time(row), bounds_over_time(row)
    yield from _in_turn("cost", [(seconds, cost_ratio(row._replace(cost=cost), best)) for seconds, cost in costs])
    if bounds.get(key):
        yield from _in_turn("over bound", [(seconds, cost / bounds[key]) for seconds, cost in costs])
    if best[key]:
        yield from _in_turn("bound", [(seconds, bound / best[key]) for seconds, bound in proven])


def curve(rows, best, bounds, common):
    """Returns the Curve for the rows of one line. `best`, `bounds`: results of best_costs() and best_bounds()."""
    seeds = Counter(row.instance for row in rows)
    changes = [(seconds, what, 1 / seeds[row.instance], before, after) for row in rows
               for seconds, what, before, after in _changes(row, best, bounds, common) if after is not None]
    changes.sort(key=lambda change: change[0])
    weights, sums = Counter(), Counter()
    steps = []
    for seconds, group in itertools.groupby(changes, key=lambda change: change[0]):
        for _, what, weight, before, after in group:
            weights[what] += weight if before is None else 0
            sums[what] += weight * (after - (before or 0))
        steps.append(_step(seconds, weights, sums, len(seeds), len(common)))
    return Curve(steps)


def _step(seconds, weights, sums, instances, common):
    def mean(what, needed):
        return sums[what] / weights[what] if weights[what] > needed - 1e-9 and weights[what] else None
    return Step(seconds, weights["plan"] / instances, weights["cost"] / common if common else 0.0, mean("cost", 0),
                mean("over bound", 0), mean("bound", common) if common else None)


def panels(rows, best, bounds):
    """Returns the Panels for the anytime lines, one per map, or one per number of agents if there is only one map."""
    lines = {line for line, group in by_line(rows).items() if is_anytime(group)}
    rows = [row for row in rows if (row.method, row.omega, row.time_limit_s) in lines]
    one_map = len({row.map for row in rows}) == 1
    groups = grouped(rows, lambda row: (row.map, row.agents if one_map else 0))
    found = []
    for (name, agents), group in sorted(groups.items()):
        of_lines = by_line(group)
        common = common_with_plans(of_lines)
        curves = {line: curve(runs, best, bounds, common) for line, runs in sorted(of_lines.items())}
        found.append(Panel(f"{name}, N = {agents}" if one_map else name, len({row.instance for row in group}),
                           len(common), {line: each for line, each in curves.items() if each.steps}))
    return [panel for panel in found if panel.curves]


def table_times(limit):
    """Returns the times 1, 2 and 5 times powers of ten from limit / 1000 up to the limit, and the limit itself."""
    return [*(time for exponent in range(-4, 7) for time in (float(f"{digit}e{exponent}") for digit in (1, 2, 5))
              if limit / 1000 <= time < limit), limit]
