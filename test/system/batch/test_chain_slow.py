"""Batches that are disturbed end with the results of an undisturbed one."""

import os
import pathlib
import random
import subprocess
import tempfile
import unittest

import chain
import slurm
from harness import Process, run

SHOPS, KILLS, NODE_KILLS = 20, 7, int(os.environ.get("NODE_KILLS", "2"))
OPTIONS = ["--", "--samples", "2000"]  # no decision depends on time


class Disturbed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.shops, cls.whole = cls.folder / "shops", cls.folder / "whole"
        chain.make_chain(cls.shops, "--count", SHOPS)
        cls.ended = run("batch", cls.shops, "-o", cls.whole, *OPTIONS)

    def setUp(self):
        self.assertEqual(self.ended.status, 1, self.ended.err)
        statuses = [row["status"] for row in chain.rows(self.whole)]
        self.assertEqual(
            {name: statuses.count(name) for name in sorted(set(statuses))},
            {"failed": 2, "infeasible": 2, "planned": 16},
        )

    def test_a_batch_that_is_killed(self):
        killed, rng, kills = self.folder / "killed", random.Random(1), 0
        while True:
            process = Process("batch", self.shops, "-o", killed, "--resume", *OPTIONS)
            self.addCleanup(process.close)
            try:
                process.process.wait(rng.uniform(0.1, 2.5) if kills < KILLS else None)
            except subprocess.TimeoutExpired:
                process.kill()
                kills += 1
                continue
            end = process.wait()
            self.assertEqual(end.status, 1, end.err)
            break
        self.assertEqual(kills, KILLS, "the batch ended before all kills")
        self.assertEqual(chain.differences(killed, self.whole), [])
        # The control: one different byte is found.
        with open(killed / "plans/0001-valid/labels.csv", "ab") as file:
            file.write(b"\n")
        self.assertEqual(chain.differences(killed, self.whole), ["plans/0001-valid/labels.csv"])

    def test_a_slurm_array_whose_node_is_killed(self):
        if reason := slurm.obstacle():
            if "CI" in os.environ:
                self.fail(f"Slurm cannot run: {reason}")
            self.skipTest(f"SLURM CANNOT RUN, SO BATCHES ON A CLUSTER ARE NOT TESTED: {reason}")
        folder = tempfile.TemporaryDirectory(prefix="slurm-")
        self.addCleanup(folder.cleanup)
        cluster = slurm.Cluster(folder.name)
        self.addCleanup(cluster.stop)  # before the folder is removed
        cluster.start()
        results = self.folder / "cluster"
        limits = ["--tasks", SHOPS // 2, "--memory", "1G", "--task-time", 30]
        ended = run("batch", self.shops, "-o", results, "--slurm", *limits, *OPTIONS, env=cluster.environment)
        self.assertEqual(ended.status, 0, ended.err)
        self.assertIn(f"{SHOPS} stores in {SHOPS // 2} tasks are queued as job ", ended.out)

        def records():
            return len(list((results / "records").glob("*.json")))

        def is_running():
            return "RUNNING" in dict(cluster.jobs()).values()

        for kill in range(NODE_KILLS):
            # Some stores are planned, and tasks are running.
            cluster.wait(lambda: records() >= SHOPS * (kill + 1) // (NODE_KILLS + 2) and is_running(), "the plans", 300)
            cluster.kill_node()

        # The signal that Slurm sends before the time limit: the task saves its checkpoints and is queued again. A
        # script that has started its plans handles the signal; one that is just starting would be killed by it.
        def has_stopped():
            arguments = slurm.arguments_of_processes()
            for job, state in cluster.jobs():
                if state == "RUNNING" and ["--part", f"{job.split('_')[-1]}/{SHOPS // 2}"] in arguments:
                    cluster.run("scancel", "--batch", "--signal=INT", job)
            logs = "".join(path.read_text() for path in (results / "slurm").glob("*.log"))
            return "stopped early: repeat the command with '--resume' to continue" in logs

        # A task that is stopped again and again before it can handle signals would use up its restarts.
        cluster.wait(has_stopped, "a task that is stopped", 300, pause=0.7)
        cluster.wait(lambda: not cluster.jobs(), "the results", 600)
        self.assertEqual(chain.differences(results, self.whole), [], cluster.logs())
