# SPDX-License-Identifier: MIT
"""Runs Grove's programs. A failure raises an exception."""
import json
import os
import shlex
import subprocess
from pathlib import Path

# Open MPI refuses to run as root without these variables.
MPIRUN = ["env", "OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1", "mpirun"]


class Failure(Exception):
    """A program failed."""


def add_folders(parser):
    """Adds the options --bin and --maps."""
    parser.add_argument("--bin", type=Path,
                        default=Path(__file__).resolve().parents[2] / "build/release/bin")
    parser.add_argument("--maps", type=Path,
                        default=os.environ.get("GROVE_MOVINGAI", "../shared/movingai"))


def run(command, timeout=None):
    """Runs a command and returns its standard output.

    Raises Failure if the exit code is not 0, and subprocess.TimeoutExpired after `timeout` seconds.
    """
    command = [str(word) for word in command]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=timeout)
    if done.returncode != 0:
        raise Failure(f"{shlex.join(command)}: exit code {done.returncode}: "
                      f"{(done.stderr or done.stdout).strip()}")
    return done.stdout


def answer(solve, plan):
    """Runs the command `solve` and returns the content of its plan file `plan`."""
    plan.unlink(missing_ok=True)  # otherwise grove would keep an existing cheaper plan
    run([*solve, "--quiet", "--output", plan])
    return json.loads(plan.read_text(encoding="utf-8"))


def optimum(solve, plan):
    """Runs the command `solve` and returns the content of its plan file. Raises SystemExit if no optimum is proven."""
    found = answer(solve, plan)
    if found["status"] != "optimal":
        raise SystemExit(f"{shlex.join(map(str, solve))}: found status {found['status']}; expected optimal")
    return found


def median_optimum(solve, plan, repeat):
    """Runs optimum() `repeat` times and returns the content of the plan file of the run with the median time.

    If `repeat` is even, the slower of the two middle runs counts.
    """
    runs = [optimum(solve, plan) for _ in range(repeat)]
    return sorted(runs, key=lambda found: found["stats"]["wall_s"])[repeat // 2]
