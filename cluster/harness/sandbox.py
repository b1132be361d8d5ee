# SPDX-License-Identifier: MIT
"""Runs a program in namespaces of its own: processes, network, mounts, host name.

What is started in there takes no port that is in use outside, is not reached from outside, and is
gone when the program ends, however it ends: the kernel kills a process namespace with its first
process, and a network and mounts go with their last user. So there is nothing to tidy up.
"""
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

SKIPPED = 77  # what ctest is told to take for "cannot be tried here"
HOST, ADDRESS = "node1", "10.77.0.1"
INTERFACE, OTHER_END = "grove0", "grove1"
HOSTS = Path("/etc/hosts")
FILES = Path("/run/grove")  # in memory, seen only in the sandbox
ON_HOST = FILES / "on_host"  # here as well, since mpirun takes no path with spaces

# Each dies with its parent, even by SIGKILL: this process, unshare, the sandbox's first process.
ENTER = ["setpriv", "--pdeathsig", "KILL",
         "unshare", "--pid", "--net", "--mount", "--uts", "--ipc",
         "--mount-proc", "--fork", "--kill-child"]
MARK = "GROVE_SANDBOX"

# What mpirun needs in here. It refuses to run as root, unless told twice; and its files, which it
# leaves behind if it is killed, go with the sandbox.
MPI_ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                   "OMPI_MCA_orte_tmpdir_base": str(FILES)}


class NotHere(Exception):
    """This machine or user lacks what is needed; the text says what, in a sentence."""


def run_in_sandbox(function):
    """Ends this program with what function() returns when called as root in a sandbox, on a host
    called HOST: this program runs once more in there. If it cannot, says why; ends with SKIPPED."""
    os.environ["PATH"] += ":/usr/sbin:/sbin"
    try:
        inside = os.environ.pop(MARK, None) and os.getpid() == 1
        status = _first_process(function) if inside else _outside()
    except NotHere as reason:
        print(f"{Path(sys.argv[0]).name}: cannot be done here: {reason}", file=sys.stderr)
        status = SKIPPED
    sys.exit(status)


def need_program(package, program):
    if not shutil.which(program):
        raise NotHere(f"there is no {program}; it is in the Debian package {package}")


def run_command(command, environment):
    """Runs it and returns the exit code by which a shell would report its end."""
    try:
        return _exit_code(subprocess.run(command, env=environment).returncode)
    except OSError as error:
        print(f"{Path(sys.argv[0]).name}: cannot run {command[0]}: {error.strerror}",
              file=sys.stderr)
        return 127


def set_hosts(addresses):
    """The sandbox's /etc/hosts; {name: address}."""
    lines = ["127.0.0.1 localhost", *(f"{address} {name}" for name, address in addresses.items())]
    (FILES / "hosts").write_text("\n".join(lines) + "\n", encoding="utf-8")


def connect(address, *on_host):
    """Gives a host its address: this one, or the one where `on_host` runs the words after it."""
    for command in (["link", "set", "lo", "up"], ["link", "set", INTERFACE, "up"],
                    ["address", "add", f"{address}/24", "dev", INTERFACE]):
        subprocess.run([*on_host, "ip", *command], check=True)


def _outside():
    if os.geteuid() != 0:
        raise NotHere("only root may make namespaces and start daemons in them")
    need_program("iproute2", "ip")
    if not HOSTS.is_file():
        raise NotHere(f"there is no {HOSTS}, over which the sandbox puts its own; `touch {HOSTS}` makes one")
    attempt = subprocess.run([*ENTER, "ip", "link", "set", "lo", "up"], capture_output=True,
                             text=True)
    if attempt.returncode != 0:
        raise NotHere(f"namespaces are not permitted ({attempt.stderr.strip()}); a container needs "
                      "CAP_SYS_ADMIN and CAP_NET_ADMIN")
    # Of a Slurm job or an mpirun that we may be part of, nothing is to be seen inside.
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith(("SLURM", "SBATCH", "SRUN", "PMI"))}
    inside = subprocess.Popen([*ENTER, sys.executable, *sys.argv], env={**environment, MARK: "1"})

    signals = []

    def end(number, _):
        signals.append(number)
        inside.kill()

    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, end)
    status = _exit_code(inside.wait())
    return 128 + signals[0] if signals else status


def _first_process(function):
    """The sandbox's init: waits for whatever has lost its parent. A process that has ended and that
    nobody waits for is still a member of its group, and Slurm would wait for the group to end."""
    child = os.fork()
    if child == 0:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        _furnish()
        return function()
    while True:
        pid, status = os.wait()
        if pid == child:
            return _exit_code(os.waitstatus_to_exitcode(status))


def _furnish():
    """A name, an address, and of its own: /run, where daemons have their sockets, and /dev/shm."""
    subprocess.run(["hostname", HOST], check=True)
    subprocess.run(["mount", "-t", "tmpfs", "-o", "mode=755", "grove", "/run"], check=True)
    subprocess.run(["mount", "-t", "tmpfs", "shm", "/dev/shm"], check=True)
    FILES.mkdir()
    ON_HOST.symlink_to(Path(__file__).with_name("on_host"))
    set_hosts({HOST: ADDRESS})
    subprocess.run(["mount", "--bind", FILES / "hosts", HOSTS], check=True)
    # One end of a virtual cable is the host's interface: mpirun does not start on a host that has
    # but a loopback, nor do Slurm's daemons. The other end is for a second host.
    for command in (["link", "add", INTERFACE, "type", "veth", "peer", "name", OTHER_END],
                    ["link", "set", OTHER_END, "up"]):
        if subprocess.run(["ip", *command]).returncode != 0:
            raise NotHere("the kernel makes no virtual Ethernet devices (veth)")
    connect(ADDRESS)


def _exit_code(returncode):
    return 128 - returncode if returncode < 0 else returncode
