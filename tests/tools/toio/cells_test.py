# SPDX-License-Identifier: MIT
"""Cubes drive on cells."""
import unittest

import orders
import plans
from grove_driving.bad_input import BadInput
from grove_toio.cells import read_cell_order, size


class Cells(unittest.TestCase):
    def test_no_roadmaps(self):
        with self.assertRaisesRegex(BadInput, r"order.json: /robots/0/start: found \[\"W\"\]; expected .*not on roadmaps"):
            read_cell_order(orders.order_file("roads"))

    def test_size(self):
        self.assertEqual(size(plans.order("narrow")), (7, 2))
