#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests cluster/preempt.sbatch: a pre-empted and restarted search resumes from its checkpoint. Run by
cluster/local_slurm."""
import os
import re
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from support import CLUSTER, checked_plan, hard_instance, run, submit_and_wait, wait_until

RESUMED = re.compile(r"\bresum(ed|es|ing)\b", re.I)
TIME_LIMIT_S = 60  # longer than any run here takes


class PreemptScript:
    """Base class for tests that run the script on an instance that the job cannot solve in its time."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.plan = self.folder / "hard.plan.json"
        self.instance = hard_instance(self.folder)
        self.job = run("sbatch", "--parsable", "--nodes=1", "--ntasks-per-node=2",
                       "--cpus-per-task=1", "--mem=1G", "--time=10", "--output=log",
                       CLUSTER / "preempt.sbatch", self.instance, "--omega", "0",
                       "--time-limit", TIME_LIMIT_S, cwd=self.folder).strip()
        self.addCleanup(subprocess.run, ["scancel", self.job], check=False)
        # Without an expansion there is nothing to resume from.
        wait_until("a plan and an expansion", lambda: re.search(r"^[A-Z* ] +[1-9]\d*( +\d+){4} ", self.log(), re.M))

    def log(self):
        path = self.folder / "log"
        return path.read_text(encoding="utf-8") if path.exists() else ""

    def rows(self, since=0):
        """Returns one entry for each row with an incumbent in the log from position `since` on."""
        return re.findall(r"^[A-Z* ]( +\d+){5} ", self.log()[since:], re.M)

    def job_is(self, **fields):
        """Returns whether Slurm reports these field values for the job, for example job_is(JobState="RUNNING")."""
        output = run("scontrol", "--oneliner", "show", "job", self.job)
        return all(f" {name}={value} " in output for name, value in fields.items())

    def wait_until_job_is(self, **fields):
        try:
            wait_until(f"{fields} in scontrol show job", lambda: self.job_is(**fields))
        except AssertionError as error:
            raise AssertionError(f"{error}\n{run('scontrol', 'show', 'job', self.job)}\n"
                                 f"{self.log()}") from error

    def checkpoint_files(self):
        return list((self.folder / "hard.checkpoint").rglob("checkpoint.grove"))

    def second_run(self, bound_before):
        """Asserts that the requeued job resumes the search. Then cancels the job and checks its plan and bound."""
        before = len(self.log())
        wait_until("the second run", lambda: self.starts_again() and self.rows(before))
        self.assertRegex(self.log()[before:], RESUMED)
        run("scancel", self.job)
        self.wait_until_job_is(JobState="CANCELLED")
        plan = checked_plan(self.instance, self.plan)
        self.assertEqual(plan["stats"]["stopped_by"], "interrupt")
        self.assertGreaterEqual(plan["lower_bound"], bound_before)

    def starts_again(self):
        """Releases a pending job after 2 s instead of Slurm's delay of two minutes, and returns True.

        A node can refuse a job in the second in which its previous run ends ("already killed"), after which Slurm holds
        the job indefinitely."""
        if self.job_is(JobState="PENDING"):
            time.sleep(2)
            for command in (["release", self.job], ["update", f"JobId={self.job}", "StartTime=now"]):
                subprocess.run(["scontrol", *command], check=False)
        return True


class AnUrgentJob(PreemptScript, unittest.TestCase):
    def test_job_with_a_requested_checkpoint_resumes_after_preemption(self):
        self.assertEqual(self.checkpoint_files(), [])
        run("scancel", "--signal=USR1", self.job)
        wait_until("a checkpoint", self.checkpoint_files)
        self.assertTrue(self.job_is(JobState="RUNNING"))
        self.assertNotRegex(self.log(), RESUMED)
        submit_and_wait("--partition=urgent", "--exclusive", "--output=/dev/null", "--wrap=true",
                        cwd=self.folder)
        self.wait_until_job_is(JobState="PENDING", Restarts="1")
        self.assertIn("Plan file", self.log())
        self.second_run(checked_plan(self.instance, self.plan)["lower_bound"])


class TimeOfGrace(PreemptScript, unittest.TestCase):
    def test_interrupted_ranks_end_in_time_and_the_job_is_requeued(self):
        # On a cluster with GraceTime, Slurm first sends SIGTERM to the ranks but not to the script.
        run("scancel", "--signal=TERM", self.job)
        self.wait_until_job_is(JobState="PENDING", Restarts="1")
        plan = checked_plan(self.instance, self.plan)
        self.assertEqual(plan["stats"]["stopped_by"], "interrupt")
        self.assertNotRegex(self.log(), RESUMED)
        self.second_run(plan["lower_bound"])


class Cancelled(PreemptScript, unittest.TestCase):
    def test_cancelled_job_writes_its_plan_and_is_not_requeued(self):
        run("scancel", self.job)
        self.wait_until_job_is(JobState="CANCELLED", Restarts="0")
        self.assertIn("Plan file", self.log())
        self.assertEqual(checked_plan(self.instance, self.plan)["stats"]["stopped_by"],
                         "interrupt")
        self.assertFalse(run("squeue", "--noheader"))


if __name__ == "__main__":
    unittest.main()
