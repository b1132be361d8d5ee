# SPDX-License-Identifier: MIT
"""Writes an execution log, one line per event (docs/drive-log.md)."""
import json

from .bad_input import BadInput

FORMAT = "grove drive 1"
MIN_SECONDS = 0.1


def open_log(path):
    try:
        return open(path, "w", encoding="utf-8")  # noqa: SIM115 - closed by the caller
    except OSError as error:
        raise BadInput(f"{path}: cannot be written: {error.strerror}") from None


class ExecutionLog:
    def __init__(self, stream, order_file, robots, seconds_per_step):
        self.stream = stream
        self.last = {}          # {robot: (time, sample) of its last line}
        self._line({"format": FORMAT, "order": order_file, "robots": robots, "seconds_per_step": seconds_per_step})

    def _line(self, holder):
        self.stream.write(json.dumps(holder, ensure_ascii=False) + "\n")
        self.stream.flush()

    def write(self, seconds, robot, at, angle, action, state):
        """Writes a line if the robot's action or state changed since its last line. Also writes one if only its
        position or angle changed, but not within MIN_SECONDS after its last line.

        at: (x, y) in cells with y down, or in metres on a roadmap. angle: degrees clockwise from north, or None.
        """
        sample = {"at": [round(at[0], 3), round(at[1], 3)]}
        if angle is not None:
            sample["angle"] = round(angle) % 360
        sample |= {"action": action, "state": state}
        then, before = self.last.get(robot, (-1.0, {}))
        changed = (before.get("action"), before.get("state")) != (action, state)
        if changed or (sample != before and seconds - then >= MIN_SECONDS - 1e-6):
            self.last[robot] = seconds, sample
            self._line({"t": round(seconds, 3), "robot": robot, **sample})
