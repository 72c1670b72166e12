"""A Slurm cluster of two nodes on this machine, and both workflows on it. Run by `cargo xtask slurm`, as root.

Configuration, state and keys lie in a folder that goes at the end; a Slurm that is installed here is not touched.
"""

import os
import re
import secrets
import signal
import socket
import subprocess
import time
import unittest

from common import PROGRAM, SETTINGS, Case, make_captures, summary

NODES = ["n1", "n2"]
CONFIGURATION = """ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
# Neither control groups nor systemd: neither is everywhere.
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
# The nodes are what stands here, whatever the machine has.
SlurmdParameters=config_overrides
ReturnToService=2
SchedulerParameters=batch_sched_delay=0
# How long squeue knows a job that has ended.
MinJobAge=600
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[1]} CPUs=1 RealMemory=4000
NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[2]} CPUs=1 RealMemory=4000
PartitionName=all Nodes=n1,n2 Default=YES State=UP
"""
# What the jobs' srun is: the executor clears its environment of Slurm's variables, among them where the configuration is.
SRUN = """#!/bin/sh
SLURM_CONF={folder}/slurm.conf exec {srun} "$@"
"""
OPTIONS = [
    "--slurm-status-command=squeue",
    "--slurm-init-seconds-before-status-checks=2",
    "--slurm-no-account",
    "--latency-wait=10",
]


def free_ports(count):
    """Ports that nobody listens on."""
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    """munged, slurmctld and a slurmd for each node."""

    def __init__(self, folder):
        self.folder = folder
        self.running = {}
        # The daemons ask for a folder that only root may write, and none above it that others may.
        folder.mkdir(mode=0o755)
        for name in ["state", "bin", *(f"spool-{node}" for node in NODES)]:
            (folder / name).mkdir()
        key = folder / "munge.key"
        key.touch(mode=0o600)
        key.write_bytes(secrets.token_bytes(128))
        host = socket.gethostname().partition(".")[0]
        (folder / "slurm.conf").write_text(CONFIGURATION.format(folder=folder, host=host, ports=free_ports(3)))
        found = subprocess.run(["which", "srun"], check=True, capture_output=True, text=True).stdout.strip()
        srun = folder / "bin/srun"
        srun.write_text(SRUN.format(folder=folder, srun=found))
        srun.chmod(0o755)
        os.environ["SLURM_CONF"] = str(folder / "slurm.conf")
        os.environ["PATH"] = f"{srun.parent}:{os.environ['PATH']}"

    def start(self):
        files = [f"--{name}-file={self.folder}/munge.{name}" for name in ("key", "pid", "log", "seed")]
        self.daemon("munged", "--foreground", "--force", f"--socket={self.folder}/munge.socket", *files)
        self.daemon("slurmctld", "-D")
        for node in NODES:
            self.start_node(node)

    def start_node(self, node):
        self.daemon("slurmd", "-D", "-N", node, name=node)

    def daemon(self, *words, name=None):
        name = name or words[0]
        with open(self.folder / f"{name}.out", "ab") as out:
            self.running[name] = subprocess.Popen(words, stdout=out, stderr=out, start_new_session=True)

    def stop(self, name):
        process = self.running.pop(name)
        process.send_signal(signal.SIGTERM)
        process.wait(timeout=60)

    def stop_all(self):
        subprocess.run(["scancel", "--user", "root"], check=False)
        for name in reversed(list(self.running)):
            self.stop(name)

    def nodes(self):
        """State of each node."""
        return dict(line.split() for line in self.ask("sinfo", "-h", "-N", "-o", "%N %T"))

    def jobs(self):
        """Id, state, node and comment of each job that Slurm knows."""
        lines = self.ask("squeue", "-h", "-t", "all", "-o", "%i|%T|%N|%k")
        return [line.split("|", 3) for line in lines]

    def ask(self, *words):
        """Lines of an answer; none while the daemons start."""
        return subprocess.run(words, capture_output=True, text=True, timeout=60).stdout.splitlines()

    def logs(self):
        return "\n".join(path.read_text("utf-8", "replace")[-3000:] for path in self.folder.glob("*.log"))


class Slurm(Case):
    def setUp(self):
        super().setUp()
        self.assertEqual(os.getuid(), 0, "Slurm's daemons ask to be started by root")
        self.cluster = Cluster(self.folder / "cluster")
        self.addCleanup(self.cluster.stop_all)
        self.cluster.start()
        try:
            self.wait_until(lambda: self.cluster.nodes() == dict.fromkeys(NODES, "idle"), limit=60)
        except AssertionError:
            self.fail(self.cluster.logs())

    def running(self):
        """Jobs at work, by their nodes."""
        return {node: job for job, state, node, _ in self.cluster.jobs() if state == "RUNNING"}

    def test_captures_survive_a_cancelled_job_and_a_lost_daemon(self):
        captures, out = self.folder / "cap'tures ü", self.folder / "results"
        # So many, and in the best quality, that there is time to disturb.
        make_captures(captures, [f"it's {number}" for number in range(24)])
        settings = ["--quality", "best", *SETTINGS[2:]]
        config = {
            "captures": captures.name,
            "results": out.name,
            "program": PROGRAM,
            "settings": settings,
            "shards": 4,
            "threads": 1,
            "memory_gib": 1,
            "minutes": 10,
            "retries": 3,
        }
        engine = self.start("estimate.smk", config, profile="slurm", more=OPTIONS)
        self.addCleanup(engine.kill)
        # Both nodes work, and results come.
        self.wait_until(lambda: len(self.running()) == 2)
        self.wait_until(lambda: list(out.glob("*/batch.json")))
        cancelled, other = self.running()["n1"], "n2"
        subprocess.run(["scancel", cancelled], check=True)
        self.cluster.stop(other)
        time.sleep(5)
        self.cluster.start_node(other)
        said = self.ended(engine, limit=400)
        self.assertIn("Trying to restart", said)
        jobs = self.cluster.jobs()
        self.assertIn((cancelled, "CANCELLED"), [(job, state) for job, state, *_ in jobs])
        # Four shards, one of them twice at least, on both nodes.
        self.assertGreaterEqual(len(jobs), 5, jobs)
        self.assertEqual({node for _, _, node, _ in jobs}, set(NODES), jobs)
        self.assertEqual(self.cluster.nodes()[other].rstrip("*"), "idle")
        plain = self.folder / "plain"
        self.normalight("batch", captures.name, "--out", plain, "--", *settings)
        self.same_results(plain, out)
        self.does_nothing("estimate.smk", config, profile="slurm", more=OPTIONS)
        print(f"jobs: {[job[:3] for job in jobs]}, restarts: {len(re.findall('Trying to restart', said))}")

    def test_a_cancelled_training_goes_on_from_its_checkpoint(self):
        recipe, runs = self.recipe("it's normal", "normal", 300), self.folder / "runs"
        config = {
            "recipes": [recipe.name],
            "seeds": [1, 2],
            "runs": runs.name,
            "program": PROGRAM,
            "threads": 1,
            "memory_gib": 1,
            "minutes": 10,
            "retries": 2,
        }
        engine = self.start("train.smk", config, profile="slurm", more=OPTIONS)
        self.addCleanup(engine.kill)
        folders = [runs / recipe.stem / f"seed-{seed}" for seed in config["seeds"]]
        self.wait_until(lambda: any((run / "checkpoint.safetensors").is_file() for run in folders))
        # Both jobs: which of them has begun to train, their names do not say.
        subprocess.run(["scancel", *self.running().values()], check=True)
        said = self.ended(engine, limit=400)
        self.assertIn("Trying to restart", said)
        self.assertEqual({node for _, _, node, _ in self.cluster.jobs()}, set(NODES))
        self.assertTrue(any("continued" in (run / "log.txt").read_text("utf-8") for run in folders))
        for run in folders:
            self.assertEqual(summary(run)["state"], "finished")
            self.same_training(run, recipe)
        self.does_nothing("train.smk", config, profile="slurm", more=OPTIONS)


if __name__ == "__main__":
    unittest.main()
