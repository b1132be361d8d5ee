#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures the overhead of a small solve in C++, in Python and as a program, in microseconds.

    overhead.py [BUILD]        (default: build/release)

Solves benchmarks/data/random-32x32-20_n5_m10.cts.json (5 agents, 10 tasks). Reports medians: of 5 repetitions of the
C++ benchmarks, of 200 solves in Python, and of 30 runs of the program. Needs public_api_benchmark and the Python
module. Only the search alone and the program run with omega 0 and one thread. grove::solve() and grove.solve() run with
their default options.
"""
import json
import statistics
import subprocess
import sys
import time
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent
BUILD = Path(sys.argv[1] if len(sys.argv) > 1 else SOURCE / "build/release").resolve()
INSTANCE = SOURCE / "benchmarks/data/random-32x32-20_n5_m10.cts.json"


def microseconds(act, times):
    taken = []
    for _ in range(times):
        begin = time.perf_counter()
        act()
        taken.append(time.perf_counter() - begin)
    return 1e6 * statistics.median(taken)


def of_benchmarks():
    done = subprocess.run([BUILD / "bin/public_api_benchmark", "--benchmark_format=json",
                           "--benchmark_repetitions=5"], capture_output=True, text=True, check=True)
    return {row["run_name"]: row["real_time"] for row in json.loads(done.stdout)["benchmarks"]
            if row.get("aggregate_name") == "median"}


def main():
    sys.path.insert(0, str(BUILD / "python"))
    import grove
    compiled = of_benchmarks()
    instance = grove.read_instance(INSTANCE)
    solution = grove.solve(instance)
    program = [BUILD / "bin/grove", "solve", INSTANCE, "--omega", "0", "--threads", "1", "--quiet",
               "--output", "/dev/null"]
    rows = [
        ("only the search, C++", compiled["BM_Inside"]),
        ("grove::solve()", compiled["BM_PublicApi"]),
        ("grove.solve() of Python", microseconds(lambda: grove.solve(instance), 200)),
        ("with plan.positions()", microseconds(lambda: grove.solve(instance).plan.positions(), 200)),
        ("grove solve, the program", microseconds(lambda: subprocess.run(program, check=True), 30)),
        ("reading the instance, C++", compiled["BM_Reading"]),
    ]
    print(f"{instance}, cost {solution.plan.cost}")
    for name, value in rows:
        print(f"{name:28}{value:10.0f} us")


if __name__ == "__main__":
    main()
