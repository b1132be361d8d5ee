# SPDX-License-Identifier: MIT
"""Computes positions of points and start values of axes."""
import math

SPREAD = 0.05  # width of the points at a tick / gap between ticks; if larger, a point could belong to two ticks
CLOCK_S = 1e-6  # resolution of runtimes, seconds


def dodged(x_values, lines):
    """Returns {line: offset of x} with which coinciding points are drawn side by side. `x_values`: ascending."""
    gap = min((b - a for a, b in zip(x_values, x_values[1:])), default=0)
    between = SPREAD * gap / max(len(lines) - 1, 1)
    return {line: between * (index - (len(lines) - 1) / 2) for index, line in enumerate(lines)}


def rounded_down(value):
    """Rounds down to a power of ten or three times a power of ten. `value`: > 0."""
    exponent = math.floor(math.log10(value))
    three = float(f"3e{exponent}")  # not 3 * 0.1, which exceeds 0.3
    return three if value >= three else float(f"1e{exponent}")


def first_time(rows):
    """Returns the start of a log axis for the runtimes of the solved rows.

    It is at most one second, and at most the larger of CLOCK_S and the shortest positive runtime.
    """
    shortest = min((row.runtime_s for row in rows if row.solved and row.runtime_s > 0), default=1)
    return rounded_down(min(max(shortest, CLOCK_S), 1))
