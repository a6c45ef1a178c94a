"""A real Slurm of one node in a folder, run as root without systemd: for tests of `frangia batch --slurm`.

Needs Debian's slurm-wlm and munge.
"""
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time


def is_installed():
    return os.geteuid() == 0 and all(shutil.which(name) for name in ("sbatch", "slurmctld", "slurmd", "munged"))


class SlurmNode:
    """Starts the daemons on entry and ends them on exit."""

    def __init__(self, folder, cores=2):
        self.folder = pathlib.Path(folder).resolve()
        self.cores = cores
        self.conf = self.folder / "slurm.conf"
        self.environment = {**os.environ, "SLURM_CONF": str(self.conf)}

    def __enter__(self):
        for name in ("state", "spool", "munge"):
            (self.folder / name).mkdir(parents=True, exist_ok=True)
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o600)
        ports = [free_port(), free_port()]
        host = socket.gethostname().split(".")[0]
        at = self.folder
        self.conf.write_text(
            f"""ClusterName=frangia
SlurmctldHost={host}(127.0.0.1)
AuthType=auth/munge
AuthInfo=socket={at}/munge/socket
CryptoType=crypto/munge
SlurmUser=root
SlurmdUser=root
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
StateSaveLocation={at}/state
SlurmdSpoolDir={at}/spool
SlurmctldPidFile={at}/slurmctld.pid
SlurmdPidFile={at}/slurmd.pid
SlurmctldLogFile={at}/slurmctld.log
SlurmdLogFile={at}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=1,batch_sched_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
JobRequeue=1
MinJobAge=3600
SlurmdTimeout=20
SlurmctldTimeout=20
NodeName={host} NodeAddr=127.0.0.1 CPUs={self.cores} RealMemory=4000 State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""
        )
        self.munged = subprocess.Popen(
            [
                "munged",
                "--force",
                "--foreground",
                f"--key-file={key}",
                f"--socket={at}/munge/socket",
                f"--pid-file={at}/munge/pid",
                f"--log-file={at}/munge/log",
                f"--seed-file={at}/munge/seed",
            ],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self.slurmctld = self.slurmd = None
        self.start_controller()
        self.start_node()
        for _ in range(60):
            if "idle" in self.ask("sinfo", "-h", "-o", "%T"):
                return self
            time.sleep(0.5)
        raise RuntimeError(f"Slurm does not start; see {at}/slurmctld.log")

    def __exit__(self, *_):
        for daemon in (self.slurmd, self.slurmctld, self.munged):
            daemon.terminate()
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()

    def start(self, *command):
        return subprocess.Popen(command, env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def start_controller(self):
        self.slurmctld = self.start("slurmctld", "-D")

    def start_node(self):
        self.slurmd = self.start("slurmd", "-D")

    def kill_controller(self):
        """The controller dies, as by a power cut, and starts again."""
        self.slurmctld.send_signal(signal.SIGKILL)
        self.slurmctld.wait()
        self.start_controller()

    def ask(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True).stdout

    def is_busy(self):
        """Whether a job waits or runs; also while the controller does not answer."""
        answer = subprocess.run(
            ["squeue", "-h", "-r", "-o", "%A"], env=self.environment, capture_output=True, text=True
        )
        return answer.returncode != 0 or bool(answer.stdout.strip())

    def running(self):
        """Identifiers of the running jobs."""
        return self.ask("squeue", "-h", "-r", "-t", "R", "-o", "%i").split()

    def requeue(self, job):
        """Kills a running job, which then begins again."""
        self.ask("scontrol", "requeue", job)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]
