# SPDX-License-Identifier: MIT
"""Quality over time: what the plans that runs had by a given time cost, and what they had proven.

The last plan of a run was re-checked. Those on the way are as the run tells; one that it says was cheaper than the
last is not believed. A run that tells nothing on the way has its plan when it ends. Runs that differ in the seed
alone share the weight of their instance.
"""
import itertools
from collections import Counter
from typing import NamedTuple, Optional

from .groups import grouped
from .metrics import by_line, cost_ratio, has_plan


class Step(NamedTuple):
    """From `seconds` on; None: not known."""
    seconds: float
    with_plan: float             # share of the instances with a plan
    common_with_plan: float      # share of the common instances with a plan of known cost
    cost_ratio: Optional[float]  # mean over these, of cost / best known cost
    cost_over_bound: Optional[float]  # likewise, of cost / best lower bound
    bound_ratio: Optional[float]  # mean over the common instances of bound / best known cost, once all have a bound


class Curve(NamedTuple):
    steps: list  # by time

    def at(self, seconds):
        """The step that holds then; None: before the first."""
        found = None
        for step in self.steps:
            if step.seconds > seconds:
                break
            found = step
        return found


class Panel(NamedTuple):
    """Of one map, or of one number of agents on the only map."""
    title: str
    instances: int
    common: int    # that every line has a plan for, with every seed
    curves: dict   # {line: Curve}


def plans_over_time(row):
    """[(seconds, cost)], costs falling, the last that of the checked plan."""
    if not has_plan(row):
        return []
    found = []
    for point in row.trace:
        if point.cost >= row.cost and (not found or point.cost < found[-1][1]):
            found.append((point.seconds, point.cost))
    if not found or found[-1][1] > row.cost:
        # What ends by itself may be a moment late; what was late has nothing at its limit.
        found.append((min(row.ended_s, row.time_limit_s) if row.solved else row.ended_s, row.cost))
    return found


def first_plan(row):
    """When it had one, of whatever cost. `row`: has a plan"""
    known = plans_over_time(row)[0][0]
    return known if row.first_plan_s is None else min(known, row.first_plan_s)


def bounds_over_time(row):
    """[(seconds, bound)], rising; of other solvers what they tell on the way, which is their claim."""
    points = [(point.seconds, point.lower_bound) for point in row.trace if point.lower_bound is not None]
    found = []
    for seconds, bound in [*points, *([] if row.lower_bound is None else [(row.ended_s, row.lower_bound)])]:
        if not found or bound > found[-1][1]:
            found.append((seconds, bound))
    return found


def is_anytime(rows):
    """Whether runs of a line improve their plans, as far as they tell."""
    return any(row.anytime or len(row.trace) > 1 for row in rows)


def common_with_plans(groups):
    """The instances of which every run of every line has a plan, of lines that have any. `groups`: {line: rows}"""
    found = [{row.instance for row in rows} - {row.instance for row in rows if not has_plan(row)}
             for rows in groups.values() if any(map(has_plan, rows))]
    return set.intersection(*found) if found else set()


def _in_turn(what, values):
    """(seconds, what, value before, value from then on)"""
    befores = [None, *(value for _, value in values)]
    return [(seconds, what, before, value) for (seconds, value), before in zip(values, befores)]


def _changes(row, best, bounds, common):
    """(seconds, what changes then, from, to) of a run."""
    if not has_plan(row):
        return
    yield first_plan(row), "plan", None, 1
    if row.instance not in common:
        return
    key = row.problem, row.instance
    costs, told = plans_over_time(row), bounds_over_time(row)
    yield from _in_turn("cost", [(seconds, cost_ratio(row._replace(cost=cost), best)) for seconds, cost in costs])
    if bounds.get(key):
        yield from _in_turn("over bound", [(seconds, cost / bounds[key]) for seconds, cost in costs])
    if best[key]:
        yield from _in_turn("bound", [(seconds, bound / best[key]) for seconds, bound in told])


def curve(rows, best, bounds, common):
    """`rows`: of a line; `best`, `bounds`: best_costs(), best_bounds()."""
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
    """Of the lines that are anytime; one for each map, or for each number of agents where there is one map."""
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
    """1, 2, 5, 10, ... from a thousandth of the limit on, and the limit."""
    return [*(time for exponent in range(-4, 7) for time in (float(f"{digit}e{exponent}") for digit in (1, 2, 5))
              if limit / 1000 <= time < limit), limit]
