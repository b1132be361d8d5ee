# SPDX-License-Identifier: MIT
"""Times of the baselines over those of the other methods, on the instances where it matters."""
import math
import statistics
from collections import defaultdict
from typing import NamedTuple

from .lines import Line

# Below it an instance says more about start-up than about search.
TRIVIAL_S = 1.0
# What a clock that starts processes can tell.
RESOLUTION_S = 0.001
# Not one method: on each instance whichever baseline was the fastest.
BEST = Line("best baseline", "", 0.0)
ALL_MAPS = ""


class Speedup(NamedTuple):
    map: str              # ALL_MAPS: of all
    baseline: Line        # or BEST
    line: Line
    instances: int        # that both tried, and the best baseline solved in more than TRIVIAL_S
    median_ratio: float   # time of the baseline / time of the line; a failure counts as the limit
    sure: str             # what failures leave of it: "exactly", "at least", "at most", "about"
    baseline_median_s: float
    line_median_s: float
    baseline_failed: int  # of `instances`
    line_failed: int


def best_baseline(lines, is_baseline):
    """The fastest row of a baseline that solved the instance; None: none did."""
    solved = [row for line, row in lines.items() if is_baseline(line) and row.solved]
    return min(solved, key=lambda row: row.runtime_s, default=None)


def _ratio(mine, other):
    return max(mine.runtime_s, RESOLUTION_S) / max(other.runtime_s, RESOLUTION_S)


def _sure(pairs, median):
    """A failure would have taken longer than the limit: the ratio of a pair is then larger (the baseline
    failed) or smaller (the other did), by nobody knows how much. Does the median depend on it?"""
    highest = statistics.median(_ratio(*pair) if pair[0].solved else math.inf for pair in pairs)
    lowest = statistics.median(_ratio(*pair) if pair[1].solved else 0 for pair in pairs)
    return {(True, True): "exactly", (True, False): "at least",
            (False, True): "at most", (False, False): "about"}[lowest == median, highest == median]


def _compared(pairs):
    """`pairs`: (row of the baseline, row of the other)"""
    median = statistics.median(_ratio(*pair) for pair in pairs)
    return (len(pairs), median, _sure(pairs, median),
            statistics.median(mine.runtime_s for mine, _ in pairs),
            statistics.median(other.runtime_s for _, other in pairs),
            sum(not mine.solved for mine, _ in pairs), sum(not other.solved for _, other in pairs))


def hard_instances(runs, is_baseline):
    """{instance: row of the best baseline} where that took more than TRIVIAL_S; `runs`: median_runs()"""
    best = {instance: best_baseline(lines, is_baseline) for instance, lines in runs.items()}
    return {instance: row for instance, row in best.items() if row and row.runtime_s > TRIVIAL_S}


def speedups(runs, is_baseline):
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
