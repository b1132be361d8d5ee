# SPDX-License-Identifier: MIT
"""Drives vehicles along a passing order by VDA 5050, the interface between fleets and their control."""
