#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the controls of a page with keyboard, mouse and touch.

    controls_test.py GROVE

Exit codes: 0 passed, 1 failed, 77 skipped because Chromium is not installed.
"""
from pages import DATA, PageTest, main

HEAT = (0xD5, 0x5E, 0x00)


class Controls(PageTest):
    def setUp(self):
        super().setUp()
        self.open(self.page(DATA / "shop.cts.json", self.solved("shop")))
        self.wait_until_known()

    def state(self, what):
        return self.evaluate(f"grove.app.{what}")

    def scale(self):
        return self.evaluate("grove.stages[0].camera.scale")

    def centre(self):
        return self.evaluate("[grove.stages[0].camera.center.x, grove.stages[0].camera.center.y]")

    def box(self, selector):
        return self.evaluate(f"(({{x, y, width, height}}) => [x, y, width, height])"
                             f"(document.querySelector({selector!r}).getBoundingClientRect())")

    def button(self, title):
        self.evaluate(f"""document.querySelector('button[title^="{title}"]').click()""")
        self.browser.settle()

    def keys(self, *keys):
        for key in keys:
            self.browser.key(key)
        self.browser.settle()

    def finger(self, kind, *points):
        self.browser.call("Input.dispatchTouchEvent", type=kind,
                          touchPoints=[{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)])

    def test_time_controls(self):
        for title, expected in (("One step forward", 1), ("To the end", 35), ("One step back", 34),
                                ("To the beginning", 0)):
            self.button(title)
            self.assertEqual(self.state("player.time"), expected)
        self.keys("PageDown", "PageDown", "PageUp", "ArrowRight")
        self.assertEqual(self.state("player.time"), 11)
        self.evaluate("(s => (s.value = 20.5, s.dispatchEvent(new Event('input'))))(document.querySelector('.time'))")
        self.browser.settle()
        self.assertEqual(self.text(".clock"), "20.5 / 35")
        self.button("Play")
        self.wait_for("grove.app.player.time > 21")
        self.button("Play")
        self.assertFalse(self.state("player.playing"))

    def test_speed_and_loop(self):
        self.button("Faster")
        self.assertEqual(self.text(".speed"), "8 /s")
        self.keys(",", ",", ",")
        self.assertEqual(self.text(".speed"), "1 /s")
        self.keys(*"." * 20)
        self.assertEqual(self.text(".speed"), "64 /s")
        self.keys("End", " ")
        self.wait_for("!grove.app.player.playing")
        self.assertEqual(self.state("player.time"), 35, "it restarts and stops at the end")
        self.keys("l", " ")
        self.wait_for("(window.latest ?? 0) > (window.latest = grove.app.player.time)")  # it has started again
        self.assertTrue(self.state("player.playing"), "a loop does not end")

    def test_wheel_zooms_and_drag_pans(self):
        x, y, *_ = self.box(".stage")
        whole = self.scale()
        self.browser.mouse("mouseWheel", x + 100, y + 100, deltaX=0, deltaY=-200)
        self.browser.settle()
        self.assertGreater(self.scale(), whole)
        before = self.centre()
        self.browser.mouse("mousePressed", x + 200, y + 200, button="left", buttons=1)
        self.browser.mouse("mouseMoved", x + 240, y + 200, button="left", buttons=1)
        self.browser.mouse("mouseReleased", x + 240, y + 200, button="left")
        self.assertLess(self.centre()[0], before[0], "dragging the map to the right moves the view to the left")
        self.keys("0")
        self.assertEqual(self.scale(), whole)
        self.keys("+", "d")
        self.assertGreater(self.scale(), whole)

    def test_pinch_zooms_and_swipe_pans(self):
        x, y, *_ = self.box(".stage")
        whole = self.scale()
        self.finger("touchStart", (x + 200, y + 200), (x + 300, y + 200))
        self.finger("touchMove", (x + 180, y + 200), (x + 320, y + 200))
        self.finger("touchMove", (x + 100, y + 200), (x + 400, y + 200))
        self.finger("touchEnd")
        self.browser.settle()
        self.assertGreater(self.scale(), 1.1 * whole)
        before = self.centre()
        self.finger("touchStart", (x + 200, y + 200))
        for k in range(1, 6):
            self.finger("touchMove", (x + 200 + 10 * k, y + 200))
        self.finger("touchEnd")
        self.assertLess(self.centre()[0], before[0])

    def test_click_selects_robot_task_destination_or_nothing(self):
        x, y, *_ = self.box(".stage")

        def click(cell_x, cell_y):
            at = self.evaluate(f"grove.stages[0].camera.toView({cell_x + 0.5}, {cell_y + 0.5})")
            self.browser.click(x + at["x"], y + at["y"])
            self.browser.settle()
            return self.text(".details h2")
        self.assertEqual(click(8, 4), "blue")
        self.assertEqual(click(2, 3), "shelf")
        self.assertEqual(click(8, 0), "red", "the destination of red")
        self.assertEqual(click(3, 0), "")

    def test_followed_robot_stays_in_the_middle(self):
        for _ in range(12):
            self.browser.key("+")
        self.keys("n", "f", "ArrowRight", "ArrowRight", "ArrowRight")
        self.assertEqual(self.centre(), [0.5, 2.5])
        self.go(7)
        self.assertEqual(self.centre(), [2.5, 3.5])
        self.keys("d")
        self.assertFalse(self.state("following"))
        self.assertNotEqual(self.centre(), [2.5, 3.5])

    def test_minimap_moves_the_view(self):
        for _ in range(8):
            self.browser.key("+")
        self.browser.settle()
        x, y, width, height = self.box(".minimap")
        self.browser.click(x + 0.8 * width, y + 0.5 * height)
        self.browser.settle()
        self.assertAlmostEqual(self.centre()[0], 0.8 * 9, delta=0.2)

    def test_chart_sets_the_time_and_its_names_select(self):
        x, y, width, height = self.box(".chart")
        self.browser.click(x + width - 2, y + 5)
        self.assertEqual(self.state("player.time"), 35)
        self.browser.click(x + 5, y + 33)
        self.browser.settle()
        self.assertEqual(self.text(".details h2"), "blue")
        self.browser.mouse("mouseMoved", x + width / 4, y + 5)
        self.assertIn("red works from 7 until 12", self.evaluate("document.querySelector('.chart').title"))

    def test_heat_map_is_visible(self):
        for kind in ("traffic", "waits", "yields"):
            self.choose_option("Heat map", kind)
            self.assertGreater(self.evaluate("grove.stages[0].shown().heat.reduce((a, b) => a + b, 0)"), 0.9, kind)
            colours = [colour for _, colour in self.browser.look().getcolors(1 << 24)]
            near = min(sum(abs(a - b) for a, b in zip(colour, HEAT)) for colour in colours)
            self.assertLess(near, 150, kind)  # the heat map lies translucent on the floor
        self.choose_option("Heat map", "none")
        self.assertIsNone(self.evaluate("grove.stages[0].shown().heat"))

    def test_long_wait_is_listed_as_an_event(self):
        self.press("Events", ".tabs button")
        self.choose_option("Kind of events", "wait")
        self.assertEqual(self.texts(".row span[dir]"), ["blue waits 4 steps for red to pass"])
        self.keys("n")
        self.press("only robot red", ".filter button")
        self.assertEqual(self.texts(".row"), [])
        self.press("only robot red", ".filter button")
        time = self.text(".row .note")
        self.go(30)
        self.press("blue waits", ".row")
        self.assertEqual((self.text(".details h2"), f"step {self.state('player.time')}"), ("blue", time))
        # A robot that is selected in the list keeps the focus there.
        self.keys("Escape")
        self.evaluate("(row => (row.focus(), row.click()))(document.querySelector('.row'))")
        self.browser.settle()
        self.assertEqual(self.text(".details h2"), "blue")
        self.assertEqual(self.evaluate("document.activeElement.className"), "row")
        self.choose_option("Kind of events", "all")
        self.evaluate("(s => (s.value = 'dock', s.dispatchEvent(new "
                      "Event('input'))))(document.querySelector('input[type=search]'))")
        self.assertEqual(self.texts(".row span[dir]"), ["dock is done", "dock"])

    def tearDown(self):
        self.assert_silent()


if __name__ == "__main__":
    main()
