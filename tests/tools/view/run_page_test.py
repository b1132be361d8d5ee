#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests `grove view --run` in a browser, with logs of real runs and with large, hostile and growing logs.

    run_page_test.py GROVE [--pictures DIR]
"""

import argparse
import json
import re
import signal
import subprocess
import sys
import tempfile
import unittest
import urllib.error
import urllib.request
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from devtools import CHROMIUM, Chromium  # noqa: E402

SKIPPED = 77
DATA = Path(__file__).resolve().parents[3] / "benchmarks/data"
ALERT = '<script>document.title = "owned"</script><img src=x onerror="document.title=\'owned\'">'
HEADER = {"event": "header", "version": "grove 1", "machine": "here", "options": "", "method": "auto", "threads": "2",
          "instance": "first.cts.json", "agents": 2, "tasks": 3}
SUMMARY = {"event": "summary", "status": "optimal", "cost": 33, "lower_bound": 33, "gap": 0, "plan_file": "p.json",
           "stats": {"wall_s": 2}}
ARGUMENTS = None


def row(time_s, kind="progress", **more):
    return {"event": kind, "time_s": time_s, "nodes": int(time_s * 10), "open": 3, "trees": 1, "lower_bound": 30,
            "incumbent": 40, "gap": 0.1, "memory_mb": 20.5} | more


def lines(*events):
    return "".join(json.dumps(event) + "\n" for event in events)


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        options = ("--disable-gpu", "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1")
        cls.browser = cls.enterClassContext(Chromium(*options))

    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.browser.console.clear()
        self.browser.requests.clear()

    def grove(self, *words):
        done = subprocess.run([ARGUMENTS.grove, *map(str, words)], cwd=self.folder, capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stderr)

    def show(self, log, size=(1280, 800)):
        (self.folder / "run.jsonl").write_text(log)
        self.grove("view", "--run", "run.jsonl")
        seconds = self.browser.open(self.folder / "run.html", size=size)
        self.quiet()
        return seconds

    def quiet(self):
        """Asserts that the page has logged nothing, sent no request and run no injected script."""
        self.browser.settle()
        self.assertEqual(self.browser.console, [])
        self.assertEqual(self.browser.requests, [])
        self.assertNotEqual(self.browser.evaluate("document.title"), "owned")

    def text(self, selector="body"):
        return self.browser.evaluate(f"document.querySelector({json.dumps(selector)})?.innerText ?? ''")

    def picture(self, name):
        if ARGUMENTS.pictures:
            self.browser.picture(ARGUMENTS.pictures / f"{name}.png")

    def test_real_run_is_shown(self):
        self.grove("solve", DATA / "rooms-32x32_n10_m30.cts.json", "--omega", 0, "--threads", 1, "--without", "primal",
                   "--quiet", "--log", "log.jsonl", "--log-format", "jsonl", "--log-tree", 1000, "-o", "p.json")
        self.show((self.folder / "log.jsonl").read_text())
        self.assertIn("Optimal: a plan of 1,070 steps, and none costs less.", self.text("header"))
        self.assertIn("The run has ended.", self.text("header"))
        nodes = sum('"event":"node"' in line for line in (self.folder / "log.jsonl").read_text().splitlines())
        self.assertIn(f"{nodes} of {nodes} expansions", self.text(".tree"))
        self.picture("run")
        self.check_tree_keys()
        for size in ((390, 844), (2560, 1440)):
            self.browser.resize(*size)
            self.quiet()
            self.assertEqual(self.browser.evaluate("document.documentElement.scrollWidth <= innerWidth"), True)
            self.picture(f"run-{size[0]}")

    def check_tree_keys(self):
        self.browser.evaluate("document.querySelector('.tree canvas').focus()")
        self.assertIn("Node 0, root of tree 0", self.text(".node"))
        self.browser.key("ArrowDown")
        self.assertNotIn("Node 0,", self.text(".node"))
        self.browser.key("p")  # back by one expansion
        before = self.text(".tree .controls")
        self.browser.key("p")
        self.assertNotEqual(self.text(".tree .controls"), before)
        self.assertRegex(self.text(".node"), r"Expanded as number \d+ at .* by worker 0")

    def test_arrow_keys_select_a_time(self):
        self.show(lines(HEADER, row(1), row(2, "incumbent", incumbent=36, source="tree"),
                        row(3, lower_bound=33, incumbent=33), SUMMARY))
        self.browser.evaluate("document.querySelector('.picture').focus()")
        self.assertIn("gap 0 %", self.text(".readout"))
        self.assertIn("With --log-tree 1000", self.text("main"))
        self.browser.key("ArrowLeft")
        self.assertIn("2 s: best plan 36, no plan costs less than 30, gap 20 %", self.text(".readout"))

    def test_bound_is_divided_among_its_sources(self):
        self.show(lines(HEADER, row(1, "bound", raised_by={"individual": 30}),
                        row(2, "bound", lower_bound=33, raised_by={"cores": 3}), SUMMARY))
        self.assertIn("lower bound 33; of it costs of single robots 30, unsatisfiable cores 3", self.text("main"))
        kinds = "[...document.querySelectorAll('.area')].map((area) => area.classList[1]).join()"
        self.assertEqual(self.browser.evaluate(kinds), "gap,raised-cores,raised-individual")

    def test_large_log_is_shown(self):
        ranks = {"nodes": list(range(1000)), "open": [1] * 1000, "lower_bound": [30, None] * 500,
                 "memory_mb": [25.5] * 999 + [None], "low_level_calls": [7] * 1000,
                 "branching_cost_queries": [8] * 1000}
        counts = {"event": "counts", "time_s": 99999, "counts": {"splits_vertex_edge": 5, "splits_target": 1},
                  "memory_mb": {"process": 100, "nodes": 20, "subproblems": 10, "mdds": 5, "dependencies": 1},
                  "ranks": ranks}
        seconds = self.show(lines(HEADER, *(row(t) for t in range(100_000)), counts))
        print(f"100,000 rows, 1,000 ranks: loaded in {seconds:.2f} s")
        self.assertIn("1,000 ranks", self.text("table caption"))
        self.assertIn("0 · 500 · 999", self.text(".spread"))
        self.assertIn("The log is incomplete", self.text(".state"))
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('.scroll tbody tr').length"), 1001)
        self.assertIn("The ranks hold the nodes", self.text("main"))

    def test_hostile_logs_run_no_script(self):
        hostile = {"event": "node", "time_s": 1, "node": 0, "worker": 0, "outcome": "split", "conflict": ALERT,
                   "split": ALERT,
                   "children": [{"node": 1, "bound": 3, "cost": 3, "constraint": ALERT}]}
        root = {"event": "root", "time_s": 0, "node": 0, "tree": 0, "bound": 1e300, "cost": -7}
        self.show(lines(HEADER | {"instance": ALERT, "options": "</script>" + ALERT}, root, hostile,
                        {"event": "note", "time_s": 1, "text": ALERT}, row(1, "incumbent", source=ALERT),
                        row(2, lower_bound=-1e300, incumbent=1e308), SUMMARY | {"status": ALERT, "stats": {ALERT: 7}}))
        self.assertIn("<img src=x", self.text("main"))
        for wrong, words in ((row(1, nodes="many"), "line 2: nodes: expected a number"),
                             ({"event": "node", "node": 5}, "line 2: node: expected a node that was made before"),
                             ({"event": "counts", "time_s": 1}, "line 2: counts: expected an object")):
            self.show(lines(HEADER, wrong))
            self.assertIn(words, self.text(".failure"))

    def test_live_run_is_followed(self):
        log = self.folder / "live.jsonl"
        command = [ARGUMENTS.grove, "view", "--run", log, "--follow"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
            try:
                self.follow(log, re.search(r"http://127\.0\.0\.1:(\d+)/([0-9a-f]{32})/", server.stdout.readline()))
            finally:
                server.send_signal(signal.SIGINT)
        self.assertEqual(server.returncode, 0)

    def follow(self, log, address):
        self.browser.call("Page.navigate", url=address[0])
        self.wait_for_text("Waiting for the log to begin.")
        log.write_text(lines(HEADER, row(1, incumbent=None)))
        self.wait_for_text("No plan yet; none costs less than 30.")
        self.assertRegex(self.text(".state"), r"^Live[.;]")  # ";" after some seconds without a row
        half = json.dumps(row(2, incumbent=44))
        with log.open("a") as more:
            more.write(half[:20])
            more.flush()
            before = len(self.browser.requests)  # the second request proves that the first answer was processed
            self.browser.wait_until("more requests", lambda: len(self.browser.requests) >= before + 2)
            more.write(half[20:] + "\n")
        self.wait_for_text("A plan of 44 steps")
        log.write_text(lines(HEADER | {"instance": "second.json"}, row(0.5, incumbent=31), SUMMARY | {"cost": 35}))
        self.wait_for_text("second.json")
        self.wait_for_text("The run has ended.")
        self.assertEqual(self.browser.console, [])
        self.assertEqual([url for url in self.browser.requests if not url.startswith(address[0])], [])
        self.check_access(int(address[1]), address[2])
        self.browser.call("Page.navigate", url="about:blank")

    def wait_for_text(self, words):
        self.browser.wait_until(words, lambda: words in self.text())

    def check_access(self, port, token):
        listening = [line.split()[1] for line in Path("/proc/net/tcp").read_text().splitlines() if " 0A " in line]
        self.assertIn(f"0100007F:{port:04X}", listening)  # 127.0.0.1, in little-endian order
        self.assertNotIn(f"00000000:{port:04X}", listening)
        for host, path, expected in (("127.0.0.1", f"/{token}/", 200), ("localhost", f"/{token}/log?from=0", 200),
                                     ("127.0.0.1", f"/{token}/log?from=x", 200), ("evil.example", f"/{token}/", 403),
                                     ("127.0.0.1", "/", 404), ("127.0.0.1", "/log?from=0", 404),
                                     ("127.0.0.1", f"/{token[:-1]}/log?from=0", 404),
                                     ("127.0.0.1", "/etc/passwd", 404)):
            request = urllib.request.Request(f"http://127.0.0.1:{port}{path}", headers={"Host": f"{host}:{port}"})
            try:
                with urllib.request.urlopen(request) as answer:
                    self.assertEqual(answer.status, expected)
            except urllib.error.HTTPError as error:
                self.assertEqual(error.code, expected)
        post = urllib.request.Request(f"http://127.0.0.1:{port}/", data=b"x")
        with self.assertRaises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(post)
        self.assertEqual(refused.exception.code, 405)


def main():
    global ARGUMENTS
    parser = argparse.ArgumentParser()
    parser.add_argument("grove", type=lambda name: Path(name).resolve())
    parser.add_argument("--pictures", type=Path)
    ARGUMENTS, rest = parser.parse_known_args()
    if not CHROMIUM:
        print("skipped: no Chromium (Debian package chromium-headless-shell)")
        return SKIPPED
    return 0 if unittest.main(argv=[sys.argv[0], *rest], exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
