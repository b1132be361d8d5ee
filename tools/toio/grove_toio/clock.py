# SPDX-License-Identifier: MIT
"""Provides an event loop with virtual time. It advances its clock instead of sleeping, so runs are fast and repeatable.
"""
import asyncio
import selectors


class _Clock(selectors.SelectSelector):
    def __init__(self):
        super().__init__()
        self.now = 0.0

    def select(self, timeout=None):
        found = super().select(0)
        if not found and timeout is not None:
            self.now += max(timeout, 0.0)
        return found


class VirtualLoop(asyncio.SelectorEventLoop):
    def __init__(self):
        self._clock = _Clock()
        super().__init__(self._clock)
        self._clock_resolution = 1e-6

    def time(self):
        return self._clock.now
