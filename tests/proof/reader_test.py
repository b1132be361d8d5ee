#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests grove-verify with arbitrary input: it prints one line and exits quickly with code 1 or 2.

    reader_test.py GROVE_VERIFY
"""
import ctypes
import ctypes.util
import json
import random
import shutil
import tempfile
import unittest
from pathlib import Path

import checkers
from rules_test import CROSS, CROSSED, HALL, certificate
from worlds import Agent, Instance, World

GOOD = certificate(CROSS, "lemma 5 0 1", *CROSSED, "theorem 5", "leaf 0")


def compressed(data):
    library = ctypes.CDLL(ctypes.util.find_library("zstd") or "libzstd.so.1")
    library.ZSTD_compressBound.restype = library.ZSTD_compress.restype = ctypes.c_size_t
    room = library.ZSTD_compressBound(ctypes.c_size_t(len(data)))
    out = ctypes.create_string_buffer(room)
    length = library.ZSTD_compress(out, ctypes.c_size_t(room), data, ctypes.c_size_t(len(data)), 1)
    return out.raw[:length]


def many(line):
    """Returns eight million copies of a line, compressed to less than 60,000 bytes. This process never holds the
    uncompressed lines, because the measured memory peak of a child starts at that of its parent."""
    frames = 80 * compressed(100_000 * line)
    assert len(frames) < 60_000
    return frames


class Reader(unittest.TestCase):
    def ends(self, data, codes=(1, 2), message="^(refused|unreadable): ", instance=CROSS, options=(), seconds=1):
        found = checkers.verify(instance, data, *options)
        self.assertIn(found.code, codes, (data[:200], found.text))
        self.assertRegex(found.text, message)
        self.assertEqual(found.text.count("\n"), 1, found.text)
        self.assertNotIn(".rs", found.text)  # no panic, for example because of an overflow
        self.assertLess(found.seconds, seconds, data[:200])
        return found

    def test_byte_order_marks_are_read(self):
        with tempfile.TemporaryDirectory() as name:
            path = CROSS.write(Path(name))
            for file in Path(name).iterdir():
                file.write_bytes(b"\xef\xbb\xbf" + file.read_bytes())
            weak = certificate(CROSS, "theorem 4", "leaf")
            self.ends(weak, (0,), "^verified: no plan costs less than 4\n", instance=path)
            self.assertEqual(checkers.small_checker(path, weak).code, 0)

    def test_compressed_certificates_are_read(self):
        whole = compressed(GOOD.encode())
        for data in (GOOD, whole, compressed(GOOD[:100].encode()) + compressed(GOOD[100:].encode())):
            self.ends(data, (0,), "^verified: no plan costs less than 5\n")
        for length in range(4, len(whole)):
            self.ends(whole[:length], (2,))
        self.ends(whole + b"x", (2,))
        rng = random.Random(1)
        for _ in range(60):
            broken = bytearray(whole)
            broken[rng.randrange(len(broken))] ^= 1 << rng.randrange(8)
            found = checkers.verify(CROSS, bytes(broken))
            self.assertTrue(found.code in (1, 2)
                            or (found.code, found.text) == (0, "verified: no plan costs less than 5\n"), found.text)

    def test_decompression_bomb_keeps_the_memory_limit(self):
        """Checks less than 60,000 bytes that decompress to hundreds of megabytes of nested splits."""
        bomb = compressed(GOOD.split("lemma")[0].encode() + b"theorem 5\n") + many(b"split 0 bar 4 1 1 | 1 bar 4 1 1\n")
        found = self.ends(bomb, (1,), "^refused: line [0-9]+: the memory limit is reached\n",
                          options=("--memory-limit", "0.05"), seconds=60)
        self.assertLess(found.memory, 0.05e9 + 150e6)  # the limit, plus the program and the window of zstd

    @unittest.skipUnless(shutil.which("zstd"), "no zstd")
    def test_small_checker_keeps_its_memory_limit(self):
        head = certificate(HALL, "theorem 99").removesuffix("end\n")
        bomb = compressed(head.encode()) + many(b"split 0 bar 7 2 2 | 1 bar 7 2 2\n")
        found = checkers.small_checker_within(100_000_000, HALL, bomb)
        self.assertEqual(found.code, 1, found.text)
        self.assertRegex(found.text, "^refused: needs more than 0.1 GB of memory\n$")
        self.assertLess(found.memory, 0.2e9)

    def test_truncated_certificates_are_refused(self):
        for length in range(len(GOOD)):
            self.ends(GOOD[:length])
        self.ends("", (2,), "^unreadable: line 1: expected more\n")

    def test_text_after_the_end_is_refused(self):
        for more in ("\n", "end\n", "leaf\n", " "):
            self.ends(GOOD + more, (2,))

    def test_invalid_lines_are_refused(self):
        lines = GOOD.split("\n")[:-1]
        for at in range(len(lines)):
            for other in ("", " ", "leaf ", "leaf  0", "leaf x", "leaf -1", "leaf +0", "joint 0", "prices 1", "lemma",
                          "lemma 5", "split", "split |",
                          "split 0 bar 4 1 1", "split 0 bar 4 1 1|1 bar 4 1 1", "split 0 bar 4 1 1 | 1 bar 4 1",
                          "split 0 bar 4 1 1 | 1 bar 4 1 1 1",
                          "demand", "demand 0 jump 4 1 1", "later", "later 0 2 1 2", "later 0 2 1 2 0 0", "theorem",
                          "theorem -1", "theorem 5 5",
                          "theorem inf ", "following", "instance", "instance 0", "grove-proof 2", "end ", "\t", "\0",
                          "é"):
                self.ends("\n".join([*lines[:at], other, *lines[at + 1:]]) + "\n")

    def test_random_bytes_are_refused(self):
        rng = random.Random(2)
        for count in (1, 10, 1000, 100000):
            self.ends(rng.randbytes(count))
            self.ends(b"\x28\xb5\x2f\xfd" + rng.randbytes(count), (2,))
            self.ends(GOOD.encode()[:60] + rng.randbytes(count))

    def test_random_changes_never_verify_another_theorem(self):
        rng = random.Random(3)
        words = GOOD.split(" ")
        for _ in range(300):
            changed = list(words)
            for _ in range(rng.randint(1, 3)):
                changed[rng.randrange(len(words))] = rng.choice(["inf", "0", "1", "4", str(2**30), str(2**32),
                                                                 str(2**64), "x", "bar", "|", "9" * 50])
            found = checkers.verify(CROSS, " ".join(changed))
            self.assertTrue(found.code in (1, 2) or found.text == "verified: no plan costs less than 5\n", changed)

    def test_changed_formulas_never_verify_another_theorem(self):
        lines = ["agent 0 0", "agent 1 0", "within 0 0", "within 1 0", "visit 0 3 0", "visit 0 4 1", "last 0 5 2",
                 "visit 1 1 0", "visit 1 4 1", "last 1 7 2", "sum -1 -2", "core 0"]
        good = certificate(CROSS, "theorem 5", "formula", *lines, "end")
        self.assertEqual(checkers.verify(CROSS, good).text, "verified: no plan costs less than 5\n")
        for length in range(len(good)):
            self.ends(good[:length])
        rng = random.Random(4)
        words = good.split(" ")
        for _ in range(300):
            changed = list(words)
            for _ in range(rng.randint(1, 3)):
                changed[rng.randrange(len(words))] = rng.choice(["inf", "0", "1", "-1", "4", str(2**30), str(2**64), "x", "-",
                                                                 "\ncore 0", "\nclause", "-2", "\ndrop 0", "--1"])
            found = checkers.verify(CROSS, " ".join(changed))
            self.assertTrue(found.code in (1, 2) or found.text == "verified: no plan costs less than 5\n", changed)

    def test_large_formulas_stay_within_their_limits(self):
        # All paths of a great excess, and many variables.
        self.ends(certificate(CROSS, "theorem 6", "formula", "agent 0 100000000", "end"), (1,), "^refused: ",
                  options=["--time-limit", "1", "--memory-limit", "0.1"], seconds=3)
        many = (f"visit 0 0 {time}" for time in range(3000000))
        self.ends(certificate(CROSS, "theorem 6", "formula", *many, "end"), (1,), "^refused: ",
                  options=["--memory-limit", "0.1"], seconds=5)

    def test_huge_numbers_are_refused(self):
        for number in (2**30 - 1, 2**30, 2**31, 2**32 - 1, 2**63, 2**64 - 1, 2**64, 10**100):
            for lines in (["theorem {}", "leaf"], ["theorem {}", "joint"], ["lemma {} 0", "leaf"],
                          ["lemma 0 {}", "leaf"], ["theorem 5", "leaf {}"],
                          ["theorem 5", "split 0 bar 4 {0} {0} | 1 bar 4 {0} {0}", "leaf", "leaf"],
                          ["theorem 5", "split 0 bar {0} 1 1 | 1 bar {0} 1 1"],
                          ["theorem 5", "split 0 norest 5 {0} | 0 rest 5 {0}", "leaf", "leaf"],
                          ["theorem 9", "later {0} {0} {0} {0} {0}"],
                          ["theorem 5", "split 0 stop {0} {0} | 0 nostop {0} {0}"],
                          ["theorem 5", "prices", "place 4 {} 1024", "end"],
                          ["theorem 5", "prices", "finish 0 {0} 1 {0} 0", "end"],
                          *(["theorem 5", "formula", *lines, "end"] for lines in
                            (["within {} 0"], ["within 0 {}"], ["agent {} 0"], ["visit 0 {} 0"], ["visit 0 0 {}"],
                             ["rests 0 {0} {0}"], ["node 0 {0} 0 0 0"], ["node 0 0 0 {0} {0}"], ["sum {}"], ["sum -{}"],
                             ["within 0 0", "sum 1 1", "count 0 0 {} 1"], ["within 0 0", "sum 1 1", "count 0 {0} {0} {0}"],
                             ["within 0 0", "sum 1 1", "count {} 0 2 1"], ["within 0 0", "clause {}"],
                             ["within 0 0", "clause -{}"], ["drop {}"], ["core {}"], ["split {0} {0}"],
                             ["meets 0 bar 4 {0} {0}"], ["inside 0 {0} 1 1"])),
                          ["lemma 5 0 1", "demand 0 bar 4 0 {}", "joint"]):
                self.ends(certificate(CROSS, *(line.format(number) for line in lines)), (1,), "^refused: ",
                          options=["--time-limit", "1"], seconds=2)
            for rows in (["place 4 1 {}"], ["place 4 1 {}"] * 2, ["edge 4 5 1 {0}", "place 5 2 {0}"]):
                rows = [row.format(number) for row in rows]
                self.ends(certificate(CROSS, "theorem 6", "prices", *rows, "end"), (1,), "^refused: ",
                          options=["--time-limit", "1"], seconds=2)

    def test_million_splits_without_leaves_are_refused(self):
        for split in ("0 bar 4 1 1 | 1 bar 4 1 1", "0 norest 5 2 | 0 rest 5 2", "1 bar 4 1 1 | 0 bar 4 1 1"):
            text = certificate(CROSS, "theorem 99").removesuffix("end\n") + f"split {split}\n" * 10**6
            self.ends(text, (2,), "line 1000005: expected more", seconds=5)
            self.ends(text + "leaf\n", (1, 2), seconds=5)
        self.ends(compressed(text.encode()), (2,), "line 1000005: expected more", seconds=5)

    def test_long_lines_and_large_files_are_refused(self):
        self.ends("leaf " * 10**6 + "\n", (2,))
        self.ends(certificate(CROSS, "lemma 5 0 1", "leaf " + "0 " * 10**6, "theorem 5", "leaf"))
        self.ends(compressed(b"x" * 10**8), (2,))
        self.ends(compressed(b"\n" * 10**8), (2,))
        self.ends(certificate(HALL, "lemma 0 0", *["demand 0 pass 9 10 1 2"] * 10**5, "leaf"), instance=HALL)

    def test_limits_are_reported(self):
        dense = Instance(World(["." * 8] * 8), [Agent((n,), 63 - n) for n in range(10)])
        text = certificate(dense, "theorem inf", "joint")
        self.ends(text, (1,), "^refused: line 5: the time limit is reached\n", dense, ["--time-limit", "0.3"])
        self.ends(text, (1,), "^refused: line 5: the memory limit is reached\n", dense, ["--memory-limit", "0.02"])

    def test_usage_errors_are_reported(self):
        for arguments in ([], ["one"], ["one", "two", "three"], ["one", "two", "--what"],
                          ["one", "two", "--time-limit"],
                          ["one", "two", "--time-limit", "0"], ["one", "two", "--memory-limit", "nan"]):
            found = checkers.Verdict([checkers.VERIFY, *arguments])
            self.assertEqual(found.code, 2)
            self.assertRegex(found.text, "^grove-verify: error: ")
        found = checkers.Verdict([checkers.VERIFY, "no/such", "no/such"])
        self.assertEqual((found.code, found.text), (2, "unreadable: no/such: No such file or directory (os error 2)\n"))

    def test_scenarios_are_read(self):
        good = certificate(CROSS, "theorem 5", "joint")
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            CROSS.write(folder)
            cells = [[place % 3 if axis == 0 else place // 3 for place in (agent.start[0], agent.goal)
                      for axis in (0, 1)] for agent in CROSS.agents]
            rows = ["\t".join(map(str, [0, "maps/tiny.map", 3, 3, *cell, 2.5])) for cell in cells]
            path = folder / "tiny.scen"
            path.write_text("\n".join(["version 1", *rows, "what is not asked for"]) + "\n")
            self.ends(good, (0,), "^verified: no plan costs less than 5\n", path, ["--agents", "2"])
            self.ends(good, (1,), "^refused: line 2: it is of another instance\n", path, ["--agents", "1"])
            self.ends(good, (2,), "line 4: expected bucket, map, size, start, goal and length\n", path,
                      ["--agents", "3"])
            for options in ([], ["--agents"], ["--agents", "0"], ["--agents", "1.5"], ["--agents", "2", "--map"]):
                self.assertRegex(checkers.verify(path, good, *options).text, "^grove-verify: error: ")
            self.assertRegex(checkers.verify(CROSS, good, "--agents", "2").text, "^grove-verify: error: ")
            (folder / "far").mkdir()
            (folder / "tiny.map").rename(folder / "far/tiny.map")
            self.ends(good, (2,), "tiny.map: No such file", path, ["--agents", "2"])
            self.ends(good, (0,), "^verified: ", path, ["--agents", "2", "--map", str(folder / "far/tiny.map")])
            (folder / "far/tiny.map").rename(folder / "tiny.map")
            (folder / "other.map").write_text((folder / "tiny.map").read_text())
            self.ends(good, (2,), "line 2: expected the name and size of the map\n", path,
                      ["--agents", "2", "--map", str(folder / "other.map")])
            text = path.read_text()
            for old, new, message in (("version 1", "version 2", "line 1: expected version 1"),
                                      ("\t3\t3\t", "\t3\t4\t", "expected the name and size"),
                                      ("tiny.map\t3", "tiny.map\t-3", "line 2: expected bucket"),
                                      ("\t2.5\n", "\n", "line 2: expected bucket"),
                                      (rows[1], rows[1].replace("tiny", "other"),
                                       "line 3: expected the map of the rows before"),
                                      (rows[0], rows[0].replace("\t2.5", "\tx"), "line 2: expected bucket"),
                                      (rows[1], rows[1].replace("\t3\t3\t1\t", "\t3\t3\t9\t"),
                                       "agents 1: expected a passable cell")):
                path.write_text(text.replace("\n" + old, "\n" + new) if old in rows else text.replace(old, new))
                self.ends(good, (2,), message, path, ["--agents", "2"])
            path.write_text("\n".join(["version 1", rows[0]]))
            self.ends(good, (2,), "its end: expected a row for each agent\n", path, ["--agents", "2"])

    def test_broken_instances_are_reported(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            path = CROSS.write(folder)
            good, good_map = path.read_text(), (folder / "tiny.map").read_text()
            rng = random.Random(4)
            for _ in range(150):
                at, to = sorted(rng.randrange(len(good)) for _ in range(2))
                path.write_text(rng.choice([good[:at], good[:at] + good[min(to, at + 9):],
                                            good[:at] + rng.choice('{}[]",:0-9e.') + good[at:]]))
                found = checkers.verify(path, GOOD)
                self.assertTrue(found.code in (1, 2) or found.text == "verified: no plan costs less than 5\n",
                                found.text)
                self.assertLess(found.seconds, 2)
            for text in ("[" * 10**5, '{"a":' * 10**5, "", "null", "[]", "{}", '{"map": 1}',
                         '{"map": "none.map", "agents": [], "tasks": []}', '"\\',
                         '"\\u12', '"\\ud800"', good + "x", good.replace('"goal"', '"start"'),
                         good.replace("[0, 1]", "[9, 1]"), "1" * 10**6):
                path.write_text(text)
                self.ends(GOOD, (2,), instance=path)
            path.write_text(good)
            for text in ("", "type octile\n", good_map.replace("...", "..", 1), good_map.replace("...", "..x", 1),
                         good_map.replace("height 3", "height 4"),
                         good_map.replace("width 3", "width 99999999999"),
                         good_map.replace("height 3", "height 4000000000"), good_map.replace("width 3", "width 0")):
                (folder / "tiny.map").write_text(text)
                self.ends(GOOD, (2,), instance=path)

    def test_instances_that_grove_refuses_are_unreadable(self):
        turning = World(["...", "...", "..."])
        on_map = Instance(turning, [Agent((0,), 8), Agent((2, "N"), 6, turn=2, goal_heading="S"), Agent((4,))],
                          [(4, 3, [2]), (1, 0, [0, 1])])
        on_roads = Instance(World(vertices=3, roads=[(0, 1, 3, False), (1, 2, 1, True), (1, 2, 2, False)]),
                            [Agent((0,), 1), Agent((2,))], [(1, 0, [0])])

        def refused(instance, change, message, file="tiny.cts.json"):
            with tempfile.TemporaryDirectory() as name:
                folder = Path(name)
                path = instance.write(folder)
                self.assertNotIn(str(path), checkers.verify(path, "x").text)
                json_of = json.loads((folder / file).read_text())
                change(json_of)
                (folder / file).write_text(json.dumps(json_of))
                found = checkers.verify(path, "x")
                self.assertEqual(found.code, 2, found.text)
                self.assertIn(str(folder / file), found.text)
                self.assertRegex(found.text, message)

        def put(*path, value):
            def change(json_of):
                for key in path[:-1]:
                    json_of = json_of[key]
                json_of[path[-1]] = value
            return change

        cell, vertex = [0, 0], "v0"
        for where in ((), ("agents", 0), ("tasks", 0)):
            for key in ("gaol", "Duration", "deadline", "", "$id", "x" * 10**5):
                refused(on_map, put(*where, key, value=1), "unknown key")
        for value in ([], [cell], cell, "*"):
            refused(on_map, put("agents", 0, "goals", value=value), "agents 0: expected goals, a list of places")
        for value in (0, 9, -1, "1", None, 1.0):
            refused(on_map, put("tasks", 0, "need", value=value), "tasks 0: expected need, at most the number of agents")
        for value in ("**", "", "a0", []):
            refused(on_map, put("tasks", 0, "agents", value=value), "tasks 0: expected agents, a list of ids")
        for path, value in (
                (("roadmap",), "tiny.map"), (("agents",), []), (("agents", 0, "id"), ""), (("agents", 0, "id"), "a\0"),
                (("agents", 0, "start"), [0.0, 0]), (("agents", 0, "start"), [0, 1e0]),
                (("agents", 0, "start"), [0, 0, "N"]),
                (("agents", 0, "start"), [-1, 0]), (("agents", 0, "start"), [2, 0]), (("agents", 0, "goal"), [0, 2]),
                (("agents", 0, "goal"), [2, 2, "N"]), (("agents", 0, "goal"), None), (("agents", 0, "heading"), "N"),
                (("agents", 0, "turn_steps"), 1), (("agents", 0, "goal_heading"), "N"),
                (("agents", 0, "motion"), "turning"),
                (("agents", 1, "motion"), "rolling"), (("agents", 1, "motion"), "Turning"),
                (("agents", 1, "motion"), True),
                (("agents", 1, "turn_steps"), 2.0), (("agents", 1, "turn_steps"), 0), (("agents", 1, "heading"), "S"),
                (("agents", 1, "start"), [2, 0, "N", "N", 0]), (("agents", 1, "start"), [2, 0, "N", "E", 0]),
                (("agents", 1, "start"), [2, 0, "N", "S", 1]), (("agents", 1, "start"), [2, 0, "N", "E", 2]),
                (("agents", 2, "working"), {"task": "t0", "done": 1, "of": 3}),
                (("agents", 2, "working"), {"task": "t0", "done": 1.0}),
                (("agents", 2, "working"), {"task": "t0", "done": 3}),
                (("agents", 2, "working"), {"task": "t1", "done": 0}),
                (("tasks", 0, "duration"), 3.0), (("tasks", 0, "duration"), -1), (("tasks", 0, "duration"), 65537),
                (("tasks", 0, "cell"), [1, 1, "N"]), (("tasks", 0, "cell"), [1.0, 1]), (("tasks", 0, "agents"), []),
                (("tasks", 0, "agents"), ["a2", "a2"]), (("tasks", 0, "agents"), "a2"), (("tasks", 0, "id"), "t1"),
                (("tasks",), [{"id": f"t{k}", "cell": cell, "agents": ["a0"]} for k in range(65)])):
            with self.subTest(path=path, value=value):
                refused(on_map, put(*path, value=value), "expected|unknown")
        refused(on_map, lambda one: one["agents"][1].pop("goal"), "a goal with its heading")
        for path, value in (
                (("map",), "tiny.roadmap.json"), (("agents", 0, "start"), ["v0", "v1", 1, 0, 0]),
                (("agents", 0, "start"), ["v1", "v2", 1]),
                (("agents", 0, "start"), ["v0", "v1", 0]), (("agents", 0, "start"), ["v0", "v1", 3]),
                (("agents", 0, "start"), ["v0", "v1"]),
                (("agents", 0, "start"), ["v1", "v2", 1, 0]), (("agents", 0, "start"), [0, 0]),
                (("agents", 0, "goal"), ["v0", "v1", 1]), (("tasks", 0, "cell"), ["v0", "v1", 1])):
            with self.subTest(path=path, value=value):
                refused(on_roads, put(*path, value=value), "expected")
        for path, value in (
                (("edges", 0, "to"), vertex), (("edges", 0, "steps"), 3.0), (("edges", 0, "steps"), 0),
                (("edges", 0, "one_way"), 1),
                (("edges", 0, "bidirectional"), True), (("edges", 0, "capacity"), 1), (("vertices", 0, "at"), [0]),
                (("vertices", 0, "at"), ["0", 0]), (("vertices", 0, "z"), 1), (("vertices", 0, "id"), ""),
                (("unit",), "m"), (("vertices",), [])):
            with self.subTest(path=path, value=value):
                refused(on_roads, put(*path, value=value), "expected|unknown key", "tiny.roadmap.json")

    def test_annotations_in_instances_are_ignored(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            path = CROSS.write(folder)
            found = json.loads(path.read_text())
            for where in (found, *found["agents"], *found["tasks"]):
                where.update({"_by": {"any": [1.5, None]}, "$schema": "instance.schema.json"})
            path.write_text(json.dumps(found))
            self.ends(GOOD, (0,), "^verified: no plan costs less than 5\n", path)

    def test_small_checker_refuses_unsupported_instances(self):
        plain = Instance(World(["...", "..."]), [Agent((0,), 2), Agent((5,), 3)])
        proof = certificate(plain, "theorem 4", "leaf")
        with tempfile.TemporaryDirectory() as name:
            path = plain.write(Path(name))
            text = path.read_text()
            self.assertEqual(checkers.small_checker(path, proof).text, "verified: no plan costs less than 4\n")
            path.write_text(text.replace("{", '{"_note": 1, "$schema": "x", '))
            self.assertEqual(checkers.small_checker(path, proof).code, 0)
            for key in ('"gaol": 1', '"Duration": 1', '"motion": "turning"', '"working": {}', '"roadmap": "x"',
                        '"start": [0, 0], "start": [0, 0]'):
                for place in ("{", '{"id"'):
                    path.write_text(text.replace(place, "{" + key + ", " + place[1:]))
                    found = checkers.small_checker(path, proof)
                    self.assertEqual(found.code, 1, found.text)
                    self.assertRegex(found.text, "^refused: ")
            for cell in ("[0.0, 0]", "[0, true]", "[0, -1]", "[3, 0]", "[0, 0, 0]", "[2, 1]", "7"):
                path.write_text(text.replace('"start": [0, 0]', '"start": ' + cell))
                self.assertRegex(checkers.small_checker(path, proof).text, "^refused: ")

    def test_numbers_follow_the_json_grammar(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            path = CROSS.write(folder)
            text = path.read_text()
            for number in ("00", "01", "1.", ".5", "+1", "-", "1e", "1e+", "1e999", "0x1", "NaN", "1_0"):
                path.write_text(text.replace("{", '{"_": ' + number + ", ", 1))
                self.ends(GOOD, (2,), "is not JSON", path)
            for number in ("0", "-0", "10", "-1.5e-3", "1E+2", "123456789012345678901234567890"):
                path.write_text(text.replace("{", '{"_": ' + number + ", ", 1))
                self.ends(GOOD, (0,), "^verified: ", path)

    def test_byte_order_mark_changes_nothing(self):
        with tempfile.TemporaryDirectory() as name:
            path = CROSS.write(Path(name))
            for file in Path(name).iterdir():
                file.write_bytes(b"\xef\xbb\xbf" + file.read_bytes())
            self.ends(GOOD, (0,), "^verified: ", path)

    def test_duplicate_key_is_named(self):
        with tempfile.TemporaryDirectory() as name:
            path = CROSS.write(Path(name))
            path.write_text(path.read_text().replace("{", '{"map": "x", ', 1))
            self.ends(GOOD, (2,), "line 1: key 'map' is there twice", path)

    def test_broken_maps_are_refused(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            path = CROSS.write(folder)
            good = (folder / "tiny.map").read_text()
            for text in (good + "...\n", good.replace("...", "...  ", 1), good.replace("height 3", "height +3"),
                         good.replace("height ", "height  "),
                         good.replace("type octile", "type  octile"), good.replace("map\n", "map x\n"),
                         good.replace("width 3", "height 3")):
                (folder / "tiny.map").write_text(text)
                self.ends(GOOD, (2,), "tiny.map: ", path)
            for text in (good.replace("\n", "\r\n"), good + "\n\n", good.removesuffix("\n"),
                         good.replace("height 3\nwidth 3", "width 3\nheight 3"),
                         good.replace("height 3", "height 3 \t")):
                (folder / "tiny.map").write_text(text)
                self.ends(GOOD, (0,), "^verified: ", path)


if __name__ == "__main__":
    checkers.main(unittest)
