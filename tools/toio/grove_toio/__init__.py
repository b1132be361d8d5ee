# SPDX-License-Identifier: MIT
"""Drives toio cubes, real or simulated, along a passing order."""
