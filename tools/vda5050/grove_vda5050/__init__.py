# SPDX-License-Identifier: MIT
"""Drives vehicles along a passing order by VDA 5050, an interface between fleet control and vehicles."""
