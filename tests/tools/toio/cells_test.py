# SPDX-License-Identifier: MIT
"""Tests the reader of orders for cubes, which must be on cells."""
import unittest

import orders
import plans
from grove_driving.bad_input import BadInput
from grove_toio.cells import read_cell_order, size


class Cells(unittest.TestCase):
    def test_roadmaps_are_refused(self):
        with self.assertRaisesRegex(BadInput,
                                    r"order.json: /robots/0/start: found \[\"W\"\]; expected .*not on roadmaps"):
            read_cell_order(orders.order_file("roads"))

    def test_size_covers_all_cells_of_the_order(self):
        self.assertEqual(size(plans.order("narrow")), (7, 2))
