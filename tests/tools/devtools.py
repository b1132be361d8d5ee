# SPDX-License-Identifier: MIT
"""A headless Chromium that does what it is told: pages are opened, played with, measured and seen.

Chromium speaks the DevTools protocol over a pair of pipes, in JSON, each message ended by a zero.
"""

import base64
import io
import json
import os
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from waiting import HANG_S, LOOK_S  # noqa: E402

CHROMIUM = next(filter(None, map(shutil.which, ("chromium-headless-shell", "chromium"))), None)


class Visit(NamedTuple):
    console: list     # what the browser said of the page
    requests: list    # URLs that went to the network, or would have
    picture: object   # what is seen


def shares(picture):
    """{colour: share of the picture}"""
    return {colour: count / (picture.width * picture.height)
            for count, colour in picture.getcolors(1 << 24)}


def is_blank(picture):
    return max(shares(picture).values()) > 0.999


# A page paints in its own frames, which were asked for before this one.
SETTLED = "new Promise((done) => requestAnimationFrame(() => setTimeout(done)))"


class NoAnswer(AssertionError):
    """For as long as the test has patience."""


class Chromium:
    """A browser with one page. Use as a context manager."""

    def __init__(self, *options):
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_it, to_us = os.pipe(), os.pipe()

        def connect():  # Chromium reads from 3 and writes to 4
            os.dup2(os.dup(to_it[0]), 3)
            os.dup2(os.dup(to_us[1]), 4)

        command = [CHROMIUM, "--headless", "--no-first-run", "--remote-debugging-pipe", "--hide-scrollbars",
                   f"--user-data-dir={self.folder.name}", "--host-resolver-rules=MAP * ~NOTFOUND",
                   *(["--no-sandbox"] if os.getuid() == 0 else []), *(options or ["--disable-gpu"]), "about:blank"]
        # Both ends keep clear of 3 and 4, which connect() puts in their place.
        # A session of its own: with it end the browser's own children, who would keep our output open.
        self.process = subprocess.Popen(command, preexec_fn=connect, close_fds=False, start_new_session=True,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_it[0])
        os.close(to_us[1])
        self.write, self.read = to_it[1], to_us[0]
        self.buffer = b""
        self.number = 0
        self.session = None
        self.console, self.requests = [], []
        target = next(t for t in self.call("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self.session = self.call("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        os.close(self.write)
        os.close(self.read)
        self.folder.cleanup()

    def message(self, seconds=HANG_S):
        """The next one from the browser; None: there is none for so long."""
        end = time.monotonic() + seconds
        while b"\0" not in self.buffer:
            if not select.select([self.read], [], [], max(0, end - time.monotonic()))[0]:
                return None
            piece = os.read(self.read, 1 << 20)
            if not piece:
                raise AssertionError("Chromium has ended")
            self.buffer += piece
        text, self.buffer = self.buffer.split(b"\0", 1)
        found = json.loads(text)
        self.note(found)
        return found

    def note(self, found):
        """What a page says and asks for."""
        method, what = found.get("method"), found.get("params", {})
        if method == "Runtime.consoleAPICalled":
            self.console.append(" ".join(str(a.get("value", a.get("description"))) for a in what["args"]))
        elif method == "Runtime.exceptionThrown":
            self.console.append(what["exceptionDetails"].get("exception", {}).get("description", "an exception"))
        elif method == "Log.entryAdded":
            self.console.append(what["entry"]["text"])
        elif method == "Network.requestWillBeSent" and not what["request"]["url"].startswith(("file:", "data:", "blob:")):
            self.requests.append(what["request"]["url"])

    def call(self, method, **parameters):
        self.number += 1
        request = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            request["sessionId"] = self.session
        text = json.dumps(request).encode() + b"\0"
        while text:
            text = text[os.write(self.write, text) :]
        while True:
            found = self.message()
            if found is None:
                raise NoAnswer(f"no answer to {method}")
            if found.get("id") != self.number:
                continue
            if "error" in found:
                raise AssertionError(f"{method}: {found['error']}")
            return found["result"]

    def open(self, page, fragment="", size=(1280, 800)):
        """Opens a file and waits until it is loaded and at work; seconds that took."""
        self.call("Page.navigate", url="about:blank")  # or another fragment would not load it anew
        self.console.clear()
        self.requests.clear()
        self.resize(*size)
        before = time.monotonic()
        self.call("Page.navigate", url=page.resolve().as_uri() + fragment)
        while not self.evaluate("document.readyState === 'complete' && !document.querySelector('.reading')"):
            if time.monotonic() - before > HANG_S:
                raise AssertionError(f"{page.name} is not loaded after {HANG_S} s")
            time.sleep(0.01)
        return time.monotonic() - before

    def settle(self):
        """Until what has changed is painted."""
        self.evaluate(SETTLED)

    def visit(self, page, fragment="", size=(1280, 800)):
        """What is said, asked of the network and seen when a page is opened."""
        self.open(page, fragment, size)
        self.settle()
        return Visit(list(self.console), list(self.requests), self.look())

    def prefer(self, **features):
        """Media features: prefers_color_scheme="dark"."""
        self.call("Emulation.setEmulatedMedia", features=[{"name": name.replace("_", "-"), "value": value}
                                                          for name, value in features.items()])

    def resize(self, width, height):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def evaluate(self, script):
        found = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in found:
            raise AssertionError(found["exceptionDetails"])
        return found["result"].get("value")

    def wait_until(self, what, condition):
        """Lets the page go on until condition(); hears what it says."""
        end = time.monotonic() + HANG_S
        while not condition():
            if time.monotonic() > end:
                raise AssertionError(f"after {HANG_S} s still not: {what}")
            self.message(LOOK_S)

    def key(self, key):
        text = key if len(key) == 1 else ""
        self.call("Input.dispatchKeyEvent", type="keyDown", key=key, text=text)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=key)

    def type(self, text):
        for letter in text:
            self.key(letter)

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def click(self, x, y):
        for kind in ("mousePressed", "mouseReleased"):
            self.mouse(kind, x, y, button="left", clickCount=1, buttons=1)

    def picture(self, file):
        file.write_bytes(self.shot())

    def shot(self):
        return base64.b64decode(self.call("Page.captureScreenshot")["data"])

    def look(self):
        """What is seen, as an image."""
        from PIL import Image  # Debian's Python has it
        return Image.open(io.BytesIO(self.shot())).convert("RGB")
