"""A Slurm cluster of this machine alone, as root and without a service manager."""

import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = ["munged", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue", "scancel"]
PATH = os.pathsep.join([os.environ.get("PATH", ""), "/usr/sbin", "/sbin"])


def obstacle():
    """The reason why Slurm cannot run here, or None."""
    missing = [program for program in PROGRAMS if not shutil.which(program, path=PATH)]
    if missing:
        return f"missing: {', '.join(missing)}; 'scripts/install-dependencies --tests' installs them"
    return None if os.geteuid() == 0 else "slurmd needs root"


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def descendants(root):
    """The processes that a process has started, and those that these have started."""
    parents = {}
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            after_name = (folder / "stat").read_text().rsplit(")", 1)[1].split()
        except OSError:  # it has ended
            continue
        parents.setdefault(int(after_name[1]), []).append(int(folder.name))
    found, waiting = [], [root]
    while waiting:
        children = parents.get(waiting.pop(), [])
        found += children
        waiting += children
    return found


def handles_interrupts(status):
    """Whether a process catches SIGINT, from its /proc/PID/status."""
    [caught] = [int(line.split()[1], 16) for line in status.splitlines() if line.startswith("SigCgt:")]
    return bool(caught >> (signal.SIGINT - 1) & 1)


def arguments_of_processes():
    """All pairs of neighbouring arguments of all processes that handle interrupts."""
    pairs = []
    for path in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (path / "cmdline").read_bytes().decode(errors="replace").split("\0")
            if not handles_interrupts((path / "status").read_text()):
                continue
        except OSError:  # it has ended
            continue
        pairs += [list(pair) for pair in zip(words, words[1:])]
    return pairs


class Cluster:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.node = socket.gethostname().split(".")[0]
        self.environment = {**os.environ, "PATH": PATH, "SLURM_CONF": str(self.folder / "slurm.conf")}
        self.daemons = {}

    def start(self):
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        self.folder.chmod(0o755)
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        (self.folder / "slurm.conf").write_text(
            f"""
ClusterName=test
SlurmctldHost={self.node}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
SlurmctldPort={free_port()}
SlurmdPort={free_port()}
AuthType=auth/munge
CryptoType=crypto/munge
AuthInfo=socket={self.folder}/munge.sock,cred_expire=5
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/spool
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0,bf_interval=1
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
MailProg=/bin/true
ReturnToService=2
KillWait=5
NodeName={self.node} NodeAddr=127.0.0.1 CPUs={os.cpu_count()} RealMemory=4000 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""",
            encoding="utf-8",
        )
        self.daemon(
            "munged",
            "--foreground",
            "--force",
            f"--key-file={key}",
            f"--socket={self.folder}/munge.sock",
            f"--pid-file={self.folder}/munged.pid",
            f"--log-file={self.folder}/munged.log",
            f"--seed-file={self.folder}/munged.seed",
        )
        self.wait(lambda: (self.folder / "munge.sock").exists(), "munged")
        self.daemon("slurmctld", "-D", "-i")
        self.start_node()

    def daemon(self, program, *arguments):
        log = open(self.folder / f"{program}.out", "ab")
        with log:
            self.daemons[program] = subprocess.Popen(
                [shutil.which(program, path=PATH), *arguments],
                env=self.environment,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
            )

    def start_node(self):
        self.daemon("slurmd", "-D")
        self.wait(lambda: self.run("sinfo", "-h", "-o", "%T").strip() in ("idle", "mixed", "allocated"), "slurmd")

    def kill_node(self):
        """Kills the node with all that runs on it. Its controller notices, as after the time-out."""
        daemon = self.daemons["slurmd"]
        for process in [daemon.pid, *descendants(daemon.pid)]:
            try:
                os.kill(process, signal.SIGKILL)
            except ProcessLookupError:
                pass
        daemon.wait()
        self.run("scontrol", "update", f"nodename={self.node}", "state=down", "reason=killed")
        self.start_node()

    def run(self, *command):
        ended = subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False)
        return ended.stdout + ended.stderr

    def jobs(self):
        """(id, state) of all jobs that have not ended."""
        lines = self.run("squeue", "-h", "-r", "-o", "%i %T").splitlines()
        return [tuple(line.split()) for line in lines]

    def wait(self, is_true, purpose, seconds=60, pause=0.1):
        end = time.monotonic() + seconds
        while not is_true():
            if time.monotonic() > end:
                raise TimeoutError(f"{purpose}: nothing within {seconds} s\n{self.logs()}")
            time.sleep(pause)

    def logs(self):
        return "\n".join(
            f"{path.name}:\n{path.read_text(errors='replace')[-3000:]}" for path in self.folder.glob("*.out")
        )

    def stop(self):
        self.run("scancel", "--user=root")
        for daemon in reversed(self.daemons.values()):
            for process in [*descendants(daemon.pid), daemon.pid]:
                try:
                    os.kill(process, signal.SIGKILL)
                except ProcessLookupError:
                    pass
            daemon.wait()
