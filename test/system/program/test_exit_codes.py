"""Exit codes 1 and 3, and 0 for a plan whose bound is open."""

import json
import random
import re
import shutil

from harness import ShopTest, contents, store_with


def spots():
    """Two spots at one mounting point, and on either side a label that only one of them reaches."""
    labels, units = [], []
    for name, x, side in (("west", 0.1, -1), ("east", 7.9, 1)):
        labels.append({"id": name, "position": [x, 3, 1.5], "normal": [-side, 0, 0], "type": "standard"})
        units.append({"id": f"to {name}", "position": [4, 3, 2.9], "axis": [side, 0, -0.36], "type": "spot"})
    return store_with(
        {
            "materials/m/reflectance": 0,
            "label_types/standard/threshold": 0.3,
            "transceiver_types": {"spot": {"emission": {"type": "lambertian", "order": 20, "flux": 5}}},
            "fixtures": [],
            "labels": labels,
            "transceivers": {"list": units},
        }
    )


def hard_matrix():
    """A random cover of 300 labels by 200 units: no exact solver proves it in a millisecond."""
    numbers = random.Random(1)
    signals = range(9)
    rows = ([numbers.choice(signals) if numbers.random() < 1 / 16 else 0 for _ in range(200)] for _ in range(300))
    return "".join(",".join(map(str, row)) + "\n" for row in rows)


class ExitCodes(ShopTest):
    def test_one_if_no_selection_reaches_all(self):
        self.write("store.json", store_with({"label_types/standard/threshold": 100}))
        out = self.told("plan store.json -o plan --samples 320 --estimator uniform", status=1)
        self.assertIn("\nNo selection reaches all 17 labels, with 99 % confidence", out)
        self.assertEqual(len(contents(self.folder / "plan")), 11)
        self.assertIn("No selection reaches all 17 labels", self.check_report())
        self.told("place plan/signal.h5 -o placement.json --model non-cooperative", status=1)
        placement = self.json("placement.json")
        self.assertEqual((placement["status"], len(placement["unreachable"])), ("infeasible", 17))
        self.assertGreater(placement["unreachable"][0]["most"], 0)
        self.told("place plan/signal.h5 --threshold 1e-9")

    def test_one_if_options_conflict(self):
        self.write("store.json", spots())
        out = self.told("plan store.json -o plan --samples 320 --curve --sensitivity", status=1)
        self.assertIn("no curve without a placement", out)
        self.assertIn("no sensitivity without a placement", out)
        placement = self.json("plan/placement.json")
        self.assertEqual((placement["status"], placement["unreachable"]), ("infeasible", []))
        self.told("report plan")
        # Greedy cannot prove infeasibility.
        out = self.told("place plan/signal.h5 -o placement.json --solver greedy", status=3)
        self.assertIn("A MIP solver may find one", out)
        self.assertEqual(self.json("placement.json")["status"], "stopped")
        self.told("plan store.json -o plan --samples 320 --solver greedy --overwrite", status=3)

    def test_zero_if_only_the_bound_is_open(self):
        """The first samples certify all labels, and nothing is left for the proof of the bound."""
        plan = "plan store.json -o plan --overwrite --samples 2000 --budget 1e-6"
        out = self.told(plan)
        placement = self.json("plan/placement.json")
        certificate, count = placement["certificate"], placement["count"]
        self.assertEqual(certificate["reached"], 17)
        self.assertIsNotNone(certificate["open"])
        bound = certificate["count_lower_bound"]
        self.assertLess(bound, count)
        certified = "All 17 labels are certified, so the plan can be mounted as it is; whether fewer transceivers are"
        sentence = f"{certified} enough is open: {bound} to {count}"
        hint = "may decide this (--budget).\n"
        self.assertIn(f"\n{sentence}", out)
        self.assertIn(f"A larger budget of the certificate {hint}", out)
        self.assertIn(sentence, self.text("plan/report.html"))

        # The control: a label for which all candidates together are just enough.
        place = "label_types/standard/threshold"
        self.write("store.json", store_with({place: 0.5}))
        self.told(plan, status=1)
        most = min(label["most"] for label in self.json("plan/placement.json")["unreachable"])
        self.write("store.json", store_with({place: min(0.5, most * (1 - 1e-6))}))
        out = self.told(plan, status=3)
        self.assertNotIn("are certified", out)
        self.assertIn(hint, out)

    def test_three_at_the_time_limit_of_a_placement(self):
        self.write("hard.csv", hard_matrix())
        place = "place hard.csv --threshold 6 -o placement.json --time-limit"
        known = re.search("; known: (.*);", self.run_here(f"{place} 1 --backend none").err)[1]
        for options in ("--reach 90%", *(f"--backend {backend}" for backend in known.split(", "))):
            self.says(f"{place} 0.001 {options}", "\n  stopped: ", status=3)
            placement = self.json("placement.json")
            self.assertEqual(placement["status"], "stopped", options)
            self.assertTrue(0 < placement["count_lower_bound"] < placement["count"], placement)
        out = self.told(f"{place} 1e-6 --solver greedy --curve", status=3)
        self.assertIn("the curve was stopped early", out)
        placement = self.json("placement.json")
        self.assertEqual((placement["status"], placement["curve_complete"]), ("stopped", False))

    def test_three_when_a_simulation_is_interrupted(self):
        simulate = "simulate store.json -o signal.h5 --estimator uniform --samples 320000 --threads 1 --json"
        process = self.start(f"{simulate} --checkpoint-interval 0")
        process.wait_for_changes(self.folder / "signal.h5.checkpoint", 4)
        end = self.interrupt(process)
        self.assertEqual(end.err, "")
        self.assertIs(json.loads(end.out)["complete"], False)
        self.assertEqual(contents(self.folder).keys(), {"signal.h5", "signal.h5.checkpoint", "store.json"})
        batches, samples = self.signals("signal.h5", "labels/batches", "labels/samples")
        self.assertTrue(2 <= min(batches) < 32 >= max(batches), batches)
        self.assertEqual(samples, [count * 10_000 for count in batches])
        self.told("place signal.h5 -o placement.json")
        self.assertEqual(self.json("placement.json")["status"], "optimal")

    def test_three_without_a_file_before_the_first_result(self):
        self.write("signal.h5", "old")
        before = contents(self.folder)
        for line, lock in (("simulate store.json -o signal.h5", "."), ("plan store.json -o plan", "plan/.")):
            # A batch of 2 billion samples per label never ends.
            process = self.start(f"{line} --samples 60000000000 --estimator uniform")
            process.wait_until((self.folder / f"{lock}signal.h5.shelfbeam-locked").exists)
            end = self.interrupt(process)
            self.assertEqual(end.out, "")
            self.assertRegex(end.err, r"\Astopped: ")
            self.assertEqual(contents(self.folder, "plan"), before, "nothing, or an empty folder")
            shutil.rmtree(self.folder / "plan", ignore_errors=True)

    def test_three_when_a_placement_is_interrupted(self):
        self.write("hard.csv", hard_matrix())
        place = "place hard.csv --threshold 6 -o placement.json --time-limit 7200"
        end = self.interrupted(place, "\n  stopped: value ")
        self.assertEqual(end.err, "")
        placement = self.json("placement.json")
        self.assertEqual(placement["status"], "stopped")
        self.assertGreater(placement["count"], 0)
