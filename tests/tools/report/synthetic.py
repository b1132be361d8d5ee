#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Generates synthetic results in the format of `grove bench`, for tests of the report and for example reports.

    synthetic.py FILE.jsonl|FILE.csv [--scenarios 15] [--solvers]
"""
import argparse
import csv
import json
import math
import random
from pathlib import Path

COLUMNS = ["instance", "method", "options", "map", "scenario", "agents", "tasks", "problem", "omega",
           "seed", "time_limit_s", "solved", "status", "cost", "lower_bound", "gap", "root_cost", "sqr",
           "runtime_s", "wall_s", "first_plan_s", "roots", "rtsp_calls", "nodes", "low_level_calls", "peak_memory_mb",
           "version", "machine", "ended_at", "error",
           "ranks", "threads", "memory_limit_gb", "plan_file", "instance_digest", "counts",
           "solver", "claimed_cost", "claimed_lower_bound", "claimed_s", "anytime", "trace"]
MAPS = {"empty-32-32": 0.5, "random-32-32-20": 1.5, "room-32-32-4": 2.6}  # difficulty of each map
AGENTS = (5, 10, 20)
TASKS = (10, 20, 30, 40, 50)
# Method: (ln of the seconds at difficulty 0, growth with difficulty, mean relative excess over the optimum)
MG_METHODS = {"auto": (-6.5, 0.85, 0.002), "cts-cbs-a": (-4.5, 1.25, 0.004),
              "cts-cbs-b": (-5.0, 0.95, 0.10), "cts-cbs-c": (-4.3, 1.05, 0.04),
              "optimal-cbs": (-3.0, 1.45, 0.0), "hcbs": (-2.5, 1.45, 0.0),
              "mgcbs": (-3.5, 1.40, 0.0), "s-cbs": (-4.0, 1.25, 0.02)}
OMEGAS = {"0": (-3.5, 1.45, 0.0), "0.01": (-4.0, 1.2, 0.003), "0.1": (-4.3, 1.1, 0.015),
          "inf": (-4.3, 1.1, 0.016)}
LIMIT_S = 180.0


def difficulty(hardness, agents, tasks):
    return hardness * 0.7 + 1.2 * math.log2(agents / 5) + tasks / 12


def _optimum(hardness, agents, tasks, scenario):
    root = 30 * agents + 12 * tasks + scenario
    return root, root + round(root * 0.004 * hardness * math.log2(agents))


def _counts(method, nodes):
    """Returns the search counters as text, or None if all are 0 and for baselines, which have no counters."""
    if not method.startswith(("auto", "cts")):
        return None
    found = {"bypasses": nodes // 9, "joint_mdd_nodes": 30 * nodes, "branching_cost_queries": 8 * nodes,
             "branching_cost_hits": 6 * nodes,
             "splits_vertex_edge": nodes // 2, "splits_corridor": nodes // 5, "splits_target": nodes // 30,
             "splits_cost": nodes // 7}
    return " ".join(f"{name}={number}" for name, number in found.items() if number) or None


def _row(dice, instance, method, options, omega, shape):
    name, hardness, scenario, agents, tasks, problem = instance
    start, growth, lost = shape
    root, optimum = _optimum(hardness, agents, tasks, scenario)
    seconds = math.exp(start + growth * difficulty(hardness, agents, tasks) + dice.gauss(0, 0.9))
    solved = seconds < LIMIT_S
    proves = omega == "0" and solved
    cost = optimum + round(optimum * lost * dice.random() * 2) if solved else None
    spent = min(seconds, LIMIT_S)
    return {
        "instance": f"{name}_s{scenario}_n{agents}_m{tasks}_{problem}", "method": method,
        "options": options, "map": name, "scenario": scenario, "agents": agents, "tasks": tasks,
        "problem": problem, "omega": omega, "seed": 0, "time_limit_s": LIMIT_S, "solved": solved,
        "status": "unknown" if not solved else "optimal" if proves else "bounded"
                  if omega != "inf" and cost <= (1 + float(omega)) * root else "feasible",
        "cost": cost, "lower_bound": optimum if proves else root,
        "gap": None if cost is None else (cost - root) / root, "root_cost": root,
        "sqr": root / cost if solved else None, "runtime_s": round(spent, 4),
        "wall_s": round(spent + 0.02, 4),
        "roots": max(1, int(spent * 20 * (0.3 if omega == "0.01" else 1))) if omega in ("0", "0.01")
                 else 1,
        "rtsp_calls": agents + (int(spent * 90 * (0.3 if omega == "0.01" else 1))
                                if omega in ("0", "0.01") else 0),
        "nodes": int(spent * 900), "low_level_calls": int(spent * 1800),
        "peak_memory_mb": round(20 + spent, 1), "version": "grove 0.1.0 (git 0123456789ab)",
        "machine": "Example processor, 2 cores", "ended_at": "2026-01-02T03:04:05Z",
        "error": None if solved else "time limit", "ranks": 1, "threads": 1, "memory_limit_gb": None,
        "instance_digest": f"{scenario:02x}{agents:02x}{tasks:02x}{problem}",
        "counts": _counts(method, int(spent * 900))}


def rows(scenarios=15, maps=tuple(MAPS), agents=AGENTS, tasks=TASKS, seed=1, study=True):
    """Yields MG-MAPF rows of eight methods and, with `study`, CTS-MAPF rows for four values of omega.

    The study uses the last map and the first number of agents.
    """
    dice = random.Random(seed)
    for name in maps:
        for number in agents:
            for amount in tasks:
                for scenario in range(1, scenarios + 1):
                    instance = (name, MAPS[name], scenario, number, amount, "mg")
                    for method, shape in MG_METHODS.items():
                        omega = ("inf" if method == "s-cbs" else
                                 "0" if shape[2] == 0 else "0.01")
                        yield _row(dice, instance, method,
                                   f"--method {method} --omega {omega}", omega, shape)
                    if study and name == maps[-1] and number == agents[0]:
                        for omega, shape in OMEGAS.items():
                            yield _row(dice, (*instance[:5], "cts"), f"cts-cbs-w{omega}",
                                       f"--method cts-cbs --omega {omega}", omega, shape)


def _trace(dice, first_s, end_s, first_cost, cost, bound):
    """Returns plans from the first to the best, at growing intervals, in the format of the column `trace`."""
    points, seconds, at = [], first_s, first_cost
    while seconds < end_s and at > cost:
        points.append(f"{seconds:.3f}:{at}:{'-' if bound is None else bound}")
        seconds, at = seconds * (1.3 + dice.random()), cost + int((at - cost) * 0.7 * dice.random())
    return " ".join([*points, f"{min(seconds, end_s):.3f}:{cost}:{'-' if bound is None else bound}"])


def _solver_row(dice, place, method, seed, shape):
    """Returns a row for classical MAPF.

    shape: (ln of seconds until the first plan, growth, relative excess of the first plan's cost, the same for the
    last plan, adapter, whether the solver is anytime, whether it reports a bound).
    """
    name, hardness, scenario, agents = place
    start, growth, first, last, adapter, anytime, has_bound = shape
    limit, bound = 30.0, 22 * agents + scenario
    optimum = bound + agents * agents // 60
    seconds = math.exp(start + growth * hardness * agents / 40 + dice.gauss(0, 0.6))
    solved = seconds < limit
    cost = optimum + round(optimum * last * (0.5 + dice.random())) if solved else None
    ended = limit if anytime or not solved else min(seconds * 1.2, limit)
    row = {
        "instance": f"{name}-random-{scenario}-{agents}", "method": method, "options": "", "map": name,
        "scenario": scenario, "agents": agents, "tasks": 0, "problem": "mapf", "omega": "" if adapter else "0.01",
        "seed": seed, "time_limit_s": limit, "solved": solved, "status": "feasible" if solved else "unknown",
        "cost": cost,
        "lower_bound": None if adapter else bound, "root_cost": bound,
        "runtime_s": round(seconds if solved else limit, 4),
        "wall_s": round(ended, 4), "first_plan_s": round(seconds, 4) if solved else None, "version": "grove 0.1.0",
        "machine": "Example processor, 2 cores", "ended_at": "2026-01-02T03:04:05Z", "ranks": 1, "threads": 1,
        "instance_digest": f"{name}{scenario}", "solver": adapter or None, "anytime": anytime,
        "claimed_cost": cost if adapter else None, "claimed_lower_bound": bound if adapter and has_bound else None}
    if solved and (anytime or not adapter):
        row["trace"] = _trace(dice, seconds, ended, max(cost, round(optimum * (1 + first))), cost,
                              bound if has_bound else None)
    return row


SOLVERS = {"auto": (-3.5, 1.9, 0.10, 0.006, "", False, True), "lns": (-4.0, 1.2, 0.30, 0.02, "mapf-lns2", True, False),
           "lacam": (-5.0, 0.5, 0.60, 0.05, "lacam3", True, False),
           "eecbs": (-3.0, 2.3, 0, 0.012, "eecbs", False, True)}


def solver_rows(scenarios=5, maps=("empty-32-32", "random-32-32-20"), agents=(20, 40, 60, 80, 100), seeds=(1, 2),
                seed=1):
    """Yields rows of Grove and three other solvers for classical MAPF."""
    dice = random.Random(seed)
    for name in maps:
        for number in agents:
            for scenario in range(1, scenarios + 1):
                for method, shape in SOLVERS.items():
                    for each in seeds:
                        yield _solver_row(dice, (name, MAPS[name], scenario, number), method, each, shape)


def write_jsonl(path, found):
    with open(path, "w", encoding="utf-8") as file:
        file.writelines(json.dumps(row) + "\n" for row in found)


def write_csv(path, found, columns=COLUMNS):
    def shown(value):
        return "" if value is None else str(value).lower() if isinstance(value, bool) else value
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows([shown(row.get(column)) for column in columns] for row in found)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", type=Path)
    parser.add_argument("--scenarios", type=int, default=15)
    parser.add_argument("--solvers", action="store_true", help="classical MAPF, with other solvers")
    a = parser.parse_args()
    found = solver_rows(a.scenarios) if a.solvers else rows(a.scenarios)
    (write_csv if a.file.suffix == ".csv" else write_jsonl)(a.file, found)


if __name__ == "__main__":
    main()
