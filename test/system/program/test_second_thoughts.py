"""Plans that reuse the signals of earlier ones."""

from compatibility import VERSIONS, old_plan
from harness import FEW, PreparedTest, store_with

PLAN = "plan store.json --samples 1000 --no-certificate"
QUICK = f"plan store.json {FEW} --no-certificate"
REUSE = "plan store.json --no-certificate --signal first"
CEILING = "transceiver_types/ceiling"


class SecondThoughts(PreparedTest):
    def prepare(self):
        self.told(f"{PLAN} -o first")

    def change(self, values):
        self.write("store.json", store_with(values))


class Reuse(SecondThoughts):
    def test_signals_are_reused_after_other_prices_and_requirements(self):
        self.change({f"{CEILING}/cost": 7, "label_types/standard/safety_factor": 1.1, "name": "another name"})
        self.says(f"{REUSE} --survive-failure --seed 2 -o second", "read from ")
        names = ("mean", "standard_error", "store_hash", "transceivers/cost")
        first, second = (self.signals(plan, *names) for plan in ("first", "second"))
        self.assertEqual(second[:2], first[:2])
        self.assertNotEqual(second[2], first[2])
        self.assertEqual(second[3][0], 7)
        self.check_values(self.json("second/run.json")["signals"], reused=True)
        # The same placement as from a file with these signals.
        self.told("place second/signal.h5 --survive-failure -o placed.json")
        self.check_values("placed.json", selected=self.json("second/placement.json")["selected"])

    def test_signals_are_not_reused_after_a_change_of_the_shop(self):
        moved = {"labels/0/id": "new", "labels/0/position": [0.1, 2, 1.5]}
        for values, misfit, reason in (
            (moved, "labels", "lacks the label 'new'"),
            ({"materials/m/reflectance": 0.123}, "light", "a material or the wavelength has changed"),
        ):
            self.change(values)
            self.says(f"{QUICK} --signal first --overwrite -o second", reason, "simulated again: ")
            self.check_values(self.json("second/run.json")["signals"], misfit=misfit)
            self.assertNotEqual(self.signals("second"), self.signals("first"))

    def test_signals_of_other_paths_are_not_reused(self):
        """Options of a simulation apply if the signals do not fit."""
        self.told(f"{QUICK} --max-bounces 2 -o two")
        self.says(f"{QUICK} --signal two --seed 2 --max-bounces 2 -o again", "read from ")
        self.assertEqual(self.bytes("again/signal.h5"), self.bytes("two/signal.h5"))
        self.told(f"{QUICK} -o simulated")
        self.says(f"{QUICK} --signal two -o all", "another number of bounces")
        self.check_values(self.json("all/run.json")["signals"], misfit="paths")
        self.assertEqual(self.bytes("all/signal.h5"), self.bytes("simulated/signal.h5"))

    def test_signals_of_an_interrupted_simulation_are_not_reused(self):
        """Both runs are stopped after some checkpoints."""
        for line, folder in (("plan store.json -o plan", "plan"), ("simulate store.json -o signal.h5", ".")):
            process = self.start(f"{line} --samples 400000000 --threads 1 --checkpoint-interval 0")
            process.wait_for_changes(self.folder / folder / "signal.h5.checkpoint", 3)
            self.interrupt(process)
        for signals in ("plan", "plan/signal.h5", "signal.h5"):
            self.says(f"{QUICK} --overwrite -o again --signal {signals}", "its simulation was interrupted")
            self.check_values(self.json("again/run.json")["signals"], misfit="incomplete")

    def test_a_refusal_offers_the_signals_of_the_finished_plan(self):
        same = f"{PLAN} --seed 2 -o first"
        self.refused(same, "finished plan", "its signals fit this store", "(--overwrite, --signal)")
        self.change({"materials/m/reflectance": 0.25})
        other = self.run_here(same)
        self.assertEqual(other.status, 2)
        self.assertNotIn("its signals fit", other.err)

    def test_signals_of_the_overwritten_plan_are_reused(self):
        mean = self.signals("first")
        self.change({f"{CEILING}/cost": 7})
        self.refused("plan store.json -o first --signal first", "contains a finished plan")
        self.says(f"{REUSE} -o first --overwrite", "read from ")
        new_mean, costs = self.signals("first", "mean", "transceivers/cost")
        self.assertEqual((new_mean, costs[0]), (mean, 7))

    def test_signals_of_a_part_of_the_labels_are_reused(self):
        self.change({"labels": []})
        self.says(f"{REUSE} -o second", "16 labels x 12 candidates, read from the 17 x 12 of ")

    def test_signals_of_earlier_versions_are_reused(self):
        for version in VERSIONS:
            store = self.json(old_plan(version, self.folder / version) / "store.json")
            next(iter(store["transceiver_types"].values()))["cost"] = 3
            self.write("store.json", store)
            self.says(f"plan store.json --no-certificate --signal {version} -o new-{version}", "read from ")
            self.assertEqual(self.signals(f"new-{version}"), self.signals(version), version)

    def test_an_interrupted_certificate_is_resumed(self):
        line = "plan store.json --signal first"
        self.told(f"{line} -o whole")
        self.interrupted(f"{line} --threads 1 -o plan", "Verification ended because it was interrupted.")
        self.says(f"{line} -o plan --resume", "read from ")
        for name in ("signal.h5", "placement.json", "labels.csv", "verification.csv"):
            self.assertEqual(self.bytes(f"plan/{name}"), self.bytes(f"whole/{name}"), name)


class Choices(SecondThoughts):
    def test_units_are_pinned_and_excluded(self):
        prices = {"currency": "EUR", f"{CEILING}/cost": 100}
        self.change(prices)
        self.told(f"{REUSE} -o priced")
        gone = self.json("priced/placement.json")["selected"][0]
        chosen = f"--pin G1-1-1 --exclude {gone}"
        self.told(f"{REUSE} {chosen} -o second")
        second = self.json("second/placement.json")
        selected, price = second["selected"], second["price"]
        self.assertEqual(price["new"], 100 * second["count"], "a pinned unit is bought")
        self.assertEqual(("G1-1-1" in selected, gone in selected), (True, False))
        self.assertRegex(self.text("second/mounting.csv"), r",G1-1-1,ceiling,0,.*,1,[^,]*,[^,]*,\n")
        self.assertRegex(self.text("second/placement.csv"), r"\nG1-1-1,.*,1,[^,]*,\n")
        self.holds("second/report.html", "(1 chosen by you)", "G1-1-1<br><small>(chosen by you)</small>")
        self.assertNotIn("chosen by you", self.text("priced/report.html"))
        self.assertEqual([len(self.signals(plan)[0]) for plan in ("second", "priced")], [11, 12])

        # The same as options of `place`, as keys of the store, and from the resolved store.
        self.told(f"place priced/signal.h5 {chosen} -o placed.json")
        self.check_values("placed.json", selected=selected)
        self.told(f"place second/signal.h5 --exclude {gone} -o placed.json")
        self.check_values("placed.json", selected=selected, price=price)
        self.change({**prices, "transceivers/pinned": ["G1-1-1"], "transceivers/excluded": [gone]})
        self.told(f"{REUSE} -o third")
        self.assertEqual(self.bytes("third/placement.json"), self.bytes("second/placement.json"))
        self.told("plan second/store.json --samples 1000 --no-certificate -o fourth")
        self.check_values("fourth/placement.json", selected=selected)

        # A price list names all candidates.
        self.write("costs.csv", f"id,cost\nG1-1-1,70\n{gone},5\n")
        self.told(f"{REUSE} --costs costs.csv -o fifth")
        self.assertEqual(self.json("fifth/placement.json")["price"]["new"], price["new"] - 30)

    def test_unknown_units_are_refused(self):
        hint = "did you mean 'G1-1-1'?"
        for flag in ("--pin", "--exclude"):
            self.refused(f"{PLAN} {flag} G1-11 -o second", "'G1-11'", hint)
            self.refused(f"place first/signal.h5 {flag} G1-11", "signal.h5: has no transceiver 'G1-11'", hint, flag)
        self.refused(f"{PLAN} --pin G1-1-* --exclude G1-*-1 -o second", "pinned unit 'G1-1-1'")

    def test_a_part_of_the_labels_is_enough(self):
        most = self.json("first/placement.json")["count"] - 1
        self.assertGreater(most, 0)
        certified = "plan store.json --signal first --estimator uniform"
        self.says(f"{certified} --at-most {most} -o fewer", "with 99 % confidence")
        self.told(f"place first/signal.h5 --at-most {most} -o placed.json")
        placed, alone = self.json("fewer/placement.json"), self.json("placed.json")
        bounds = {key: alone[key] for key in ("reached", "reached_upper_bound")}
        self.check_values(placed["partial"], goal="at_most", value=most, **bounds)
        self.assertEqual(placed["selected"], alone["selected"])
        self.assertLess(placed["certificate"]["reached"], 17)
        self.assertTrue(placed["certificate"]["missed"])
        self.assertIn("asked for", self.check_report("fewer"))

        self.told(f"{certified} --reach 50% -o half")
        half = self.json("half/placement.json")
        self.check_values(half["partial"], goal="share")
        self.assertLessEqual(half["count"], placed["count"])
        self.assertGreaterEqual(half["certificate"]["reached"], 9)
        self.refused_each(
            ("--at-most 2 --objective links", "--at-most"),
            ("--reach 0.5 --weighted", "--reach"),
            ("--at-most 2 --curve", "--curve"),
            command="plan store.json -o bad",
        )
