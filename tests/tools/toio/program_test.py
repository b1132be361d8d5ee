# SPDX-License-Identifier: MIT
"""Tests the program grove-toio: the demonstration, messages and exit codes."""
import functools
import json
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import in_process
import orders
from grove_toio.cli import main

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from waiting import HANG_S, text_of, wait_until  # noqa: E402


def start(*arguments):
    return subprocess.Popen([orders.GROVE.parent / "grove-toio", *map(str, arguments)], text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def run(*arguments):
    process = start(*arguments)
    out, err = process.communicate(timeout=HANG_S)
    return process.returncode, out, err


class Program(unittest.TestCase):
    def test_grove_toio_starts_the_program(self):
        done = subprocess.run([orders.GROVE, "toio", "--help"], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("ORDER.json", done.stdout)

    def test_demonstration_visits_all_tasks(self):
        with tempfile.TemporaryDirectory() as folder:
            log = Path(folder) / "drive.jsonl"
            code, out, err = run("--demo", "--fast", "--log", log)
            self.assertEqual((code, err), (0, ""))
            self.assertIn("3 robots", out)
            self.assertIn("Tasks         all visited", out)
            self.assertRegex(out, r"Distance      at least [5-9]\d\.\d mm between centres")
            self.assertEqual(json.loads(log.read_text().splitlines()[0])["robots"], ["purple", "yellow", "green"])

    def test_equal_runs_write_equal_logs(self):
        with tempfile.TemporaryDirectory() as folder:
            logs = [Path(folder) / name for name in ("a", "b")]
            for log in logs:
                done = run(orders.order_file("dense"), "--fast", "--loss", 0.2, "--log", log, "--quiet")
                self.assertEqual(done, (0, "", ""))
            self.assertEqual(*(log.read_bytes() for log in logs))

    def test_incomplete_drive_is_an_error(self):
        code, out, err = run(orders.order_file("dense"), "--fast", "--lift", "a0@2=never", "--time-limit", "40")
        self.assertEqual(code, 1)
        self.assertIn("Tasks         not all visited", out)
        self.assertTrue(err.startswith("grove: error: not done within 40 s: "), err)
        self.assertIn("a0 is off the mat", err)
        self.assertEqual(err.count("\n"), 1)

    def test_signals_end_a_drive(self):
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            with self.subTest(signal=number), tempfile.TemporaryDirectory() as folder:
                log = Path(folder) / "drive.jsonl"
                process = start(orders.order_file("dense"), "--log", log)
                wait_until("robots drive", lambda: '"moving"' in text_of(log), process)
                process.send_signal(number)
                process.communicate(timeout=HANG_S)
                self.assertEqual(process.returncode, code)

    def refused(self, text, *arguments, code=2, by=run):
        found, out, err = by(*arguments)
        self.assertEqual(found, code, err)
        self.assertTrue(err.startswith("grove: error: "), err)
        self.assertEqual(err.count("\n"), 1, err)
        self.assertIn(text, err)
        self.assertNotIn("Traceback", err)

    def test_wrong_input_is_refused(self):
        order, ring, missing = orders.order_file("dense"), orders.order_file("round"), orders.folder() / "none.json"
        plan = orders.folder() / "dense.plan.json"
        for text, *arguments in (
                ("none.json: cannot be read", missing), ("/format: found null", plan),
                ("/ring: found a ring of 4 robots on cells", ring),
                ("ORDER.json", ), ("ORDER.json", order, "--demo"), ("--moon", order, "--moon"),
                ("--mat: found 'moon'", order, "--mat", "moon"), ("--mat: found '5,5,1,1'", order, "--mat", "5,5,1,1"),
                ("--mat: found 304 x 216 units for 9 x 9", order, "--cells", "9x9"),
                ("--cells: found 2x2", order, "--cells", "2x2"), ("--cells: found 'x'", order, "--cells", "x"),
                ("--pitch: found 60", order, "--pitch", "60"), ("--pitch", order, "--pitch", "nan"),
                ("--loss: found '2'", order, "--loss", "2"), ("--noise", order, "--noise", "9"),
                ("--speed: found '9'", order, "--speed", "9"), ("--seed", order, "--seed", "-1"),
                ("--lift: found 'a0@1'", order, "--lift", "a0@1"), ("expected one of a0", order, "--lift", "x@1=1"),
                ("--cube", order, "--cube", "a0=toio-x"), ("--cube", order, "--bluetooth", "--cube", "a0"),
                ("--fast: requires simulated cubes; found --bluetooth", order, "--bluetooth", "--fast"),
                ("not allowed with", order, "--bluetooth", "--simulate"),
                ("cannot be written", order, "--log", orders.folder() / "no" / "log")):
            with self.subTest(arguments=arguments):
                self.refused(text, *arguments, by=functools.partial(in_process.run, main))
        self.refused("none.json: cannot be read", missing)

    def test_full_disk_is_an_error(self):
        self.refused("No space left", orders.order_file("dense"), "--fast", "--quiet", "--log", "/dev/full", code=1)
