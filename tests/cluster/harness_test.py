#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests cluster/two_hosts and cluster/local_slurm: they run their commands and leave no process behind, however they
end.
Exits with code 77 if they cannot run here; the output gives the reason."""
import os
import signal
import subprocess
import sys
import tempfile
import unittest
import uuid
from pathlib import Path

from support import CLUSTER, wait_until

TWO_HOSTS = CLUSTER / "two_hosts"
LOCAL_SLURM = CLUSTER / "local_slurm"
# Not root, but with permission to read every file, so that the test works in any folder:
UNPRIVILEGED = ["setpriv", "--reuid", "65534", "--regid", "65534", "--clear-groups",
          "--inh-caps", "+dac_override", "--ambient-caps", "+dac_override"]


def run(*command):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          check=False)


def programs_with(mark):
    """Returns the names of the processes, in any namespace, that have `mark` in their environment."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            if mark.encode() in (process / "environ").read_bytes():
                found.append((process / "comm").read_text(encoding="utf-8").strip())
        except OSError:
            pass  # the process has ended in the meantime
    return found


class Commands(unittest.TestCase):
    def test_exit_code_is_that_of_the_command(self):
        for script, code in (("exit 0", 0), ("exit 5", 5), ("kill -TERM $$", 128 + 15)):
            self.assertEqual(run(TWO_HOSTS, "sh", "-c", script).returncode, code)
        self.assertEqual(run(TWO_HOSTS, "--", "no-such-program").returncode, 127)
        self.assertEqual(run(TWO_HOSTS).returncode, 2)
        self.assertEqual(run(LOCAL_SLURM).returncode, 2)

    def test_mpirun_starts_ranks_on_both_hosts(self):
        done = run(TWO_HOSTS, "mpirun", "--hostfile", CLUSTER / "hostfile.example", "--map-by",
                   "ppr:1:node", "hostname")
        self.assertEqual(sorted(done.stdout.split()), ["node1", "node2"], done.stderr)

    def test_slurm_has_the_requested_number_of_nodes(self):
        for nodes, names in (("1", ["node1"]), ("2", ["node1", "node2"])):
            done = run(LOCAL_SLURM, "--nodes", nodes, "--", "srun", "-N", nodes, "hostname")
            self.assertEqual(sorted(done.stdout.split()), names, done.stderr)

    def test_missing_permission_is_reported(self):
        done = run(*UNPRIVILEGED, sys.executable, LOCAL_SLURM, "true")
        self.assertEqual(done.returncode, 77)
        self.assertIn("only root", done.stderr)

    def test_missing_hosts_file_is_reported(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run("unshare", "--mount", "sh", "-c", f"cp -a /etc {folder} && rm {folder}/etc/hosts && "
                       f"mount --bind {folder}/etc /etc && exec {LOCAL_SLURM} true")
        self.assertEqual(done.returncode, 77, done.stderr)
        self.assertIn("not possible on this machine: /etc/hosts is missing", done.stderr)


class Cleanup(unittest.TestCase):
    """Tests that no process remains after the harness ends."""

    def killed_by(self, number):
        mark = f"GROVE_TEST_MARK={uuid.uuid4()}"
        harness = subprocess.Popen(["env", mark, LOCAL_SLURM, "--nodes", "2", "srun", "sleep", "1000"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(harness.kill)
        programs = {"munged", "slurmctld", "slurmd", "srun", "sleep"}
        wait_until("a job in Slurm", lambda: programs <= set(programs_with(mark)), harness)
        harness.send_signal(number)
        self.assertEqual(harness.wait(), -9 if number == signal.SIGKILL else 128 + number)
        wait_until("all processes have ended", lambda: not programs_with(mark))

    def test_no_process_remains_after_sigint(self):
        self.killed_by(signal.SIGINT)

    def test_no_process_remains_after_sigterm(self):
        self.killed_by(signal.SIGTERM)

    def test_no_process_remains_after_sigkill(self):
        self.killed_by(signal.SIGKILL)

    def test_no_process_remains_after_the_command_has_ended(self):
        mark = f"GROVE_TEST_MARK={uuid.uuid4()}"
        with tempfile.TemporaryDirectory() as folder:
            ran = Path(folder) / "ran"
            job = f"touch {ran}; exec sleep 1000"
            run("env", mark, LOCAL_SLURM, "sh", "-c",
                f"sleep 1000 & srun sh -c '{job}' & until [ -e {ran} ]; do sleep 0.1; done")
            self.assertTrue(ran.exists())
        self.assertEqual(programs_with(mark), [])


def main():
    for harness in (TWO_HOSTS, LOCAL_SLURM):
        attempt = run(harness, "true")
        if attempt.returncode == 77:
            print(attempt.stderr.strip())
            sys.exit(77)
    unittest.main()


if __name__ == "__main__":
    main()
