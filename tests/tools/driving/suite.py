# SPDX-License-Identifier: MIT
"""Runs the tests in a folder: FOLDER_test.py GROVE [TEST...]."""
import sys
import unittest
from pathlib import Path


def run(file, modules):
    """Runs the tests in the modules, or those named on the command line, and returns the exit code."""
    grove, *names = sys.argv[1:]
    sys.path[:0] = [str(Path(file).resolve().parent), str(Path(grove).resolve().parent)]
    import orders
    orders.GROVE = Path(grove).resolve()
    done = unittest.TextTestRunner(verbosity=1).run(unittest.defaultTestLoader.loadTestsFromNames(names or modules))
    return 0 if done.wasSuccessful() and done.testsRun else 1
