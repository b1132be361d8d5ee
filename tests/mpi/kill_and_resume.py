#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Kills a distributed solve at random moments and goes on from its checkpoint, with another number
of ranks each time, until it ends; the answer must be the one of an undisturbed run.

    kill_and_resume.py [--kills N] [--seed S] [--most-seconds T] INSTANCE

GROVE and GROVE_MPI name the programs.
"""
import argparse
import os
import random
import signal
import sys
import tempfile
import time
from pathlib import Path

from mpi_program import GROVE, mpirun, plan_of, processes_of, run, start


def undisturbed(instance, folder):
    code, said = run([GROVE, "solve", instance, "--omega", 0, "--quiet", "--output", "plan.json"],
                     folder)
    assert code == 0, said
    plan = plan_of(Path(folder) / "plan.json")
    assert plan["status"] == "optimal", plan["status"]
    return plan["cost"]


def kill_a_rank(running, dice, most_seconds):
    """So long after they have started, at most."""
    while not (ranks := processes_of(running)) and running.poll() is None:
        time.sleep(0.02)
    time.sleep(dice.uniform(0.3, most_seconds))
    if running.poll() is None:
        os.kill(dice.choice(sorted(ranks.values())), signal.SIGKILL)


def disturbed(instance, folder, kills, dice, most_seconds):
    """The plan in the end, and how many runs were killed before theirs."""
    killed = 0
    while True:
        ranks = dice.choice([1, 2, 3, 4])
        running = start(mpirun(ranks, "solve", instance, "--omega", 0, "--threads", 1,
                               "--checkpoint", "kept", "--checkpoint-interval", 0.2,
                               "--resume", "auto", "--output", "plan.json"), folder)
        if killed < kills:
            kill_a_rank(running, dice, most_seconds)
        said, _ = running.communicate()
        if running.returncode == 0:
            return plan_of(Path(folder) / "plan.json"), killed
        assert killed < kills, said
        killed += 1
        print(f"killed one of {ranks} ranks: mpirun ended with {running.returncode}")


def check(instance, kills, seed, most_seconds=2.0):
    dice = random.Random(seed)
    with tempfile.TemporaryDirectory() as folder:
        truth = undisturbed(instance, folder)
        plan, killed = disturbed(instance, folder, kills, dice, most_seconds)
        assert (plan["status"], plan["cost"]) == ("optimal", truth), (plan["status"], plan["cost"])
        code, said = run([GROVE, "check", instance, "plan.json"], folder)
        assert code == 0, said
        print(f"{killed} kills, then optimal with cost {truth}")
        return killed


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("instance", type=Path)
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--most-seconds", type=float, default=2.0)
    a = parser.parse_args()
    check(a.instance.resolve(), a.kills, a.seed, a.most_seconds)
    return 0


if __name__ == "__main__":
    sys.exit(main())
