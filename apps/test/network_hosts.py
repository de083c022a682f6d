# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Hosts that share a folder over a network: namespaces of this machine, each with a name, an interface and mounts of its
own, and a server with a GlusterFS or an SFTP server in a namespace too. What runs on a host ends with it."""

import itertools
import os
import pathlib
import shutil
import signal
import subprocess
import sys

from processes import wait_until

SFTP_SERVER = "/usr/lib/openssh/sftp-server"
SFTP_PORT = 2222
PROGRAMS = {
    "unshare": "util-linux",
    "ip": "iproute2",
    "glusterd": "glusterfs-server",
    "glusterfs": "glusterfs-client",
    "sshfs": "sshfs",
    SFTP_SERVER: "openssh-sftp-server",
}
SERVER_ADDRESS = "10.77.0.1"

# Where GlusterFS keeps its state, which is to be gone with the host.
STATE_FOLDERS = ("/run", "/var/lib/glusterd", "/var/log/glusterfs")

# As administrators set them who want a host that is gone to be noticed soon: in some 3 s instead of 42.
GLUSTER_OPTIONS = {
    "network.ping-timeout": 3,
    "server.tcp-user-timeout": 3,
    "server.keepalive-time": 1,
    "server.keepalive-interval": 1,
    "server.keepalive-count": 2,
}


def why_not():
    """Why there can be no hosts here, or nothing."""
    path = os.environ["PATH"] + ":/usr/sbin:/sbin"
    missing = [package for program, package in PROGRAMS.items() if not shutil.which(program, path=path)]
    if missing:
        return f"no network file systems here: scripts/install-packages network, Debian packages {' '.join(missing)}"
    if os.geteuid() != 0:
        return "only root can make namespaces with mounts and interfaces"
    if not os.access("/dev/fuse", os.R_OK | os.W_OK):
        return "no /dev/fuse here"
    probe = ["unshare", "--mount", "--uts", "--net", "--pid", "--fork", "sh", "-c"]
    probe += ["ip link add bridge type bridge && ip link add port0 type veth && mount -t tmpfs tmpfs /run"]
    result = subprocess.run(probe, capture_output=True, text=True, check=False)
    return f"no namespaces with interfaces and mounts here: {result.stderr.strip()}" if result.returncode else ""


class Host:
    """Namespaces that live as long as their first process, which waits for the end of this one."""

    def __init__(self, name):
        self.name = name
        self.started = []
        command = ["unshare", "--mount", "--uts", "--net", "--pid", "--fork", "--kill-child", "--mount-proc"]
        self.first = subprocess.Popen(
            [*command, "sh", "-c", f"hostname {name} && ip link set lo up && echo ready && exec cat"],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
        )  # fmt: skip
        if self.first.stdout.readline() != "ready\n":
            self.stop()
            raise AssertionError(f"no namespaces for {name}")
        self.pid = child_of(self.first.pid)

    def stop(self):
        for process in (self.first, *self.started):
            if process.poll() is None:
                process.kill()
            process.communicate()

    def enter(self, *command, cwd="/"):
        """A command line that runs a command here."""
        inside = ["nsenter", f"--target={self.pid}", "--mount", "--uts", "--net", "--pid"]
        return [*inside, "env", f"--chdir={cwd}", *map(str, command)]

    def run(self, *command, cwd="/", check=True, timeout=60):
        result = subprocess.run(
            self.enter(*command, cwd=cwd), capture_output=True, text=True, check=False, timeout=timeout
        )
        if check and result.returncode != 0:
            raise AssertionError(f"{self.name}: {command}: {result.returncode}\n{result.stdout}{result.stderr}")
        return result

    def start(self, *command, cwd="/"):
        process = subprocess.Popen(
            self.enter(*command, cwd=cwd), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        self.started.append(process)
        return process

    def see(self, path):
        """A path as it is on this host, for others to use."""
        return pathlib.Path(f"/proc/{self.pid}/root{path}")

    def cut_off(self):
        self.run("ip", "link", "set", "eth0", "down")

    def join_again(self):
        self.run("ip", "link", "set", "eth0", "up")


def child_of(pid):
    """The process that a process has started."""
    return int(pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()[0])


def send(process, number):
    """Sends a signal to what Host.start() runs: the child of its process."""
    os.kill(child_of(process.pid), number)


class Network:
    """A server, and clients at a bridge that belongs to it."""

    def __init__(self, *names):
        self.hosts = []
        try:
            self.server = self.add("server")
            self.server.run("ip", "link", "add", "bridge", "type", "bridge")
            self.server.run("ip", "address", "add", f"{SERVER_ADDRESS}/24", "dev", "bridge")
            self.server.run("ip", "link", "set", "bridge", "up")
            self.clients = [self.add(name) for name in names]
            for number, client in enumerate(self.clients):
                self.connect(client, f"port{number}", f"10.77.0.{number + 2}")
        except BaseException:
            self.stop()
            raise

    def add(self, name):
        self.hosts.append(Host(name))
        return self.hosts[-1]

    def connect(self, client, port, address):
        # From outside, where the numbers of processes are those that are known here.
        cable = ["ip", "link", "add", port, "type", "veth", "peer", "name", "eth0", "netns", str(client.pid)]
        subprocess.run(["nsenter", f"--target={self.server.pid}", "--net", *cable], check=True)
        self.server.run("ip", "link", "set", port, "master", "bridge", "up")
        client.run("ip", "address", "add", f"{address}/24", "dev", "eth0")
        client.run("ip", "link", "set", "eth0", "up")

    def stop(self):
        for host in reversed(self.hosts):
            host.stop()

    def share_by_gluster(self, folder):
        """The clients see a folder of the server under the same name."""
        for host in self.hosts:
            for state in STATE_FOLDERS:
                host.run("mount", "-t", "tmpfs", "tmpfs", state)
        server = self.server
        server.run("mkdir", "/run/gluster")
        server.run("glusterd")
        wait_until(lambda: server.run("gluster", "pool", "list", check=False).returncode == 0, "glusterd")
        command = ["gluster", "--mode=script", "volume"]
        server.run(*command, "create", "shared", f"{SERVER_ADDRESS}:{folder}", "force")
        server.run(*command, "set", "shared", *itertools.chain(*GLUSTER_OPTIONS.items()))
        server.run(*command, "start", "shared")
        for client in self.clients:
            # The folder itself is known as the server's, and not mounted upon.
            client.run("mount", "-t", "tmpfs", "tmpfs", folder)
            client.run("mount", "-t", "glusterfs", f"{SERVER_ADDRESS}:/shared", folder)

    def share_by_sftp(self, folder, *options):
        """The same without locks between the clients."""
        self.server.start(sys.executable, "-B", __file__)
        for client in self.clients:
            command = ["sshfs", f"{SERVER_ADDRESS}:{folder}", folder, "-o", f"directport={SFTP_PORT}"]
            mounted = lambda: client.run(*command, *options, check=False).returncode == 0  # noqa: B023
            wait_until(mounted, "sshfs")


def serve_sftp():
    """An SFTP server for each connection, without a secure shell around it."""
    import socket

    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    with socket.create_server(("", SFTP_PORT)) as listener:
        while True:
            connection, _ = listener.accept()
            with connection:
                connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                subprocess.Popen([SFTP_SERVER], stdin=connection, stdout=connection)


if __name__ == "__main__":
    serve_sftp()
