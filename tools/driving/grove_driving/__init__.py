# SPDX-License-Identifier: MIT
"""Shared code of the programs that drive robots along a passing order."""
