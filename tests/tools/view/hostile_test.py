#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests hostile or corrupt pages: they run no injected script, and they report the error.

    hostile_test.py GROVE

Exit codes: 0 passed, 1 failed, 77 skipped because Chromium is not installed.
"""
import json
import re
import shutil
import subprocess

from pages import DATA, PageTest, main

RUN = "window.hacked=1"
IDS = [
    f"</script><script>{RUN}</script>", f"<img src=x onerror={RUN}>", f"<svg onload={RUN}>", f"javascript:{RUN}",
    f"\"'><iframe srcdoc='<script>parent.{RUN}</script>'>", f"${{{RUN}}}", "<!--", "]]>", "&lt;b&gt;", "__proto__",
    "constructor",
    "\u202egnol\u2066", "רובוט שלוש", "روبوت", "机器人🤖", "a\nb\tc", " ", "\u0001", "x" * 20_000, "long " * 4000,
]


def data(**changes):
    """Returns the data of a page with one robot on a map, after `changes`."""
    return {"format": "grove view 1", "instance": "test",
            "world": {"kind": "grid", "width": 4, "height": 3, "free": "12"},
            "agents": [{"id": "a", "start": 0}], "tasks": [],
            "plans": [{"name": "p", "claims": {}, "agents": [{"path": "@0;3E"}]}],
            **changes}


class Hostile(PageTest):
    def assert_harmless(self):
        self.assert_silent()
        self.assertIsNone(self.evaluate("window.hacked ?? null"))
        self.assertEqual(self.evaluate("document.querySelectorAll('img, iframe, object, main script').length"), 0)
        self.assertLessEqual(self.evaluate("document.documentElement.scrollWidth"), self.evaluate("innerWidth"))

    def test_hostile_ids_and_names_run_no_script(self):
        starts = [[x, y] for y in range(4) for x in range(5)]
        agents = [{"id": name, "start": start} for name, start in zip(IDS, starts)]
        tasks = [{"id": name, "cell": start, "agents": [name]} for name, start in zip(IDS, starts)]
        plan = self.plan({a["id"]: [a["start"]] for a in agents}, sequence={name: [name] for name in IDS})
        evil = self.folder / "<img src=x onerror=hacked=1>.plan.json"
        shutil.copy(plan, evil)
        page = self.page(self.grid(5, 4, agents, tasks), plan, evil)
        for size in ((1280, 800), (390, 844)):
            self.open(page, size=size)
            self.wait_until_known()
            for tab in ("Tasks", "Robots", "Events", "Differences"):
                self.press(tab, ".tabs button")
            self.press("Robots", ".tabs button")
            self.assertEqual(len(self.texts(".row")), len(IDS))
            for _ in IDS if size[0] > 1000 else IDS[:3]:
                self.browser.key("n")
                self.browser.settle()
                self.assertIn("Now:", self.text(".now"))
            self.assertLess(max(map(len, self.texts(".row span"))), 100)
            self.assert_harmless()

    def test_hostile_vertex_names_run_no_script(self):
        roadmap = {"vertices": [{"id": name, "at": [i % 5 * 10, i // 5 * 10]} for i, name in enumerate(IDS)],
                   "edges": [{"from": a, "to": b, "steps": 3} for a, b in zip(IDS, IDS[1:])]}
        (self.folder / "r.roadmap.json").write_text(json.dumps(roadmap), encoding="utf-8")
        self.open(self.page(self.instance({"roadmap": "r.roadmap.json", "tasks": [],
                                           "agents": [{"id": "a", "start": IDS[0]}]}),
                            self.plan({"a": [[IDS[0]]]})))
        self.browser.key("n")
        self.browser.settle()
        self.assertIn("on </script>", self.text(".now"))
        self.assert_harmless()

    def test_hostile_links_have_no_effect(self):
        page = self.page(DATA / "first.cts.json", self.solved("first"))
        for fragment in ("#t=1e999", "#t=-7", "#t=NaN&agent=__proto__", f"#agent=<script>{RUN}</script>", "#%E0%A4%A",
                         "#t=99999999999",
                         "#t=3&t=4&agent=red&agent=blue", "#task=" + "x" * 10_000):
            with self.subTest(fragment[:30]):
                self.open(page, fragment)
                self.assertRegex(self.text(".clock"), r"^\d+ / 19$")
                self.assert_harmless()

    def test_plan_of_a_million_steps_is_shown(self):
        agents = [{"id": "a", "start": 0}, {"id": "b", "start": 8}]
        plan = [{"path": "@0;" + "2E.2W." * 166_666 + "3E"}, {"path": "@8;1000000."}]
        self.open(self.page_of(data(agents=agents, plans=[{"name": "p", "claims": {}, "agents": plan}])))
        self.wait_until_known()
        self.assertEqual(self.text(".verdict"), "✓ valid, checked by this page")
        for key in ("n", "End", "ArrowLeft", "Home", "ArrowRight"):
            self.browser.key(key)
            self.browser.settle()
        self.assertEqual(self.text(".clock"), "1 / 1000000")
        self.press("Events", ".tabs button")
        self.assertLessEqual(len(self.texts(".row")), 300)
        self.assert_harmless()

    def test_thousands_of_tasks_on_one_cell_are_shown(self):
        tasks = [{"id": f"t{k}", "place": 5, "agents": [0]} for k in range(5000)]
        self.open(self.page_of(data(tasks=tasks, plans=[{"name": "p", "claims": {}, "agents": [{"path": "@0;ES"}]}])))
        self.wait_until_known()
        self.press("Tasks", ".tabs button")
        self.assertEqual(len(self.texts(".row")), 300)
        self.assertIn("4,700 more", self.text(".rows p"))
        self.go(2)
        self.assertEqual(self.texts(".row .note")[0], "1 of 1")
        self.browser.key("n")
        self.browser.settle()
        self.assertEqual(len(self.texts(".details li")), 201)
        self.assert_harmless()

    def test_page_without_robots_and_tasks_is_shown(self):
        self.open(self.page_of(data(agents=[], plans=[])))
        for key in "n", "p", "f", " ", "End", "?", "Escape", "0":
            self.browser.key(key)
        self.browser.settle()
        self.assert_harmless()

    def test_corrupt_data_is_reported_with_its_position(self):
        def without(key):
            return {name: value for name, value in data().items() if name != key}
        plan = data()["plans"][0]
        for message, corrupt in [
            ("the data is no JSON", ""), ("the data is no JSON", "{"), ("the data: expected an object", "[]"),
            ("the data: expected an object", "null"), ("format: expected", without("format")),
            ("format: expected", data(format="grove view 2")),
            ("world: expected", without("world")), ("agents: expected a list", without("agents")),
            ("tasks: expected a list", without("tasks")), ("plans: expected a list", without("plans")),
            ("the data: expected no 'more'", data(more=1)),
            ("agents[0].start: expected", data(agents=[{"id": "a", "start": 99}])),
            ("agents[0].id: expected a text", data(agents=[{"id": {}, "start": 0}])),
            ("tasks[0].agents[0]", data(tasks=[{"id": "t", "place": 0, "agents": [7]}])),
            ("plans[0].agents: expected a list of 1", data(plans=[{**plan, "agents": []}])),
            ("plans[0].agents[0].path: a path leaves the world", data(plans=[{**plan, "agents": [{"path": "@0;9S"}]}])),
            ("plans[0].agents[0].path: a path contains '<'", data(plans=[{**plan, "agents": [{"path": "<script>"}]}])),
        ]:
            with self.subTest(message):
                self.open(self.page_of(corrupt))
                self.assertEqual(self.text("h1"), "This plan cannot be shown")
                self.assertIn(message, self.text(".failure p"))
                self.assert_harmless()

    def test_page_without_data_is_reported(self):
        page = self.page(DATA / "first.cts.json")
        page.write_text(re.sub(r'<script type="application/json".*?</script>', "", page.read_text(encoding="utf-8"),
                               flags=re.S),
                        encoding="utf-8")
        self.open(page)
        self.assertEqual(self.text(".failure p"), "this page contains no data")
        self.assert_harmless()

    def test_running_script_is_detected(self):
        page = self.folder / "bad.html"
        page.write_text(f"<p>{IDS[1]}</p>", encoding="utf-8")
        self.browser.open(page)
        self.browser.settle()
        self.assertEqual(self.evaluate("window.hacked"), 1)


if __name__ == "__main__":
    main()
