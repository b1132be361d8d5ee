#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs `grove solve` on the cells of the paper's data set and prints a table.

Each cell is (map, N agents, M tasks); its instances come from `grove generate instance` and the
scenarios <map>-random-<k>.scen beside the map. Every plan is re-checked with `grove check`. Options
after `--` go to `grove solve` as they are.

    benchmarks/cells.py --maps DIR --time-limit 10 -- --omega 0.01 --policy fixed
"""

import argparse
import csv
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--grove", default="build/release/bin/grove", help="the program")
    parser.add_argument("--maps", type=pathlib.Path, default="../shared/movingai",
                        help="where the .map and .scen files are")
    parser.add_argument("--map", nargs="+",
                        default=["empty-32-32", "random-32-32-20", "room-32-32-4"])
    parser.add_argument("--agents", nargs="+", type=int, default=[5, 10, 20])
    parser.add_argument("--tasks", nargs="+", type=int, default=[10, 30, 50])
    parser.add_argument("--scenarios", nargs="+", type=int, default=[1, 2, 3])
    parser.add_argument("--time-limit", type=float, default=10.0, help="seconds per instance")
    parser.add_argument("--mg", action="store_true", help="the MG-MAPF data set")
    parser.add_argument("--csv", type=pathlib.Path, help="write a row per instance to this file")
    parser.add_argument("options", nargs="*", help="options for grove solve, after --")
    return parser.parse_args()


def run(command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\nended with {done.returncode}: {done.stderr}")
    return done.stdout


def solve(arguments, folder, name, agents, tasks, scenario):
    instance = folder / "instance.cts.json"
    plan = folder / "plan.json"
    generate = [arguments.grove, "generate", "instance", "--map", arguments.maps / f"{name}.map",
                "--scen", arguments.maps / f"{name}-random-{scenario}.scen",
                "--agents", str(agents), "--tasks", str(tasks), "--seed", str(scenario),
                "-o", instance]
    run(generate + (["--mg"] if arguments.mg else []))
    run([arguments.grove, "solve", instance, "--quiet", "--output", plan,
         "--time-limit", str(arguments.time_limit), *arguments.options])
    result = json.loads(plan.read_text())
    if "cost" in result:
        run([arguments.grove, "check", instance, plan])
    stats = result["stats"]
    return {
        "map": name, "agents": agents, "tasks": tasks, "scenario": scenario,
        "status": result["status"], "cost": result.get("cost"),
        "lower_bound": result["lower_bound"],
        "seconds": stats["wall_s"], "nodes": stats.get("nodes_expanded", 0),
        "roots": stats.get("roots_generated", 0), "rtsp_calls": stats.get("rtsp_calls", 0),
        "memory_mb": stats["peak_memory_mb"],
    }


def gap_text(row):
    if row["cost"] is None:
        return "-"
    return f"{100 * (row['cost'] / row['lower_bound'] - 1):.2f}"


def print_cell(rows):
    first = rows[0]
    proven = sum(row["status"] in ("optimal", "bounded") for row in rows)
    values = [", ".join(row["status"] for row in rows),
              ", ".join(gap_text(row) for row in rows),
              ", ".join(str(row["roots"]) for row in rows),
              ", ".join(str(row["rtsp_calls"]) for row in rows),
              ", ".join(str(row["nodes"]) for row in rows),
              f"{statistics.median(row['seconds'] for row in rows):.2f}"]
    print(f"| {first['map']} | {first['agents']} | {first['tasks']} | {proven}/{len(rows)} | "
          + " | ".join(values) + " |", flush=True)


def main():
    arguments = parse_arguments()
    print("| map | N | M | proven | status | gap % | roots | rTSP calls | nodes | median s |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name in arguments.map:
            for agents in arguments.agents:
                for tasks in arguments.tasks:
                    cell = [solve(arguments, pathlib.Path(folder), name, agents, tasks, scenario)
                            for scenario in arguments.scenarios]
                    print_cell(cell)
                    rows += cell
    proven = sum(row["status"] in ("optimal", "bounded") for row in rows)
    print(f"\n{proven} of {len(rows)} proven to omega, "
          f"{sum(row['status'] == 'optimal' for row in rows)} of them optimal, "
          f"{sum(row['cost'] is None for row in rows)} without a plan")
    if arguments.csv:
        with open(arguments.csv, "w", newline="") as file:
            writer = csv.DictWriter(file, fieldnames=rows[0].keys())
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
