#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests cluster/solve.sbatch, which solves one instance on two nodes. Run by cluster/local_slurm --nodes 2."""
import os
import tempfile
import unittest
from pathlib import Path

from support import (CLUSTER, EASY, checked_plan, recorded_hosts, recording_program,
                     submit_and_wait)
from mpi_test import MpiTest  # support.py has extended the module path


class SolveScript(MpiTest):
    def test_ranks_on_two_nodes_solve_one_instance(self):
        with tempfile.TemporaryDirectory() as folder:
            codes = submit_and_wait(
                "--cpus-per-task=1", "--mem=1G", "--output=log", CLUSTER / "solve.sbatch", EASY,
                "--omega", "0", "--output", "plan.json", cwd=folder,
                env={**os.environ, "GROVE_MPI": str(recording_program(folder))})
            log = (Path(folder) / "log").read_text(encoding="utf-8")
            self.assertEqual(codes, [0], log)
            self.assertEqual(recorded_hosts(folder), ["node1", "node2"])
            plan = checked_plan(EASY, Path(folder) / "plan.json")
            self.assertEqual(plan["status"], "optimal", log)

    def test_job_runs_with_all_requests_of_memory_and_nodes(self):
        for options in (["--mem=0"], ["--mem-per-cpu=500M"], ["--exclusive"], ["--exclusive", "--mem-per-cpu=500M"],
                        []):
            with self.subTest(options), tempfile.TemporaryDirectory() as folder:
                codes = submit_and_wait("--cpus-per-task=1", "--output=log", *options, CLUSTER / "solve.sbatch", EASY,
                                        "--output", "plan.json", cwd=folder)
                log = (Path(folder) / "log").read_text(encoding="utf-8")
                self.assertEqual(codes, [0], log)
                checked_plan(EASY, Path(folder) / "plan.json")
                self.assertEqual("0.5 GB of them granted" in log, "--mem-per-cpu=500M" in options, log)


if __name__ == "__main__":
    unittest.main()
