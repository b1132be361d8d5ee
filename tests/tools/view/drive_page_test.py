#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests `grove view --drive` in a browser, with logs that have ended, logs that still grow, and hostile logs.

    drive_page_test.py GROVE
"""
import contextlib
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
        return subprocess.run([self.grove, *map(str, words)], cwd=self.folder, capture_output=True, text=True,
                              check=True)

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
        self.browser.settle()

    def positions(self):
        return self.browser.evaluate("[...grove.stages[0].frame.xs].map((x, i) => [x, grove.stages[0].frame.ys[i]])")

    def test_ended_drive_is_shown(self):
        self.begin(line(0, "a", [0, 0], 0, "moving", 90), line(0, "b", [0, 1], 0, "done"),
                   line(2, "a", [1, 0], 1, "moving", 90), line(4, "a", [2, 0], 2, "lifted"),
                   line(9, "a", [2, 0], 2, "moving", 90), line(13, "a", [4, 0], 4, "done", 90))
        self.browser.open(self.drive_page())
        self.go(1)
        for got, expected in zip(self.positions(), ([1.0, 0.5], [0.5, 1.5])):
            for one, other in zip(got, expected):
                self.assertAlmostEqual(one, other, places=3)
        self.assertEqual(self.colours()["a", 0], MOVING)
        self.assertIn("The execution has ended.", self.text(".strip"))
        self.assertIn("moving · 0 of 4", self.text(".rows"))
        self.go(5)
        self.assertEqual(self.colours()["a", 0], COLLISION)
        self.assertIn("1 needs help", self.text(".strip"))
        self.assertIn("lifted off · 2 of 4", self.text(".rows"))
        self.browser.evaluate("grove.app.choose(0)")
        self.browser.settle()
        self.assertIn("2 of 4 actions done: step 2 of 4 of the plan.", self.text(".details"))
        self.assertRegex(self.text(".details"), r"0:04\s+t")
        self.go(13)
        self.assertIn("2 of 2 done, 0 waiting, up to 0:09 late", self.text(".strip"))
        self.quiet()

    def test_link_selects_a_time_and_a_robot(self):
        self.begin(line(0, "a", [0, 0], 0, "moving", 90), line(0, "b", [0, 1], 0, "done"),
                   line(10, "a", [4, 0], 4, "done", 90))
        self.browser.open(self.drive_page(), "#t=5&agent=a")
        self.wait_for("grove.app.player.time === 5 && grove.app.chosen === 0")
        self.assertAlmostEqual(self.positions()[0][0], 2.5, places=3)
        self.assertIn("a", self.text(".details h2"))
        self.browser.evaluate("grove.app.go(7), grove.app.choose(1)")
        self.wait_for("location.hash === '#t=7&agent=b'")
        self.browser.evaluate("location.hash = '#t=2&task=t'")
        self.wait_for("grove.app.player.time === 2 && grove.app.chosenTask === 0 && grove.app.chosen === -1")
        self.quiet()

    def test_link_to_a_live_drive_selects_a_time(self):
        self.begin(line(0, "a", [0, 0], 0, "moving", 90), line(20, "a", [1, 0], 1, "moving"))
        with self.server() as address:
            with pages.Chromium("--disable-gpu", "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1") as browser:
                self.browser = browser
                browser.call("Page.navigate", url=address + "#t=5&agent=a")
                self.wait_for("globalThis.grove?.app.player.time === 5 && grove.app.chosen === 0 && "
                              "!grove.app.player.live")
                browser.evaluate("document.querySelector('.golive').click()")
                self.wait_for("location.hash === '#agent=a'")  # a live page has no time in its address

    def test_states_have_different_signs(self):
        self.begin(*(line(t, "a", [0, 0], 0, state)
                     for t, state in enumerate(("waiting", "moving", "working", "lifted", "lost", "done"))))
        self.browser.open(self.drive_page())
        seen = set()
        for t, sign in enumerate(("…", "", "↻", "↑", "?", "✓")):
            self.go(t)
            self.assertEqual(self.browser.evaluate("grove.stages[0].frame.mark(0)"), sign)
            seen.add(self.around_the_robot())
        self.assertEqual(len(seen), 6)  # all states differ visibly
        self.quiet()

    def around_the_robot(self):
        """Returns the pixels of the label canvas at the edge of the robot, where the signs are."""
        return self.browser.evaluate("""(() => {
          const {camera, frame, element} = grove.stages[0];
          const at = camera.toView(frame.xs[0], frame.ys[0]);
          const r = 0.34 * camera.scale;
          const canvas = element.querySelectorAll("canvas")[3];
          const ratio = canvas.width / camera.width;
          const box = [at.x + 0.4 * r, at.y - 1.1 * r, 0.7 * r, 0.7 * r].map((v) => Math.round(v * ratio));
          const copy = Object.assign(document.createElement("canvas"), {width: box[2], height: box[3]});
          const c = copy.getContext("2d", {willReadFrequently: true});
          c.drawImage(canvas, ...box, 0, 0, box[2], box[3]);
          return [...c.getImageData(0, 0, box[2], box[3]).data].join();
        })()""")

    def test_truncated_log_is_shown(self):
        self.begin(line(0, "a", [0, 0], 0, "moving"), line(3, "a", [2, 0], 2, "waiting"), '{"t": 4, "rob')
        self.browser.open(self.drive_page())
        self.assertIn("The log ends before all robots are done.", self.text(".strip"))
        self.go(3)
        self.assertIn("waiting · 2 of 4", self.text(".rows"))
        self.quiet()

    def test_invalid_line_is_refused(self):
        self.begin(line(1, "a", [1, 0], 1, "moving"), line(2, "a", [1, 0], 1, ALERT))
        words = [self.grove, "view", self.instance_file, self.plan_file, "--drive", self.log]
        done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("drive.jsonl: line 3: /state: found", done.stderr)
        self.assertFalse((self.folder / "drive.html").exists())

    def test_robots_on_a_roadmap_are_at_its_vertices(self):
        """Checks that metres have y up: a robot at a vertex is shown where the vertex is painted."""
        self.instance_file = pages.DATA / "yard.cts.json"
        self.run_grove("solve", self.instance_file, "--quiet", "--threads", "1", "--output", self.plan_file)
        yard = json.loads((pages.DATA / "yard.roadmap.json").read_text())
        robot = json.loads(self.instance_file.read_text())["agents"][0]["id"]
        self.begin(*(line(t, robot, vertex["at"], 0, "moving") for t, vertex in enumerate(yard["vertices"])),
                   robots=(robot,))
        self.browser.open(self.drive_page())
        for t in range(len(yard["vertices"])):
            self.go(t)
            x, y, there_x, there_y = self.browser.evaluate(f"""(() => {{
              const {{frame}} = grove.stages[0], {{xs, ys}} = grove.app.model.world;
              return [frame.xs[0], frame.ys[0], xs[{t}], ys[{t}]];
            }})()""")
            self.assertAlmostEqual(x, there_x, places=2)
            self.assertAlmostEqual(y, there_y, places=2)
        self.quiet()

    def test_hostile_names_run_no_script(self):
        instance = self.grid(3, 1, [{"id": ALERT, "start": [0, 0], "goal": [2, 0]}],
                             [{"id": ALERT, "cell": [1, 0], "agents": [ALERT]}])
        self.run_grove("solve", instance, "--quiet", "--output", self.plan_file)
        self.begin(line(0, ALERT, [0, 0], 0, "moving"), line(2, ALERT, [2, 0], 2, "done"), robots=(ALERT,))
        self.browser.open(self.drive_page())
        self.browser.evaluate("grove.app.choose(0)")
        self.browser.settle()
        self.assertIn(ALERT[:20], self.text(".details"))
        self.assertNotEqual(self.browser.evaluate("document.title"), "owned")
        self.quiet()

    def test_demo_drive_is_shown(self):
        done = self.run_grove("toio", "--demo", "--fast", "--log", self.log)
        self.assertIn("all visited", done.stdout)
        demo = self.grove.parent / "grove_toio/demo/demo.cts.json"
        self.run_grove("solve", demo, "--omega", "0", "--threads", "1", "--quiet", "--output", self.plan_file)
        self.instance_file = demo
        self.browser.open(self.drive_page())
        self.browser.evaluate("grove.app.player.go(grove.app.player.end), grove.app.changed()")
        self.browser.settle()
        self.assertIn("3 of 3 done", self.text(".strip"))
        self.assertEqual(self.browser.evaluate("grove.app.tasks.every(({agents, times}) => times.length === "
                                               "agents.length)"), True)
        self.quiet()

    @contextlib.contextmanager
    def server(self, *words):
        """Runs a server, yields its address and ends it with SIGINT."""
        command = [self.grove, "view", self.instance_file, self.plan_file, "--drive", self.log, "--follow", *words]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
            try:
                yield re.search(r"http://127\.0\.0\.1:\d+/[0-9a-f]{32}/", server.stdout.readline())[0]
                server.send_signal(signal.SIGINT)
                self.assertEqual(server.wait(120), 0)
            finally:
                server.kill()

    def test_live_drive_is_followed(self):
        with self.server() as address:
            with pages.Chromium("--disable-gpu", "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1") as browser:
                self.browser = browser
                self.follow(address)
            request = urllib.request.Request(address, headers={"Host": "evil.example"})
            with self.assertRaises(urllib.error.HTTPError) as refused:
                urllib.request.urlopen(request)
            self.assertEqual(refused.exception.code, 403)
            refused.exception.close()

    def test_server_sends_without_compression(self):
        """Checks that httplib does not compress a long log, because that would take seconds. The browser would
        accept it."""
        self.begin(*(line(t, "a", [0, 0], 0, "moving") for t in range(1000)))
        with self.server() as address:
            for path in ("", "log?from=0&file="):
                request = urllib.request.Request(address + path, headers={"Accept-Encoding": "gzip, br"})
                with urllib.request.urlopen(request) as answer:
                    self.assertIsNone(answer.headers["Content-Encoding"])
                    text = answer.read().decode()
            self.assertEqual(text, self.log.read_text())

    def test_port_is_reserved_and_released(self):
        with self.server() as address:
            port = re.search(r":(\d+)/", address)[1]
            for _ in range(5):
                with urllib.request.urlopen(address) as answer:
                    answer.read()  # returns only when the server closes the connection
            words = [self.grove, "view", self.instance_file, self.plan_file, "--drive", self.log, "--follow", "--port",
                     port]
            second = subprocess.run(words, capture_output=True, text=True, timeout=120)
            self.assertEqual(second.returncode, 2)
            self.assertIn("--port: is in use", second.stderr)
        with self.server("--port", port) as again:  # the port is free again immediately
            self.assertIn(f":{port}/", again)
            self.assertNotEqual(again, address)  # a new token

    def follow(self, address):
        self.browser.call("Page.navigate", url=address)
        self.until("Waiting for the execution to start.")
        self.begin(line(0, "a", [0, 0], 0, "moving"), line(0, "b", [0, 1], 0, "waiting"))
        self.until("Live.")
        self.add(line(20, "a", [1, 0], 1, "waiting"))
        self.until(lambda: abs(self.positions()[0][0] - 1.5) < 0.1)
        self.drag_the_slider(0.1)
        self.until("The execution continues; this is an earlier moment.")
        self.assertEqual(self.browser.evaluate("document.querySelector('.golive').ariaPressed"), "false")
        self.assertLess(before := self.browser.evaluate("grove.app.player.time"), 10)
        self.add(line(40, "a", [2, 0], 2, "moving"))
        self.until(lambda: self.browser.evaluate("grove.app.player.end") == 40)
        self.assertEqual(self.browser.evaluate("grove.app.player.time"), before)
        self.browser.evaluate("document.querySelector('.golive').click()")
        self.until("Live.")
        whole = line(50, "a", [3, 0], 3, "moving")
        self.add(whole[:30])  # the line arrives in two parts
        self.wait_for_two_requests()
        self.assertEqual(self.browser.evaluate("grove.app.player.end"), 40)
        self.add(whole[30:])
        self.until(lambda: self.browser.evaluate("grove.app.player.end") == 50)
        self.add(line(51, "a", [1, 0], 1, ALERT), line(51, "ghost", [1, 0], 1, "moving"), "{\n")
        self.until("⚠ 3 invalid log lines skipped; first: line 7: state: expected one of")
        self.add(line(60, "a", [4, 0], 4, "done"), line(60, "b", [0, 1], 0, "done"))
        self.until("The execution has ended.")
        self.until("2 of 2 done")
        self.begin(line(0, "a", [0, 0], 0, "moving"))  # a different execution
        self.until(lambda: self.browser.evaluate("grove.app.player.end") == 0)
        self.assertNotIn("skipped", self.text(".strip"))
        self.log.write_text("no drive\n")
        self.until("This is not the log of an execution of this plan: line 1: the data is no JSON")
        self.assertEqual(self.browser.console, [])
        self.assertTrue(all(url.startswith(address) for url in self.browser.requests), self.browser.requests)

    def drag_the_slider(self, part):
        """Drags the slider with the mouse from its end to a fraction of its length."""
        box = self.browser.evaluate("(({x, y, width, height}) => [x, y, width, height])"
                                    "(document.querySelector('.time').getBoundingClientRect())")
        y = box[1] + box[3] / 2
        places = [box[0] + part_of * (box[2] - 16) + 8 for part_of in (0.95, 0.5, part)]
        mouse = lambda kind, x, **more: self.browser.call("Input.dispatchMouseEvent", type=kind, x=x, y=y,
                                                          **more)  # noqa: E731
        mouse("mousePressed", places[0], button="left", buttons=1, clickCount=1)
        for x in places[1:]:
            mouse("mouseMoved", x, button="left", buttons=1)
        mouse("mouseReleased", places[-1], button="left", buttons=0, clickCount=1)
        self.browser.settle()

    def add(self, *lines):
        with self.log.open("a") as file:
            file.write("".join(lines))

    def until(self, what):
        """Waits until the top line contains a text, or until a condition holds."""
        self.browser.wait_until(what, (lambda: what in self.text(".strip")) if isinstance(what, str) else what)

    def wait_for_two_requests(self):
        """Waits until the page has requested the log twice, because it has then processed the first answer."""
        before = len(self.browser.requests)
        self.browser.wait_until("more requests", lambda: len(self.browser.requests) >= before + 2)


if __name__ == "__main__":
    pages.main()
