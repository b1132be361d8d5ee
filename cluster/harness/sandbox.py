# SPDX-License-Identifier: MIT
"""Runs a program in its own namespaces: processes, network, mounts, host name.

Processes in the sandbox do not occupy ports of the machine and cannot be reached from outside. They end with the
program, even if it is killed: the kernel kills a process namespace with its first process, and removes a network
and mounts with their last user. So no clean-up is needed.
"""
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

SKIPPED = 77  # exit code that ctest treats as skipped
HOST, ADDRESS = "node1", "10.77.0.1"
INTERFACE, OTHER_END = "grove0", "grove1"
HOSTS = Path("/etc/hosts")
FILES = Path("/run/grove")  # in memory, visible only in the sandbox
ON_HOST = FILES / "on_host"  # a link here, because mpirun does not accept a path with spaces

# Chain of processes that each die with their parent, even by SIGKILL: this process, unshare, the
# sandbox's first process.
ENTER = ["setpriv", "--pdeathsig", "KILL",
         "unshare", "--pid", "--net", "--mount", "--uts", "--ipc",
         "--mount-proc", "--fork", "--kill-child"]
MARK = "GROVE_SANDBOX"

# Environment for mpirun. It refuses to run as root without the first two variables. The third places its
# files in the sandbox, so that they disappear even if mpirun is killed.
MPI_ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                   "OMPI_MCA_orte_tmpdir_base": str(FILES)}


class NotHere(Exception):
    """This machine or user does not support the sandbox; the text is the reason."""


def run_in_sandbox(function):
    """Runs function() as root in a sandbox, on a host named HOST, and exits with its return value.

    Starts this program a second time in the sandbox. If that is impossible, prints the reason and exits with SKIPPED.
    """
    os.environ["PATH"] += ":/usr/sbin:/sbin"
    try:
        inside = os.environ.pop(MARK, None) and os.getpid() == 1
        status = _first_process(function) if inside else _outside()
    except NotHere as reason:
        print(f"{Path(sys.argv[0]).name}: not possible on this machine: {reason}", file=sys.stderr)
        status = SKIPPED
    sys.exit(status)


def need_program(package, program):
    if not shutil.which(program):
        raise NotHere(f"{program} was not found; it is in the Debian package {package}")


def run_command(command, environment):
    """Runs a command; returns its exit code in the convention of shells."""
    try:
        return _exit_code(subprocess.run(command, env=environment).returncode)
    except OSError as error:
        print(f"{Path(sys.argv[0]).name}: cannot run {command[0]}: {error.strerror}",
              file=sys.stderr)
        return 127


def set_hosts(addresses):
    """Writes the sandbox's /etc/hosts. addresses: {name: address}."""
    lines = ["127.0.0.1 localhost", *(f"{address} {name}" for name, address in addresses.items())]
    (FILES / "hosts").write_text("\n".join(lines) + "\n", encoding="utf-8")


def connect(address, *on_host):
    """Sets the address of this host, or of the host on which the command prefix `on_host` runs commands."""
    for command in (["link", "set", "lo", "up"], ["link", "set", INTERFACE, "up"],
                    ["address", "add", f"{address}/24", "dev", INTERFACE]):
        subprocess.run([*on_host, "ip", *command], check=True)


def _outside():
    if os.geteuid() != 0:
        raise NotHere("only root may make namespaces and start daemons in them")
    need_program("iproute2", "ip")
    if not HOSTS.is_file():
        raise NotHere(f"{HOSTS} is missing, over which the sandbox mounts its own; `touch {HOSTS}` creates it")
    attempt = subprocess.run([*ENTER, "ip", "link", "set", "lo", "up"], capture_output=True,
                             text=True)
    if attempt.returncode != 0:
        raise NotHere(f"namespaces are not permitted ({attempt.stderr.strip()}); a container needs "
                      "CAP_SYS_ADMIN and CAP_NET_ADMIN")
    # Hides a surrounding Slurm job or mpirun from the sandbox.
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
    """Acts as the sandbox's init process: reaps orphaned processes.

    A process that has ended but is not reaped remains a member of its group, and Slurm would wait for the group.
    """
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
    """Sets host name and address, and mounts private /run (sockets of daemons) and /dev/shm."""
    subprocess.run(["hostname", HOST], check=True)
    subprocess.run(["mount", "-t", "tmpfs", "-o", "mode=755", "grove", "/run"], check=True)
    subprocess.run(["mount", "-t", "tmpfs", "shm", "/dev/shm"], check=True)
    FILES.mkdir()
    ON_HOST.symlink_to(Path(__file__).with_name("on_host"))
    set_hosts({HOST: ADDRESS})
    subprocess.run(["mount", "--bind", FILES / "hosts", HOSTS], check=True)
    # One end of a virtual cable is the host's interface, because mpirun and Slurm's daemons do not start
    # on a host that has only a loopback interface. The other end is for a second host.
    for command in (["link", "add", INTERFACE, "type", "veth", "peer", "name", OTHER_END],
                    ["link", "set", OTHER_END, "up"]):
        if subprocess.run(["ip", *command]).returncode != 0:
            raise NotHere("the kernel does not support virtual Ethernet devices (veth)")
    connect(ADDRESS)


def _exit_code(returncode):
    return 128 - returncode if returncode < 0 else returncode
