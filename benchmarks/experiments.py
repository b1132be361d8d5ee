#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the experiments on Moving AI maps, one command each.

    benchmarks/experiments.py paper                      the paper's cells: proven results
    benchmarks/experiments.py large -j 2                 hundreds of agents: plans and gaps
    benchmarks/experiments.py crowded                    dense instances: first plans
    benchmarks/experiments.py classical -- --omega 0     classical MAPF: comparison with other solvers
    benchmarks/experiments.py ablation --tasks 30        each technique disabled in turn

Instances come from `grove generate instance` and the scenarios <map>-random-<k>.scen. Every plan of Grove, and
paths of other solvers, are checked with `grove check`. Claims that contradict each other, such as a plan below a
proven bound, are reported on standard error. Options after `--` are passed to `grove solve`, which uses one thread
without `--threads`. Cases whose map or scenario is missing are skipped and reported. The tables are Markdown; --csv
writes a row per run, also for `grove report`.
Exit codes: 0 all ran, 1 some failed, claims contradict each other, or nothing ran, 2 wrong usage.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
GROVE = ROOT / "build/release/bin/grove"
sys.path[:0] = [str(ROOT / "benchmarks"), str(ROOT / "tools/report")]

from grove_report.proofs import contradictions  # noqa: E402
from grove_report.rows import row_of  # noqa: E402
from harness import tables  # noqa: E402
from harness.instances import Case, Maps, cases_in  # noqa: E402
from harness.runs import Grove, Job, OtherSolver, run_all  # noqa: E402

PAPER_MAPS = ["empty-32-32", "random-32-32-20", "room-32-32-4"]
LARGE = [("random-64-64-10", 100, 300), ("random-64-64-10", 200, 600),
         ("random-64-64-10", 100, 900), ("den312d", 100, 300), ("room-64-64-8", 100, 300),
         ("warehouse-10-20-10-2-1", 100, 300)]
CROWDED = [("room-32-32-4", 120, 120), ("random-32-32-20", 250, 250)]
CLASSICAL = [("room-32-32-4", 20), ("room-32-32-4", 30), ("room-32-32-4", 40),
             ("random-32-32-20", 50), ("random-32-32-20", 70),
             ("empty-32-32", 100), ("empty-32-32", 150)]


def paper_cases(arguments):
    return [Case(name, agents, tasks, scenario, arguments.mg)
            for name in arguments.map for agents in arguments.agents for tasks in arguments.tasks
            for scenario in arguments.scenarios]


def listed_cases(sizes, arguments):
    return [Case(name, agents, tasks, scenario) for name, agents, tasks in sizes
            if not arguments.map or name in arguments.map for scenario in arguments.scenarios]


def grove_of(arguments):
    return Grove(arguments.grove, tuple(arguments.options))


def jobs_of(solvers, cases, arguments):
    return [Job(solver, case, arguments.time_limit) for case in cases for solver in solvers]


def paper(arguments):
    jobs = jobs_of([grove_of(arguments)], paper_cases(arguments), arguments)
    return jobs, lambda rows: [tables.cells(rows), tables.proofs(rows)]


def large(arguments):
    jobs = jobs_of([grove_of(arguments)], listed_cases(LARGE, arguments), arguments)
    return jobs, lambda rows: [tables.plans(rows)]


def crowded(arguments):
    jobs = jobs_of([grove_of(arguments)], listed_cases(CROWDED, arguments), arguments)
    return jobs, lambda rows: [tables.plans(rows)]


def classical(arguments):
    sizes = [(name, agents, None) for name, agents in CLASSICAL]
    solvers = [grove_of(arguments)] + [OtherSolver(arguments.grove, *other) for other in arguments.other]
    jobs = jobs_of(solvers, listed_cases(sizes, arguments), arguments)
    return jobs, lambda rows: [tables.comparison(rows)]


def technique_names(grove):
    """Returns the techniques that `grove solve --without` accepts, from its error message for an unknown technique."""
    message = subprocess.run([grove, "solve", "--without", "?", "x"], capture_output=True, text=True,
                             check=False).stderr
    names = re.search(r"--without: .*expected one of ([a-z, -]+)", message)
    if not names:
        sys.exit(f"experiments.py: error: {grove}: found no list of techniques in: {message}")
    return names.group(1).strip().split(", ")


def ablation(arguments):
    names = arguments.technique or technique_names(arguments.grove)
    whole = grove_of(arguments)
    solvers = [whole] + [Grove(whole.program, (*whole.options, "--without", name),
                               f"without {name}") for name in names]
    cases = cases_in(arguments.instances) if arguments.instances else paper_cases(arguments)
    jobs = jobs_of(solvers, cases, arguments)
    return jobs, lambda rows: [tables.ablation(rows, whole.name)]


def add_common(parser, time_limit, scenarios):
    parser.add_argument("--grove", default=GROVE, help="program grove")
    parser.add_argument("--maps", type=pathlib.Path,
                        default=os.environ.get("GROVE_MOVINGAI", "../shared/movingai"),
                        help="folder of the .map and .scen files (default: the environment variable "
                             "GROVE_MOVINGAI, else %(default)s)")
    parser.add_argument("--scenarios", nargs="+", type=int, default=scenarios, metavar="K")
    parser.add_argument("--time-limit", type=float, default=time_limit, metavar="S",
                        help="time limit per instance, seconds (default: %(default)s)")
    parser.add_argument("-j", "--jobs", type=int, default=1, metavar="N",
                        help="runs at a time (default: %(default)s); more than one distorts the times")
    parser.add_argument("--csv", type=pathlib.Path, help="write a row per run to this file")


def add_cells(parser):
    parser.add_argument("--map", nargs="+", default=PAPER_MAPS)
    parser.add_argument("--agents", nargs="+", type=int, default=[5, 10, 20], metavar="N")
    parser.add_argument("--tasks", nargs="+", type=int, default=[10, 20, 30, 40, 50], metavar="M")
    parser.add_argument("--mg", action="store_true", help="the MG-MAPF data set")


def add_filter(parser):
    parser.add_argument("--map", nargs="+", help="only these maps")


def make_parser():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True, metavar="EXPERIMENT")

    def add(function, summary, time_limit, scenarios):
        command = commands.add_parser(function.__name__, help=summary, description=summary)
        command.set_defaults(experiment=function)
        add_common(command, time_limit, scenarios)
        return command
    add_cells(add(paper, "the paper's cells: proven results", 10, [1, 2, 3]))
    add_filter(add(large, "hundreds of agents and tasks: plans and gaps", 60, [1, 2, 3, 4, 5]))
    add_filter(add(crowded, "dense instances: first plans", 5, [1, 2, 3, 4, 5]))
    command = add(classical, "classical MAPF: comparison with other solvers", 10, [1, 2, 3, 4, 5])
    add_filter(command)
    command.add_argument("--other", nargs=3, action="append", default=[],
                         metavar=("NAME", "COMMAND", "REGEX"),
                         help="another solver (repeatable): its command, in which {map}, {scen}, "
                              "{agents}, {time_limit} and {output} (a file it may write) are replaced, "
                              "and a pattern of its output that means a plan, with the cost as group 1. "
                              "Paths in {output}, as EECBS and lacam write them, are checked")
    command = add(ablation, "the paper's cells with each technique disabled in turn", 5,
                  [1, 2, 3])
    add_cells(command)
    command.add_argument("--technique", nargs="+", help="only these techniques (default: all)")
    command.add_argument("--instances", type=pathlib.Path, metavar="FOLDER",
                         help="use the *.cts.json files of this folder instead of the cells")
    return parser


def parse(words):
    split = words.index("--") if "--" in words else len(words)
    arguments = make_parser().parse_args(words[:split])
    arguments.options = words[split + 1:]
    for name, _, pattern in getattr(arguments, "other", []):
        if re.compile(pattern).groups < 1:
            sys.exit(f"experiments.py: error: --other {name}: found '{pattern}'; expected a group that is the cost")
    return arguments


def report_problems(rows):
    """Reports contradictions, failed runs and unchecked claims on standard error.

    Returns whether there are contradictions or failed runs.
    """
    found = contradictions([row_of(row, row["instance"]) for row in rows])
    if found:
        print("PROOFS CONTRADICT EACH OTHER: not all of these claims can be true", file=sys.stderr)
    for each in found:
        print(f"{each.instance}: {each.what}", file=sys.stderr)
    failed = [row for row in rows if row["status"] == "error"]
    for row in failed:
        print(f"failed: {row['method']}: {row['error']}", file=sys.stderr)
    for (method,), group in tables.grouped([row for row in rows if row.get("checked") is False], "method").items():
        print(f"{len(group)} plans of {method} are unchecked claims: it writes no paths to {{output}}", file=sys.stderr)
    return bool(failed or found)


def main():
    arguments = parse(sys.argv[1:])
    jobs, report = arguments.experiment(arguments)
    rows = run_all(jobs, Maps(arguments.maps), arguments.jobs, arguments.csv)
    is_wrong = report_problems(rows)
    if rows:
        print("\n\n".join(report(rows)))
    return 0 if rows and not is_wrong else 1


if __name__ == "__main__":
    sys.exit(main())
