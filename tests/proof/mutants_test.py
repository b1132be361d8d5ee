#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Checks that each bug of mutants.txt matches exactly one place in the sources."""
import unittest

import mutants


class Mutants(unittest.TestCase):
    def test_each_bug_is_inserted_in_one_place(self):
        inserted = 0
        for number, file, before, old, new, _ in mutants.read_list():
            with self.subTest(number=number):
                text = (mutants.ROOT / file).read_text(encoding="utf-8")
                try:
                    self.assertNotEqual(mutants.mutate(text, number, before, old, new), text)
                except SystemExit as error:
                    self.fail(str(error))
                inserted += 1
        self.assertGreater(inserted, 100)


if __name__ == "__main__":
    unittest.main()
