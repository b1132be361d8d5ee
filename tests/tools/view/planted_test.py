#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests plans with one planted fault each: only the robots at fault are red, and only at the time of the fault.

    planted_test.py GROVE

Exit codes: 0 passed, 1 failed, 77 skipped because Chromium is not installed.
"""
import json

from pages import MOVING, PageTest, main

ROAD = {"vertices": [{"id": "A", "at": [0, 0]}, {"id": "B", "at": [4, 0]}, {"id": "C", "at": [4, 4]},
                     {"id": "D", "at": [0, 4]}],
        "edges": [{"from": "A", "to": "B", "steps": 4}, {"from": "C", "to": "D", "steps": 3}]}


def cells(*list_of):
    return [list(cell) for cell in list_of]


def turning(x, y, heading, **more):
    return {"id": "a", "start": [x, y], "motion": "turning", "heading": heading, **more}


class Planted(PageTest):
    def check(self, instance, plan, red, event):
        """Asserts which robots are red and which event is listed. red: {time: ids}; event: (time, text)."""
        self.open(self.page(instance, plan), size=(800, 520))
        self.wait_until_known()
        self.assertEqual(self.text(".verdict"), "✗ 1 problem")
        for time, names in red.items():
            with self.subTest(time=time):
                self.go(time)
                self.assertEqual(self.red(), names)
        self.check_event(*event, red)
        self.assert_silent()

    def check_event(self, time, text, red):
        """Asserts that the event is in the list and that a click on it goes to its time."""
        self.go(0)
        self.press("Events", ".tabs button")
        self.choose_option("Kind of events", "wrong")
        self.assertEqual(self.texts(".row.bad span[dir]"), [text])
        self.press(text, ".row.bad")
        self.assertEqual(self.text(".clock").split(" ")[0], str(time))
        self.assertEqual(self.red(), red[time])
        self.assertIn(self.text(".details h2"), red[time])
        self.assertEqual(self.texts(".details h4.bad"), ["Problems"])

    # The third robot, c, is never at fault.
    def grid_of(self, *agents):
        return self.grid(6, 4, [*agents, {"id": "c", "start": [0, 3]}])

    def with_c(self, **paths):
        return self.plan({**paths, "c": cells((0, 3), (1, 3), (2, 3), (3, 3), (4, 3), (5, 3))})

    def test_vertex_collision(self):
        instance = self.grid_of({"id": "a", "start": [0, 1]}, {"id": "b", "start": [2, 0]})
        plan = self.with_c(a=cells((0, 1), (1, 1), (2, 1), (3, 1), (4, 1)), b=cells((2, 0), (2, 0), (2, 1), (2, 2)))
        self.check(instance, plan, {0: "", 1: "", 1.4: "", 1.6: "ab", 2: "ab", 3: "", 4: ""},
                   (2, "a and b are both on [2, 1]"))

    def test_edge_collision(self):
        instance = self.grid_of({"id": "a", "start": [1, 1]}, {"id": "b", "start": [4, 1]})
        plan = self.with_c(a=cells((1, 1), (2, 1), (3, 1), (4, 1)), b=cells((4, 1), (3, 1), (2, 1), (1, 1)))
        self.check(instance, plan, {0: "", 1: "", 1.3: "ab", 2: "ab", 3: ""}, (2, "a and b change places at [2, 1]"))

    def test_collision_with_a_robot_at_rest(self):
        instance = self.grid_of({"id": "a", "start": [0, 1]}, {"id": "b", "start": [3, 1]})
        plan = self.with_c(a=cells((0, 1), (1, 1), (2, 1), (3, 1), (4, 1), (5, 1)), b=cells((3, 1)))
        self.check(instance, plan, {1: "", 2: "", 3: "ab", 4: "", 5: ""}, (3, "a and b are both on [3, 1]"))

    def test_turning_robot_moves_sideways(self):
        instance = self.grid_of(turning(0, 2, "E"))
        path = [[0, 2, "E"], [1, 2, "E"], [1, 1, "E"], [2, 1, "E"]]
        self.check(instance, self.with_c(a=path), {0: "", 1: "", 1.5: "a", 2: "a", 3: ""},
                   (2, "a goes to [1, 1], which is not ahead of it"))

    def test_collision_within_a_turn(self):
        instance = self.grid_of(turning(3, 1, "E", turn_steps=2), {"id": "b", "start": [5, 1]})
        path = [[3, 1, "E"], [3, 1, "E"], [3, 1, "E", "S", 1], [3, 1, "S"], [3, 1, "S"]]
        plan = self.with_c(a=path, b=cells((5, 1), (4, 1), (3, 1), (2, 1), (1, 1)))
        self.check(instance, plan, {0: "", 1: "", 2: "ab", 3: "", 4: ""}, (2, "a and b are both on [3, 1]"))

    def test_turn_reverses(self):
        instance = self.grid_of(turning(3, 1, "E", turn_steps=2))
        path = [[3, 1, "E"], [3, 1, "E", "S", 1], [3, 1, "E"], [4, 1, "E"]]
        self.check(instance, self.with_c(a=path), {0: "", 1: "", 1.5: "a", 2: "a", 3: ""},
                   (2, "a turns in a way that is not a step of a turn"))

    def test_step_to_a_distant_cell(self):
        instance = self.grid_of({"id": "a", "start": [0, 1]})
        plan = self.with_c(a=cells((0, 1), (1, 1), (3, 1), (4, 1)))
        self.check(instance, plan, {1: "", 1.5: "a", 2: "a", 3: ""},
                   (2, "a goes from [1, 1] to [3, 1], which is not a possible step"))

    def test_step_onto_a_blocked_cell(self):
        instance = self.grid(4, 2, [{"id": "a", "start": [0, 0]}], rows=["..@.", "...."])
        plan = self.plan({"a": cells((0, 0), (1, 0), (2, 0), (2, 1), (3, 1))})
        self.check(instance, plan, {1: "", 2: "a", 3: "", 4: ""}, (2, "a goes from [1, 0] to [2, 0], which is blocked"))

    def test_robot_moves_during_work(self):
        instance = self.grid(6, 4, [{"id": "a", "start": [0, 1], "goal": [4, 1]}, {"id": "c", "start": [0, 3]}],
                             [{"id": "t", "cell": [2, 1], "agents": ["a"], "duration": 3}])
        plan = self.plan({"a": cells((0, 1), (1, 1), (2, 1), (2, 1), (2, 1), (3, 1), (3, 1), (4, 1)),
                          "c": cells((0, 3))},
                         work={"a": [{"task": "t", "begin": 2, "end": 5}]}, sequence={"a": ["t"]})
        self.check(instance, plan, {1: "", 3: "", 4: "", 5: "a", 6: ""}, (5, "a moves at work on t"))

    def test_path_ends_away_from_the_goal(self):
        instance = self.grid_of({"id": "a", "start": [0, 1], "goal": [4, 1]})
        plan = self.with_c(a=cells((0, 1), (1, 1), (2, 1), (3, 1)))
        self.check(instance, plan, {1: "", 2: "", 3: "a", 4: "a", 5: "a"},
                   (3, "a ends on [3, 1], not on its destination [4, 1]"))

    def roads(self, a, b):
        (self.folder / "r.roadmap.json").write_text(json.dumps(ROAD), encoding="utf-8")
        return self.instance({"roadmap": "r.roadmap.json", "agents": [{"id": "a", "start": a}, {"id": "b", "start": b}],
                              "tasks": []})

    def test_vertex_collision_on_a_road(self):
        plan = self.plan({"a": [["A"], ["A", "B", 1], ["A", "B", 2], ["A", "B", 1], ["A"]],
                          "b": [["B"], ["A", "B", 3], ["A", "B", 2], ["A", "B", 3], ["B"]]})
        self.check(self.roads("A", "B"), plan, {0: "", 1: "", 2: "ab", 3: "", 4: ""}, (2, "a and b are both on A–B 2"))

    def test_edge_collision_on_a_road(self):
        plan = self.plan({"a": [["C"], ["C", "D", 1], ["C", "D", 2], ["D"]],
                          "b": [["D"], ["C", "D", 2], ["C", "D", 1], ["C"]]})
        self.check(self.roads("C", "D"), plan, {0: "", 1: "", 1.5: "ab", 2: "ab", 3: ""},
                   (2, "a and b change places at C–D 1"))

    def test_only_the_invalid_of_two_plans_is_red(self):
        instance = self.grid_of({"id": "a", "start": [1, 1]}, {"id": "b", "start": [4, 2]})
        good = {"a": cells((1, 1), (2, 1), (3, 1)), "b": cells((4, 2), (3, 2), (2, 2))}
        bad = {"a": good["a"], "b": cells((4, 2), (4, 1), (3, 1))}
        self.with_c(**good).rename(self.folder / "good.json")
        self.open(self.page(instance, self.folder / "good.json", self.with_c(**bad)))
        self.wait_until_known()
        self.go(2)
        self.assertEqual((self.red(0), self.red(1)), ("", "ab"))

    # Plans in the formats of other programs:

    def other(self, text):
        (self.folder / "other.txt").write_text(text, encoding="utf-8")
        return self.folder / "other.txt"

    def crossing(self):
        return self.grid(6, 4,
                         [{"id": "a", "start": [0, 1], "goal": [4, 1]}, {"id": "b", "start": [3, 1], "goal": [0, 1]}])

    def test_fault_in_a_path_list_of_eecbs(self):
        plan = self.other("Agent 0: (1,0)->(1,1)->(1,2)->(1,3)->(1,4)->\nAgent 1: (1,3)->(1,2)->(1,1)->(1,0)->\n")
        self.check(self.crossing(), plan, {0: "", 1: "", 1.5: "ab", 2: "ab", 3: ""},
                   (2, "a and b change places at [1, 1]"))

    def test_fault_in_the_output_of_lacam3(self):
        plan = self.other("agents=2\nmap_file=m.map\nsolver=planner\nsolved=1\nsoc=8\nsoc_lb=7\nmakespan=4\n"
                          "makespan_lb=4\n"
                          "sum_of_loss=8\nsum_of_loss_lb=7\ncomp_time=1\nseed=0\n\nstarts=(0,1),(3,1),\n"
                          "goals=(4,1),(0,1),\n"
                          "solution=\n0:(0,1),(3,1),\n1:(1,1),(2,1),\n2:(2,1),(2,1),\n3:(3,1),(1,1),\n4:(4,1),(0,1),\n")
        self.check(self.crossing(), plan, {0: "", 1: "", 2: "ab", 3: "", 4: ""}, (2, "a and b are both on [2, 1]"))

    def test_fault_in_the_input_of_mapf_visualizer(self):
        plan = self.other("solution=\n0:(0,1),(3,1),\n1:(1,1),(3,2),\n2:(2,1),(2,2),\n3:(2,2),(1,2),\n4:(4,1),(0,2),\n"
                          "5:(4,1),(0,1),\n")
        self.check(self.crossing(), plan, {2: "", 3: "", 3.5: "a", 4: "a", 5: ""},
                   (4, "a goes from [2, 2] to [4, 1], which is not a possible step"))

    def test_valid_plan_has_robots_without_red(self):
        instance = self.grid_of({"id": "a", "start": [0, 1]})
        self.open(self.page(instance, self.with_c(a=cells((0, 1), (1, 1)))), "#t=0")
        self.assertEqual(self.text(".verdict"), "✓ valid, checked by this page")
        self.assertEqual(set(self.colours().values()), {MOVING})


if __name__ == "__main__":
    main()
