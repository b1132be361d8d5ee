# SPDX-License-Identifier: MIT
"""Starts a private Slurm inside a sandbox: munged, one slurmctld, and one slurmd per host.

The cluster has two partitions: `batch`, and `urgent`, whose jobs pre-empt those of `batch`. It does not use cgroups
(ProctrackType is proctrack/pgid), because a container may not have them. Therefore it neither binds ranks to cores nor
enforces memory limits. Ports and sockets have their default values, because the sandbox is isolated.
"""
import os
import subprocess
import time

from . import sandbox

FOLDER = sandbox.FILES / "slurm"
CONFIGURATION = FOLDER / "slurm.conf"
READY_WITHIN_S = 20
# Configured resources of a node, sufficient for the requests of the job scripts.
CPUS, MEMORY_MB = 8, 16384

SILENT = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}

TEMPLATE = """\
ClusterName=grove
SlurmctldHost={controller}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool.%n
TmpFS={folder}/tmp.%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SlurmdParameters=config_overrides
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
SchedulerParameters=batch_sched_delay=0,sched_interval=1,bf_interval=1
SlurmctldParameters=preempt_send_user_signal
NodeName={nodes} CPUs={cpus} RealMemory={memory} State=UNKNOWN
PartitionName=batch Nodes=ALL Default=YES PriorityTier=1
PartitionName=urgent Nodes=ALL PriorityTier=2 PreemptMode=OFF
"""


def start(hosts):
    """Starts the daemons, waits until they accept jobs, and returns the environment for Slurm commands.

    hosts: names of the hosts; the first one is the sandbox's own host.
    """
    sandbox.need_program("munge", "munged")
    sandbox.need_program("slurmctld", "slurmctld")
    sandbox.need_program("slurmd", "slurmd")
    sandbox.need_program("slurm-client", "sbatch")
    environment = {**os.environ, **sandbox.MPI_ENVIRONMENT, "SLURM_CONF": str(CONFIGURATION)}
    _start_munged()
    (FOLDER / "state").mkdir(parents=True)
    CONFIGURATION.write_text(TEMPLATE.format(
        controller=sandbox.HOST, folder=FOLDER, nodes=",".join(hosts), cpus=CPUS,
        memory=MEMORY_MB), encoding="utf-8")
    subprocess.Popen(["slurmctld", "-D"], env=environment, **SILENT)
    for host in hosts:
        for purpose in ("spool", "tmp"):
            (FOLDER / f"{purpose}.{host}").mkdir()
        subprocess.Popen([sandbox.ON_HOST, host, "slurmd", "-D", "-N", host], env=environment,
                         **SILENT)
    _wait_until_ready(hosts, environment)
    return environment


def _start_munged():
    """Starts munged as user munge, with a new key, on the default socket, which is private to the sandbox."""
    folder = sandbox.FILES.parent / "munge"
    folder.mkdir(mode=0o755)
    subprocess.run(["chown", "munge:", folder], check=True)
    as_munge = ["setpriv", "--reuid", "munge", "--regid", "munge", "--init-groups"]
    files = [f"--{what}-file={folder}/{what}" for what in ("key", "pid", "seed", "log")]
    subprocess.run([*as_munge, "mungekey", "--create", f"--keyfile={folder}/key"], check=True)
    subprocess.Popen([*as_munge, "munged", "--foreground", *files], **SILENT)


def _wait_until_ready(hosts, environment):
    deadline = time.monotonic() + READY_WITHIN_S
    states = []
    while states != ["idle"] * len(hosts):
        if time.monotonic() > deadline:
            raise RuntimeError(f"Slurm is not ready after {READY_WITHIN_S} s:\n" + _logs())
        time.sleep(0.1)
        states = subprocess.run(["sinfo", "-h", "-N", "-p", "batch", "-o", "%T"], text=True,
                                env=environment, stdout=subprocess.PIPE,
                                stderr=subprocess.DEVNULL).stdout.split()


def _logs():
    logs = [*FOLDER.glob("*.log"), *(sandbox.FILES.parent / "munge").glob("log")]
    return "\n".join(f"{log.name}: {line}" for log in logs
                     for line in log.read_text(errors="replace").splitlines()[-15:])
