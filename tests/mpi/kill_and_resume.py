#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Kills a distributed solve at random times and resumes it from its checkpoint until it ends, each time with a random
number of ranks.

It must prove the same optimal cost as an undisturbed run. With --script, cluster/preempt.sbatch resumes the solve, with
three ranks and with mpirun as a replacement for srun.

    kill_and_resume.py [--kills N] [--seed S] [--max-seconds T] [--script] INSTANCE

The environment variables GROVE and GROVE_MPI name the programs.
"""
import argparse
import os
import random
import signal
import sys
import tempfile
import time
from pathlib import Path

from mpi_program import GROVE, GROVE_MPI, mpirun, plan_of, processes_of, run, searches, start
from waiting import text_of, wait_until

PREEMPT = Path(__file__).resolve().parents[2] / "cluster/preempt.sbatch"
SRUN = """#!/bin/sh
while case $1 in --*) ;; *) false ;; esac; do shift; done
exec mpirun --oversubscribe --bind-to none -np 3 "$@"
"""
SLURM = {"SLURM_MEM_PER_NODE": "6000", "SLURM_CPUS_PER_TASK": "1", "SLURM_NTASKS_PER_NODE": "3", "SLURM_JOB_ID": "7"}


def undisturbed(instance, folder):
    code, output = run([GROVE, "solve", instance, "--omega", 0, "--quiet", "--output", "plan.json"],
                     folder)
    assert code == 0, output
    plan = plan_of(Path(folder) / "plan.json")
    assert plan["status"] == "optimal", plan["status"]
    return plan["cost"]


def kill_a_rank(running, dice, checkpoint, max_seconds):
    """Kills a random rank up to `max_seconds` after all ranks search. If `max_seconds` is None, kills it after the
    next checkpoint instead. Does nothing if the job ends before.

    (If a rank is killed while it connects, mpirun of Open MPI 4 can hang.)"""
    before = written_at(checkpoint)
    ranks = {}

    def is_moment():
        ranks.update(processes_of(running))
        return running.poll() is not None or ranks and all(map(searches, ranks.values())) and (
            max_seconds is not None or written_at(checkpoint) != before)

    wait_until("all ranks search", is_moment)
    if max_seconds is not None:
        time.sleep(dice.uniform(0, max_seconds))
    if running.poll() is None:
        try:
            os.kill(dice.choice(sorted(ranks.values())), signal.SIGKILL)
        except ProcessLookupError:
            pass  # the rank has just ended by itself


def written_at(file):
    return file.stat().st_mtime_ns if file.exists() else None


def lost(log):
    """Returns the number of times that the script reported a lost rank."""
    return text_of(log).count("A rank was lost")


def disturbed_script(instance, folder, kills, dice, max_seconds):
    """Kills ranks during one run of the job script, which restarts the solve by itself. Returns the final plan and
    the number of killed ranks."""
    (folder / "bin").mkdir()
    (folder / "bin/srun").write_text(SRUN, encoding="utf-8")
    (folder / "bin/srun").chmod(0o755)
    log = folder / "script-output"
    running = start(["sh", "-c", 'exec bash "$@" >script-output 2>&1', "sh", PREEMPT, "--restarts", kills, instance,
                     "--omega", 0, "--checkpoint-interval", 0.2, "--output", "plan.json"], folder,
                    PATH=f"{folder}/bin:{os.environ['PATH']}", GROVE_MPI=GROVE_MPI, **SLURM)
    killed = 0
    while killed < kills and running.poll() is None:
        checkpoint = folder / f"{instance.name.removesuffix('.cts.json')}.checkpoint/checkpoint.grove"
        kill_a_rank(running, dice, checkpoint, max_seconds)
        wait_until("the script has reported the lost rank",
                   lambda: running.poll() is not None or lost(log) > killed)
        killed = lost(log)
    code = running.wait()
    text = log.read_text(encoding="utf-8")
    assert code == 0, text
    print(f"{killed} killed, {text.count('Resuming from a checkpoint')} times resumed from a checkpoint")
    return plan_of(folder / "plan.json"), killed


def disturbed(instance, folder, kills, dice, max_seconds):
    """Returns the final plan and the number of runs that were killed before it was found."""
    killed = 0
    while True:
        ranks = dice.choice([1, 2, 3, 4])
        running = start(mpirun(ranks, "solve", instance, "--omega", 0, "--threads", 1,
                               "--checkpoint", "kept", "--checkpoint-interval", 0.2,
                               "--resume", "auto", "--output", "plan.json"), folder)
        if killed < kills:
            kill_a_rank(running, dice, Path(folder) / "kept/checkpoint.grove", max_seconds)
        output, _ = running.communicate()
        if running.returncode == 0:
            return plan_of(Path(folder) / "plan.json"), killed
        assert killed < kills, output
        killed += 1
        print(f"killed one of {ranks} ranks: mpirun exited with code {running.returncode}")


def check(instance, kills, seed, max_seconds=None, way=disturbed):
    dice = random.Random(seed)
    with tempfile.TemporaryDirectory() as folder:
        truth = undisturbed(instance, folder)
        plan, killed = way(instance, Path(folder), kills, dice, max_seconds)
        assert (plan["status"], plan["cost"]) == ("optimal", truth), (plan["status"], plan["cost"])
        code, output = run([GROVE, "check", instance, "plan.json"], folder)
        assert code == 0, output
        assert killed or not kills, "solved before a rank could be killed"
        print(f"{killed} kills, then optimal with cost {truth}")
        return killed


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("instance", type=Path)
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--max-seconds", type=float, default=2.0)
    parser.add_argument("--script", action="store_true", help="ten kills in a run of the job script")
    a = parser.parse_args()
    way, in_a_run = (disturbed_script, 10) if a.script else (disturbed, a.kills)
    kills = 0
    while kills < a.kills:
        kills += check(a.instance.resolve(), min(a.kills - kills, in_a_run), a.seed + kills, a.max_seconds, way)
    print(f"{kills} kills in all")
    return 0


if __name__ == "__main__":
    sys.exit(main())
