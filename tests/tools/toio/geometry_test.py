# SPDX-License-Identifier: MIT
"""Tests distances, cells on mats, and the paths of robots in a ring."""
import random
import unittest

from grove_toio import geometry, rings
from grove_driving.bad_input import BadInput
from grove_toio.mat import BODY, MIN_PITCH, MATS, RESERVE, make_grid

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


class Distances(unittest.TestCase):
    def test_segment_distance_agrees_with_samples(self):
        source = random.Random(1)
        for _ in range(200):
            a, b, c, d = ((source.uniform(0, 9), source.uniform(0, 9)) for _ in range(4))
            sampled = min(geometry.distance(self.point(a, b, i), self.point(c, d, k))
                          for i in range(31) for k in range(31))
            found = geometry.segment_to_segment(a, b, c, d)
            self.assertLessEqual(found, sampled + 1e-9)
            self.assertLess(sampled - found, 0.5)

    def test_nearer_agrees_with_path_distance(self):
        source = random.Random(2)
        for _ in range(300):
            paths = [[(source.uniform(0, 9), source.uniform(0, 9)) for _ in range(source.randint(1, 3))]
                     for _ in range(2)]
            least = source.uniform(0, 5)
            self.assertEqual(geometry.nearer(*paths, least), geometry.path_to_path(*paths) < least)

    @staticmethod
    def point(a, b, i):
        return (a[0] + (b[0] - a[0]) * i / 30, a[1] + (b[1] - a[1]) * i / 30)

    def test_turn_between_angles_is_the_shorter_one(self):
        self.assertEqual(geometry.turn_between(350, 10), 20)
        self.assertEqual(geometry.turn_between(10, 350), -20)


class Grids(unittest.TestCase):
    def test_cells_of_the_simple_mat(self):
        grid = make_grid(MATS["simple"], 7, 5)
        self.assertAlmostEqual(grid.pitch, 43.2)
        self.assertAlmostEqual(sum(grid.centre((3, 2))), (98 + 402 + 142 + 358) / 2)
        self.assertAlmostEqual(grid.cell(grid.centre((6, 1)))[0], 6)

    def test_cubes_at_the_ends_of_their_tolerances_do_not_touch(self):
        for pitch in (MIN_PITCH, 43.2, 50, 67):
            grid = make_grid((0, 0, 1000, 1000), 5, 5, pitch)
            self.assertGreaterEqual(pitch - 2 * (grid.tolerance + RESERVE), BODY - 1e-9)

    def test_too_narrow_mats_are_refused(self):
        for arguments in ((MATS["simple"], 9, 5), (MATS["simple"], 7, 5, 30), (MATS["simple"], 7, 5, 60)):
            with self.assertRaises(BadInput):
                make_grid(*arguments)


class Rings(unittest.TestCase):
    def test_paths_round_a_square_form_a_circle(self):
        for path in rings.wide_paths(SQUARE):
            for point in path:
                self.assertAlmostEqual(geometry.distance(point, (0.5, 0.5)), 0.5 ** 0.5)

    def test_paths_lead_from_cell_to_cell(self):
        cells = [(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (0, 1)]
        for route in (cells, cells[::-1]):
            for i, path in enumerate(rings.wide_paths(route)):
                self.assertAlmostEqual(geometry.distance(path[0], route[i]), 0)
                self.assertAlmostEqual(geometry.distance(path[-1], route[(i + 1) % 6]), 0)

    def test_straight_paths_have_a_smaller_gap(self):
        straight = [[(a[0] + (b[0] - a[0]) * i / rings.PARTS, a[1] + (b[1] - a[1]) * i / rings.PARTS)
                     for i in range(rings.PARTS + 1)] for a, b in zip(SQUARE, SQUARE[1:] + SQUARE[:1])]
        self.assertGreater(rings.least_gap(rings.wide_paths(SQUARE)), rings.least_gap(straight) + 0.2)

    def test_near_rings_are_detected(self):
        moved = [(x + 2, y) for x, y in SQUARE]
        self.assertTrue(rings.near(SQUARE, moved))
        self.assertFalse(rings.near(SQUARE, [(x + 1, y) for x, y in moved]))
