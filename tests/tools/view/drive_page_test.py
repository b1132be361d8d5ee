#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""grove view --drive in a browser: drives that ended, go on, and mean harm.

    drive_page_test.py GROVE
"""
import json
import re
import signal
import subprocess
import unittest
import urllib.error
import urllib.request

import pages
from pages import COLLISION, MOVING

ALERT = '<script>document.title = "owned"</script>'


def line(t, robot, at, action, state, angle=None):
    return json.dumps({"t": t, "robot": robot, "at": at, **({} if angle is None else {"angle": angle}),
                       "action": action, "state": state}) + "\n"


class DrivePages(pages.PageTest):
    def setUp(self):
        super().setUp()
        self.instance_file = self.grid(5, 2, [{"id": "a", "start": [0, 0], "goal": [4, 0]},
                                              {"id": "b", "start": [0, 1], "goal": [0, 1]}],
                                       [{"id": "t", "cell": [2, 0], "agents": ["a"]}])
        self.plan_file = self.folder / "i.plan.json"
        self.run_grove("solve", self.instance_file, "--quiet", "--output", self.plan_file)
        self.log = self.folder / "drive.jsonl"
        self.browser.console.clear()
        self.browser.requests.clear()

    def run_grove(self, *words):
        return subprocess.run([self.grove, *map(str, words)], cwd=self.folder, capture_output=True, text=True, check=True)

    def begin(self, *lines, robots=("a", "b")):
        header = {"format": "grove drive 1", "order": "o.json", "robots": robots, "seconds_per_step": 1.0}
        self.log.write_text(json.dumps(header) + "\n" + "".join(lines), encoding="utf-8")

    def drive_page(self):
        self.run_grove("view", self.instance_file, self.plan_file, "--drive", self.log)
        return self.folder / "drive.html"

    def text(self, selector="body"):
        return self.browser.evaluate(f"document.querySelector({json.dumps(selector)})?.innerText ?? ''")

    def quiet(self):
        self.assertEqual((self.browser.console, self.browser.requests), ([], []))

    def go(self, seconds):
        self.browser.evaluate(f"grove.app.go({seconds})")
        self.browser.wait(0.15)

    def positions(self):
        return self.browser.evaluate("[...grove.stages[0].frame.xs].map((x, i) => [x, grove.stages[0].frame.ys[i]])")

    def test_a_drive_that_ended(self):
        self.begin(line(0, "a", [0, 0], 0, "moving", 90), line(0, "b", [0, 1], 0, "done"),
                   line(2, "a", [1, 0], 1, "moving", 90), line(4, "a", [2, 0], 2, "lifted"),
                   line(9, "a", [2, 0], 2, "moving", 90), line(13, "a", [4, 0], 4, "done", 90))
        self.browser.open(self.drive_page())
        self.go(1)
        for got, expected in zip(self.positions(), ([1.0, 0.5], [0.5, 1.5])):
            for one, other in zip(got, expected):
                self.assertAlmostEqual(one, other, places=3)
        self.assertEqual(self.colours()["a", 0], MOVING)
        self.assertIn("The drive has ended.", self.text(".strip"))
        self.assertIn("moving · 0 of 4", self.text(".rows"))
        self.go(5)
        self.assertEqual(self.colours()["a", 0], COLLISION)
        self.assertIn("1 to look after", self.text(".strip"))
        self.assertIn("lifted off · 2 of 4", self.text(".rows"))
        self.browser.evaluate("grove.app.choose(0)")
        self.browser.wait(0.15)
        self.assertIn("2 of 4 actions done: step 2 of 4 of the plan.", self.text(".details"))
        self.assertRegex(self.text(".details"), r"0:04\s+1: t")
        self.go(13)
        self.assertIn("2 of 2 done, 0 waiting", self.text(".strip"))
        self.quiet()

    def test_a_log_that_breaks_off(self):
        self.begin(line(0, "a", [0, 0], 0, "moving"), line(3, "a", [2, 0], 2, "waiting"), '{"t": 4, "rob')
        self.browser.open(self.drive_page())
        self.assertIn("The log ends before everybody is done.", self.text(".strip"))
        self.go(3)
        self.assertIn("waiting · 2 of 4", self.text(".rows"))
        self.quiet()

    def test_a_line_that_cannot_be_read(self):
        self.begin(line(1, "a", [1, 0], 1, "moving"), line(2, "a", [1, 0], 1, ALERT), line(3, "a", [2, 0], 2, "moving"))
        self.browser.open(self.drive_page())
        self.assertIn("The log cannot be read on: line 3: state: expected one of", self.text(".strip"))
        self.quiet()

    def test_names_that_mean_harm(self):
        instance = self.grid(3, 1, [{"id": ALERT, "start": [0, 0], "goal": [2, 0]}], [{"id": ALERT, "cell": [1, 0], "agents": [ALERT]}])
        self.run_grove("solve", instance, "--quiet", "--output", self.plan_file)
        self.begin(line(0, ALERT, [0, 0], 0, "moving"), line(2, ALERT, [2, 0], 2, "done"), robots=(ALERT,))
        self.browser.open(self.drive_page())
        self.browser.evaluate("grove.app.choose(0)")
        self.browser.wait(0.2)
        self.assertIn(ALERT[:20], self.text(".details"))
        self.assertNotEqual(self.browser.evaluate("document.title"), "owned")
        self.quiet()

    def test_a_real_drive(self):
        done = self.run_grove("toio", "--demo", "--fast", "--log", self.log)
        self.assertIn("all visited", done.stdout)
        demo = self.grove.parent / "grove_toio/demo/demo.cts.json"
        self.run_grove("solve", demo, "--omega", "0", "--threads", "1", "--quiet", "--output", self.plan_file)
        self.instance_file = demo
        self.browser.open(self.drive_page())
        self.browser.evaluate("grove.app.player.go(grove.app.player.end), grove.app.changed()")
        self.browser.wait(0.2)
        self.assertIn("3 of 3 done", self.text(".strip"))
        self.assertEqual(self.browser.evaluate("grove.app.tasks.every(({agents, times}) => times.length === agents.length)"), True)
        self.quiet()

    def test_a_drive_is_followed(self):
        command = [self.grove, "view", self.instance_file, self.plan_file, "--drive", self.log, "--follow"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
            try:
                address = re.search(r"http://127\.0\.0\.1:\d+/", server.stdout.readline())[0]
                with pages.Chromium("--disable-gpu", "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1") as browser:
                    self.browser = browser
                    self.follow(address)
                request = urllib.request.Request(address, headers={"Host": "evil.example"})
                with self.assertRaises(urllib.error.HTTPError) as refused:
                    urllib.request.urlopen(request)
                self.assertEqual(refused.exception.code, 403)
                refused.exception.close()
            finally:
                server.send_signal(signal.SIGINT)
            self.assertEqual(server.wait(10), 0)

    def follow(self, address):
        self.browser.call("Page.navigate", url=address)
        self.until("Waiting for the drive to begin.")
        self.begin(line(0, "a", [0, 0], 0, "moving"), line(0, "b", [0, 1], 0, "waiting"))
        self.until("Live.")
        self.add(line(20, "a", [1, 0], 1, "waiting"))
        self.until(lambda: abs(self.positions()[0][0] - 1.5) < 0.1)
        self.browser.evaluate("grove.app.go(2)")
        self.until("It goes on; this is what was.")
        self.add(line(40, "a", [2, 0], 2, "moving"))
        self.until(lambda: self.browser.evaluate("grove.app.player.end") == 40)
        self.assertEqual(self.browser.evaluate("grove.app.player.time"), 2)
        self.browser.evaluate("document.querySelector('.golive').click()")
        self.until("Live.")
        self.add(line(60, "a", [4, 0], 4, "done"), line(60, "b", [0, 1], 0, "done"))
        self.until("The drive has ended.")
        self.begin(line(0, "a", [0, 0], 0, "moving"))       # another one
        self.until(lambda: self.browser.evaluate("grove.app.player.end") == 0)
        self.assertEqual(self.browser.console, [])
        self.assertTrue(all(url.startswith(address) for url in self.browser.requests), self.browser.requests)

    def add(self, *lines):
        with self.log.open("a") as file:
            file.write("".join(lines))

    def until(self, what):
        """A text of the line at the top, or a condition."""
        for _ in range(100):
            if (what in self.text(".strip")) if isinstance(what, str) else what():
                return
            self.browser.wait(0.1)
        self.fail(f"not seen: {what}; the page says {self.text('.strip')!r}")


if __name__ == "__main__":
    pages.main()
