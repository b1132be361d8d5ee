# SPDX-License-Identifier: MIT
"""What the tests of the cluster folder share. They run inside cluster/local_slurm or
cluster/two_hosts, with the program to test in GROVE_MPI and the checker of plans in GROVE."""
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
    """The program that an environment variable names."""
    path = os.environ.get(variable, "")
    if not os.access(path, os.X_OK):
        raise AssertionError(f"the environment variable {variable} must name a program, and is "
                             f"'{path}'")
    return path


def run(*command, **options):
    """What it printed; an error, with all that it said, if it does not end with 0."""
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}\nended with {done.returncode}:\n"
                             f"{done.stdout}")
    return done.stdout


def submit_and_wait(*arguments, **options):
    """Calls sbatch; returns the exit codes of the job, or of all jobs of the array, when it has
    ended. (sbatch --wait looks but every few seconds.)"""
    job = run("sbatch", "--parsable", *arguments, **options).strip()
    wait_until(f"job {job} has ended", lambda: not run("squeue", "--noheader", "--jobs", job))
    said = run("scontrol", "show", "job", job)
    return [int(code) for code in re.findall(r" ExitCode=(\d+):", said)]


def recording_program(folder):
    """A program that is GROVE_MPI but for a line in `folder`/ranks for every start of a rank: its
    host."""
    path = Path(folder) / "recording-grove-mpi"
    path.write_text(f'#!/bin/sh\nhostname >>"{folder}/ranks"\n'
                    f'exec "{program("GROVE_MPI")}" "$@"\n', encoding="utf-8")
    path.chmod(0o755)
    return path


def recorded_hosts(folder):
    return sorted((Path(folder) / "ranks").read_text(encoding="utf-8").split())


def checked_plan(instance, plan):
    """The plan file's content, after grove check has said that it is valid."""
    run(program("GROVE"), "check", instance, plan)
    return json.loads(Path(plan).read_text(encoding="utf-8"))


def hard_instance(folder):
    """An instance on which the search finds plans soon, but no proof within a minute."""
    path = Path(folder) / "hard.cts.json"
    run(program("GROVE"), "generate", "instance", "--map", DATA / "rooms-32x32.map",
        "--agents", 30, "--tasks", 60, "--seed", 1, "-o", path)
    return path
