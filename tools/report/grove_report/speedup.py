# SPDX-License-Identifier: MIT
"""Computes ratios of the baselines' times to the times of the other methods, on instances that are not trivial."""
import math
import statistics
from collections import defaultdict
from typing import NamedTuple

from .lines import Line

# An instance that takes less time measures the start of the program rather than the search.
TRIVIAL_S = 1.0
# Resolution of times that include the start of a process, seconds.
RESOLUTION_S = 0.001
# Virtual best baseline: the fastest baseline on each instance.
BEST = Line("best baseline", "", 0.0)
ALL_MAPS = ""


class Speedup(NamedTuple):
    map: str              # a map, or ALL_MAPS
    baseline: Line        # a baseline, or BEST
    line: Line
    instances: int        # number of instances that both tried and that the best baseline solved in more than TRIVIAL_S
    median_ratio: float   # time of the baseline / time of the line; a failure counts as the limit
    sure: str             # how failures affect the ratio: "exactly", "at least", "at most", "about"
    baseline_median_s: float
    line_median_s: float
    baseline_failed: int  # number of failures of the baseline among `instances`
    line_failed: int      # number of failures of the line among `instances`


def best_baseline(lines, is_baseline):
    """Returns the fastest solved row among the baselines. Returns None if no baseline solved the instance."""
    solved = [row for line, row in lines.items() if is_baseline(line) and row.solved]
    return min(solved, key=lambda row: row.runtime_s, default=None)


def _ratio(mine, other):
    return max(mine.runtime_s, RESOLUTION_S) / max(other.runtime_s, RESOLUTION_S)


def _sure(pairs, median):
    """Returns how failures affect the median ratio: "exactly", "at least", "at most" or "about".

    A failed run would have taken longer than the limit, by an unknown amount. The true ratio of its pair is therefore
    larger if the baseline failed, and smaller if the other method failed.
    """
    highest = statistics.median(_ratio(*pair) if pair[0].solved else math.inf for pair in pairs)
    lowest = statistics.median(_ratio(*pair) if pair[1].solved else 0 for pair in pairs)
    return {(True, True): "exactly", (True, False): "at least",
            (False, True): "at most", (False, False): "about"}[lowest == median, highest == median]


def _compared(pairs):
    """Returns the fields of Speedup after `line`. `pairs`: list of (row of the baseline, row of the other method)."""
    median = statistics.median(_ratio(*pair) for pair in pairs)
    return (len(pairs), median, _sure(pairs, median),
            statistics.median(mine.runtime_s for mine, _ in pairs),
            statistics.median(other.runtime_s for _, other in pairs),
            sum(not mine.solved for mine, _ in pairs), sum(not other.solved for _, other in pairs))


def hard_instances(runs, is_baseline):
    """Returns {instance: row of the best baseline} for the instances on which it took more than TRIVIAL_S.

    runs: median_runs().
    """
    best = {instance: best_baseline(lines, is_baseline) for instance, lines in runs.items()}
    return {instance: row for instance, row in best.items() if row and row.runtime_s > TRIVIAL_S}


def speedups(runs, is_baseline):
    """Returns the Speedup of each line over each baseline and BEST, for all maps together and for each map."""
    pairs = defaultdict(list)
    for instance, best in hard_instances(runs, is_baseline).items():
        lines = runs[instance]
        ours = {line: row for line, row in lines.items() if is_baseline(line)} | {BEST: best}
        for baseline, row in ours.items():
            for line, other in lines.items():
                if line != baseline:
                    pairs[ALL_MAPS, baseline, line].append((row, other))
                    pairs[other.map, baseline, line].append((row, other))
    return [Speedup(*key, *_compared(found)) for key, found in sorted(
        pairs.items(), key=lambda item: (item[0][0], item[0][1] != BEST, *item[0][1:]))]
