# SPDX-License-Identifier: MIT
"""Runs solvers on cases, several at a time, and makes one row of results per run."""

import collections
import concurrent.futures
import csv
import dataclasses
import json
import math
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import time

from harness.instances import instance_arguments
from harness.programs import Failure, run

# A subset of the columns of `grove bench`, so that `grove report` can read the rows.
COLUMNS = ["instance", "method", "options", "map", "scenario", "agents", "tasks", "problem", "omega",
           "seed", "time_limit_s", "solved", "status", "cost", "lower_bound", "gap", "runtime_s",
           "wall_s", "first_plan_s", "roots", "rtsp_calls", "nodes", "low_level_calls",
           "peak_memory_mb", "version", "ended_at", "error", "threads", "counts"]
FROM_STATS = {"roots": "roots_generated", "nodes": "nodes_expanded"} | {
    name: name for name in ("seed", "threads", "rtsp_calls", "low_level_calls", "peak_memory_mb", "version")}
PATHS = re.compile(r"^(Agent \d+:|solution=)", re.M)  # paths in the output of other solvers
FIRST_PLAN = re.compile(r"^[*HCLS] .* (\d+\.\d+)s$", re.M)
GRACE_S = 10  # a program is killed this many seconds after its time limit


def gap(cost, bound):
    if cost is None or bound is None or (bound == 0 and cost > 0):
        return None
    return 0.0 if cost == bound else (cost - bound) / bound


def first_plan_seconds(log):
    """Returns the time of the first plan in the text log of a run. Returns None if the log has no plan."""
    found = FIRST_PLAN.search(log)
    return float(found.group(1)) if found else None


@dataclasses.dataclass(frozen=True)
class Grove:
    """`grove solve` with `options`, on one thread unless they include --threads. Checks plans with `grove check`."""

    program: str
    options: tuple = ()
    name: str = "Grove"

    def solve(self, maps, case, time_limit, folder):
        instance = instance_arguments(self.program, maps, case, folder)
        threads = () if "--threads" in self.options else ("--threads", 1)
        plan, log = pathlib.Path(folder) / "plan.json", pathlib.Path(folder) / "log.txt"
        run([self.program, "solve", *instance, "--quiet", "--output", plan, "--log", log,
             "--time-limit", time_limit, *threads, *self.options], timeout=time_limit + GRACE_S)
        result = json.loads(plan.read_text())
        if "cost" in result:
            run([self.program, "check", instance[0], plan, *instance[1:]])
        stats = result["stats"]
        return {"options": shlex.join(map(str, self.options)), "omega": result["omega"],
                "solved": "cost" in result and "stopped_by" not in stats,
                "status": result["status"], "cost": result.get("cost"),
                "lower_bound": None if result["status"] == "infeasible" else result["lower_bound"],
                "wall_s": stats["wall_s"], "first_plan_s": first_plan_seconds(log.read_text()),
                "error": stats.get("stopped_by"), "checked": True,
                "counts": " ".join(f"{name}={value}" for name, value in stats.items() if name not in FROM_STATS.values()
                                   and isinstance(value, int) and value),
                **{column: stats.get(name) for column, name in FROM_STATS.items()}}


@dataclasses.dataclass(frozen=True)
class OtherSolver:
    """Any solver for classical MAPF.

    command: may contain {map}, {scen}, {agents}, {time_limit}, and {output}, a file that the solver may write.
    pattern: regular expression that is searched in the solver's output, followed by the content of {output}. A match
    means that the solver claims a plan, and group 1 is its cost. Paths in {output} are checked with `grove check`.
    """

    grove: str
    name: str
    command: str
    pattern: str

    def solve(self, maps, case, time_limit, folder):
        output = pathlib.Path(folder) / "output"
        values = {"map": maps.map(case), "scen": maps.scenario(case), "agents": case.agents,
                  "time_limit": f"{time_limit:g}", "output": output}
        command = [word.format(**values) for word in shlex.split(self.command)]
        start = time.monotonic()
        try:
            done = subprocess.run(command, capture_output=True, text=True, check=False,
                                  timeout=time_limit + GRACE_S)
            text = done.stdout + done.stderr
        except subprocess.TimeoutExpired:
            text = ""
        row = {"options": self.command, "wall_s": time.monotonic() - start, "status": "unknown"}
        written = output.read_text() if output.exists() else ""
        found = re.search(self.pattern, text + written, re.M)
        if not found:
            return row
        cost = int(float(found.group(1)))
        if cost < 0:
            raise Failure(f"claims a cost of {cost}")
        has_paths = bool(PATHS.search(written))
        if has_paths:
            self.check(maps, case, output, cost)
        return row | {"status": "feasible", "solved": True, "cost": cost, "checked": has_paths}

    def check(self, maps, case, output, cost):
        done = subprocess.run([self.grove, "check", maps.scenario(case), output, "--map", maps.map(case),
                               "--agents", str(case.agents)], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            first = done.stderr.splitlines()[0].removeprefix("grove: error: ").removeprefix(f"{output}: ")
            raise Failure(f"claims a plan of cost {cost}, but its paths are wrong: {first}")
        paths_cost = int(re.match(r"valid: cost (\d+)", done.stdout).group(1))
        if paths_cost != cost:
            raise Failure(f"claims a plan of cost {cost}, but its paths cost {paths_cost}")


@dataclasses.dataclass(frozen=True)
class Job:
    solver: Grove | OtherSolver
    case: object
    time_limit: float


def csv_value(value):
    return str(value).lower() if isinstance(value, bool) else value


def row_of(job, maps):
    """Runs a job and returns its row. A failure gives a row with status "error"."""
    case = job.case
    row = dict.fromkeys(COLUMNS) | {
        "instance": case.id, "method": job.solver.name, "map": case.map, "scenario": case.scenario,
        "agents": case.agents, "tasks": case.tasks or 0, "problem": case.problem,
        "time_limit_s": job.time_limit, "solved": False}
    with tempfile.TemporaryDirectory() as folder:
        try:
            row.update(job.solver.solve(maps, case, job.time_limit, folder))
        except (Failure, OSError, ValueError, OverflowError, subprocess.TimeoutExpired) as error:
            row.update(status="error", error=f"{case}: {error}")
    return row | {"gap": gap(row["cost"], row["lower_bound"]),
                  "runtime_s": row["wall_s"] if row["solved"] else job.time_limit,
                  "ended_at": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())}


class Progress:
    """Shows a progress line on a terminal."""

    def __init__(self, total):
        self.total = total
        self.done = 0
        self.start = time.monotonic()

    def step(self, row):
        self.done += 1
        passed = time.monotonic() - self.start
        left = passed / self.done * (self.total - self.done)
        if sys.stderr.isatty():
            last = f"{row['map']} {row['agents']} {row['method']}: {row['status']}"
            print(f"\r\033[K{self.done} of {self.total}, about {math.ceil(left / 60)} min left; "
                  f"{last}", end="", file=sys.stderr, flush=True)
        if sys.stderr.isatty() and self.done == self.total:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def run_all(jobs, maps, workers, csv_path=None):
    """Runs all jobs and returns their rows in the order of the jobs. Skips and reports cases with missing files.

    Also writes each row to the CSV file as soon as its job ends, so that the rows survive an interruption.
    """
    cases = dict.fromkeys(job.case for job in jobs)
    missing = collections.Counter(filter(None, map(maps.missing, cases)))
    for file, count in missing.items():
        print(f"skipped {count} of {len(cases)} cases: {file} is missing", file=sys.stderr)
    jobs = [job for job in jobs if not maps.missing(job.case)]
    progress = Progress(len(jobs))
    rows = [None] * len(jobs)
    file = open(csv_path, "w", newline="", encoding="utf-8") if csv_path else None
    try:
        writer = csv.DictWriter(file, fieldnames=COLUMNS, extrasaction="ignore") if file else None
        if writer:
            writer.writeheader()
        with concurrent.futures.ThreadPoolExecutor(workers) as pool:
            futures = {pool.submit(row_of, job, maps): i for i, job in enumerate(jobs)}
            try:
                for future in concurrent.futures.as_completed(futures):
                    row = rows[futures[future]] = future.result()
                    progress.step(row)
                    if writer:
                        writer.writerow({name: csv_value(value) for name, value in row.items()})
                        file.flush()
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                raise
    finally:
        if file:
            file.close()
    return rows
