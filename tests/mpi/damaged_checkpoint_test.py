# SPDX-License-Identifier: MIT
"""Checks that a job ends with an error that names the file if the last checksum of its checkpoint is wrong."""

import os
from pathlib import Path
import subprocess
import tempfile
import unittest

INSTANCE = Path(__file__).parents[2] / "benchmarks" / "data" / "first.cts.json"


def solve(folder, *options):
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    return subprocess.run(
        ["mpirun", "-np", "2", "--oversubscribe", "--bind-to", "none", os.environ["GROVE_MPI"],
         "solve", INSTANCE, "--threads", "1", "--quiet", "--output", folder / "plan.json",
         "--checkpoint", folder / "state", *options],
        env=environment, capture_output=True, text=True, timeout=60)


class DamagedCheckpoint(unittest.TestCase):
    def test_damaged_checkpoint_ends_the_job_and_names_the_file(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            first = solve(folder)
            self.assertEqual(first.returncode, 0, first.stderr)
            file = folder / "state" / "checkpoint.grove"
            content = bytearray(file.read_bytes())
            content[-1] ^= 1  # the last checksum, which is read only after all nodes
            file.write_bytes(content)
            resumed = solve(folder, "--resume", "auto")
            self.assertEqual(resumed.returncode, 2, resumed.stderr)
            self.assertIn("checkpoint.grove", resumed.stderr)
            self.assertIn("is damaged", resumed.stderr)


if __name__ == "__main__":
    unittest.main()
