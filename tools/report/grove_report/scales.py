# SPDX-License-Identifier: MIT
"""Where points lie and axes begin."""
import math

SPREAD = 0.05  # of the gap between two ticks; more, and a point is no longer plainly one of its tick
CLOCK_S = 1e-6  # no runtime is known better


def dodged(x_values, lines):
    """{line: what to add to x}, so that points on each other are drawn a little side by side. `x_values`:
    in order."""
    gap = min((b - a for a, b in zip(x_values, x_values[1:])), default=0)
    between = SPREAD * gap / max(len(lines) - 1, 1)
    return {line: between * (index - (len(lines) - 1) / 2) for index, line in enumerate(lines)}


def rounded_down(value):
    """To a power of ten, or three times one. `value`: above 0."""
    exponent = math.floor(math.log10(value))
    three = float(f"3e{exponent}")  # not 3 * 0.1, which is more than 0.3
    return three if value >= three else float(f"1e{exponent}")


def first_time(rows):
    """Where a log axis of the runtimes of the solved rows begins: no such run was faster, but those
    of which the clock saw nothing. At most a second."""
    shortest = min((row.runtime_s for row in rows if row.solved and row.runtime_s > 0), default=1)
    return rounded_down(min(max(shortest, CLOCK_S), 1))
