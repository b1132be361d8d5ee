# SPDX-License-Identifier: MIT
"""Provides a base class for tests of grove view pages. It writes pages, shares one browser, and reads what a page
shows."""

import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from devtools import CHROMIUM, Chromium, NoAnswer, is_blank, shares  # noqa: E402, F401

SKIPPED = 77
DATA = Path(__file__).resolve().parents[3] / "benchmarks/data"
MOVING = (0x00, 0x72, 0xB2)
COLLISION = (0xD0, 0x02, 0x1B)
CHOSEN = (0xB4, 0x00, 0x9E)

# Returns the colour at the centre of each robot on the canvas of robots.
COLOURS = """grove.stages.flatMap(({camera, frame, element}, plan) => {
  const canvas = element.querySelectorAll("canvas")[1];
  const copy = Object.assign(document.createElement("canvas"), {width: canvas.width, height: canvas.height});
  const c = copy.getContext("2d", {willReadFrequently: true});
  c.drawImage(canvas, 0, 0);
  return grove.app.model.agents.map(({id}, i) => {
    const at = camera.toView(frame.xs[i], frame.ys[i]);
    return [id, plan, [...c.getImageData(at.x, at.y, 1, 1).data].slice(0, 3)];
  });
})"""


class PageTest(unittest.TestCase):
    """Provides one browser for all tests in a file, and a folder for each test."""
    grove = Path("build/release/bin/grove")

    @classmethod
    def setUpClass(cls):
        cls.browser = cls.enterClassContext(Chromium())

    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    # --- pages ---

    def page(self, instance, *plans, name="page.html"):
        subprocess.run([self.grove, "view", instance, *plans, "-o", self.folder / name], check=True,
                       stdout=subprocess.DEVNULL)
        return self.folder / name

    def solved(self, name):
        plan = self.folder / f"{name}.plan.json"
        subprocess.run([self.grove, "solve", DATA / f"{name}.cts.json", "--threads", "1", "--quiet", "--output", plan],
                       check=True)
        return plan

    def page_of(self, data):
        """Writes a page with this data, which is text or an object to be written as JSON."""
        page = self.page(DATA / "first.cts.json")
        text = data if isinstance(data, str) else json.dumps(data).replace("<", "\\u003c")
        block = re.compile(r'(<script type="application/json" id="grove-data">).*?(</script>)', re.S)
        page.write_text(block.sub(lambda m: m[1] + text + m[2], page.read_text(encoding="utf-8"), count=1),
                        encoding="utf-8")
        return page

    def grid(self, width, height, agents, tasks=(), rows=None):
        """Writes an instance on a map and returns its path. Without `rows` all cells are free."""
        rows = rows or ["." * width] * height
        (self.folder / "m.map").write_text(f"type octile\nheight {height}\nwidth {width}\nmap\n" + "\n".join(rows)
                                           + "\n",
                                           encoding="utf-8")
        return self.instance({"map": "m.map", "agents": agents, "tasks": list(tasks)})

    def instance(self, data):
        path = self.folder / "i.cts.json"
        path.write_text(json.dumps(data), encoding="utf-8")
        return path

    def plan(self, paths, name="plan.json", **of_agents):
        """Writes a plan with correct costs and returns its path. paths: {id: path}. of_agents: `work` and
        `sequence`, by id."""
        def rest(path):
            return max((t for t in range(1, len(path)) if path[t] != path[t - 1]), default=0)
        agents = []
        for agent, path in paths.items():
            work = of_agents.get("work", {}).get(agent, [])
            cost = max([rest(path), *(piece["end"] for piece in work)])
            agents.append({"id": agent, "path": path, "cost": cost, "work": work,
                           "sequence": of_agents.get("sequence", {}).get(agent, [])})
        plan = {"status": "feasible", "cost": sum(a["cost"] for a in agents), "lower_bound": 0, "omega": 0,
                "agents": agents}
        (self.folder / name).write_text(json.dumps(plan), encoding="utf-8")
        return self.folder / name

    # --- what a page shows ---

    def open(self, page, fragment="", size=(1280, 800)):
        self.browser.open(page, fragment, size)
        self.browser.settle()

    def see(self, page, fragment="", size=(1280, 800)):
        """Visits a page and returns the shares of its colours. Asserts that the page sends no requests, logs nothing
        and is not blank."""
        seen = self.browser.visit(page, fragment, size)
        self.assertEqual(seen.console, [])
        self.assertEqual(seen.requests, [])
        self.assertFalse(is_blank(seen.picture))
        return shares(seen.picture)

    def assert_silent(self):
        self.browser.settle()
        self.assertEqual(self.browser.console, [])
        self.assertEqual(self.browser.requests, [])

    def evaluate(self, script):
        return self.browser.evaluate(script)

    def text(self, selector):
        return self.evaluate(f"document.querySelector({json.dumps(selector)})?.textContent ?? ''")

    def texts(self, selector):
        return self.evaluate(f"[...document.querySelectorAll({json.dumps(selector)})].map((e) => e.textContent)")

    def press(self, text, selector="button"):
        """Clicks the first element of the selector whose text contains `text`, if there is one."""
        found = self.evaluate(f"[...document.querySelectorAll({json.dumps(selector)})]"
                              f".find((e) => e.textContent.includes({json.dumps(text)}))?.click() ?? 'none'")
        self.browser.settle()
        return found

    def choose_option(self, label, value):
        select = f"document.querySelector('select[aria-label={json.dumps(label)}]')"
        self.evaluate(f"{select}.value = {json.dumps(value)}, {select}.dispatchEvent(new Event('change'))")
        self.browser.settle()

    def go(self, time):
        self.evaluate(f"grove.app.go({time})")
        self.browser.settle()

    def wait_for(self, script):
        self.browser.wait_until(script, lambda: self.evaluate(script))

    def wait_until_known(self):
        """Runs the checks and the analysis of waits to their end, without pausing for frames."""
        self.wait_for("grove.app.work(500), grove.app.viewed.every((v) => v.checker.done && v.waits.done)")
        self.browser.settle()

    def colours(self):
        """Returns {(id, index of the plan): painted colour}."""
        return {(agent, plan): tuple(colour) for agent, plan, colour in self.evaluate(COLOURS)}

    def red(self, plan=0):
        """Returns the ids of the robots painted red as one string, for example "ab"."""
        return "".join(sorted(agent
                              for (agent, of), colour in self.colours().items() if colour == COLLISION and of == plan))


def main(**settings):
    """Runs the tests in the calling file: PROGRAM GROVE [options of unittest]."""
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        PageTest.grove = Path(sys.argv.pop(1)).resolve()
    if CHROMIUM is None:
        print("skipped: neither chromium-headless-shell nor chromium is installed")
        sys.exit(SKIPPED)
    unittest.main(module="__main__", **settings)
