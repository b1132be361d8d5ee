# SPDX-License-Identifier: MIT
"""Provides a clock with two times since the start of a drive: real seconds and vehicle seconds.

The times differ if simulated vehicles run faster or slower than real time. Plan, log and disturbances are in vehicle
seconds.
"""
import time


class Clock:
    def __init__(self, pace=1.0, monotonic=time.monotonic):
        """Starts the clock. `pace`: vehicle seconds per real second."""
        self.pace = pace
        self._monotonic = monotonic
        self._begin = monotonic()

    def real(self):
        """Returns the real seconds since the start."""
        return self._monotonic() - self._begin

    def now(self):
        """Returns the vehicle seconds since the start."""
        return self.real() * self.pace
