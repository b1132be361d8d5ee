# SPDX-License-Identifier: MIT
"""Runs a program in its own namespaces: processes, network, mounts, host name, IPC.

Processes in the sandbox do not occupy ports of the machine and cannot be reached from outside. They end with the
program, even if it is killed: when the first process of a process namespace ends, the kernel kills all other
processes in it, and it removes a network or mount namespace after its last process. No clean-up is necessary.
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
ON_HOST = FILES / "on_host"  # a symbolic link, because mpirun accepts no path with spaces

# Command prefix that starts a process in new namespaces. The calling process, unshare and the first process
# of the sandbox form a chain in which each process is killed when its parent ends, even by SIGKILL.
ENTER = ["setpriv", "--pdeathsig", "KILL",
         "unshare", "--pid", "--net", "--mount", "--uts", "--ipc",
         "--mount-proc", "--fork", "--kill-child"]
MARK = "GROVE_SANDBOX"

# Environment for mpirun. Without the first two variables mpirun refuses to run as root. The third one
# places its files in the sandbox, so that they disappear even if mpirun is killed.
MPI_ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                   "OMPI_MCA_orte_tmpdir_base": str(FILES)}


class NotHere(Exception):
    """The sandbox is not possible on this machine or for this user; the text gives the reason."""


def run_in_sandbox(function):
    """Runs function() as root in a sandbox whose host name is HOST, and exits with its return value.

    Starts this program a second time in the sandbox. If that is impossible or function() raises NotHere, prints the
    reason and exits with SKIPPED. After a signal N that ends the sandbox, exits with 128 + N.
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
    """Runs a command and returns its exit code as a shell would: 128 + N after signal N, 127 if it cannot be run."""
    try:
        return _exit_code(subprocess.run(command, env=environment).returncode)
    except OSError as error:
        print(f"{Path(sys.argv[0]).name}: cannot run {command[0]}: {error.strerror}",
              file=sys.stderr)
        return 127


def set_hosts(addresses):
    """Writes the sandbox's /etc/hosts from `addresses`, a dict from host name to IP address."""
    lines = ["127.0.0.1 localhost", *(f"{address} {name}" for name, address in addresses.items())]
    (FILES / "hosts").write_text("\n".join(lines) + "\n", encoding="utf-8")


def connect(address, *on_host):
    """Enables the network interfaces of a host and sets its IP address.

    on_host: command prefix that runs a command on that host; without it, commands run on this host.
    """
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
    # Hides the variables of a surrounding Slurm job or mpirun from the sandbox.
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
    """Acts as the sandbox's init process: runs function() in a child, reaps orphaned processes, and returns the exit
    code of the child.

    A process that has ended but has not been reaped remains a member of its process group, and Slurm would wait for
    this group.
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
    """Sets host name and IP address. Mounts a private /run (for sockets of daemons), /dev/shm and /etc/hosts."""
    subprocess.run(["hostname", HOST], check=True)
    subprocess.run(["mount", "-t", "tmpfs", "-o", "mode=755", "grove", "/run"], check=True)
    subprocess.run(["mount", "-t", "tmpfs", "shm", "/dev/shm"], check=True)
    FILES.mkdir()
    ON_HOST.symlink_to(Path(__file__).with_name("on_host"))
    set_hosts({HOST: ADDRESS})
    subprocess.run(["mount", "--bind", FILES / "hosts", HOSTS], check=True)
    # mpirun and Slurm's daemons do not start on a host that has only a loopback interface. Therefore the
    # host gets one end of a virtual cable. The other end is for a second host.
    for command in (["link", "add", INTERFACE, "type", "veth", "peer", "name", OTHER_END],
                    ["link", "set", OTHER_END, "up"]):
        if subprocess.run(["ip", *command]).returncode != 0:
            raise NotHere("the kernel does not support virtual Ethernet devices (veth)")
    connect(ADDRESS)


def _exit_code(returncode):
    return 128 - returncode if returncode < 0 else returncode
