#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests untrusted instances: which content of named files messages quote, what --confine refuses, and how much
memory small files can require.

    hostile_files_test.py GROVE [GROVE_VERIFY]
"""
import json
import os
import resource
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

GROVE = Path(sys.argv[1]).resolve()
VERIFY = Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None
SECRET = "root:hunter2:19000"
MAP = "type octile\nheight 1\nwidth 3\nmap\n...\n"
ROBOTS = {"agents": [{"id": "a", "start": [0, 0], "goal": [2, 0]}], "tasks": []}
MEMORY_GB = 0.2
KILLED_GB = 4  # limit on the address space of the program, in GB


class Hostile(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.top = Path(holder.name)
        self.folder = self.top / "theirs"
        (self.folder / "below").mkdir(parents=True)
        self.write("secret", SECRET + "\n", self.top)
        for name in ("ours.map", "theirs/inside.map", "theirs/below/map.map"):
            self.write(name, MAP, self.top)

    def write(self, name, content, folder=None):
        path = (folder or self.folder) / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def instance(self, more, name="i.cts.json"):
        return self.write(name, json.dumps({**ROBOTS, **more}))

    def run_it(self, *words):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (KILLED_GB << 30, KILLED_GB << 30))
        return subprocess.run([GROVE, *map(str, words)], cwd=self.folder, capture_output=True, text=True, timeout=120,
                              preexec_fn=limit, check=False)

    def refused(self, *words):
        done = self.run_it(*words)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr


class Messages(Hostile):
    def test_file_that_is_no_map_is_not_quoted(self):
        for key in ("map", "roadmap"):
            for name in (self.top / "secret", "../secret"):
                message = self.refused("check", self.instance({key: str(name)}), "none.plan.json")
                self.assertNotIn("hunter2", message)
                self.assertIn("secret", message)   # only the file name, not its content
                self.assertIn("expected", message)
        message = self.refused("solve", self.instance({"map": "/proc/self/environ"}))
        self.assertNotIn("=", message)

    def test_file_that_does_not_begin_as_a_roadmap_is_not_quoted(self):
        for content in (f'"{SECRET}"', "1" * 30, "1e999", f'["{SECRET}"]', "true"):
            self.write("other", content)
            message = self.refused("check", self.instance({"roadmap": "other"}), "none.plan.json")
            for word in ("hunter2", "111", "1e999"):
                self.assertNotIn(word, message)

    def test_malformed_map_is_quoted(self):
        self.write("bad.map", MAP.replace("width 3", "width x"))
        self.assertIn("found 'x'", self.refused("check", self.instance({"map": "bad.map"}), "none.plan.json"))

    def test_file_that_is_no_image_is_not_quoted(self):
        for suffix in ("pgm", "png"):
            image = self.write(f"other.{suffix}", f"# a comment\n{SECRET}\n")
            self.write("m.yaml", f"image: {image}\nresolution: 0.1\norigin: [0, 0, 0]\n")
            self.assertNotIn("hunter2", self.refused("convert", "m.yaml", "out.map", "--cell-size", 0.1))

    @unittest.skipUnless(VERIFY, "no grove-verify")
    def test_grove_verify_quotes_nothing(self):
        self.write("proof", "grove-proof 1\n")
        for key in ("map", "roadmap"):
            done = subprocess.run([VERIFY, self.instance({key: "../secret"}), self.folder / "proof"],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertNotIn("hunter2", done.stdout + done.stderr)


def commands(instance, plan):
    """Yields the arguments of each command that reads an instance, except bench."""
    yield "solve", instance, "-o", "out.plan.json", "--quiet"
    yield "check", instance, plan
    yield "view", instance, plan, "-o", "out.html"
    yield "replan", instance, plan, "--at", 1, "-o", "then.plan.json", "--output-instance", "then.cts.json", "--quiet"
    yield "execute", instance, plan, "--order", "out.order.json"
    yield "convert", instance, "out.mapfw.json", "--drop", "ids"


class Confined(Hostile):
    def setUp(self):
        super().setUp()
        (self.folder / "link.map").symlink_to("../ours.map")
        (self.folder / "up").symlink_to("..")
        (self.folder / "near.map").symlink_to("below/map.map")

    outside = ("../ours.map", "below/../../ours.map", "link.map", "up/ours.map", "up/theirs/../ours.map")
    inside = ("inside.map", "below/map.map", "below/../inside.map", "near.map", "./inside.map")

    def test_every_command_refuses_paths_outside_the_folder(self):
        plan = self.folder / "p.plan.json"
        self.run_it("solve", self.instance({"map": "inside.map"}), "-o", plan, "--quiet")
        self.assertTrue(plan.exists())
        for command in commands(self.instance({"map": "../ours.map"}), plan):
            with self.subTest(command=command[0]):
                self.assertEqual(self.run_it(*command).returncode, 0)  # without --confine a map anywhere is accepted
                message = self.refused(*command, "--confine")
                self.assertRegex(message, "/map: '../ours.map' leads outside the folder.*--confine")
        for command in commands(self.instance({"map": "inside.map"}), plan):
            with self.subTest(command=command[0]):
                done = self.run_it(*command, "--confine")
                self.assertEqual(done.returncode, 0, done.stderr)

    def test_paths_outside_the_folder_are_refused(self):
        for name in (*self.outside, str(self.folder / "inside.map"), str(self.top / "ours.map")):
            with self.subTest(name=name):
                self.assertIn("with --confine", self.refused("solve", self.instance({"map": name}), "--confine"))
        for name in self.inside:
            with self.subTest(name=name):
                done = self.run_it("solve", self.instance({"map": name}), "--confine", "--quiet")
                self.assertEqual(done.returncode, 0, done.stderr)

    def test_standard_input_is_confined_to_the_current_folder(self):
        for name, code in (("inside.map", 0), ("../ours.map", 2)):
            done = subprocess.run([GROVE, "solve", "-", "--confine", "--quiet"], cwd=self.folder, text=True,
                                  input=json.dumps({**ROBOTS, "map": name}), capture_output=True, timeout=60,
                                  check=False)
            self.assertEqual(done.returncode, code, done.stderr)

    def test_scenarios_and_images_are_confined(self):
        row = "0\t{}\t3\t1\t0\t0\t2\t0\t2\n"
        for name, code in (("inside.map", 0), ("link.map", 2)):
            self.write("s.scen", "version 1\n" + row.format(name))
            self.assertEqual(self.run_it("solve", "s.scen", "--agents", 1, "--quiet").returncode, 0)
            self.assertEqual(self.run_it("solve", "s.scen", "--agents", 1, "--confine", "--quiet").returncode, code)
        self.write("ours.pgm", "P2 3 1 255 255 255 255\n", self.top)
        self.write("m.yaml", "image: ../ours.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n")
        self.assertEqual(self.run_it("convert", "m.yaml", "out.map", "--cell-size", 0.1).returncode, 0)
        self.assertIn("m.yaml: image: '../ours.pgm' leads out",
                      self.refused("convert", "m.yaml", "out.map", "--cell-size", 0.1, "--confine"))

    def test_bench_is_confined(self):
        self.instance({"map": "../ours.map"})
        words = ("bench", self.folder / "i.cts.json", "--run", "a: --omega 0", "--time-limit", 20, "--quiet",
                 "--output-dir")
        self.assertEqual(self.run_it(*words, "open").returncode, 0)
        self.assertIn("leads out", self.run_it(*words, "confined", "--confine").stderr)

    @unittest.skipUnless(VERIFY, "no grove-verify")
    def test_grove_verify_is_confined(self):
        proof = self.folder / "c.proof"
        self.run_it("solve", self.instance({"map": "inside.map"}), "--omega", 0, "--proof", proof, "--quiet")
        for name, code in [*((name, 2) for name in self.outside), *((name, 0) for name in self.inside),
                           (str(self.folder / "inside.map"), 2)]:
            with self.subTest(name=name):
                done = subprocess.run([VERIFY, self.instance({"map": name}), proof, "--confine"], capture_output=True,
                                      text=True, check=False)
                self.assertEqual(done.returncode, code, done.stdout)


class Memory(Hostile):
    """Tests files of at most a few kilobytes that would require gigabytes of memory."""

    def refused_for_memory(self, *words, limit=True):
        message = self.refused(*words, *(["--memory-limit", MEMORY_GB] if limit else []))
        self.assertIn("memory", message)

    def test_long_roads_are_refused_for_memory(self):
        self.write("r.json", json.dumps({"vertices": [{"id": "A", "at": [0, 0]}, {"id": "B", "at": [1, 0]}],
                                         "edges": [{"from": "A", "to": "B", "steps": 67_000_000}]}))
        path = self.write("i.cts.json", json.dumps({"roadmap": "r.json",
                                                    "agents": [{"id": "a", "start": "A", "goal": "B"}], "tasks": []}))
        self.refused_for_memory("solve", path)

    def test_long_turns_and_durations_are_refused_for_memory(self):
        turning = {"motion": "turning", "heading": "E", "turn_steps": 65536}
        self.write("m.map", "type octile\nheight 1\nwidth 60\nmap\n" + "." * 60 + "\n")
        agents = [{"id": "a", "start": [0, 0], "goal": [2, 0], **turning}]
        self.refused_for_memory("solve", self.instance({"map": "m.map", "agents": agents}))
        tasks = [{"id": f"t{i}", "cell": [1, 0], "agents": ["a"], "duration": 65536} for i in range(60)]
        self.refused_for_memory("solve", self.instance({"map": "m.map", "tasks": tasks}))

    def test_small_instance_is_read_under_any_memory_limit(self):
        done = self.run_it("solve", self.instance({"map": "inside.map"}), "--memory-limit", 0, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_image_larger_than_its_file_is_refused(self):
        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        head = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 32767, 32767, 8, 0, 0, 0, 0))
        self.write("m.png", head + chunk(b"IDAT", zlib.compress(bytes(1000))) + chunk(b"IEND", b""))
        self.write("m.yaml", "image: m.png\nresolution: 0.1\norigin: [0, 0, 0]\n")
        self.assertIn("32767 x 32767 pixels", self.refused("convert", "m.yaml", "out.map", "--cell-size", 0.1))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
