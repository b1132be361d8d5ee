#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Each bug of mutants.txt has its one place in the sources, however these have changed."""
import unittest

import mutants


class Mutants(unittest.TestCase):
    def test_each_is_inserted_in_one_place(self):
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
