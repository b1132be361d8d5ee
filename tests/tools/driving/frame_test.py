# SPDX-License-Identifier: MIT
"""Tests the conversion from the metres in an order to cells."""
import unittest

import orders
from grove_driving.frame import Frame
from grove_driving.order import read_order


class Frames(unittest.TestCase):
    def test_metres_of_a_shifted_map_convert_to_cells(self):
        orders.order_file("dense")
        orders.grove("execute", "dense.cts.json", "dense.plan.json", "--order", "shifted.order.json", "--cell-size",
                     "0.8",
                     "--origin", "-3,2.5")
        order = read_order(orders.folder() / "shifted.order.json")
        frame = Frame(order)
        self.assertAlmostEqual(frame.cell, 0.8)
        for robot in order.robots:
            for action in robot.actions:
                for one, other in zip(frame.cells(action.at), action.place):
                    self.assertAlmostEqual(one, other)

    def test_roadmap_places_stay_in_metres(self):
        self.assertEqual(Frame(read_order(orders.order_file("roads"))).cells((2.5, 1.0)), (2.5, 1.0))
