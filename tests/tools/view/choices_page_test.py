#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests pages of instances in which robots choose tasks and destinations.

    choices_page_test.py GROVE

Exit codes: 0 passed, 1 failed, 77 skipped because Chromium is not installed.
"""
from pages import CHOSEN, PageTest, main, shares


def row(y, *xs):
    return [[x, y] for x in xs]


class Choices(PageTest):
    """Robots a, b and c. Robots a and b may end on three places, one robot must do "any" for 2 steps, two of a and c
    must visit "two", and c must visit "own"."""

    def setUp(self):
        super().setUp()
        goals = [[5, 0], [0, 3], [5, 3]]
        self.choices = self.grid(
            6, 4, [{"id": "a", "start": [0, 0], "goals": goals}, {"id": "b", "start": [0, 1], "goals": goals},
                   {"id": "c", "start": [0, 2]}],
            [{"id": "any", "cell": [2, 1], "agents": "*", "need": 1, "duration": 2},
             {"id": "two", "cell": [3, 0], "agents": ["a", "c", "b"], "need": 2},
             {"id": "own", "cell": [1, 2], "agents": ["c"]}])
        self.paths = {"a": row(0, 0, 1, 2, 3, 4, 5),
                      "b": [[0, 1], [1, 1], [2, 1], [2, 1], [2, 1], [2, 0], [3, 0], [3, 1], [3, 2], [3, 3], [4, 3],
                            [5, 3]],
                      "c": row(2, 0, 1)}
        self.work = {"a": [{"task": "two", "begin": 3, "end": 3}],
                     "b": [{"task": "any", "begin": 2, "end": 4}, {"task": "two", "begin": 6, "end": 6}]}
        self.order = {"a": ["two"], "b": ["any", "two"], "c": ["own"]}

    def page_of_plan(self, work=None, order=None, **paths):
        plan = self.plan({**self.paths, **paths}, work=work or self.work, sequence=order or self.order)
        return self.page(self.choices, plan)

    def test_lists_show_needs_and_open_tasks(self):
        self.open(self.page_of_plan())
        self.wait_until_known()
        self.assertEqual(self.text(".verdict"), "✓ valid, checked by this page")
        self.assertEqual(self.texts(".row"), ["any0 of 1 (any of 3)", "two0 of 2 (any of 3)", "own0 of 1"])
        for time, open_tasks in ((0, 3), (1, 2), (3, 2), (4, 1), (6, 0)):
            self.go(time)
            self.assertIn(f"{open_tasks} of 3 open now", self.text(".filters"))
        self.press("only open", ".filter button")
        self.assertEqual(self.texts(".row"), [])
        self.assertIn("no task is open", self.text(".rows"))
        self.go(5)
        self.assertEqual(self.texts(".row"), ["two1 of 2 (any of 3)"])
        self.press("Events", ".tabs button")
        self.choose_option("Kind of events", "task")
        self.assertEqual(self.texts(".row span[dir]"), ["own is done", "any is done by b", "two is done by b"])
        self.assert_silent()

    def test_details_show_who_visits_a_task_and_when(self):
        self.open(self.page_of_plan(), "#t=0&task=two")
        self.assertIn("Needs 2 of 3 robots: any.", self.text(".details"))
        self.assertEqual(self.texts(".details .moments li"), ["3 a", "6 b"])
        self.open(self.page_of_plan(), "#t=0&agent=b")
        details = self.text(".details")
        self.assertIn("Ends on [5, 3], its choice of 3 possible destinations.", details)
        self.assertIn("Visits 2 of 2 tasks that it may visit.", details)
        self.assertEqual(self.texts(".details .moments li"), ["2 any (by choice), at work until 4",
                                                              "6 two (by choice)"])
        self.assert_silent()

    def test_possible_destinations_are_marked(self):
        def colours_around(x, y):
            box = self.evaluate("(({x, y}) => [x, y])(document.querySelector('.stage').getBoundingClientRect())")
            centre = self.evaluate(f"grove.stages[0].camera.toView({x + 0.5}, {y + 0.5})")
            half = self.evaluate("0.45 * grove.stages[0].camera.scale")
            left, top = box[0] + centre["x"] - half, box[1] + centre["y"] - half
            return shares(self.browser.look().crop(tuple(map(round, (left, top, left + 2 * half, top + 2 * half)))))
        self.open(self.page_of_plan(), "#t=0&agent=a", size=(800, 520))
        taken, free, of_b = (colours_around(*place).get(CHOSEN, 0) for place in ((5, 0), (0, 3), (5, 3)))
        self.assertGreater(taken, 2 * free)
        self.assertGreater(free, 0.005)
        self.assertGreater(of_b, 0.005)
        self.open(self.page_of_plan(), "#t=0&agent=c", size=(800, 520))
        self.assertEqual(colours_around(0, 3).get(CHOSEN, 0), 0)

    def test_click_selects_the_robot_that_chooses_a_destination(self):
        self.open(self.page_of_plan())
        x, y = self.evaluate("(({x, y}) => [x, y])(document.querySelector('.stage').getBoundingClientRect())")
        for cell, name in (((5, 3), "b"), ((5, 0), "a"), ((0, 3), "")):
            at = self.evaluate(f"grove.stages[0].camera.toView({cell[0] + 0.5}, {cell[1] + 0.5})")
            self.browser.click(x + at["x"], y + at["y"])
            self.browser.settle()
            self.assertEqual(self.text(".details h2"), name)

    def test_need_that_is_not_met_is_a_problem_of_its_task(self):
        work = {**self.work, "a": []}
        self.open(self.page_of_plan(work=work, order={**self.order, "a": []}))
        self.wait_until_known()
        self.assertEqual(self.text(".verdict"), "✗ 1 problem")
        self.press("Events", ".tabs button")
        text = "two is visited by 1 of its 3 robots, but needs 2"
        self.assertEqual(self.texts(".row.bad span[dir]"), [text])
        self.press(text, ".row.bad")
        self.assertEqual(self.text(".details h2"), "two")
        self.assertIn("1 visit missing", self.text(".details"))
        self.assert_silent()

    def test_instance_without_a_plan_shows_choices(self):
        page = self.page(self.choices)
        self.open(page, "#agent=a")
        self.assertIn("May visit any, two.", self.text(".details"))
        self.assertIn("Ends on one of [5, 0], [0, 3], [5, 3].", self.text(".details"))
        self.open(page, "#task=any")
        self.assertIn("Needs 1 of 3 robots: any.", self.text(".details"))
        self.assertIn("possible destination", self.text(".legend"))
        self.assertIn("needs only some robots", self.text(".legend"))
        self.assert_silent()

    def test_plans_with_different_tasks_are_compared(self):
        one = self.plan(self.paths, name="one.json", work=self.work, sequence=self.order)
        other = self.plan(
            {"a": [[0, 0], [1, 0], [2, 0], [2, 1], [2, 1], [2, 1], [2, 0], [3, 0], [4, 0], [5, 0]],
             "b": [[0, 1], [1, 1], [1, 1], [1, 1], [1, 1], [1, 1], [1, 1], [1, 1], [1, 2], [1, 3], [0, 3]],
             "c": [[0, 2], [1, 2], [2, 2], [3, 2], [3, 1], [3, 0], [3, 1], [3, 2], [2, 2], [1, 2]]},
            name="two.json", work={"a": [{"task": "any", "begin": 3, "end": 5}, {"task": "two", "begin": 7, "end": 7}],
                                   "c": [{"task": "two", "begin": 5, "end": 5}]},
            sequence={"a": ["any", "two"], "b": [], "c": ["own", "two"]})
        self.open(self.page(self.choices, one, other), "#agent=b")
        self.wait_until_known()
        self.assertIn("It visits different tasks.", self.text(".details"))
        self.assertEqual(self.texts(".verdict"), 2 * ["✓ valid, checked by this page"])
        self.assertEqual(self.texts(".visits tbody tr"), ["any2not its task", "two6not its task"])
        self.assertIn("different tasks", self.text(".lists"))
        self.assert_silent()


if __name__ == "__main__":
    main()
