#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures the speed-up by threads and ranks on instances of thousands of nodes (omega 0).

    benchmarks/parallel.py [--modes 2-threads 2-ranks ...] [--repeat 3] [--maps FOLDER] [--bin BIN_DIR]

Each mode is compared with one thread in the same run: speed-up, change in the number of nodes, and, for ranks,
messages and bytes per node. Values are medians of the repetitions. They are meaningless on a machine with other load.
"""
import argparse
import os
import statistics
import tempfile
from pathlib import Path

from harness.instances import Case, Maps, instance_arguments
from harness.programs import MPIRUN, add_folders, median_optimum

CASES = [("random-32-32-20", 20, 20, 1), ("room-32-32-4", 20, 10, 3), ("room-32-32-4", 20, 20, 3),
         ("room-32-32-4", 20, 30, 2), ("room-32-32-4", 20, 30, 3), ("room-32-32-4", 20, 40, 1),
         ("room-32-32-4", 20, 40, 2), ("room-32-32-4", 20, 40, 3), ("room-32-32-4", 20, 50, 2),
         ("room-32-32-4", 20, 50, 3), ("room-32-32-4", 10, 50, 1)]
MODES = ["2-threads", "4-threads", "1-ranks", "2-ranks", "4-ranks", "8-ranks",
         "deterministic-1", "deterministic-2"]


def command(mode, programs):
    """Returns the command for a mode as (words before the subcommand, options after the instance)."""
    kind, number = sorted(mode.split("-"), key=str.isdigit)
    if kind == "ranks":
        binding = [] if int(number) <= (os.cpu_count() or 1) else ["--oversubscribe", "--bind-to", "none"]
        return [*MPIRUN, *binding, "-np", number, programs / "grove-mpi"], ["--threads", "1"]
    deterministic = ["--deterministic"] if kind == "deterministic" else []
    return [programs / "grove"], ["--threads", number, *deterministic]


def solve(mode, instance, a, folder):
    """Returns the seconds, cost and statistics of the run with the median time. All runs must prove the optimum."""
    before, after = command(mode, a.bin)
    found = median_optimum([*before, "solve", *instance, "--omega", 0, "--time-limit", a.time_limit,
                            *after], folder / "plan.json", a.repeat)
    return found["stats"]["wall_s"], found["cost"], found["stats"]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--modes", nargs="+", default=["2-threads", "2-ranks"], choices=MODES)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--first", type=int, default=len(CASES), help="number of instances (default: all)")
    parser.add_argument("--time-limit", type=float, default=120)
    add_folders(parser)
    a = parser.parse_args()
    gains = {mode: [] for mode in a.modes}
    print("| instance | 1 thread | " + " | ".join(a.modes) + " |")
    print("|---|---" + "|---" * len(a.modes) + "|")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for case in [Case(*case) for case in CASES[:a.first]]:
            instance = instance_arguments(a.bin / "grove", Maps(a.maps), case, folder)
            seconds, cost, alone = solve("1-threads", instance, a, folder)
            cells = [f"{seconds:.2f} s, {alone['nodes_expanded']} nodes"]
            for mode in a.modes:
                took, same_cost, stats = solve(mode, instance, a, folder)
                assert same_cost == cost, (case, mode, cost, same_cost)
                more = stats["nodes_expanded"] / alone["nodes_expanded"] - 1
                messages = "" if "messages" not in stats else (
                    f", {stats['messages'] / stats['nodes_expanded']:.2f} messages and "
                    f"{stats['message_bytes'] / stats['nodes_expanded']:.0f} bytes a node")
                gains[mode].append((seconds / took, more))
                cells.append(f"{seconds / took:.2f} times as fast, nodes {100 * more:+.0f} %{messages}")
            print(f"| {case} | " + " | ".join(cells) + " |", flush=True)
    medians = [f"**{statistics.median(gain for gain, _ in gains[mode]):.2f}**, "
               f"{100 * statistics.median(more for _, more in gains[mode]):+.0f} %"
               for mode in a.modes]
    print("| median | | " + " | ".join(medians) + " |")


if __name__ == "__main__":
    main()
