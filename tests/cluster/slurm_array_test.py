#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests cluster/array.sbatch, which solves a list of instances, one job each. Run by cluster/local_slurm."""
import shutil
import tempfile
import unittest
from pathlib import Path

from support import CLUSTER, DATA, checked_plan, submit_and_wait
from mpi_test import MpiTest  # support.py has extended the module path

NAMES = ["rooms-32x32_n5_m10", "empty-32x32_n5_m10", "first"]


class ArrayScript(MpiTest):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        shutil.copytree(DATA, self.folder / "data")
        lines = [f"{name}.cts.json\n" for name in NAMES]
        (self.folder / "data/list.txt").write_text("".join(lines), encoding="utf-8")

    def exit_codes(self, array):
        return submit_and_wait(f"--array={array}", "--cpus-per-task=1", "--mem=1G",
                               CLUSTER / "array.sbatch", "data/list.txt", "--omega", "0",
                               cwd=self.folder)

    def test_each_line_has_its_plan(self):
        self.assertEqual(self.exit_codes("1-3"), [0, 0, 0])
        self.assertEqual(len(list(self.folder.glob("plans/*"))), 3)
        for line, name in enumerate(NAMES, 1):
            plan = checked_plan(DATA / f"{name}.cts.json",
                                self.folder / f"plans/{line}-{name}.plan.json")
            self.assertEqual(plan["status"], "optimal")

    def test_index_beyond_the_list_fails_without_the_others(self):
        self.assertEqual(sorted(self.exit_codes("3-4")), [0, 2])
        self.assertEqual([plan.name for plan in self.folder.glob("plans/*")],
                         ["3-first.plan.json"])


if __name__ == "__main__":
    unittest.main()
