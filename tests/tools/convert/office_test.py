#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Converts a ROS map of an office, solves an instance on it and checks the waypoints against the original image.

    office_test.py GROVE [FOLDER]    keeps the files in FOLDER
"""
import csv
import math
import random
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

GROVE = Path(sys.argv[1] if len(sys.argv) > 1 else "build/release/bin/grove").resolve()
KEEP = Path(sys.argv[2]) if len(sys.argv) > 2 else None
RESOLUTION = 0.05
ORIGIN = (-10.0, -5.5)
RADIUS = 0.22
FREE, WALL, UNKNOWN = 254, 0, 205


def office(width=400, height=300, seed=1):
    """Returns pixel rows, from the top, of an office: two rows of rooms along a corridor, doors, desks, an unknown
    corner."""
    dice = random.Random(seed)
    rows = [bytearray([FREE]) * width for _ in range(height)]

    def fill(x0, y0, x1, y1, value):
        for y in range(max(0, y0), min(height, y1)):
            for x in range(max(0, x0), min(width, x1)):
                rows[y][x] = value

    for x0, y0, x1, y1 in ((0, 0, width, 3), (0, height - 3, width, height), (0, 0, 3, height),
                           (width - 3, 0, width, height)):
        fill(x0, y0, x1, y1, WALL)
    for wall in (120, 180):
        fill(0, wall, width, wall + 3, WALL)
    for x in range(80, width - 40, 80):
        fill(x, 0, x + 3, 120, WALL)
        fill(x, 180, x + 3, height, WALL)
    for x in range(0, width - 40, 80):
        for wall in (120, 180):
            door = x + dice.randrange(15, 45)
            fill(door, wall, door + 20, wall + 3, FREE)
        for top in (15, 205):
            desk = (x + dice.randrange(10, 30), top + dice.randrange(0, 30))
            fill(desk[0], desk[1], desk[0] + 30, desk[1] + 16, WALL)
    fill(width - 30, height - 40, width, height, UNKNOWN)
    return [bytes(row) for row in rows]


def png(rows):
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head)
            + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows))) + chunk(b"IEND", b""))


def clearance(rows, x, y):
    """Returns the distance in metres, at most 1, from a point in world coordinates to the nearest pixel that is not
    free."""
    px, py = (x - ORIGIN[0]) / RESOLUTION, len(rows) - (y - ORIGIN[1]) / RESOLUTION
    reach, best = int(1 / RESOLUTION), 1.0
    for iy in range(int(py) - reach, int(py) + reach + 1):
        for ix in range(int(px) - reach, int(px) + reach + 1):
            inside = 0 <= ix < len(rows[0]) and 0 <= iy < len(rows)
            if inside and rows[iy][ix] == FREE:
                continue
            dx, dy = max(0, ix - px, px - ix - 1), max(0, iy - py, py - iy - 1)
            best = min(best, math.hypot(dx, dy) * RESOLUTION)
    return best


class Office(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = KEEP or Path(temporary.name)
        self.folder.mkdir(exist_ok=True)
        self.rows = office()

    def grove(self, *words, code=0):
        done = subprocess.run([GROVE, *words], cwd=self.folder, capture_output=True, text=True,
                              timeout=60, check=False)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout if code == 0 else done.stderr

    def write(self, image="office.pgm", **keys):
        size = f"{len(self.rows[0])} {len(self.rows)}"
        body = b"".join(self.rows)
        data = png(self.rows) if image.endswith(".png") else f"P5\n# a comment\n{size}\n255\n".encode() + body
        (self.folder / image).write_bytes(data)
        settings = {"image": image, "resolution": RESOLUTION, "origin": [*ORIGIN, 0.0], "negate": 0,
                    "occupied_thresh": 0.65, "free_thresh": 0.196, **keys}
        text = "".join(f"{key}: {value}\n" for key, value in settings.items() if value is not None)
        (self.folder / "office.yaml").write_text(text)

    def convert(self, *more, code=0):
        return self.grove("convert", "office.yaml", "office.map", "--cell-size", "0.5", *more, code=code)

    def test_waypoints_lie_on_free_space(self):
        self.write()
        message = self.convert("--robot-radius", str(RADIUS))
        self.assertIn("40 x 30 cells", message)
        self.assertIn("--cell-size 0.5 --origin -10,-5.5", message)
        self.grove("generate", "instance", "--map", "office.map", "--agents", "12", "--tasks", "36",
                   "-o", "office.cts.json")
        self.grove("solve", "office.cts.json", "--quiet", "--time-limit", "10", "-o", "office.plan.json")
        self.grove("view", "office.cts.json", "office.plan.json", "-o", "office.html")
        self.grove("view", "office.cts.json", "office.plan.json", "--png", "office.png", "--at", "0,10")
        self.grove("convert", "--plan", "office.plan.json", "office.cts.json", "office.csv", "--to",
                   "waypoints", "--cell-size", "0.5", "--origin", "-10,-5.5", "--seconds-per-step", "0.8")
        with (self.folder / "office.csv").open(newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertGreater(len(rows), 300)
        seen, least = {}, 1.0
        for before, now in zip(rows, rows[1:]):
            if before["robot"] != now["robot"]:
                continue
            a, b = ([float(row[key]) for key in ("x", "y")] for row in (before, now))
            for part in (0, 0.25, 0.5, 0.75, 1):
                at = tuple(round(p + part * (q - p), 4) for p, q in zip(a, b))
                seen.setdefault(at, None)
        for at in seen:
            least = min(least, clearance(self.rows, *at))
        self.assertGreaterEqual(least, RADIUS - 1e-6)
        self.assertGreater(len([row for row in rows if row["task"]]), 30)

    def test_wide_robots_reach_fewer_cells(self):
        self.write()
        counts = []
        for radius in ("0", "0.2", "0.3", "0.45"):
            counts.append(int(self.convert("--robot-radius", radius).split(" cells, ")[1].split()[0]))
        self.assertEqual(sorted(counts, reverse=True), counts)
        self.assertGreater(counts[0], counts[-1] + 50)

    def test_map_without_free_cells_is_refused(self):
        self.write()
        for options, text in ((("--robot-radius", "5"),
                               "office.yaml: no cell is free on the map of cells of 0.5 m for robots of "
                                                        "radius 5 m; expected a smaller --robot-radius or --cell-size"),
                              (("--cell-size", "7", "--robot-radius", "0.5"), "no two neighbouring cells are free")):
            error = self.convert(*options, code=2)
            self.assertIn(text, error)
            self.assertEqual(error.count("\n"), 1)
        self.rows = [bytes([UNKNOWN]) * len(row) for row in self.rows]
        self.write()
        self.assertIn("office.yaml: the middle of no cell is free; expected", self.convert(code=2))
        self.assertFalse((self.folder / "office.map").exists())

    def test_png_pgm_and_negated_images_give_the_same_map(self):
        maps = []
        self.write()
        self.convert()
        maps.append((self.folder / "office.map").read_text())
        self.write("office.png")
        self.convert()
        maps.append((self.folder / "office.map").read_text())
        self.rows = [bytes(255 - v for v in row) for row in self.rows]
        self.write(negate=1)
        self.convert()
        maps.append((self.folder / "office.map").read_text())
        self.assertEqual(len(set(maps)), 1)

    def test_malformed_maps_are_refused_with_file_and_place(self):
        for keys, text in (({"resolution": "fine"}, "office.yaml: resolution: found 'fine'"),
                           ({"resolution": None}, "office.yaml: resolution"),
                           ({"origin": [0, 0, 1.57]}, "yaw of 1.57"),
                           ({"mode": "raw"}, "office.yaml: mode: found 'raw'"),
                           ({"image": "nowhere.pgm"}, "nowhere.pgm")):
            self.write(**keys)
            (self.folder / "nowhere.pgm").unlink(missing_ok=True)
            error = self.convert(code=2)
            self.assertIn(text, error)
            self.assertEqual(error.count("\n"), 1)
        self.write()
        (self.folder / "office.pgm").write_bytes(b"P5\n400 300\n255\nshort")
        self.assertIn("expected more pixels", self.convert(code=2))
        (self.folder / "office.pgm").write_bytes(b"GIF89a")
        self.assertIn("expected P5 or P2", self.convert(code=2))
        self.write("office.png")
        (self.folder / "office.png").write_bytes(b"no image")
        self.assertIn("office.png", self.convert(code=2))
        self.write()
        self.assertIn("required", self.grove("convert", "office.yaml", "office.map", code=2))
        self.assertIn("no cell of 100 m", self.grove("convert", "office.yaml", "office.map", "--cell-size",
                                                     "100", code=2))

    def test_ascii_map_is_converted(self):
        (self.folder / "hall.txt").write_text("####\n#. #\n#_0#\n####\n")
        self.assertIn("4 x 4 cells, 4 passable", self.grove("convert", "hall.txt", "hall.map"))
        (self.folder / "hall.txt").write_text("####\n####\n")
        self.assertIn("hall.txt: has no free cell; expected", self.grove("convert", "hall.txt", "wall.map", code=2))
        self.assertFalse((self.folder / "wall.map").exists())
        (self.folder / "hall.txt").write_text("####\n#.?#\n")
        self.assertIn("hall.txt: line 2, column 3: found '?'",
                      self.grove("convert", "hall.txt", "hall.map", code=2))
        (self.folder / "hall.txt").write_text("####\n#.#\n")
        self.assertIn("found 3 cells; expected 4", self.grove("convert", "hall.txt", "hall.map", code=2))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
