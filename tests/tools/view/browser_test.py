#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Opens pages of grove view in a real browser: they ask for nothing, complain of nothing, and show the plan.

    browser_test.py GROVE GL_PAGE      GL_PAGE: gl_page.ts, bundled

Exit codes: 0 passed, 1 failed, 77 there is no Chromium here.
"""
import html
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from browser import CHROMIUM, is_blank, shares, visit  # noqa: E402

GROVE = Path("build/release/bin/grove")
GL_PAGE = Path("build/release/tests/tools/view/gl_page.js")
SKIPPED = 77
DATA = Path(__file__).resolve().parents[3] / "benchmarks/data"
MOVING = (0x00, 0x72, 0xB2)
COLLISION = (0xD0, 0x02, 0x1B)
CHOSEN = (0xB4, 0x00, 0x9E)


def dump(page, *options):
    """The page's document after its scripts have run."""
    with tempfile.TemporaryDirectory() as folder:
        command = [CHROMIUM, "--headless", *options, f"--user-data-dir={folder}", *(["--no-sandbox"] if os.getuid() == 0 else []),
                   "--dump-dom", page.as_uri()]
        return subprocess.run(command, capture_output=True, text=True, check=True, timeout=120).stdout


class Browser(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def page(self, instance, *plans):
        subprocess.run([GROVE, "view", instance, *plans, "-o", self.folder / "page.html"], check=True,
                       stdout=subprocess.DEVNULL)
        return self.folder / "page.html"

    def solved(self, name):
        plan = self.folder / f"{name}.plan.json"
        subprocess.run([GROVE, "solve", DATA / f"{name}.cts.json", "--quiet", "--output", plan], check=True)
        return plan

    def see(self, page, **how):
        seen = visit(page, **how)
        self.assertEqual(seen.console, [])
        self.assertEqual(seen.requests, set())
        self.assertFalse(is_blank(seen.picture))
        return shares(seen.picture)

    def test_plans_of_all_kinds_of_worlds(self):
        for name in ("first", "shop", "yard", "empty-32x32_n5_m10"):
            with self.subTest(name):
                page = self.page(DATA / f"{name}.cts.json", self.solved(name))
                for size in ((1280, 800), (390, 844)):
                    seen = self.see(page, size=size, fragment="#t=1")
                    self.assertGreater(seen.get(MOVING, 0), 0)
                    self.assertLess(seen.get(COLLISION, 0), 0.01)

    def test_two_plans_and_none(self):
        plan = self.solved("shop")
        self.see(self.page(DATA / "shop.cts.json", plan, plan), size=(1280, 800))
        self.see(self.page(DATA / "shop.cts.json"), size=(1280, 800))

    def test_a_link_names_a_moment_and_a_robot(self):
        page = self.page(DATA / "shop.cts.json", self.solved("shop"))
        self.assertLess(self.see(page, size=(1280, 800)).get(CHOSEN, 0), 0.001)
        self.assertGreater(self.see(page, size=(1280, 800), fragment="#t=8&agent=blue").get(CHOSEN, 0), 0.003)

    def test_a_collision_is_red_at_its_moment(self):
        instance = self.folder / "meet.cts.json"
        (self.folder / "m.map").write_text("type octile\nheight 1\nwidth 5\nmap\n.....\n", encoding="utf-8")
        instance.write_text(json.dumps({"map": "m.map", "tasks": [], "agents": [
            {"id": "a", "start": [0, 0], "goal": [4, 0]}, {"id": "b", "start": [4, 0], "goal": [0, 0]}]}),
            encoding="utf-8")
        plan = self.folder / "meet.txt"
        plan.write_text("Agent 0: (0,0)->(0,1)->(0,2)->(0,3)->(0,4)->\nAgent 1: (0,4)->(0,3)->(0,2)->(0,1)->(0,0)->\n",
                        encoding="utf-8")
        page = self.page(instance, plan)
        red = {t: self.see(page, size=(1280, 800), fragment=f"#t={t}").get(COLLISION, 0) for t in (0, 1, 2, 3, 4)}
        self.assertGreater(red[2], 10 * max(red[0], red[1], red[3], red[4]))

    def test_ids_are_no_markup(self):
        instance = self.folder / "bad.cts.json"
        (self.folder / "m.map").write_text("type octile\nheight 1\nwidth 3\nmap\n...\n", encoding="utf-8")
        evil = "</script><script>console.error('run')</script><img src=x onerror=console.error('run')>"
        instance.write_text(json.dumps({"map": "m.map",
            "agents": [{"id": evil, "start": [0, 0], "goal": [2, 0]}],
            "tasks": [{"id": evil + "t", "cell": [1, 0], "agents": [evil]}]}), encoding="utf-8")
        plan = self.folder / "p.json"
        subprocess.run([GROVE, "solve", instance, "--quiet", "--output", plan], check=True)
        self.see(self.page(instance, plan), size=(1280, 800), fragment="#t=1&agent=" + "%3Cscript%3E")

    def test_robots_by_webgl(self):
        page = self.folder / "gl.html"
        page.write_text(f"<body><script>{GL_PAGE.read_text(encoding='utf-8')}</script></body>", encoding="utf-8")
        text = dump(page, "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
        found = json.loads(html.unescape(re.search(r'<pre id="result">(.*?)</pre>', text, re.S).group(1)))
        opaque = {name: f"{r},{g},{b},255" for name, (r, g, b) in
                  {"moving": MOVING, "resting": (0x8A, 0x92, 0x9C), "collision": COLLISION, "heading": (0x1C, 0x21, 0x28)}.items()}
        self.assertEqual(found["pixels"], {
            "a moves": opaque["moving"], "nobody is here": "0,0,0,0",
            "b turns, pointing down and to the left": opaque["heading"],
            "c and d collide": opaque["collision"], "their star is larger than a robot": opaque["collision"],
            "a rests": opaque["resting"]})
        print(f"10,000 robots by WebGL: {found['milliseconds']:.1f} ms a frame (no graphics card here)")

    def test_data_that_is_spoilt_is_told(self):
        page = self.page(DATA / "first.cts.json", self.solved("first"))
        page.write_text(page.read_text(encoding="utf-8").replace('"grove view 1"', '"grove view 2"', 1), encoding="utf-8")
        self.assertLess(self.see(page, size=(1280, 800)).get(MOVING, 0), 0.0001)


if __name__ == "__main__":
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        GROVE = Path(sys.argv.pop(1)).resolve()
        GL_PAGE = Path(sys.argv.pop(1)).resolve()
    if CHROMIUM is None:
        print("skipped: there is no chromium-headless-shell and no chromium")
        sys.exit(SKIPPED)
    unittest.main()
