# SPDX-License-Identifier: MIT
"""Controls a headless Chromium: opens pages, sends input, evaluates scripts and takes screenshots.

Uses the DevTools protocol over a pair of pipes. Messages are JSON and end with a zero byte.
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
    console: list     # console messages, exceptions and log entries
    requests: list    # URLs of network requests, including blocked ones; not file:, data: and blob:
    picture: object   # screenshot as an RGB image


def shares(picture):
    """Returns {colour: share of the pixels with that colour}."""
    return {colour: count / (picture.width * picture.height)
            for count, colour in picture.getcolors(1 << 24)}


def is_blank(picture):
    return max(shares(picture).values()) > 0.999


# Resolves after the next frame. Frames that the page requested earlier come first.
PAINTED = "new Promise((done) => requestAnimationFrame(() => setTimeout(done)))"


class NoAnswer(AssertionError):
    """Reports that Chromium did not answer within HANG_S seconds."""


class Chromium:
    """Controls a browser with one page. Use as a context manager."""

    def __init__(self, *options):
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_it, to_us = os.pipe(), os.pipe()

        def connect():  # Chromium reads from descriptor 3 and writes to 4
            os.dup2(os.dup(to_it[0]), 3)
            os.dup2(os.dup(to_us[1]), 4)

        command = [CHROMIUM, "--headless", "--no-first-run", "--remote-debugging-pipe", "--hide-scrollbars",
                   f"--user-data-dir={self.folder.name}", "--host-resolver-rules=MAP * ~NOTFOUND",
                   *(["--no-sandbox"] if os.getuid() == 0 else []), *(options or ["--disable-gpu"]), "about:blank"]
        # close_fds=False keeps descriptors 3 and 4, which connect() sets.
        # A new session, so that killing its process group also ends the child processes of the browser, which keep our
        # output open.
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
        """Returns the next message from the browser, or None if none arrives within `seconds` seconds.

        Raises AssertionError if the browser has ended.
        """
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
        """Records console output and network requests of the page."""
        method, what = found.get("method"), found.get("params", {})
        if method == "Runtime.consoleAPICalled":
            self.console.append(" ".join(str(a.get("value", a.get("description"))) for a in what["args"]))
        elif method == "Runtime.exceptionThrown":
            self.console.append(what["exceptionDetails"].get("exception", {}).get("description", "an exception"))
        elif method == "Log.entryAdded":
            self.console.append(what["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            url = what["request"]["url"]
            if not url.startswith(("file:", "data:", "blob:")):
                self.requests.append(url)

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
        """Opens a file, waits until it is loaded and returns the time that this took in seconds."""
        self.call("Page.navigate", url="about:blank")  # a change of the fragment alone does not reload a page
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
        """Waits until all changes are painted."""
        self.evaluate(PAINTED)

    def visit(self, page, fragment="", size=(1280, 800)):
        """Opens a page and returns its console output, its network requests and a screenshot."""
        self.open(page, fragment, size)
        self.settle()
        return Visit(list(self.console), list(self.requests), self.look())

    def prefer(self, **features):
        """Sets media features, such as prefers_color_scheme="dark"."""
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
        """Processes messages from the page until condition() holds. Fails after HANG_S seconds."""
        end = time.monotonic() + HANG_S
        while not condition():
            if time.monotonic() > end:
                raise AssertionError(f"after {HANG_S} s the condition does not hold: {what}")
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
        """Returns a screenshot as an RGB image."""
        from PIL import Image  # Debian package python3-pil
        return Image.open(io.BytesIO(self.shot())).convert("RGB")
