# SPDX-License-Identifier: MIT
"""Two times since the begin of a drive: real seconds, and those of the vehicles. Simulated vehicles may be faster
than real ones; their seconds are those that the plan, the log and what happens to them are about."""
import time


class Clock:
    def __init__(self, pace=1.0, monotonic=time.monotonic):
        """pace: seconds of the vehicles in a real second."""
        self.pace = pace
        self._monotonic = monotonic
        self._begin = monotonic()

    def real(self):
        return self._monotonic() - self._begin

    def now(self):
        """Of the vehicles."""
        return self.real() * self.pace
