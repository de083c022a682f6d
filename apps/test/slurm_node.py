# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""A Slurm of one node: three daemons on the loopback interface, with a configuration and a key of their own."""

import os
import pathlib
import shutil
import socket
import subprocess

from processes import wait_until

DAEMONS = {"munged": "munge", "slurmctld": "slurmctld", "slurmd": "slurmd", "sbatch": "slurm-client"}
CONFIGURATION = """\
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmctldPort={controller_port}
SlurmdPort={daemon_port}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerParameters=sched_interval=1,batch_sched_delay=0,sched_min_interval=0
ReturnToService=2
KillWait=2
MinJobAge=600
NodeName={host} NodeAddr=127.0.0.1 CPUs={processors} RealMemory=4000 State=UNKNOWN
PartitionName=test Nodes={host} Default=YES MaxTime=10 State=UP
"""


def environment_for(paths):
    """The environment with more folders in front of PATH, and those of daemons behind it."""
    return {**os.environ, "PATH": os.pathsep.join([*map(str, paths), os.environ["PATH"], "/usr/sbin", "/sbin"])}


def why_not():
    """Why a Slurm cannot be started here, or nothing."""
    path = environment_for([])["PATH"]
    missing = [package for program, package in DAEMONS.items() if not shutil.which(program, path=path)]
    if missing:
        return f"Slurm is not installed: scripts/install-packages schedulers, Debian packages {' '.join(missing)}"
    return "" if os.geteuid() == 0 else "only root can start the daemons of Slurm"


def free_ports(number):
    sockets = [socket.socket() for _ in range(number)]
    for each in sockets:
        each.bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


class SlurmNode:
    """Started by its construction; stop() ends it."""

    def __init__(self, folder, paths=()):
        self.folder = pathlib.Path(folder)
        self.environment = {**environment_for(paths), "SLURM_CONF": str(self.folder / "slurm.conf")}
        self.daemons = []
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        controller_port, daemon_port = free_ports(2)
        values = {
            "host": socket.gethostname().split(".")[0],
            "folder": self.folder,
            "controller_port": controller_port,
            "daemon_port": daemon_port,
            "processors": os.cpu_count(),
        }
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(**values))
        munge = ["munged", "--foreground", f"--key-file={key}", f"--socket={self.folder}/munge.socket", "--force"]
        munge += [f"--{kind}-file={self.folder}/munged.{kind}" for kind in ("pid", "seed", "log")]
        try:
            self.start(*munge)
            self.wait_for(lambda: (self.folder / "munge.socket").exists())
            self.start("slurmctld", "-D", "-i")
            self.start("slurmd", "-D", "-N", values["host"])
            self.wait_for(lambda: "idle" in self.run("sinfo", "--noheader", "--format=%T", check=False))
        except BaseException:
            self.stop()
            raise

    def start(self, *command):
        log = open(self.folder / f"{command[0]}.output", "wb")
        with log:
            self.daemons.append(
                subprocess.Popen(command, env=self.environment, stdout=log, stderr=log, cwd=self.folder)
            )

    def stop(self):
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in reversed(self.daemons):
            try:
                daemon.wait(timeout=10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()

    def logs(self):
        """The ends of what the daemons wrote."""
        files = sorted([*self.folder.glob("*.log"), *self.folder.glob("*.output")])
        return "\n".join(f"{path.name}: {path.read_text(errors='replace')[-2000:]}" for path in files)

    def wait_for(self, condition, seconds=60):
        def holds():
            if any(daemon.poll() is not None for daemon in self.daemons):
                raise AssertionError("a daemon of Slurm has ended")
            return condition()

        try:
            wait_until(holds, "Slurm", seconds, 0.1)
        except AssertionError as error:
            raise AssertionError(f"{error}\n{self.logs()}") from None

    def run(self, *command, check=True, cwd=None):
        """What a command of Slurm prints."""
        result = subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False, cwd=cwd)
        if check and result.returncode != 0:
            raise AssertionError(f"{command}: {result.returncode}\n{result.stdout}{result.stderr}")
        return result.stdout

    def queue(self):
        """States of the tasks that have not ended, an array one line for each task."""
        return self.run("squeue", "--noheader", "--array", "--format=%T").split()
