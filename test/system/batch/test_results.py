"""Plans small chains, and reads their results."""

import json
import os
import pathlib
import re
import signal
import sqlite3
import subprocess
import tempfile
import time
import unittest

import chain

QUICK = ["--samples", "128", "--no-certificate"]  # no decision depends on time
STATUSES = ["failed", "unfinished", "infeasible", "undecided", "planned"]


class Batch(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.shops, self.results = self.folder / "shops", self.folder / "results"

    def batch(self, *arguments, code=None):
        ended = chain.shelfbeam("batch", self.shops, "-o", self.results, *arguments)
        if code is not None:
            self.assertEqual(ended.returncode, code, ended.stderr)
        return ended

    def refused(self, *parts, arguments=()):
        before = chain.contents(self.results) if (self.results / "records").exists() else None
        ended = self.batch(*arguments, code=2)
        self.assertTrue(ended.stderr.startswith("error: "), ended.stderr)
        for part in parts:
            self.assertIn(part, ended.stderr)
        if before is not None:
            self.assertEqual(chain.contents(self.results), before)

    def test_results_are_sorted_by_need(self):
        chain.make_chain(self.shops, "--count", 7, "--kinds", "valid,valid,infeasible,broken")
        ended = self.batch("--", *QUICK, code=1)
        self.assertIn("Planned: 4 of 7 stores. These need attention: 1 failed, 2 not possible", ended.stdout)
        self.assertIn("1 failed", ended.stdout)
        rows = chain.rows(self.results)
        self.assertEqual(len(rows), 7)
        need = [(STATUSES.index(row["status"]), row["warnings"] == "0", -float(row["price"] or 0)) for row in rows]
        self.assertEqual(need, sorted(need))
        self.assertEqual(rows[0]["name"], "0004-broken")
        self.assertEqual(
            {row["name"] for row in rows if row["status"] == "infeasible"}, {"0003-infeasible", "0007-infeasible"}
        )
        for row in rows:
            self.assertEqual(row["report"] != "", row["status"] != "failed")
            if row["report"]:
                self.assertTrue((self.results / row["report"]).exists())
        with sqlite3.connect(self.results / "results.sqlite") as database:
            self.assertEqual(
                [name for (name,) in database.execute("SELECT name FROM stores ORDER BY position")],
                [row["name"] for row in rows],
            )
            effort = database.execute("SELECT runs, cpu_s, wall_s, peak_memory FROM effort").fetchall()
        for runs, cpu_s, wall_s, peak_memory in effort:
            self.assertEqual(runs, 1)
            self.assertGreater(cpu_s, 0)
            self.assertLess(cpu_s, 1.2 * wall_s + 0.1)
            self.assertGreater(peak_memory, 5_000_000)
        page = (self.results / "results.html").read_text(encoding="utf-8")
        self.assertIn('<a href="plans/0001-valid/report.html">0001-valid</a>', page)
        heads = re.findall(r"<th[^>]*>([^<]*)</th>", page)
        self.assertEqual(heads[:5], ["Store", "Units", "At least", "Price", "Answer"])
        self.refused("contains the results of an earlier batch", "'--resume'")

        # A corrected store: only this one is planned again.
        records = {path.name: path.stat().st_mtime_ns for path in (self.results / "records").iterdir()}
        (self.shops / "0004-broken/store.json").write_bytes((self.shops / "0001-valid/store.json").read_bytes())
        self.batch("--only", "failed", "--", *QUICK, code=1)
        self.assertEqual(
            {
                path.name
                for path in (self.results / "records").iterdir()
                if path.stat().st_mtime_ns != records[path.name]
            },
            {"0004-broken.json"},
        )
        self.assertNotIn("failed", {row["status"] for row in chain.rows(self.results)})
        # A changed file and changed options.
        (self.shops / "0004-broken/store.json").write_text("{}", encoding="utf-8")
        self.assertIn("1 failed", self.batch("--resume", "--", *QUICK, code=1).stdout)

    def test_lists_and_folders(self):
        chain.make_chain(self.shops, "--count", 2, "--kinds", "broken")
        (self.shops / "list.txt").write_text(
            "# two shops\n\n 0001-broken/store.json\n0002-broken/store.json \n", encoding="utf-8"
        )
        ended = chain.shelfbeam("batch", self.shops / "list.txt", "-o", self.shops / "results", "--json")
        self.assertEqual(ended.returncode, 1, ended.stderr)
        self.assertEqual(
            json.loads(ended.stdout)["stores"],
            {"failed": 2, "unfinished": 0, "infeasible": 0, "undecided": 0, "planned": 0},
        )
        # The folder of the results and other plans are not stores.
        (self.shops / "plan").mkdir()
        for name in ("store.json", "placement.json"):
            (self.shops / "plan" / name).write_text("{}", encoding="utf-8")
        (self.shops / "results/store.json").write_text("{}", encoding="utf-8")
        ended = chain.shelfbeam("batch", self.shops, "-o", self.shops / "results", "--resume")
        self.assertIn("Planned: 0 of 2 stores.", ended.stdout)

    def test_wrong_use_is_refused(self):
        chain.make_chain(self.shops, "--count", 2, "--kinds", "broken")
        self.refused("options of 'plan'", "--sample", arguments=("--", "--sample", "5"))
        self.refused("plan --quiet", arguments=("--", "--quiet"))
        self.refused("options of 'plan'", arguments=("--", "-o", "elsewhere"))
        self.refused("--part", "'3/2'", arguments=("--part", "3/2"))
        self.refused("--only", arguments=("--only", "planned"))
        self.assertFalse(self.results.exists())
        for source, part in ((self.folder / "none", "cannot be read"), (self.folder / "empty", "names no store")):
            (self.folder / "empty").mkdir(exist_ok=True)
            ended = chain.shelfbeam("batch", source, "-o", self.results)
            self.assertEqual(ended.returncode, 2)
            self.assertIn(part, ended.stderr)
        self.refused("has no results of a batch", arguments=("--collect",))
        self.results.mkdir()
        (self.results / "results.csv").write_text("my own", encoding="utf-8")
        self.refused("results.csv: was not written by a batch")

    def stopped(self, *arguments):
        """The output of a batch that is stopped while plans save checkpoints."""
        process = subprocess.Popen(
            [chain.PROGRAM, "batch", self.shops, "-o", self.results, *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        while not list(self.results.glob("plans/*/*.checkpoint")):
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate()
        self.assertEqual(process.returncode, 3, err)
        self.assertIn("stopped early: repeat the command with '--resume' to continue", err)
        return out

    def test_a_stopped_batch_resumes(self):
        chain.make_chain(self.shops, "--count", 3, "--kinds", "valid")
        options = ["--no-certificate", "--checkpoint-interval", "0", "--samples"]
        self.assertIn("3 not planned yet", self.stopped("--", *options, "3000"))
        self.batch("--resume", "--", *options, "3000", code=0)
        with sqlite3.connect(self.results / "results.sqlite") as database:
            self.assertGreater(database.execute("SELECT max(runs) FROM effort").fetchone()[0], 1)
        # Checkpoints of other options do not hinder new plans.
        self.stopped("--overwrite", "--", *options, "3000")
        self.batch("--resume", "--", *options, "1000", code=0)

    def test_a_plan_that_lacks_memory_runs_again_alone(self):
        chain.make_chain(self.shops, "--count", 2, "--kinds", "broken,valid")
        store = self.shops / "0002-valid/store.json"
        shop = json.loads(store.read_text(encoding="utf-8"))
        shop["transceivers"]["grids"][0]["spacing"] = 0.03
        for gondola in shop["fixtures"]:
            gondola["labels"]["spacing"] = 0.05
        store.write_text(json.dumps(shop), encoding="utf-8")
        self.batch("--memory", "1100M", "--threads", "2", "--", *QUICK)
        with sqlite3.connect(self.results / "results.sqlite") as database:
            runs = dict(database.execute("SELECT name, runs FROM effort"))
            (answer,) = database.execute("SELECT answer FROM stores WHERE name = '0002-valid'").fetchone()
        self.assertEqual(runs, {"0001-broken": 1, "0002-valid": 2})
        self.assertIn("the limit is 0.88 GB", answer)  # 80 % of all, not of a half

    def test_plans_with_an_open_bound_are_planned(self):
        chain.make_chain(self.shops, "--count", 2, "--kinds", "valid")
        certified = ["--samples", "2000", "--budget"]
        # Without a budget, the first samples certify the labels of one shop, but prove no bound.
        self.batch("--", *certified, "600", code=0)
        (self.results / "records/0001-valid.json").unlink()
        ended = self.batch("--only", "failed", "--", *certified, "1e-6", code=0)
        first, second = sorted(chain.rows(self.results), key=lambda row: row["name"])
        self.assertEqual([first["status"], second["status"]], ["planned"] * 2)
        low, high = first["price_lower_bound"] or first["lower_bound"], first["price"] or first["units"]
        self.assertLess(float(low), float(high))
        self.assertIn("are certified, so the plan can be mounted as it is; whether", first["answer"])
        self.assertIn("For 1 planned store, whether", ended.stdout)
        self.assertIn("open: 0001-valid (", ended.stdout)
        self.assertIn("'--only open -- --budget SECONDS'", ended.stdout)
        # More time for this plan only: the other keeps its answer, although its options were others.
        record = (self.results / "records/0002-valid.json").stat().st_mtime_ns
        ended = self.batch("--only", "open", "--", *certified, "599", code=0)
        self.assertNotIn("is open", ended.stdout)
        self.assertEqual((self.results / "records/0002-valid.json").stat().st_mtime_ns, record)

    def test_parts_are_the_batch(self):
        chain.make_chain(self.shops, "--count", 4, "--kinds", "valid,broken")
        self.batch("--", *QUICK, code=1)
        whole = self.folder / "whole"
        os.rename(self.results, whole)
        for part in (3, 1, 2):
            ended = self.batch("--part", f"{part}/3", "--", *QUICK, code=0)
            self.assertEqual(ended.stdout, "")
        self.assertFalse((self.results / "results.csv").exists())
        self.batch("--collect", code=1)
        self.assertEqual(chain.differences(self.results, whole), [])
        # The control: another seed gives other signals.
        self.batch("--overwrite", "--seed", "2", "--", *QUICK, code=1)
        self.assertIn("plans/0001-valid/signal.h5", chain.differences(self.results, whole))


if __name__ == "__main__":
    unittest.main()
