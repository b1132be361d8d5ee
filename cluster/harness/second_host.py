# SPDX-License-Identifier: MIT
"""Starts a second host inside a sandbox, with its own host name, network and /dev/shm.

A virtual cable connects it to the first host. The two hosts share files, processors, memory and process
ids.
"""
import subprocess

from . import sandbox

HOST, ADDRESS = "node2", "10.77.0.2"

HOLDER = ["unshare", "--net", "--uts", "--ipc", "--mount", "sh", "-c",
          f"hostname {HOST} && mount -t tmpfs shm /dev/shm && echo ready && exec sleep infinity"]


def start():
    """Starts the second host, which exists until the sandbox ends."""
    holder = subprocess.Popen(HOLDER, stdout=subprocess.PIPE, text=True)
    if holder.stdout.readline() != "ready\n":
        raise sandbox.NotHere("a second set of namespaces is not permitted")
    (sandbox.FILES / HOST).write_text(str(holder.pid), encoding="utf-8")
    subprocess.run(["ip", "link", "set", sandbox.OTHER_END, "netns", str(holder.pid),
                    "name", sandbox.INTERFACE], check=True)
    sandbox.connect(ADDRESS, sandbox.ON_HOST, HOST)
    sandbox.set_hosts({sandbox.HOST: sandbox.ADDRESS, HOST: ADDRESS})
