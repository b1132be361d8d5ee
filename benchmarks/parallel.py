#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What threads and ranks gain, on instances of some thousand nodes (w = 0).

    benchmarks/parallel.py [--modes 2-threads 2-ranks ...] [--repeat 3] [--maps FOLDER] [--bin BIN_DIR]

Each mode is compared with one thread in the same run: the speed-up, the nodes more or fewer, and of ranks
the messages and bytes per node. Medians of the repetitions; a machine with other work to do tells nothing.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from harness.instances import Case, Maps, instance_arguments  # noqa: E402

CASES = [("random-32-32-20", 20, 20, 1), ("room-32-32-4", 20, 10, 3), ("room-32-32-4", 20, 20, 3),
         ("room-32-32-4", 20, 30, 2), ("room-32-32-4", 20, 30, 3), ("room-32-32-4", 20, 40, 1),
         ("room-32-32-4", 20, 40, 2), ("room-32-32-4", 20, 40, 3), ("room-32-32-4", 20, 50, 2),
         ("room-32-32-4", 20, 50, 3), ("room-32-32-4", 10, 50, 1)]
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
MODES = ["2-threads", "4-threads", "1-ranks", "2-ranks", "4-ranks", "8-ranks",
         "deterministic-1", "deterministic-2"]


def command(mode, programs):
    """What comes before the instance, and the options after it."""
    kind, number = sorted(mode.split("-"), key=str.isdigit)
    if kind == "ranks":
        binding = [] if int(number) <= (os.cpu_count() or 1) else ["--oversubscribe", "--bind-to", "none"]
        return ["mpirun", *binding, "-np", number, programs / "grove-mpi"], ["--threads", "1"]
    deterministic = ["--deterministic"] if kind == "deterministic" else []
    return [programs / "grove"], ["--threads", number, *deterministic]


def solve(mode, instance, a, folder):
    """Seconds and statistics of the median run; all must prove the same optimum."""
    before, after = command(mode, a.bin)
    runs = []
    for _ in range(a.repeat):
        (folder / "plan.json").unlink(missing_ok=True)  # a better one would stay
        subprocess.run([str(word) for word in [*before, "solve", *instance, "--omega", 0,
                                               "--time-limit", a.time_limit, "--quiet",
                                               "--output", folder / "plan.json", *after]],
                       check=True, env=ENVIRONMENT, stdout=subprocess.DEVNULL)
        plan = json.loads((folder / "plan.json").read_text(encoding="utf-8"))
        assert plan["status"] == "optimal", (mode, instance, plan["status"])
        runs.append((plan["stats"]["wall_s"], plan["cost"], plan["stats"]))
    runs.sort(key=lambda run: run[0])
    return runs[len(runs) // 2]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--modes", nargs="+", default=["2-threads", "2-ranks"], choices=MODES)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--first", type=int, default=len(CASES), help="only so many instances")
    parser.add_argument("--time-limit", type=float, default=120)
    parser.add_argument("--maps", type=Path,
                        default=os.environ.get("GROVE_MOVINGAI", "../shared/movingai"))
    parser.add_argument("--bin", type=Path, default=HERE.parent / "build/release/bin")
    a = parser.parse_args()
    gains = {mode: [] for mode in a.modes}
    print("| instance | 1 thread | " + " | ".join(a.modes) + " |")
    print("|---|---" + "|---" * len(a.modes) + "|")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for case in [Case(*case) for case in CASES[:a.first]]:
            make, instance = instance_arguments(a.bin / "grove", Maps(a.maps), case, folder)
            subprocess.run([str(word) for word in make], check=True, stdout=subprocess.DEVNULL)
            seconds, cost, alone = solve("1-threads", instance, a, folder)
            cells = [f"{seconds:.2f} s, {alone['nodes_expanded']} nodes"]
            for mode in a.modes:
                took, same_cost, stats = solve(mode, instance, a, folder)
                assert same_cost == cost, (case, mode, cost, same_cost)
                more = stats["nodes_expanded"] / alone["nodes_expanded"] - 1
                talk = "" if "messages" not in stats else (
                    f", {stats['messages'] / stats['nodes_expanded']:.2f} messages and "
                    f"{stats['message_bytes'] / stats['nodes_expanded']:.0f} bytes a node")
                gains[mode].append((seconds / took, more))
                cells.append(f"{seconds / took:.2f} times as fast, nodes {100 * more:+.0f} %{talk}")
            print(f"| {case} | " + " | ".join(cells) + " |", flush=True)
    medians = [f"**{statistics.median(gain for gain, _ in gains[mode]):.2f}**, "
               f"{100 * statistics.median(more for _, more in gains[mode]):+.0f} %"
               for mode in a.modes]
    print("| median | | " + " | ".join(medians) + " |")


if __name__ == "__main__":
    main()
