#!/usr/bin/env python3
"""The job-array script on a real Slurm: one node, started here, stopped at the end.

usage: slurm_test.py PROGRAM SCRIPT
Exit status 77 (skipped) where Slurm is not installed, or may not be started: it needs root.
"""
import json
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
TASKS = 3


def skip(why):
    print("skipped:", why)
    sys.exit(SKIPPED)


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


class Cluster:
    """slurmctld and slurmd with a configuration of their own."""

    def __init__(self, folder):
        self.folder = folder
        self.daemons = []
        control, node = free_ports(2)
        name = socket.gethostname().split(".")[0]
        for sub in ("state", "spool"):
            os.makedirs(os.path.join(folder, sub))
        settings = {
            "ClusterName": "intarsia-test", "SlurmctldHost": f"{name}(127.0.0.1)", "SlurmctldPort": control,
            "SlurmdPort": node, "AuthType": "auth/none", "CredType": "cred/none", "SlurmUser": "root",
            "SlurmdUser": "root", "StateSaveLocation": f"{folder}/state", "SlurmdSpoolDir": f"{folder}/spool",
            "SlurmctldPidFile": f"{folder}/slurmctld.pid", "SlurmdPidFile": f"{folder}/slurmd.pid",
            "SlurmctldLogFile": f"{folder}/slurmctld.log", "SlurmdLogFile": f"{folder}/slurmd.log",
            "ProctrackType": "proctrack/linuxproc", "TaskPlugin": "task/none", "SwitchType": "switch/none",
            "SelectType": "select/cons_tres", "SelectTypeParameters": "CR_CPU", "MpiDefault": "none",
            "JobAcctGatherType": "jobacct_gather/none", "AccountingStorageType": "accounting_storage/none",
            "ReturnToService": 2, "SchedulerType": "sched/builtin", "LaunchParameters": "",
        }
        cores = os.cpu_count() or 1
        with open(self.config, "w", encoding="ascii") as file:
            for key, value in settings.items():
                if value != "":
                    file.write(f"{key}={value}\n")
            file.write(f"NodeName={name} NodeAddr=127.0.0.1 CPUs={cores} RealMemory=1000 State=UNKNOWN\n")
            file.write(f"PartitionName=all Nodes={name} Default=YES MaxTime=INFINITE State=UP\n")

    @property
    def config(self):
        return os.path.join(self.folder, "slurm.conf")

    @property
    def environment(self):
        return {**os.environ, "SLURM_CONF": self.config}

    def start(self):
        for command in (["slurmctld", "-D", "-f", self.config], ["slurmd", "-D", "-f", self.config]):
            log = open(os.path.join(self.folder, command[0] + ".out"), "wb")
            self.daemons.append(subprocess.Popen(command, stdout=log, stderr=log, env=self.environment))
        for _ in range(150):
            if any(d.poll() is not None for d in self.daemons):
                return False
            if "idle" in self.ask("sinfo", "-h", "-o", "%T"):
                return True
            time.sleep(0.2)
        return False

    def ask(self, *command):
        done = subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False)
        return done.stdout if done.returncode == 0 else ""

    def submit(self, *arguments):
        done = subprocess.run(["sbatch", "--parsable", *arguments], env=self.environment, cwd=self.folder,
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError("sbatch: " + done.stderr)
        return done.stdout.strip()

    def wait(self, job, seconds):
        end = time.time() + seconds
        while time.time() < end:
            if not self.ask("squeue", "-h", "-j", job).strip():
                return
            time.sleep(0.3)
        raise RuntimeError("the job does not end:\n" + self.ask("squeue"))

    def stop(self):
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in self.daemons:
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()

    def logs(self):
        for name in sorted(os.listdir(self.folder)):
            if name.endswith((".log", ".out")):
                with open(os.path.join(self.folder, name), encoding="utf-8", errors="replace") as file:
                    print(f"== {name}\n{file.read()[-2000:]}")


def check(what, condition):
    print("ok  " if condition else "FAIL", what)
    if not condition:
        raise RuntimeError(what)


def make_scans(program, folder):
    os.makedirs(folder)
    for i, shape in enumerate(["cube", "cube", "sphere", "star", "cube"]):
        subprocess.run([program, "make", shape, "--triangles", str(1200 + 100 * i), "-o", f"{folder}/scan-{i}.ply",
                        "-q"], check=True)
    with open(f"{folder}/broken.ply", "w", encoding="ascii") as file:
        file.write("ply\nformat ascii 1.0\nelement vertex 3\n")


def run(program, script, folder):
    scans, results = os.path.join(folder, "scans"), os.path.join(folder, "results")
    make_scans(program, scans)
    cluster = Cluster(os.path.join(folder, "slurm"))
    try:
        if not cluster.start():
            cluster.logs()
            skip("slurmctld and slurmd do not start here")
        environment = "ALL,INTARSIA=" + program
        array = ["--array", f"1-{TASKS}", "--cpus-per-task=1", "--mem=0", "--export", environment,
                 "--output", f"{folder}/slurm/task-%a.out", script, scans, results, "--write", "none"]
        cluster.wait(cluster.submit(*array), 240)
        with open(f"{results}/summary.json", encoding="utf-8") as file:
            summary = json.load(file)
        rows = {row["name"]: row for row in summary["meshes"]}
        check("every mesh of all tasks is in the summary", len(rows) == 6)
        check("the broken one failed, with its reason", rows["broken"]["exit"] == 3)
        check("all others have a layout", all(r["exit"] in (0, 5) for n, r in rows.items() if n != "broken"))
        tasks = [open(f"{folder}/slurm/task-{i}.out", encoding="utf-8").read() for i in range(1, TASKS + 1)]
        check("each task took its share", all(text.count("] ") == 2 for text in tasks))
        stamps = {n: os.stat(f"{results}/{n}/report.json").st_mtime_ns for n in rows if n != "broken"}
        cluster.wait(cluster.submit(*array), 240)
        check("submitted again, it leaves out what is done",
              stamps == {n: os.stat(f"{results}/{n}/report.json").st_mtime_ns for n in stamps})
    except Exception:
        cluster.logs()
        raise
    finally:
        cluster.stop()


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    for name in ("slurmctld", "slurmd", "sbatch", "squeue", "sinfo"):
        if shutil.which(name) is None:
            skip(f"{name} is not installed (Debian: slurm-wlm)")
    if os.geteuid() != 0:
        skip("Slurm's daemons need root")
    with tempfile.TemporaryDirectory() as folder:
        run(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), folder)


if __name__ == "__main__":
    main()
