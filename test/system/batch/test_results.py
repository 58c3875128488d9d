"""Plans small chains, and reads their results."""

import json
import os
import re
import sqlite3

import chain
from chain import QUICK

STATUSES = ["failed", "unfinished", "infeasible", "undecided", "planned"]


class Batch(chain.BatchTest):
    def make(self, count, kinds):
        chain.make_chain(self.shops, "--count", count, "--kinds", kinds)

    def space(self, name, candidates, labels):
        """Sets the distances of a shop's candidates and labels."""
        shop = self.json(f"t/{name}/store.json")
        shop["transceivers"]["grids"][0]["spacing"] = candidates
        for gondola in shop["fixtures"]:
            gondola["labels"]["spacing"] = labels
        self.add_shop(name, shop)

    def records(self):
        """Name -> time of the last change."""
        return {path.name: path.stat().st_mtime_ns for path in (self.results / "records").iterdir()}

    def asked(self, query):
        with sqlite3.connect(self.results / "results.sqlite") as database:
            return database.execute(query).fetchall()

    def test_results_are_sorted_by_need(self):
        self.make(7, "valid,valid,infeasible,broken")
        ended = self.batch(QUICK, 1)
        self.assertIn("Planned: 4 of 7 stores. These need attention: 1 failed, 2 not possible", ended.out)
        rows = chain.rows(self.results)
        self.assertEqual(len(rows), 7)
        need = [(STATUSES.index(row["status"]), row["warnings"] == "0", -float(row["price"] or 0)) for row in rows]
        self.assertEqual(need, sorted(need))
        self.assertEqual(rows[0]["name"], "0004-broken")
        infeasible = {name for name, status in self.statuses().items() if status == "infeasible"}
        self.assertEqual(infeasible, {"0003-infeasible", "0007-infeasible"})
        for row in rows:
            self.assertEqual(row["report"] != "", row["status"] != "failed")
            if row["report"]:
                self.assertTrue((self.results / row["report"]).exists())
        names = [(row["name"],) for row in rows]
        self.assertEqual(self.asked("SELECT name FROM stores ORDER BY position"), names)
        for runs, cpu_s, wall_s, peak_memory in self.asked("SELECT runs, cpu_s, wall_s, peak_memory FROM effort"):
            self.assertEqual(runs, 1)
            self.assertGreater(cpu_s, 0)
            self.assertLess(cpu_s, 1.2 * wall_s + 0.1)
            self.assertGreater(peak_memory, 5_000_000)
        page = self.text("r/results.html")
        self.assertIn('<a href="plans/0001-valid/report.html">0001-valid</a>', page)
        heads = re.findall(r"<th[^>]*>([^<]*)</th>", page)
        self.assertEqual(heads[:5], ["Store", "Units", "At least", "Price", "Answer"])
        self.refused("batch t -o r", "contains the results of an earlier batch", "'--resume'")

        # A corrected store: only this one is planned again.
        records = self.records()
        self.add_shop("0004-broken", self.bytes("t/0001-valid/store.json"))
        self.batch(f"--only failed {QUICK}", 1)
        changed = {name for name, time in self.records().items() if time != records[name]}
        self.assertEqual(changed, {"0004-broken.json"})
        self.assertNotIn("failed", self.statuses().values())
        # A changed file and changed options.
        self.add_shop("0004-broken", {})
        self.assertIn("1 failed", self.batch(f"--resume {QUICK}", 1).out)

    def test_lists_and_folders(self):
        self.make(2, "broken")
        self.write("t/list.txt", "# two shops\n\n 0001-broken/store.json\n0002-broken/store.json \n")
        ended = self.run_here("batch t/list.txt -o t/results --json")
        self.assertEqual(ended.status, 1, ended.err)
        self.assertEqual(json.loads(ended.out)["stores"], {**dict.fromkeys(STATUSES, 0), "failed": 2})
        # The folder of the results and other plans are not stores.
        for name in ("plan/store.json", "plan/placement.json", "results/store.json"):
            self.write(f"t/{name}", {})
        self.assertIn("Planned: 0 of 2 stores.", self.run_here("batch t -o t/results --resume").out)

    def test_wrong_use_is_refused(self):
        self.make(2, "broken")
        (self.folder / "empty").mkdir()
        for line, *parts in (
            ("t -- --sample 5", "options of 'plan'", "--sample"),
            ("t -- --quiet", "plan --quiet"),
            ("t -- -o elsewhere", "options of 'plan'"),
            ("t --part 3/2", "--part", "'3/2'"),
            ("t --only planned", "--only"),
            ("none", "cannot be read"),
            ("empty", "names no store"),
            ("t --collect", "has no results of a batch"),
        ):
            source, _, options = line.partition(" ")
            self.refused(f"batch {source} -o r {options}", *parts)
        self.write("r/results.csv", "my own")
        self.refused("batch t -o r", "results.csv: was not written by a batch")

    def stop(self, options):
        """The output of a batch that is stopped while plans save checkpoints."""
        process = self.start(f"batch t -o r {options}")
        process.wait_until(lambda: list(self.results.glob("plans/*/*.checkpoint")))
        end = process.end()
        self.assertEqual(end.status, 3, end.err)
        self.assertIn("stopped early: repeat the command with '--resume' to continue", end.err)
        return end.out

    def test_a_stopped_batch_resumes(self):
        self.make(3, "valid")
        options = "--threads 2 -- --no-certificate --estimator uniform --checkpoint-interval 0 --samples"
        self.assertIn("3 not planned yet", self.stop(f"{options} 5000"))
        self.batch(f"--resume {options} 5000")
        self.assertGreater(self.asked("SELECT max(runs) FROM effort")[0][0], 1)
        # Checkpoints of other options do not hinder new plans.
        self.stop(f"--overwrite {options} 5000")
        self.batch(f"--resume {options} 100")

    def test_a_plan_that_lacks_memory_runs_again_alone(self):
        self.make(2, "broken,valid")
        self.space("0002-valid", 0.045, 0.05)
        self.batch(f"--memory 1100M --threads 2 {QUICK}", 1)
        runs = dict(self.asked("SELECT name, runs FROM effort"))
        self.assertEqual(runs, {"0001-broken": 1, "0002-valid": 2})
        ((answer,),) = self.asked("SELECT answer FROM stores WHERE name = '0002-valid'")
        self.assertIn("the limit is 0.88 GB", answer)  # 80 % of all, not of a half

    def test_plans_with_an_open_bound_are_planned(self):
        self.make(2, "valid")
        for name in ("0001-valid", "0002-valid"):
            self.space(name, 2.5, 3)
        certified = "-- --samples 1000 --estimator uniform --budget"
        # Without a budget, the first samples certify the labels of both shops, but prove the bound of one only.
        ended = self.batch(f"{certified} 1e-6")
        first, second = sorted(chain.rows(self.results), key=lambda row: row["name"])
        self.assertEqual([first["status"], second["status"]], ["planned"] * 2)
        low, high = first["price_lower_bound"] or first["lower_bound"], first["price"] or first["units"]
        self.assertLess(float(low), float(high))
        self.assertIn("are certified, so the plan can be mounted as it is; whether", first["answer"])
        self.assertIn("For 1 planned store, whether", ended.out)
        self.assertIn("open: 0001-valid (", ended.out)
        self.assertIn("'--only open -- --budget SECONDS'", ended.out)
        # More time for this plan only: the other keeps its answer, although its options were others.
        records = self.records()
        ended = self.batch(f"--only open {certified} 599")
        self.assertNotIn("is open", ended.out)
        changed = {name for name, time in self.records().items() if time != records[name]}
        self.assertEqual(changed, {"0001-valid.json"})

    def test_parts_are_the_batch(self):
        self.make(4, "valid,broken")
        self.batch(QUICK, 1)
        whole = self.folder / "whole"
        os.rename(self.results, whole)
        for part in (3, 1, 2):
            self.assertEqual(self.batch(f"--part {part}/3 {QUICK}").out, "")
        self.assertFalse((self.results / "results.csv").exists())
        self.batch("--collect", 1)
        self.assertEqual(chain.differences(self.results, whole), [])
        # The control: another seed gives other signals.
        self.batch(f"--overwrite --seed 2 {QUICK}", 1)
        self.assertIn("plans/0001-valid/signal.h5", chain.differences(self.results, whole))
