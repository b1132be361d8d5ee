# SPDX-License-Identifier: MIT
"""A second host inside a sandbox: a host name, a network and a /dev/shm of its own, joined to the
first host by a virtual cable. Files, processors and memory are all that the two share."""
import subprocess

from . import sandbox

HOST, ADDRESS = "node2", "10.77.0.2"

HOLDER = ["unshare", "--net", "--uts", "--ipc", "--mount", "sh", "-c",
          f"hostname {HOST} && mount -t tmpfs shm /dev/shm && echo ready && exec sleep infinity"]


def start():
    """Starts it; it is there until the sandbox ends."""
    holder = subprocess.Popen(HOLDER, stdout=subprocess.PIPE, text=True)
    if holder.stdout.readline() != "ready\n":
        raise sandbox.NotHere("a second set of namespaces is not permitted")
    (sandbox.FILES / HOST).write_text(str(holder.pid), encoding="utf-8")
    subprocess.run(["ip", "link", "set", sandbox.OTHER_END, "netns", str(holder.pid),
                    "name", sandbox.INTERFACE], check=True)
    sandbox.connect(ADDRESS, sandbox.ON_HOST, HOST)
    sandbox.set_hosts({sandbox.HOST: sandbox.ADDRESS, HOST: ADDRESS})
