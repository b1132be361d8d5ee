#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""`grove toio`: all tests of this folder.

    toio_test.py GROVE [TEST...]
"""
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
MODULES = ["protocol_test", "order_test", "geometry_test", "cube_test", "drive_test", "trouble_test",
           "bluetooth_test", "program_test"]


def main():
    grove, *names = sys.argv[1:]
    sys.path[:0] = [str(HERE), str(Path(grove).resolve().parent)]
    import plans
    plans.GROVE = Path(grove).resolve()
    loader = unittest.defaultTestLoader
    tests = loader.loadTestsFromNames(names or MODULES)
    done = unittest.TextTestRunner(verbosity=1).run(tests)
    return 0 if done.wasSuccessful() and done.testsRun else 1


if __name__ == "__main__":
    sys.exit(main())
