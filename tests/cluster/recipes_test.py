# SPDX-License-Identifier: BSD-3-Clause
"""The recipes of examples/cluster on the real programs: slurmctld, slurmd and munged of Debian on the loopback, GNU
parallel, Snakemake. Each is skipped where its programs are not installed (slurmctld slurmd slurm-client munge;
parallel; snakemake). Environment: VERICONE, VERICONE_SOURCE."""
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import unittest

VERICONE = os.path.abspath(os.environ["VERICONE"])
RECIPES = os.path.join(os.environ["VERICONE_SOURCE"], "examples", "cluster")
PARTS = 16


def contents(folder):
    files = {}
    for name in sorted(os.listdir(folder)):
        if name != "provenance.json":
            with open(os.path.join(folder, name), "rb") as f:
                files[name] = f.read()
    return files


class Recipe(unittest.TestCase):
    ENGAGEMENTS = 160

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name
        self.environment = {**os.environ, "ENGAGEMENTS": str(self.ENGAGEMENTS),
                            "PATH": os.path.dirname(VERICONE) + os.pathsep + os.environ["PATH"]}

    def needs(self, *programs):
        missing = [p for p in programs if not shutil.which(p, path=self.environment["PATH"] + ":/usr/sbin:/sbin")]
        if missing:
            self.skipTest("not installed: " + ", ".join(missing))

    def run_here(self, *words, **options):
        result = subprocess.run(words, cwd=self.folder, env=self.environment, capture_output=True, text=True, check=False,
                                **options)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout

    def equals_one_run(self, merged, figures):
        words = [VERICONE, "campaign", "-N", str(self.ENGAGEMENTS), "--seed", "1", "--quiet", "--out", "whole"]
        self.run_here(*words, *([] if figures else ["--no-figures"]))
        self.assertEqual(contents(os.path.join(self.folder, merged)), contents(os.path.join(self.folder, "whole")))


class Parallel(Recipe):
    def test_is_one_run(self):
        self.needs("parallel")
        self.run_here("sh", os.path.join(RECIPES, "campaign.parallel"), "5")
        self.equals_one_run("out/campaign", figures=True)


class Snakemake(Recipe):
    def test_is_one_run(self):
        self.needs("snakemake")
        self.run_here("snakemake", "--quiet", "--cores", "2", "--snakefile", os.path.join(RECIPES, "Snakefile"), "--config",
                      "parts=5", f"engagements={self.ENGAGEMENTS}")
        self.equals_one_run("out/campaign", figures=True)


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class Slurm(Recipe):
    """An array of 16 parts; two of them are killed, queued again and go on."""

    ENGAGEMENTS = 16_000

    def start(self, *words):
        with open(os.path.join(self.folder, os.path.basename(words[0]) + ".log"), "w", encoding="utf-8") as log:
            process = subprocess.Popen(words, cwd=self.folder, env=self.environment, stdout=log, stderr=log)

        def stop():
            process.terminate()
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        self.addCleanup(stop)

    def cluster(self):
        """munged, slurmctld and slurmd of this folder alone, as whoever runs the test."""
        here = os.path.join(self.folder, "slurm")
        for name in ("munge", "state", "spool"):
            os.makedirs(os.path.join(here, name), mode=0o700)
        key = os.path.join(here, "munge", "key")
        with open(key, "wb") as f:
            f.write(os.urandom(1024))
        os.chmod(key, 0o400)
        munge = os.path.join(here, "munge", "socket")
        self.start("/usr/sbin/munged", "--foreground", "--force", f"--key-file={key}", f"--socket={munge}",
                   f"--pid-file={here}/munge/pid", f"--log-file={here}/munge/log", f"--seed-file={here}/munge/seed")
        host, user = socket.gethostname().split(".")[0], subprocess.check_output(["id", "-un"], text=True).strip()
        config = os.path.join(here, "slurm.conf")
        with open(config, "w", encoding="utf-8") as f:
            f.write("\n".join([
                "ClusterName=vericone", f"SlurmctldHost={host}(127.0.0.1)", f"SlurmUser={user}", f"SlurmdUser={user}",
                # cred_expire is also how long what is queued again has to wait
                "AuthType=auth/munge", f"AuthInfo=socket={munge},cred_expire=10", "CredType=cred/munge", f"SlurmctldPort={free_port()}",
                f"SlurmdPort={free_port()}", f"StateSaveLocation={here}/state", f"SlurmdSpoolDir={here}/spool",
                f"SlurmctldPidFile={here}/slurmctld.pid", f"SlurmdPidFile={here}/slurmd.pid", "ProctrackType=proctrack/linuxproc",
                "TaskPlugin=task/none", "JobAcctGatherType=jobacct_gather/none", "AccountingStorageType=accounting_storage/none",
                "SchedulerType=sched/builtin", "SelectType=select/cons_tres", "SelectTypeParameters=CR_CPU", "MpiDefault=none",
                "ReturnToService=2", "SlurmdParameters=config_overrides", "JobRequeue=1", "MinJobAge=300",
                f"NodeName={host} NodeAddr=127.0.0.1 CPUs=4 State=UNKNOWN",
                f"PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP", ""]))
        self.environment["SLURM_CONF"] = config
        deadline = time.monotonic() + 60
        while not os.path.exists(munge):
            self.assertLess(time.monotonic(), deadline, "munged did not start")
            time.sleep(0.1)
        self.start("/usr/sbin/slurmctld", "-D", "-i", "-f", config)
        self.start("/usr/sbin/slurmd", "-D", "-N", host, "-f", config)
        while "idle" not in subprocess.run(["sinfo", "-h", "-o", "%t"], env=self.environment, capture_output=True, text=True,
                                           check=False).stdout:
            self.assertLess(time.monotonic(), deadline, "no node came up")
            time.sleep(0.3)

    def tasks(self, job):
        out = self.run_here("squeue", "-h", "-r", "-j", job, "-t", "all", "-o", "%K %T")
        return dict(line.split() for line in out.splitlines())

    def wait(self, what, condition):
        deadline = time.monotonic() + 400
        while not condition():
            self.assertLess(time.monotonic(), deadline, what)
            time.sleep(0.2)

    def test_two_of_an_array_are_killed_and_go_on(self):
        self.needs("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol")
        self.cluster()
        job = self.run_here("sbatch", "--parsable", os.path.join(RECIPES, "campaign.sbatch")).strip()
        killed = {}

        def kill_two():
            for folder in os.listdir("/proc"):
                if not folder.isdigit() or len(killed) == 2:
                    continue
                try:
                    with open(f"/proc/{folder}/cmdline", encoding="utf-8", errors="replace") as f:
                        words = f.read().split("\0")
                    inside = os.readlink(f"/proc/{folder}/cwd") == os.path.realpath(self.folder)
                except OSError:
                    continue
                if "--part" not in words or not inside:
                    continue
                part = words[words.index("--part") + 1].split("/")[0]
                partial = os.path.join(self.folder, "parts", part, "engagements.csv.partial")
                if part not in killed and os.path.exists(partial) and os.path.getsize(partial) > 1000:
                    os.kill(int(folder), signal.SIGKILL)
                    killed[part] = os.path.getsize(partial)
            return len(killed) == 2
        self.wait("no tasks to kill", kill_two)
        self.wait("the killed did not end", lambda: all(self.tasks(job).get(k) in ("FAILED", "CANCELLED") for k in killed))
        for part in killed:
            self.run_here("scontrol", "requeue", f"{job}_{part}")
        self.wait("tasks did not end", lambda: set(self.tasks(job).values()) == {"COMPLETED"})
        self.run_here(VERICONE, "merge", *(f"parts/{k}" for k in range(1, PARTS + 1)), "--quiet", "--no-figures", "--out",
                      "out/campaign")
        self.equals_one_run("out/campaign", figures=False)


if __name__ == "__main__":
    unittest.main()
