#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests output files and signals.

The tests cover locks against a second run, links (no writes through them), permissions according to the umask,
messages about a full disk, and signals that arrive before the run starts.

    outputs_test.py GROVE
"""
import json
import os
import resource
import signal
import stat
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

GROVE = Path(sys.argv[1]).resolve()
DATA = Path(__file__).resolve().parents[3] / "benchmarks/data"
QUICK = DATA / "first.cts.json"
TIMEOUT_S = 120  # time limit of programs, in case they hang


class Outputs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.hard = self.folder / "hard.cts.json"
        self.run_it("generate", "instance", "--map", DATA / "rooms-32x32.map", "--agents", 60, "--tasks", 100,
                    "--seed", 1, "-o", self.hard)

    def run_it(self, *words, **more):
        return subprocess.run([GROVE, *map(str, words)], cwd=self.folder, capture_output=True, text=True,
                              timeout=TIMEOUT_S,
                              check=False, **more)

    def start(self, *words, **more):
        running = subprocess.Popen([GROVE, *map(str, words)], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True, **more)
        self.addCleanup(running.stdout.close)
        self.addCleanup(running.wait)
        self.addCleanup(running.kill)
        return running

    def read_until(self, running, words):
        """Reads the output until a line contains the words, and returns all lines read."""
        output = ""
        for line in running.stdout:
            output += line
            if words in line:
                return output
        self.fail(f"'{words}' is not in the output: {output}")


class OneAtATime(Outputs):
    def test_second_run_with_the_same_output_is_refused(self):
        outputs = {"-o": "x.plan.json", "--proof": "x.proof", "--log": "x.log", "--incumbents": "x"}
        words = [word for pair in outputs.items() for word in pair]
        self.run_it("solve", QUICK, "-o", "q.plan.json")
        (self.folder / "x.plan.json").write_text("{}")
        (self.folder / "link").symlink_to("x.plan.json")     # a link to the same file
        running = self.start("solve", self.hard, "--omega", 0, "--time-limit", TIMEOUT_S, *words)
        self.read_until(running, " %")     # the first plan
        for option, name in outputs.items():
            mine = ["-o", "y.plan.json"] if option != "-o" else []
            done = self.run_it("solve", QUICK, option, name, *mine)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
            self.assertRegex(done.stderr, r"^grove: error: x.*: is being written by another run "
                                          rf"\(process {running.pid} on host .*\); "
                                          "expected another name, or the end of that run\n$")
        for done in (self.run_it("solve", QUICK, "-o", "link"),
                     self.run_it("replan", QUICK, "q.plan.json", "--at", 0, "-o", "x.plan.json")):
            self.assertEqual(done.returncode, 2)
            self.assertIn("is being written by another run", done.stderr)
        running.send_signal(signal.SIGTERM)
        output, _ = running.communicate(timeout=TIMEOUT_S)
        self.assertEqual(running.returncode, 0, output)
        self.assertEqual([path.name for path in self.folder.iterdir() if path.name.startswith(".grove-")], [])
        checked = self.run_it("check", self.hard, "x.plan.json")
        self.assertEqual(checked.returncode, 0, checked.stderr + output)

    def test_lock_of_a_killed_run_does_not_block_the_next(self):
        running = self.start("solve", self.hard, "--omega", 0, "--time-limit", TIMEOUT_S, "-o", "x.plan.json")
        self.read_until(running, "lower bound")
        running.kill()
        running.wait()
        done = self.run_it("solve", QUICK, "-o", "x.plan.json")
        self.assertEqual(done.returncode, 0, done.stderr)


class Links(Outputs):
    def test_locks_and_parts_are_not_written_through_links(self):
        kept = self.folder / "kept"
        kept.mkdir()
        victim = self.folder / "victim"
        victim.write_text("precious")
        for name, words in (("kept/checkpoint.lock", ("--checkpoint", "kept")),
                            (".grove-x.proof.lock", ("--proof", "x.proof"))):
            (self.folder / name).symlink_to(victim)
            done = self.run_it("solve", QUICK, "-o", "q.plan.json", *words)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("link", done.stderr)
            (self.folder / name).unlink()
            os.link(victim, self.folder / name)
            self.assertEqual(self.run_it("solve", QUICK, "-o", "q.plan.json", *words).returncode, 2)
            (self.folder / name).unlink()
        (self.folder / "x.proof.part-0-0").symlink_to(self.folder / "made")
        done = self.run_it("solve", QUICK, "-o", "q.plan.json", "--proof", "x.proof")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertFalse((self.folder / "made").exists())
        self.assertEqual(victim.read_text(), "precious")


class Permissions(Outputs):
    def test_new_files_have_the_permissions_of_the_umask(self):
        for mask, expected in ((0o077, 0o600), (0o022, 0o644), (0o002, 0o664)):
            folder = self.folder / f"{mask:o}"
            folder.mkdir()
            done = subprocess.run([GROVE, "solve", QUICK, "--checkpoint", "kept", "--log", "run.log", "--proof",
                                   "c.proof",
                                   "--incumbents", "i", "--quiet"], cwd=folder, umask=mask, capture_output=True,
                                  text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            found = [path for path in folder.rglob("*") if path.is_file()]
            self.assertTrue({"checkpoint.grove", "checkpoint.lock", "run.log", "c.proof",
                             "first.plan.json"} <= {path.name for path in found}, found)
            for path in found:
                self.assertEqual(oct(stat.S_IMODE(path.stat().st_mode)), oct(expected), path)
            self.assertEqual(stat.S_IMODE((folder / "kept").stat().st_mode), 0o777 & ~mask)


class FullDisk(Outputs):
    @staticmethod
    def nearly_full():
        resource.setrlimit(resource.RLIMIT_FSIZE, (200, 200))

    def test_summary_is_printed_if_the_plan_is_not_written(self):
        done = self.run_it("solve", QUICK, "-o", "x.plan.json", preexec_fn=self.nearly_full)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stdout, r"\nStatus +optimal\nCost +\d+\nLower bound +\d+\n")
        self.assertRegex(done.stdout, r"\nPlan file +x\.plan\.json was not written\n$")
        self.assertEqual(done.stderr, "grove: error: x.plan.json: cannot be written: File too large\n")
        self.assertFalse((self.folder / "x.plan.json").exists())

    def test_jsonl_summary_is_printed_if_the_plan_is_not_written(self):
        done = self.run_it("solve", QUICK, "-o", "x.plan.json", "--log-format", "jsonl", preexec_fn=self.nearly_full)
        self.assertEqual(done.returncode, 1, done.stderr)
        summary = json.loads(done.stdout.splitlines()[-1])
        self.assertEqual((summary["event"], summary["status"], summary["plan_file"]), ("summary", "optimal", None))

    def test_full_special_file_is_an_error(self):
        done = self.run_it("solve", QUICK, "-o", "/dev/full")
        self.assertEqual(done.returncode, 1)
        self.assertIn("Lower bound", done.stdout)
        self.assertIn("No space left on device", done.stderr)

    def test_disk_full_during_recording_of_a_certificate(self):
        running = self.start("solve", self.hard, "--omega", 0, "--time-limit", TIMEOUT_S, "-o", "x.plan.json",
                             "--proof", "x.proof",
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (60_000, 60_000)))
        part = self.folder / "x.proof.part-0-0"
        output = self.read_until(running, "lower bound")
        while part.exists():  # until the file size limit is reached
            self.assertIsNone(running.poll())
        running.send_signal(signal.SIGTERM)
        rest, _ = running.communicate(timeout=TIMEOUT_S)
        self.assertEqual(running.returncode, 1, output + rest)
        self.assertRegex(rest, r"\nCost +\d+\nLower bound +\d+\n")
        self.assertRegex(rest, r"\nProof file +x\.proof: none was written\n")
        self.assertIn("grove: error: x.proof.part-0-0: cannot be written: File too large\n", rest)
        self.assertEqual(self.run_it("check", self.hard, "x.plan.json").returncode, 0)
        self.assertEqual(list(self.folder.glob("*.part-*")), [])

    @unittest.skipUnless(os.access("/dev", os.W_OK), "only root can write the parts of a certificate next to /dev/full")
    def test_disk_full_at_the_end_of_a_certificate(self):
        done = self.run_it("solve", QUICK, "-o", "x.plan.json", "--proof", "/dev/full")
        self.assertIn("Lower bound", done.stdout)
        self.assertEqual(done.returncode, 1, done.stderr)


class Signals(Outputs):
    @staticmethod
    def signal_waiting():
        """Makes SIGUSR1, which requests a checkpoint, pending before the program starts."""
        signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGUSR1])
        os.kill(os.getpid(), signal.SIGUSR1)

    def test_checkpoint_request_before_the_run_is_served(self):
        running = self.start("solve", self.hard, "--omega", 0, "--time-limit", TIMEOUT_S, "--checkpoint", "kept",
                             preexec_fn=self.signal_waiting)
        output = self.read_until(running, "Checkpoint of")  # the first periodic checkpoint would come after ten minutes
        running.send_signal(signal.SIGTERM)
        rest, _ = running.communicate(timeout=TIMEOUT_S)
        self.assertEqual(running.returncode, 0, output + rest)
        self.assertTrue((self.folder / "kept/checkpoint.grove").exists())

    def test_sigusr1_ends_no_command(self):
        """Sends SIGUSR1 to commands while they wait for their instance on standard input."""
        for words in (("check", "-", "none.plan.json"), ("view", "-"), ("solve", "-")):
            running = self.start(*words, stdin=subprocess.PIPE)
            while not self.catches(running.pid, signal.SIGUSR1):
                self.assertIsNone(running.poll())
            running.send_signal(signal.SIGUSR1)
            running.communicate("{}", timeout=TIMEOUT_S)
            self.assertEqual(running.returncode, 2, words)

    @staticmethod
    def catches(pid, number):
        status = dict(line.split(":", 1) for line in Path(f"/proc/{pid}/status").read_text().splitlines())
        return int(status["SigCgt"], 16) >> (number - 1) & 1


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
