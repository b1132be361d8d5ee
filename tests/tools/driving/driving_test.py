#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs all tests in this folder, which test code shared by the programs that drive robots.

    driving_test.py GROVE [TEST...]
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import suite  # noqa: E402

sys.exit(suite.run(__file__, ["order_test", "frame_test"]))
