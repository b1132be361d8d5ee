# SPDX-License-Identifier: MIT
"""Running solvers on cases, several at a time; a row of results per run."""

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

COLUMNS = ["solver", "map", "agents", "tasks", "scenario", "status", "cost", "lower_bound",
           "gap_percent", "seconds", "first_plan_s", "nodes", "roots", "rtsp_calls", "memory_mb",
           "message"]
FIRST_PLAN = re.compile(r"^[*HCLS] .* (\d+\.\d+)s$", re.M)
GRACE_S = 10  # after its time limit a program is killed


class Failure(Exception):
    """A program did not do what it should."""


def run(command, timeout=None):
    """The output of a command that must succeed."""
    command = [str(word) for word in command]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=timeout)
    if done.returncode != 0:
        raise Failure(f"{shlex.join(command)} ended with {done.returncode}: "
                      f"{(done.stderr or done.stdout).strip()}")
    return done.stdout


def gap_percent(cost, bound):
    if cost is None or (bound == 0 and cost > 0):
        return None
    return 0.0 if cost == bound else 100 * (cost - bound) / bound


def first_plan_seconds(log):
    """When the first plan was there, by the log of a run; None: never."""
    found = FIRST_PLAN.search(log)
    return float(found.group(1)) if found else None


@dataclasses.dataclass(frozen=True)
class Grove:
    """`grove solve` with some options, on one thread unless they say otherwise.

    Every plan is re-checked with `grove check`.
    """

    program: str
    options: tuple = ()
    name: str = "grove"

    def solve(self, maps, case, time_limit, folder):
        generate, instance = instance_arguments(self.program, maps, case, folder)
        if generate:
            run(generate)
        threads = () if "--threads" in self.options else ("--threads", 1)
        plan, log = pathlib.Path(folder) / "plan.json", pathlib.Path(folder) / "log.txt"
        run([self.program, "solve", *instance, "--quiet", "--output", plan, "--log", log,
             "--time-limit", time_limit, *threads, *self.options], timeout=time_limit + GRACE_S)
        result = json.loads(plan.read_text())
        if "cost" in result:
            run([self.program, "check", instance[0], plan, *instance[1:]])
        stats = result["stats"]
        cost, bound = result.get("cost"), result["lower_bound"]
        return {"status": result["status"], "cost": cost, "lower_bound": bound,
                "gap_percent": gap_percent(cost, bound), "seconds": stats["wall_s"],
                "first_plan_s": first_plan_seconds(log.read_text()),
                "nodes": stats.get("nodes_expanded", 0), "roots": stats.get("roots_generated", 0),
                "rtsp_calls": stats.get("rtsp_calls", 0), "memory_mb": stats["peak_memory_mb"]}


@dataclasses.dataclass(frozen=True)
class OtherSolver:
    """Any program for classical MAPF.

    `command` may hold {map}, {scen}, {agents}, {time_limit} and {output}, a file of its own to
    write. `pattern` is searched in what it prints and in that file: it found a plan if there is a
    match, whose group 1, if there is one, is the cost.
    """

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
        seconds = time.monotonic() - start
        if output.exists():
            text += output.read_text()
        found = re.search(self.pattern, text, re.M)
        cost = int(float(found.group(1))) if found and found.re.groups else None
        return {"status": "solved" if found else "unknown", "cost": cost, "seconds": seconds}


@dataclasses.dataclass(frozen=True)
class Job:
    solver: Grove | OtherSolver
    case: object
    time_limit: float


def row_of(job, maps):
    """Runs a job. What goes wrong is a row of status "failed"."""
    row = dict.fromkeys(COLUMNS)
    row.update(solver=job.solver.name, map=job.case.map, agents=job.case.agents,
               tasks=job.case.tasks, scenario=job.case.scenario)
    with tempfile.TemporaryDirectory() as folder:
        try:
            row.update(job.solver.solve(maps, job.case, job.time_limit, folder))
        except (Failure, OSError, ValueError, subprocess.TimeoutExpired) as error:
            row.update(status="failed", message=f"{job.case}: {error}")
    return row


class Progress:
    """One line on a terminal that is written over and over."""

    def __init__(self, total):
        self.total = total
        self.done = 0
        self.start = time.monotonic()

    def step(self, row):
        self.done += 1
        passed = time.monotonic() - self.start
        left = passed / self.done * (self.total - self.done)
        if sys.stderr.isatty():
            last = f"{row['map']} {row['agents']} {row['solver']}: {row['status']}"
            print(f"\r\033[K{self.done} of {self.total}, about {math.ceil(left / 60)} min left; "
                  f"{last}", end="", file=sys.stderr, flush=True)
        if sys.stderr.isatty() and self.done == self.total:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def run_all(jobs, maps, workers, csv_path=None):
    """The rows of all jobs whose files are there, in their order; says what is left out.

    Rows also go to the CSV file as they come, so an interrupted run leaves what it has.
    """
    cases = dict.fromkeys(job.case for job in jobs)
    missing = collections.Counter(filter(None, map(maps.missing, cases)))
    for file, count in missing.items():
        print(f"skipped {count} of {len(cases)} cases: there is no {file}", file=sys.stderr)
    jobs = [job for job in jobs if not maps.missing(job.case)]
    progress = Progress(len(jobs))
    rows = [None] * len(jobs)
    file = open(csv_path, "w", newline="", encoding="utf-8") if csv_path else None
    try:
        writer = csv.DictWriter(file, fieldnames=COLUMNS) if file else None
        if writer:
            writer.writeheader()
        with concurrent.futures.ThreadPoolExecutor(workers) as pool:
            futures = {pool.submit(row_of, job, maps): i for i, job in enumerate(jobs)}
            try:
                for future in concurrent.futures.as_completed(futures):
                    row = rows[futures[future]] = future.result()
                    progress.step(row)
                    if writer:
                        writer.writerow(row)
                        file.flush()
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                raise
    finally:
        if file:
            file.close()
    return rows
