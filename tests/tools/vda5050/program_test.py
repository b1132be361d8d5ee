# SPDX-License-Identifier: MIT
"""Tests the program grove-vda5050, also with a broker: commands, messages and exit codes."""
import contextlib
import functools
import json
import shutil
import signal
import subprocess
import tempfile
import unittest
from pathlib import Path

import in_process
import orders
from grove_vda5050.cli import main
from grove_vda5050.trial import MOSQUITTO, own_broker

FAST = ("--speed", "4", "--turn-speed", "360", "--pace", "5")


def start(*arguments):
    return subprocess.Popen([orders.GROVE.parent / "grove-vda5050", *map(str, arguments)], text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def run(*arguments):
    process = start(*arguments)
    out, err = process.communicate(timeout=120)
    return process.returncode, out, err


def order(name="dense"):
    return orders.order_file(name, False)


class Refusals(unittest.TestCase):
    def refused(self, text, *arguments, by=functools.partial(in_process.run, main)):
        code, out, err = by(*arguments)
        self.assertEqual((code, out), (2, ""), err)
        self.assertTrue(err.startswith("grove: error: "), err)
        self.assertIn(text, err)
        self.assertEqual(err.count("\n"), 1, err)

    def test_unknown_command_is_refused_by_the_program(self):
        self.refused("invalid choice", "fly", by=run)

    def test_wrong_arguments_give_one_error_line(self):
        missing, ring = orders.folder() / "none.json", orders.order_file("round")
        for text, *arguments in (
                ("COMMAND",),
                ("invalid choice", "fly"),
                ("ORDER.json", "drive", "--broker", "localhost"),
                ("--broker", "drive", order()),
                ("found 'x:y'; expected HOST or HOST:PORT", "drive", order(), "--broker", "x:y"),
                ("cannot be reached", "drive", order(), "--broker", "127.0.0.1:1"),
                ("cannot be reached", "vehicles", order(), "--broker", "127.0.0.1:1"),
                ("cannot be reached", "watch", "--broker", "127.0.0.1:1"),
                ("none.json: cannot be read", "orders", missing, "-o", orders.folder()),
                ("found a ring of", "orders", ring, "-o", orders.folder()),
                ("--no-following", "drive", ring, "--broker", "localhost"),
                ("found '4'; expected 2.1 or 3.0", "orders", order(), "-o", "x", "--protocol", "4"),
                ("found 'a/b'; expected letters", "orders", order(), "-o", "x", "--map-id", "a/b"),
                ("found robot 'zz'", "orders", order(), "-o", "x", "--serial", "zz=1"),
                ("found 7 for a0 and a1", "orders", order(), "-o", "x", "--serial", "a0=7", "--serial", "a1=7"),
                ("found robot 'zz'", "trial", order(), "--stop", "zz@1=2"),
                ("found 'a0@1=never'", "trial", order(), "--stop", "a0@1=never"),
                ("found '0'; expected an integer of at least 1", "trial", order(), "--base", "0"),
                ("--ca-file: requires --tls", "drive", order(), "--broker", "localhost", "--ca-file", "x"),
                ("cannot be created", "orders", order(), "-o", "/dev/null/x")):
            with self.subTest(text=text):
                self.refused(text, *arguments)

    def test_help_lists_commands_and_options(self):
        done = subprocess.run([orders.GROVE, "vda5050", "--help"], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("--no-following", done.stdout)
        for command in ("orders", "drive", "vehicles", "watch", "trial"):
            code, out, err = in_process.run(main, command, "--help")
            self.assertEqual((code, err), (0, ""))
            self.assertIn(f"usage: grove vda5050 {command}", out)


class Orders(unittest.TestCase):
    def test_orders_are_written_to_files(self):
        with tempfile.TemporaryDirectory() as folder:
            code, out, err = run("orders", order("work"), "-o", folder, "--protocol", "3.0", "--serial", "a0=AGV-7",
                                 "--horizon", "2", "--manufacturer", "acme")
            self.assertEqual((code, err), (0, ""))
            self.assertIn("5 vehicles, VDA 5050 3.0.0", out)
            names = sorted(p.name for p in Path(folder).iterdir())
            self.assertEqual(names, ["AGV-7.order.json"] + [f"a{i}.order.json" for i in range(1, 5)])
            message = json.loads((Path(folder) / names[0]).read_text())
            self.assertEqual((message["version"], message["serialNumber"], message["manufacturer"]),
                             ("3.0.0", "AGV-7", "acme"))
            self.assertEqual(sum(not n["released"] for n in message["nodes"]), 2)


@unittest.skipUnless(shutil.which("mosquitto") or Path(MOSQUITTO).exists(), "no mosquitto")
class OverABroker(unittest.TestCase):
    def test_trial_completes_all_tasks(self):
        with tempfile.TemporaryDirectory() as folder:
            log = Path(folder) / "drive.jsonl"
            code, out, err = run("trial", order("many"), *FAST, "--protocol", "3.0", "--delayed", "0.05", "--delay",
                                 "1",
                                 "--stop", "a1@1=2", "--log", log)
            self.assertEqual((code, err), (0, ""), out)
            for text in ("Vehicles      9 of 9 done", "no vehicle drove to an occupied place",
                         "Released      nothing wrong", "all checked by the schemas of 3.0.0"):
                self.assertIn(text, out)
            lines = [json.loads(line) for line in log.read_text().splitlines()]
            self.assertEqual((lines[0]["format"], len(lines[0]["robots"])), ("grove drive 1", 9))
            last = {line["robot"]: line for line in lines[1:]}
            for robot in json.loads(order("many").read_text())["robots"]:
                line = last[robot["id"]]
                place = robot["actions"][-1]["to"] if robot["actions"] else robot["start"]
                self.assertEqual((line["state"], line["action"]), ("done", len(robot["actions"])))
                for one, other in zip(line["at"], place):
                    self.assertAlmostEqual(one, other, delta=0.01)

    def test_drive_vehicles_and_watch_run_separately(self):
        with own_broker() as broker, contextlib.ExitStack() as stack:
            watch = stack.enter_context(start("watch", "--broker", broker))
            self.assertIn("Watching", watch.stdout.readline())
            drive = stack.enter_context(start("drive", order(), "--broker", broker, "--serial", "a0=zero"))
            vehicles = stack.enter_context(start("vehicles", order(), "--broker", broker, "--serial", "a0=zero", *FAST))
            for process in (watch, drive, vehicles):
                stack.callback(process.kill)
            out, err = drive.communicate(timeout=120)
            self.assertEqual((drive.returncode, err), (0, ""), out)
            self.assertIn("6 of 6 done", out)
            for process, number, text in ((vehicles, signal.SIGTERM, "no vehicle drove to an occupied place"),
                                          (watch, signal.SIGINT, "Released      nothing wrong")):
                process.send_signal(number)
                out, err = process.communicate(timeout=120)
                self.assertEqual((process.returncode, err), (0, ""), out)
                self.assertIn(text, out)

    def test_drive_without_vehicles_is_an_error(self):
        with own_broker() as broker:
            code, out, err = run("drive", order("narrow"), "--broker", broker, "--time-limit", "1")
            self.assertEqual(code, 1)
            self.assertIn("0 of 2 done", out)
            self.assertEqual(err, "grove: error: not done within 1 s: up (up) has sent no state; down (down) has "
                                  "sent no state\n")

    def test_signals_end_a_drive(self):
        with own_broker() as broker:
            for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
                with start("drive", order(), "--broker", broker) as process:
                    process.stdout.readline()
                    process.stdout.readline()
                    process.send_signal(number)
                    _, err = process.communicate(timeout=120)
                    self.assertEqual((process.returncode, err), (code, ""))
