#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests a solve on two hosts without Slurm, set up as docs/operators.md describes. Run by cluster/two_hosts."""
import os
import tempfile
import unittest
from pathlib import Path

from support import CLUSTER, EASY, checked_plan, recorded_hosts, recording_program, run
from mpi_test import MpiTest  # support.py has extended the module path


class TwoHosts(MpiTest):
    def solve(self, folder, *mpirun_options):
        run("mpirun", "--hostfile", CLUSTER / "hostfile.example", *mpirun_options,
            "--mca", "btl_tcp_if_include", "grove0", "--mca", "oob_tcp_if_include", "grove0",
            recording_program(folder), "solve", EASY, "--threads", 1, "--omega", 0,
            "--output", "plan.json", cwd=folder)
        return checked_plan(EASY, Path(folder) / "plan.json")

    def test_one_rank_per_host_solves(self):
        with tempfile.TemporaryDirectory() as folder:
            plan = self.solve(folder, "--map-by", "ppr:1:node", "--bind-to", "none")
            self.assertEqual(plan["status"], "optimal")
            self.assertEqual(recorded_hosts(folder), ["node1", "node2"])

    def test_two_ranks_per_host_solve(self):
        with tempfile.TemporaryDirectory() as folder:
            plan = self.solve(folder, "--map-by", "ppr:2:node", "--bind-to", "none")
            self.assertEqual(plan["status"], "optimal")
            self.assertEqual(recorded_hosts(folder), ["node1", "node1", "node2", "node2"])


if __name__ == "__main__":
    unittest.main()
