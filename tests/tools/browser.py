# SPDX-License-Identifier: MIT
"""Opens a page in a headless Chromium: what it says, what it asks of the network, and what is seen."""

import json
import os
import re
import subprocess
import tempfile
from pathlib import Path
from typing import NamedTuple

from devtools import CHROMIUM


class Visit(NamedTuple):
    console: list     # what the browser said of the page
    requests: set     # URLs that went to the network, or would have
    picture: object   # what is seen


def visit(page, size=(1280, 2400), fragment=""):
    from PIL import Image  # Debian's Python has it
    with tempfile.TemporaryDirectory() as folder:
        command = [CHROMIUM, "--headless", "--disable-gpu", "--hide-scrollbars", "--no-first-run",
                   f"--user-data-dir={folder}/profile", f"--window-size={size[0]},{size[1]}",
                   "--enable-logging=stderr", f"--log-net-log={folder}/net.json",
                   "--host-resolver-rules=MAP * ~NOTFOUND", "--virtual-time-budget=4000",
                   f"--screenshot={folder}/shot.png",
                   *(["--no-sandbox"] if os.getuid() == 0 else []), page.as_uri() + fragment]
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
        if not Path(f"{folder}/shot.png").exists():
            raise AssertionError(f"no picture: {done.stderr}")
        log = json.loads(Path(f"{folder}/net.json").read_text(encoding="utf-8"))
        requests = {event["params"]["url"] for event in log["events"]
                    if "url" in event.get("params", {})}
        return Visit(re.findall(r"CONSOLE[:(]\d+\)?\] (.*)", done.stderr),
                     {url for url in requests if not url.startswith(("file:", "data:"))},
                     Image.open(f"{folder}/shot.png").convert("RGB").copy())


def shares(picture):
    """{colour: share of the picture}"""
    return {colour: count / (picture.width * picture.height)
            for count, colour in picture.getcolors(1 << 24)}


def is_blank(picture):
    return max(shares(picture).values()) > 0.999
