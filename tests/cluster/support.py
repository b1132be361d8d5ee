# SPDX-License-Identifier: MIT
"""Provides helpers for the cluster tests, which run inside cluster/local_slurm or cluster/two_hosts.

The environment variable GROVE_MPI names the program under test, and GROVE the plan checker."""
import json
import os
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from waiting import wait_until  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
CLUSTER = ROOT / "cluster"
DATA = ROOT / "benchmarks/data"
EASY = DATA / "rooms-32x32_n10_m30.cts.json"  # solved to optimality within a second


def program(variable):
    """Returns the path of the program named by an environment variable."""
    path = os.environ.get(variable, "")
    if not os.access(path, os.X_OK):
        raise AssertionError(f"the environment variable {variable} must name a program; found "
                             f"'{path}'")
    return path


def run(*command, **options):
    """Returns the output of a command. Raises AssertionError with the output if the exit code is not 0."""
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}\nexited with code {done.returncode}:\n"
                             f"{done.stdout}")
    return done.stdout


def submit_and_wait(*arguments, **options):
    """Calls sbatch, waits, and returns the exit codes of the job, or of all jobs of an array. Polls by itself,
    because sbatch --wait polls only every few seconds."""
    job = run("sbatch", "--parsable", *arguments, **options).strip()
    wait_until(f"job {job} has ended", lambda: not run("squeue", "--noheader", "--jobs", job))
    output = run("scontrol", "show", "job", job)
    return [int(code) for code in re.findall(r" ExitCode=(\d+):", output)]


def recording_program(folder):
    """Writes a program that runs GROVE_MPI and appends the host name of each started rank to `folder`/ranks. Returns
    its path."""
    path = Path(folder) / "recording-grove-mpi"
    path.write_text(f'#!/bin/sh\nhostname >>"{folder}/ranks"\n'
                    f'exec "{program("GROVE_MPI")}" "$@"\n', encoding="utf-8")
    path.chmod(0o755)
    return path


def recorded_hosts(folder):
    return sorted((Path(folder) / "ranks").read_text(encoding="utf-8").split())


def checked_plan(instance, plan):
    """Returns the content of the plan file after `grove check` has accepted it."""
    run(program("GROVE"), "check", instance, plan)
    return json.loads(Path(plan).read_text(encoding="utf-8"))


def hard_instance(folder):
    """Generates an instance for which the search finds plans soon but no proof within a minute. Returns its path."""
    path = Path(folder) / "hard.cts.json"
    run(program("GROVE"), "generate", "instance", "--map", DATA / "rooms-32x32.map",
        "--agents", 30, "--tasks", 60, "--seed", 1, "-o", path)
    return path
