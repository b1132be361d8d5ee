# SPDX-License-Identifier: MIT
"""Computes measures for the rows of one line: success, runtime, SQR, PAR-2, ...

Rows that differ only in the seed are repetitions of an instance. A mean is first taken over the repetitions of each
instance and then over the instances.
"""
import functools
import statistics
from collections import Counter, defaultdict
from fractions import Fraction
from typing import NamedTuple, Optional

from .groups import grouped
from .lines import line_of
from .rows import CLAIMED, INVALID


NO_PROMISE = ("", "inf")  # values of omega that guarantee nothing


@functools.cache
def _factor(omega):
    return 1 + Fraction(omega)


def within_omega(row):
    """Returns whether a row with a plan proves that its cost is at most (1 + omega) times the lower bound.

    Returns None if its omega guarantees nothing. Compares cost and bound if the row has both. Otherwise the status
    decides; it is the second choice, because the status of a method can refer to a different bound.
    """
    if row.omega in NO_PROMISE:
        return None
    if row.status == "optimal":
        return True
    if row.lower_bound is None:
        return row.status == "bounded"
    return row.cost <= _factor(row.omega) * row.lower_bound


def has_plan(row):
    """Returns whether the row has a checked plan, even if the run ended at a limit."""
    return row.cost is not None and row.status not in ("error", INVALID, CLAIMED)


def best_costs(rows, known=()):
    """Returns {(problem, instance): least cost of any checked plan}.

    Includes runs that ended at a limit, but not runs with an error, because their plans may be invalid. known:
    {(problem, instance): cost} from other sources.
    """
    best = dict(known)
    for row in filter(has_plan, rows):
        key = row.problem, row.instance
        best[key] = min(best.get(key, row.cost), row.cost)
    return best


def best_bounds(rows, known=()):
    """Returns {(problem, instance): highest proven lower bound}, without bounds that other solvers merely claim."""
    best = dict(known)
    for row in rows:
        if row.lower_bound is not None and row.status not in ("error", "infeasible") and row.bound_holds_for_all_plans:
            key = row.problem, row.instance
            best[key] = max(best.get(key, 0), row.lower_bound)
    return best


def cost_ratio(row, best):
    """Returns cost / best known cost, which is >= 1. Returns None if the best known cost is 0 and the cost is not."""
    least = best[row.problem, row.instance]
    if row.cost == least:
        return 1.0
    return row.cost / least if least else None


class Measures(NamedTuple):
    """Measures of the rows of one line. A value is None if no row provides it."""
    instances: int
    seeds: int                     # maximum number of runs of an instance
    runs: int
    solved: int
    invalid: int                   # number of runs with an invalid plan
    claimed: int                   # number of runs that report a plan but wrote none
    within_omega: Optional[int]    # number of solved runs within omega; None: omega guarantees nothing
    success: float                 # mean over instances of the share of solved runs
    mean_runtime_s: float          # a failure counts as the time limit
    median_runtime_s: float        # a failure counts as the time limit
    par2_s: float                  # mean; a failure counts as twice the time limit
    mean_sqr: Optional[float]      # mean SQR over solved rows
    mean_cost_ratio: Optional[float]  # mean of cost / best known cost over solved rows
    common: int                    # number of common_instances()
    common_sqr: Optional[float]    # mean SQR over the common instances
    common_cost_ratio: Optional[float]  # mean of cost / best known cost over the common instances
    common_mean_cost: Optional[float]
    common_median_cost: Optional[float]
    common_mean_s: Optional[float]
    common_median_s: Optional[float]
    mean_roots: Optional[float]    # mean over all rows with a value
    mean_rtsp_calls: Optional[float]


def over_seeds(rows, value):
    """Returns, for each instance, the mean of value(row) over its rows. Omits instances without a value."""
    values = defaultdict(list)
    for row in rows:
        found = value(row)
        if found is not None:
            values[row.instance].append(found)
    # Avoids fmean for a single value, the usual case, because it takes ten times as long.
    return [found[0] if len(found) == 1 else statistics.fmean(found) for found in values.values()]


def _mean(values):
    return statistics.fmean(values) if values else None


def _median(values):
    return statistics.median(values) if values else None


def always_solved(rows):
    """Returns the instances for which every run is solved."""
    return {row.instance for row in rows} - {row.instance for row in rows if not row.solved}


def common_instances(groups):
    """Returns the instances that all lines solve with every seed, without lines that solve no instance.

    Returns the empty set if fewer than two lines solve any instance. groups: {line: rows}.
    """
    solved = [always_solved(rows) for rows in groups.values() if any(row.solved for row in rows)]
    return set.intersection(*solved) if len(solved) > 1 else set()


def measures(rows, best, common=frozenset()):
    """Returns the Measures of `rows`, which has at least one row, all of one line.

    best: best_costs() of all rows. common: common_instances() of the rows of all lines.
    """
    solved = [row for row in rows if row.solved]
    shared = [row for row in solved if row.instance in common]
    runs = Counter(row.instance for row in rows)
    runtimes = over_seeds(rows, lambda row: row.runtime_s)
    common_costs = over_seeds(shared, lambda row: row.cost)
    common_s = over_seeds(shared, lambda row: row.runtime_s)
    return Measures(
        instances=len(runs), seeds=max(runs.values()), runs=len(rows), solved=len(solved),
        invalid=sum(row.status == INVALID for row in rows), claimed=sum(row.status == CLAIMED for row in rows),
        within_omega=None if rows[0].omega in NO_PROMISE else sum(map(within_omega, solved)),
        success=statistics.fmean(over_seeds(rows, lambda row: row.solved)),
        mean_runtime_s=statistics.fmean(runtimes), median_runtime_s=statistics.median(runtimes),
        par2_s=statistics.fmean(over_seeds(rows, lambda row: row.runtime_s if row.solved else 2 * row.time_limit_s)),
        mean_sqr=_mean(over_seeds(solved, lambda row: row.sqr)),
        mean_cost_ratio=_mean(over_seeds(solved, lambda row: cost_ratio(row, best))),
        common=len(common), common_sqr=_mean(over_seeds(shared, lambda row: row.sqr)),
        common_cost_ratio=_mean(over_seeds(shared, lambda row: cost_ratio(row, best))),
        common_mean_cost=_mean(common_costs), common_median_cost=_median(common_costs),
        common_mean_s=_mean(common_s), common_median_s=_median(common_s),
        mean_roots=_mean(over_seeds(rows, lambda row: row.roots)),
        mean_rtsp_calls=_mean(over_seeds(rows, lambda row: row.rtsp_calls)))


class Configuration(NamedTuple):
    map: str
    agents: int
    tasks: int


def by_configuration(rows, best):
    """Returns {configuration: {line: Measures}} for the lines with rows of the configuration.

    best: see measures().
    """
    groups = grouped(rows, lambda row: Configuration(row.map, row.agents, row.tasks))
    return {configuration: measures_by_line(group, best) for configuration, group in sorted(groups.items())}


def measures_by_line(rows, best):
    """Returns {line: Measures}, ordered by line, which is a method with its omega and time limit (lines.py).

    `best`: see measures().
    """
    groups = by_line(rows)
    common = common_instances(groups)
    return {line: measures(group, best, common) for line, group in sorted(groups.items())}


def by_line(rows):
    """Returns {line: rows of the line}."""
    return grouped(rows, line_of)


def median_runs(rows):
    """Returns {instance: {line: row}}, where the row is the median by runtime of the runs that differ only in the seed.

    A failure counts as slower than any success. For an even number of runs, the faster of the two middle runs counts.
    """
    groups = defaultdict(lambda: defaultdict(list))
    for row in rows:
        groups[row.instance][line_of(row)].append(row)
    return {instance: {line: sorted(runs, key=lambda row: (not row.solved, row.runtime_s))
                       [(len(runs) - 1) // 2] for line, runs in lines.items()}
            for instance, lines in groups.items()}


def solved_over_time(rows):
    """Returns the runtimes of the solved rows in ascending order, so that k rows are solved by the k-th runtime."""
    return sorted(row.runtime_s for row in rows if row.solved)


def only_solver(runs):
    """Returns {line: [rows of instances that other methods tried but only the line's method solves]}.

    runs: median_runs().
    """
    found = defaultdict(list)
    for lines in runs.values():
        solvers = [line for line, row in lines.items() if row.solved]
        if len({line.method for line in solvers}) == 1 and len({line.method for line in lines}) > 1:
            for line in solvers:
                found[line].append(lines[line])
    return dict(found)


def beyond_baselines(runs, is_baseline):
    """Returns {line: number of instances that the line solves and that baselines tried but none solved}."""
    found = defaultdict(int)
    for lines in runs.values():
        tried = [row.solved for line, row in lines.items() if is_baseline(line)]
        if not tried or any(tried):
            continue
        for line, row in lines.items():
            if row.solved:
                found[line] += 1
    return dict(found)
