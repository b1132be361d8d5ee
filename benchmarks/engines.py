#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that all engines find the same optimum, on tiny generated instances and on the given instances.

Engines: one process with 1, 2 and 4 threads; 1, 2, 3 and 4 ranks; 2 ranks of 2 threads.

    engines.py [--tiny N] [--time-limit S] [--bin BIN_DIR] [INSTANCE...]

Exit code 1 if two engines prove different optima. Instances that an engine does not solve within the limit are
listed.
"""
import argparse
import csv
import sys
import tempfile
from pathlib import Path

from harness.programs import MPIRUN, answer, run

DATA = Path(__file__).resolve().parent / "data"
THREADS = [1, 2, 4]
RANKS = [(1, 1), (2, 1), (3, 1), (4, 1), (2, 2)]  # (ranks, threads per rank)


def make_tiny(grove, folder, count):
    """Generates `count` instances with few agents on few cells and therefore many conflicts; returns their paths."""
    instances = []
    for seed in range(count):
        path = folder / f"tiny-{seed}.cts.json"
        run([grove, "generate", "instance", "--map", DATA / "first.map", "--agents", 3 + seed % 4,
             "--tasks", 3 + seed % 5, "--seed", seed, "-o", path])
        instances.append(path)
    return instances


def by_threads(grove, instances, threads, limit, folder):
    """Solves the instances on `threads` threads and returns {instance: proven optimum or None}."""
    found = {}
    for path in instances:
        found_plan = answer([grove, "solve", path, "--omega", 0, "--threads", threads, "--time-limit", limit],
                      folder / "plan.json")
        found[path.name] = found_plan["cost"] if found_plan["status"] == "optimal" else None
    return found


def by_ranks(grove_mpi, instances, ranks, threads, limit, folder):
    listing = folder / "list.txt"
    listing.write_text("".join(f"{path}\n" for path in instances), encoding="utf-8")
    output = folder / f"batch-{ranks}-{threads}"
    run([*MPIRUN, "--oversubscribe", "--bind-to", "none", "-np", ranks, grove_mpi, "batch", listing,
         "--ranks-per-instance", ranks, "--threads", threads, "--omega", 0, "--time-limit", limit,
         "--output", output, "--quiet"])
    found = {}
    with open(output / "results.csv", encoding="utf-8", newline="") as table:
        for row in csv.DictReader(table):
            assert not row["error"], row
            cost = int(row["cost"]) if row["status"] == "optimal" else None
            found[f"{Path(row['instance']).name}.cts.json"] = cost
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("instances", nargs="*", type=Path)
    parser.add_argument("--tiny", type=int, default=500)
    parser.add_argument("--time-limit", type=float, default=60)
    parser.add_argument("--bin", type=Path,
                        default=Path(__file__).resolve().parents[1] / "build/release/bin")
    a = parser.parse_args()
    grove, grove_mpi = a.bin.resolve() / "grove", a.bin.resolve() / "grove-mpi"
    differ = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        instances = make_tiny(grove, folder, a.tiny) + [path.resolve() for path in a.instances]
        answers = {f"{t} threads": by_threads(grove, instances, t, a.time_limit, folder)
                   for t in THREADS}
        for ranks, threads in RANKS:
            answers[f"{ranks} ranks x {threads}"] = by_ranks(grove_mpi, instances, ranks, threads,
                                                             a.time_limit, folder)
        for path in instances:
            costs = {engine: found[path.name] for engine, found in answers.items()}
            if len({cost for cost in costs.values() if cost is not None}) > 1:
                differ += 1
                print(f"DIFFERENT: {path.name}: {costs}")
            elif None in costs.values():
                print(f"not proven by all: {path.name}: {costs}")
    for engine, found in answers.items():
        print(f"{engine:12} {sum(cost is not None for cost in found.values())} of "
              f"{len(instances)} proven")
    print(f"{differ} of {len(instances)} instances differ")
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
