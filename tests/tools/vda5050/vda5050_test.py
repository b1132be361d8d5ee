#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs all tests in this folder, which test the command `grove vda5050`.

    vda5050_test.py GROVE [TEST...]
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "driving"))

import suite  # noqa: E402

sys.exit(suite.run(__file__, ["route_test", "release_test", "messages_test", "vehicle_test", "control_test",
                              "monitor_test", "pace_test", "program_test"]))
