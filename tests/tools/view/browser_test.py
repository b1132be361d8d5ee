#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Opens pages of grove view in a browser and checks that they send no requests, log no errors, and show the plan.

    browser_test.py GROVE

The environment variable GROVE_GL_PAGE names the bundle of gl_page.ts.

Exit codes: 0 passed, 1 failed, 77 skipped because Chromium is not installed.
"""
import json
import os
from pathlib import Path

from pages import CHOSEN, COLLISION, DATA, MOVING, Chromium, NoAnswer, PageTest, main

GL_PAGE = Path(os.environ.get("GROVE_GL_PAGE", "build/release/tests/tools/view/gl_page.mjs"))
DARK_MOVING = (0x56, 0xB4, 0xE9)


class Browser(PageTest):
    def test_plans_of_all_kinds_of_worlds_are_shown(self):
        for name in ("first", "shop", "yard", "empty-32x32_n5_m10"):
            with self.subTest(name):
                page = self.page(DATA / f"{name}.cts.json", self.solved(name))
                for size in ((1280, 800), (390, 844)):
                    seen = self.see(page, size=size, fragment="#t=1")
                    self.assertGreater(seen.get(MOVING, 0), 0)
                    self.assertLess(seen.get(COLLISION, 0), 0.01)

    def test_colours_follow_the_preferred_scheme(self):
        page = self.page(DATA / "first.cts.json", self.solved("first"))
        for scheme, floor, moving in (("light", (255, 255, 255), MOVING), ("dark", (0x1B, 0x20, 0x28), DARK_MOVING)):
            self.browser.prefer(prefers_color_scheme=scheme)
            seen = self.see(page)
            self.assertGreater(seen.get(floor, 0), 0.3)
            self.assertGreater(seen.get(moving, 0), 0.001)
        self.browser.prefer(prefers_color_scheme="light")

    def test_instance_without_a_plan_has_no_controls(self):
        self.see(self.page(DATA / "shop.cts.json"))
        self.assertEqual(self.text(".controls"), "")

    def test_link_selects_a_time_and_a_robot(self):
        page = self.page(DATA / "shop.cts.json", self.solved("shop"))
        self.assertLess(self.see(page).get(CHOSEN, 0), 0.001)
        self.assertGreater(self.see(page, fragment="#t=8&agent=blue").get(CHOSEN, 0), 0.002)

    def drawn_by_webgl(self, page):
        with Chromium("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader") as browser:
            browser.open(page)
            return json.loads(browser.evaluate("document.querySelector('#result').textContent"))

    def test_webgl_paints_robots(self):
        page = self.folder / "gl.html"
        page.write_text(f"<body><script>{GL_PAGE.read_text(encoding='utf-8')}</script></body>", encoding="utf-8")
        try:
            found = self.drawn_by_webgl(page)
        except NoAnswer:  # happened once: software rendering hung on a correct page
            found = self.drawn_by_webgl(page)
        opaque = {name: f"{r},{g},{b},255" for name, (r, g, b) in
                  {"moving": MOVING, "resting": (0x8A, 0x92, 0x9C), "collision": COLLISION,
                   "heading": (0x1C, 0x21, 0x28)}.items()}
        self.assertEqual(found["pixels"], {
            "a moves": opaque["moving"], "an empty cell": "0,0,0,0",
            "b turns, pointing down and to the left": opaque["heading"],
            "c and d collide": opaque["collision"], "their star is larger than a robot": opaque["collision"],
            "a rests": opaque["resting"]})
        print(f"10,000 robots by WebGL: {found['milliseconds']:.1f} ms a frame (no graphics card here)")

    def test_keyboard_reaches_every_control(self):
        self.open(self.page(DATA / "shop.cts.json", self.solved("shop")))
        self.browser.key("?")
        self.assertTrue(self.evaluate("document.querySelector('dialog').open"))
        self.browser.key("n")
        self.assertEqual(self.text(".details h2"), "", "keys act on the list of keys only")
        self.browser.key("?")
        self.assertFalse(self.evaluate("document.querySelector('dialog').open"))
        self.browser.key("n")
        self.browser.key("f")
        self.browser.settle()
        self.assertEqual(self.text(".details h2"), "red")
        self.assertTrue(self.evaluate("grove.app.following"))
        # The tab key reaches every control, and the focused control is visible as such.
        reached = set()
        for _ in range(60):
            self.browser.key("Tab")
            reached.add(self.evaluate("(e => e.tagName + ' ' + (e.title || e.ariaLabel || "
                                      "e.textContent))(document.activeElement)"))
            outlined = self.evaluate("document.activeElement === document.body || "
                                     "getComputedStyle(document.activeElement).outlineStyle !== 'none'")
            self.assertTrue(outlined)
        controls = self.evaluate("[...document.querySelectorAll('button, select, input')].filter((e) => "
                                 "e.checkVisibility())"
                                 ".map((e) => e.tagName + ' ' + (e.title || e.ariaLabel || e.textContent))")
        self.assertGreater(len(controls), 15)
        self.assertEqual(set(controls) - reached, set())
        # Keys pressed in a select element must not affect the player.
        before = self.evaluate("grove.app.player.time")
        self.evaluate("document.querySelector('select').focus()")
        self.browser.key("ArrowRight")
        self.assertEqual(self.evaluate("grove.app.player.time"), before)
        self.assert_silent()


class TwoPlans(PageTest):
    """Tests pages with two plans side by side."""

    def both(self, one, other):
        """Writes a page with two plans for robots a, b and c. None stands for a file without a plan."""
        instance = self.grid(8, 3, [{"id": name, "start": [0, y]} for y, name in enumerate("abc")],
                             [{"id": "t", "cell": [1, 1], "agents": ["b"]},
                              {"id": "u", "cell": [2, 1], "agents": ["b"]}])
        sequence = {"b": ["t", "u"]}
        files = []
        for name, paths in (("one", one), ("two", other)):
            file = self.plan(paths or {}, name=f"{name}.json", sequence=sequence)
            if paths is None:
                file.write_text(json.dumps({"status": "unknown", "lower_bound": 3, "omega": 0}), encoding="utf-8")
            files.append(file)
        return self.page(instance, *files)

    @staticmethod
    def row(y, *xs):
        return [[x, y] for x in xs]

    def good(self, **changes):
        return {"a": self.row(0, 0, 1, 2), "b": self.row(1, 0, 1, 2), "c": self.row(2, 0, 1), **changes}

    def open_both(self, one, other):
        self.open(self.both(one, other))
        self.wait_until_known()
        self.assert_silent()

    def test_differences_have_costs_and_times(self):
        self.open_both(self.good(), self.good(b=self.row(1, 0, 0, 0, 1, 2), c=self.row(2, 0, 0, 1)))
        self.assertIn("2 of 3 robots differ. two.json costs 3 more than one.json.", self.text(".filters"))
        self.assertEqual(self.texts(".row"), ["b2 → 4 (+2)", "c1 → 2 (+1)"])
        self.assertEqual(self.texts(".pair .moment"), ["1", "1"])
        self.assertIn("cost 8 (+3, +60 %)", self.texts(".plan .claim"))
        self.choose_option("Sort order", "name")
        self.assertEqual(self.texts(".row")[0], "b2 → 4 (+2)")

    def test_row_selects_the_robot_in_both_plans_and_its_first_difference(self):
        self.open_both(self.good(), self.good(b=self.row(1, 0, 1, 1, 2)))
        self.press("b", ".pair .row")
        self.assertEqual(self.text(".details h2"), "b")
        self.assertEqual(self.evaluate("grove.app.player.time"), 0)
        self.assertIn("It costs +1 in the second plan.", self.text(".details"))
        self.assertEqual(self.texts(".visits .moment"), ["1", "1", "2", "3"])
        self.press("2", ".pair .moment")
        self.assertEqual(self.evaluate("grove.app.player.time"), 2)
        # Each stage shows both paths of the chosen robot: its own in the robot's colour, the other dashed in the text
        # colour.
        for stage in self.evaluate("grove.stages.map(({element}) => (({x, y, width, height}) => [x, y, width, height])"
                                   "(element.getBoundingClientRect()))"):
            x, y, width, height = map(round, stage)
            seen = self.browser.look().crop((x, y, x + width, y + height)).getcolors(1 << 24)
            self.assertGreater(dict((colour, count) for count, colour in seen).get(CHOSEN, 0), 100)
        self.assertNotEqual(*(self.evaluate(f"JSON.stringify([...grove.stages[{i}].frame.xs])") for i in (0, 1)))

    def test_different_order_of_visits_is_shown(self):
        self.open_both(self.good(), self.good(b=[[0, 1], [0, 2], [1, 2], [2, 2], [2, 1], [1, 1]], c=[[0, 2], [0, 2]]))
        self.assertIn("different order", self.texts(".row")[0])

    def test_equal_plans_have_no_differences(self):
        self.open_both(self.good(), self.good())
        self.assertIn("0 of 3 robots differ. Both plans cost the same.", self.text(".filters"))
        self.assertIn("every robot does the same", self.text(".rows"))
        self.browser.key("n")
        self.browser.settle()
        self.assertIn("the same in both", self.text(".details"))

    def test_missing_path_is_shown(self):
        self.open_both(self.good(), self.good(a=[]))
        self.assertIn("cannot be compared", self.text(".filters"))
        self.assertEqual(self.texts(".row"), ["a2 → no path"])
        self.press("a", ".pair .row")
        self.assertIn("The plan has no path for this robot.", self.text(".details"))

    def test_file_without_a_plan_is_shown(self):
        self.open_both(self.good(), None)
        self.assertEqual(self.evaluate("grove.stages.length"), 1)
        self.assertIn("no plan in this file", self.text(".strip"))

    def test_plans_of_different_lengths_play_together(self):
        self.open_both(self.good(), self.good(c=self.row(2, 0, *[0] * 20, 1)))
        self.assertTrue(self.text(".clock").endswith("/ 21"))
        self.browser.key("End")
        self.browser.settle()
        self.assertEqual(self.evaluate("grove.stages.map((s) => s.frame.time)"), [21, 21])


if __name__ == "__main__":
    main()
