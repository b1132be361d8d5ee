# SPDX-License-Identifier: MIT
"""Running Grove's programs: to any good end, or to a proof."""
import json
import os
import shlex
import subprocess
from pathlib import Path

# It minds root.
MPIRUN = ["env", "OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1", "mpirun"]


class Failure(Exception):
    """A program did not do what it should."""


def add_folders(parser):
    """Options that say where the programs are, and the maps."""
    parser.add_argument("--bin", type=Path,
                        default=Path(__file__).resolve().parents[2] / "build/release/bin")
    parser.add_argument("--maps", type=Path,
                        default=os.environ.get("GROVE_MOVINGAI", "../shared/movingai"))


def run(command, timeout=None):
    """The output of a command that must succeed."""
    command = [str(word) for word in command]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=timeout)
    if done.returncode != 0:
        raise Failure(f"{shlex.join(command)} ended with {done.returncode}: "
                      f"{(done.stderr or done.stdout).strip()}")
    return done.stdout


def answer(solve, plan):
    """What the file `plan` says after a solve."""
    plan.unlink(missing_ok=True)  # a better one would stay
    run([*solve, "--quiet", "--output", plan])
    return json.loads(plan.read_text(encoding="utf-8"))


def optimum(solve, plan):
    """The same of one that must prove the optimum."""
    found = answer(solve, plan)
    if found["status"] != "optimal":
        raise SystemExit(f"{shlex.join(map(str, solve))}: {found['status']}; expected optimal")
    return found


def median_optimum(solve, plan, repeat):
    """The same of the median of several runs, by their time."""
    runs = [optimum(solve, plan) for _ in range(repeat)]
    return sorted(runs, key=lambda found: found["stats"]["wall_s"])[repeat // 2]
