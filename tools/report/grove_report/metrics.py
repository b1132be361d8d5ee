# SPDX-License-Identifier: MIT
"""The figures of a set of rows of one line: success, runtime, SQR, PAR-2, ..."""
import statistics
from collections import defaultdict
from typing import NamedTuple, Optional

from .lines import line_of


class Measures(NamedTuple):
    """None: no row to tell."""
    runs: int
    solved: int
    success: float                 # solved / runs
    mean_runtime_s: float          # a failure counts as the time limit
    median_runtime_s: float        # likewise
    par2_s: float                  # a failure counts as twice the time limit
    mean_sqr: Optional[float]      # over solved rows
    mean_roots: Optional[float]    # over all rows that tell
    mean_rtsp_calls: Optional[float]


def _mean(values):
    values = [value for value in values if value is not None]
    return statistics.fmean(values) if values else None


def measures(rows):
    solved = sum(row.solved for row in rows)
    return Measures(
        runs=len(rows), solved=solved, success=solved / len(rows),
        mean_runtime_s=statistics.fmean(row.runtime_s for row in rows),
        median_runtime_s=statistics.median(row.runtime_s for row in rows),
        par2_s=statistics.fmean(row.runtime_s if row.solved else 2 * row.time_limit_s
                                for row in rows),
        mean_sqr=_mean(row.sqr for row in rows if row.solved),
        mean_roots=_mean(row.roots for row in rows),
        mean_rtsp_calls=_mean(row.rtsp_calls for row in rows))


class Cell(NamedTuple):
    map: str
    agents: int
    tasks: int


def by_cell(rows):
    """{cell: {line: Measures}}; a line without rows in a cell is not there."""
    groups = defaultdict(list)
    for row in rows:
        groups[Cell(row.map, row.agents, row.tasks), line_of(row)].append(row)
    cells = defaultdict(dict)
    for (cell, line), group in sorted(groups.items()):
        cells[cell][line] = measures(group)
    return dict(cells)


def by_line(rows):
    """{line: its rows}"""
    groups = defaultdict(list)
    for row in rows:
        groups[line_of(row)].append(row)
    return dict(groups)


def median_runs(rows):
    """{instance: {line: row}}: of runs that differ in the seed alone the median one, a failure being
    slower than any success; of an even number the faster of the two in the middle."""
    groups = defaultdict(lambda: defaultdict(list))
    for row in rows:
        groups[row.instance][line_of(row)].append(row)
    return {instance: {line: sorted(runs, key=lambda row: (not row.solved, row.runtime_s))
                       [(len(runs) - 1) // 2] for line, runs in lines.items()}
            for instance, lines in groups.items()}


def solved_over_time(rows):
    """The runtimes of the solved rows, in order: by the k-th, k are solved."""
    return sorted(row.runtime_s for row in rows if row.solved)


def only_solver(runs):
    """{line: [rows of instances that its method alone solves though others tried]}; `runs`:
    median_runs()."""
    found = defaultdict(list)
    for lines in runs.values():
        solvers = [line for line, row in lines.items() if row.solved]
        if len({line.method for line in solvers}) == 1 and len({line.method for line in lines}) > 1:
            for line in solvers:
                found[line].append(lines[line])
    return dict(found)


def beyond_baselines(runs, is_baseline):
    """{line: number of instances that it solves and no baseline that tried does}."""
    found = defaultdict(int)
    for lines in runs.values():
        tried = [row.solved for line, row in lines.items() if is_baseline(line)]
        if not tried or any(tried):
            continue
        for line, row in lines.items():
            if row.solved:
                found[line] += 1
    return dict(found)
