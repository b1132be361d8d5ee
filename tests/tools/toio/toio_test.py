#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs all tests in this folder, which test the command `grove toio`.

    toio_test.py GROVE [TEST...]
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "driving"))

import suite  # noqa: E402

sys.exit(suite.run(__file__, ["protocol_test", "cells_test", "geometry_test", "cube_test", "drive_test",
                              "trouble_test", "bluetooth_test", "program_test"]))
