#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Simulates a user of pages with 10 and 1,000 robots and prints a row of measured times for each size.

    interaction_test.py GROVE [--all] [--pictures FOLDER]

--all adds pages with 100 and 10,000 robots, and time limits: loading a page takes less than 3 seconds, and its own
code less than 8 ms per frame in the median. Exit codes: 0 passed, 1 failed, 77 skipped because Chromium is not
installed.
"""
import json
import random
import sys
import time
from pathlib import Path

from pages import PageTest, main

PICTURES = None
SIZES = ((10, 20, 100), (1000, 200, 500))  # number of robots, side of the map in cells, steps
ALL_SIZES = ((10, 20, 100), (100, 50, 300), (1000, 200, 500), (10_000, 1000, 500))
IS_MEASURED = False  # whether time limits are enforced
SECONDS = 1  # duration for which the plan is played

FRAMES = """new Promise((done) => {
  grove.frames.length = 0;
  let count = 0, begin = 0;
  const go = (now) => {
    begin ||= now;
    ++count;
    if (now - begin < SECONDS * 1000) return requestAnimationFrame(go);
    const sorted = [...grove.frames].sort((a, b) => a - b);
    done({fps: 1000 * count / (now - begin), median: sorted[sorted.length >> 1],
          p95: sorted[Math.floor(0.95 * sorted.length)]});
  };
  requestAnimationFrame(go);
})"""


def synthetic(folder, count, side, steps):
    """Writes an instance and its plan and returns both paths. Robots move to and fro, each in its own part of a row;
    every third robot has a task."""
    rng = random.Random(count)
    name = f"b{count}"
    (folder / f"{name}.map").write_text(f"type octile\nheight {side}\nwidth {side}\nmap\n" + ("." * side + "\n") * side)
    in_a_row = -(-count // side)
    part = side // in_a_row
    agents, tasks, lines = [], [], []
    for i in range(count):
        first, y = i % in_a_row * part, i // in_a_row
        x, step, path = first + rng.randrange(part), 1, []
        for _ in range(steps):
            path.append((x, y))
            if rng.random() < 0.15:
                step = -step
            elif first <= x + step < first + part:
                x += step
        agents.append({"id": f"robot-{i}", "start": path[0], "goal": path[-1]})
        if i % 3 == 0:
            tasks.append({"id": f"t{i}", "cell": path[steps // 2], "agents": [f"robot-{i}"]})
        lines.append(f"Agent {i}: " + "->".join(f"({y},{x})" for x, y in path) + "->\n")
    (folder / f"{name}.cts.json").write_text(json.dumps({"map": f"{name}.map", "agents": agents, "tasks": tasks}))
    (folder / f"{name}.txt").write_text("".join(lines))
    return folder / f"{name}.cts.json", folder / f"{name}.txt"


class Interaction(PageTest):
    def picture(self, name):
        if PICTURES:
            self.browser.picture(PICTURES / f"{name}.png")

    def key(self, *keys):
        for key in keys:
            self.browser.key(key)
        self.browser.settle()

    def play(self, count):
        """Plays the plan and pauses it. Returns the frame rate and the times of frames."""
        self.wait_for("grove.app.viewed.every((v) => v.checker.done && v.waits.done)")
        self.browser.settle()
        self.assertIn("valid", self.text(".verdict"))
        self.picture(f"{count}-opened")
        self.browser.key(" ")
        found = self.evaluate(FRAMES.replace("SECONDS", str(SECONDS)))
        self.key(" ")
        paused = self.text(".clock")
        self.assertGreater(int(float(paused.split()[0])), 0)
        self.browser.settle()
        self.assertEqual(self.text(".clock"), paused)
        self.key("Home", "ArrowRight")
        self.assertTrue(self.text(".clock").startswith("1 /"))
        return found

    def search(self, count):
        self.browser.key("/")
        self.browser.type(f"robot-{count - 1}")
        self.key("Enter")
        self.assertEqual(self.text(".details h2"), f"robot-{count - 1}")
        self.assertIn("Now:", self.text(".now"))
        self.picture(f"{count}-chosen")
        self.key("Escape", "Escape")  # first for the search field, then for the page
        self.assertEqual(self.text(".details h2"), "")

    def zoom_in(self, count):
        for _ in range(4):
            self.browser.mouse("mouseWheel", 300, 300, deltaX=0, deltaY=-120)
        self.browser.mouse("mousePressed", 300, 300, button="left", buttons=1)
        self.browser.mouse("mouseMoved", 360, 340, button="left", buttons=1)
        self.browser.mouse("mouseReleased", 360, 340, button="left")
        self.browser.settle()
        self.assertFalse(self.evaluate("document.querySelector('.minimap').hidden"))
        self.picture(f"{count}-closer")
        self.key("0")
        self.assertTrue(self.evaluate("document.querySelector('.minimap').hidden"))

    def jump(self, page, count):
        self.open(page, f"#t=37&agent=robot-{count // 2}")
        self.assertTrue(self.text(".clock").startswith("37 /"))
        self.assertEqual(self.text(".details h2"), f"robot-{count // 2}")
        # The address reflects the time and the selection.
        self.key("ArrowRight")
        self.wait_for(f"location.hash === '#t=38&agent=robot-{count // 2}'")

    def test_pages_of_all_sizes_are_interactive(self):
        for count, side, steps in ALL_SIZES if IS_MEASURED else SIZES:
            with self.subTest(robots=count):
                instance, plan = synthetic(self.folder, count, side, steps)
                begin = time.monotonic()
                page = self.page(instance, plan)
                written = time.monotonic() - begin
                loaded = self.browser.open(page)
                found = self.play(count)
                self.search(count)
                self.zoom_in(count)
                self.jump(page, count)
                self.assert_silent()
                size = page.stat().st_size
                print(f"{count:6} robots, {steps} steps on {side} x {side}: written in {written:.2f} s, "
                      f"{size / 1e6:.2f} MB, "
                      f"loaded in {loaded:.2f} s, {found['fps']:.0f} frames a second, the page's own code "
                      f"{found['median']:.1f} ms a frame ({found['p95']:.1f} in 95 %)", flush=True)
                if count <= 1000:
                    self.assertLess(size, 2e6)
                if IS_MEASURED:
                    self.assertLess(loaded, 3)
                    self.assertLess(found["median"], 8)


if __name__ == "__main__":
    IS_MEASURED = "--all" in sys.argv
    SECONDS = 3 if IS_MEASURED else 1
    if IS_MEASURED:
        sys.argv.remove("--all")
    if "--pictures" in sys.argv:
        at = sys.argv.index("--pictures")
        PICTURES = Path(sys.argv[at + 1])
        del sys.argv[at : at + 2]
    main()
