#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plays with pages of 6 to 10,000 robots as a user would, and reports what that takes.

    interaction_test.py GROVE [--all] [--pictures FOLDER]      --all: with 100 and 10,000 robots

Prints a row for each size. Exit codes: 0 passed, 1 failed, 77 there is no Chromium here.
"""
import argparse
import json
import random
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from devtools import CHROMIUM, Chromium  # noqa: E402

GROVE = Path("build/release/bin/grove")
PICTURES = None
SIZES = ((6, 20, 100, 30), (1000, 200, 500, 30))  # robots, side of the map, steps, frames a second
ALL_SIZES = (*SIZES, (100, 50, 300, 30), (10_000, 1000, 500, 5))
SKIPPED = 77

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
    """Robots that go to and fro, each in its own part of a row; a task for every third of them."""
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
    page = folder / f"{name}.html"
    subprocess.run([GROVE, "view", folder / f"{name}.cts.json", folder / f"{name}.txt", "-o", page], check=True,
                   stdout=subprocess.DEVNULL)
    return page


class Interaction(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def picture(self, browser, name):
        if PICTURES:
            browser.picture(PICTURES / f"{name}.png")

    def text(self, browser, selector):
        return browser.evaluate(f"document.querySelector({json.dumps(selector)})?.textContent ?? ''")

    def wait_for(self, browser, holds, seconds=30):
        for _ in range(10 * seconds):
            if holds():
                return
            browser.wait(0.1)
        self.fail("waited in vain")

    def play(self, browser, page, count):
        seconds = browser.open(page)
        self.assertLess(seconds, 3)
        self.wait_for(browser, lambda: "valid" in self.text(browser, ".verdict"))
        self.picture(browser, f"{count}-opened")
        # Playing, and standing still again.
        browser.key(" ")
        found = browser.evaluate(FRAMES.replace("SECONDS", "2"))
        browser.key(" ")
        browser.wait(0.3)
        still = self.text(browser, ".clock")
        self.assertGreater(int(float(still.split()[0])), 3)
        browser.wait(0.3)
        self.assertEqual(self.text(browser, ".clock"), still)
        # A step on and back.
        browser.key("Home")
        browser.key("ArrowRight")
        browser.wait(0.2)
        self.assertTrue(self.text(browser, ".clock").startswith("1 /"))
        self.search(browser, count)
        self.look_closer(browser, count)
        self.jump(browser, page, count)
        for size in ((390, 844), (1920, 1080)):
            browser.resize(*size)
            browser.wait(0.5)
            self.picture(browser, f"{count}-{size[0]}")
        return seconds, found

    def search(self, browser, count):
        browser.key("/")
        browser.type(f"robot-{count - 1}")
        browser.key("Enter")
        browser.wait(0.3)
        self.assertEqual(self.text(browser, ".details h2"), f"robot-{count - 1}")
        self.assertIn("Now:", self.text(browser, ".now"))
        self.picture(browser, f"{count}-chosen")
        browser.key("Escape")  # the field's
        browser.key("Escape")
        browser.wait(0.2)
        self.assertEqual(self.text(browser, ".details h2"), "")

    def look_closer(self, browser, count):
        for _ in range(4):
            browser.mouse("mouseWheel", 300, 300, deltaX=0, deltaY=-120)
        browser.mouse("mousePressed", 300, 300, button="left", buttons=1)
        browser.mouse("mouseMoved", 360, 340, button="left", buttons=1)
        browser.mouse("mouseReleased", 360, 340, button="left")
        browser.wait(0.3)
        self.assertFalse(browser.evaluate("document.querySelector('.minimap').hidden"))
        self.picture(browser, f"{count}-closer")
        browser.key("0")
        browser.wait(0.2)
        self.assertTrue(browser.evaluate("document.querySelector('.minimap').hidden"))

    def jump(self, browser, page, count):
        browser.open(page, f"#t=37&agent=robot-{count // 2}")
        browser.wait(0.5)
        self.assertTrue(self.text(browser, ".clock").startswith("37 /"))
        self.assertEqual(self.text(browser, ".details h2"), f"robot-{count // 2}")
        # The address follows what is looked at.
        browser.key("ArrowRight")
        browser.wait(0.6)
        self.assertEqual(browser.evaluate("location.hash"), f"#t=38&agent=robot-{count // 2}")

    def test_pages_of_all_sizes(self):
        for count, side, steps, fps in SIZES:
            with self.subTest(robots=count), Chromium() as browser:
                page = synthetic(self.folder, count, side, steps)
                seconds, found = self.play(browser, page, count)
                # What the browser itself says of software that stands for a graphics card is not ours.
                self.assertEqual([text for text in browser.console if "software WebGL" not in text], [])
                self.assertEqual(browser.requests, [])
                self.assertGreater(found["fps"], fps)
                print(f"{count:6} robots: {page.stat().st_size / 1e6:.2f} MB, loaded in {seconds:.2f} s, {found['fps']:.0f} frames "
                      f"a second, the page's own code {found['median']:.1f} ms a frame ({found['p95']:.1f} in 95 %)", flush=True)
                if count == 1000:
                    self.assertLess(page.stat().st_size, 2e6)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("grove", type=Path)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--pictures", type=Path)
    arguments = parser.parse_args()
    if arguments.all:
        SIZES = ALL_SIZES
    GROVE, PICTURES = arguments.grove.resolve(), arguments.pictures
    if CHROMIUM is None:
        print("skipped: there is no chromium-headless-shell and no chromium")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
