# SPDX-License-Identifier: MIT
"""The drive as it happens, line by line: docs/drive-log.md."""
import json

FORMAT = "grove drive 1"
LEAST_SECONDS = 0.1


class DriveLog:
    def __init__(self, stream, order_file, robots, seconds_per_step):
        self.stream = stream
        self.last = {}          # robot: time and what was written of it
        self._line({"format": FORMAT, "order": order_file, "robots": robots, "seconds_per_step": seconds_per_step})

    def _line(self, holder):
        self.stream.write(json.dumps(holder, ensure_ascii=False) + "\n")
        self.stream.flush()

    def write(self, seconds, handle, grid):
        x, y = grid.cell(handle.position)
        said = {"at": [round(x, 3), round(y, 3)], "angle": round(handle.angle + 90) % 360,
                "action": handle.done, "state": handle.state}
        then, before = self.last.get(handle.name, (-1.0, {}))
        changed = (before.get("action"), before.get("state")) != (handle.done, handle.state)
        if changed or (said != before and seconds - then >= LEAST_SECONDS - 1e-6):
            self.last[handle.name] = seconds, said
            self._line({"t": round(seconds, 3), "robot": handle.name, **said})
