"""Examples of `new`, and the files and texts of `plan`."""

import json

from harness import FEW, PLAN_FILES, ROOT, ProgramTest, ShopTest, contents, small_store, store_with


class New(ProgramTest):
    def test_examples_are_written_and_inspected(self):
        for example in sorted((ROOT / "examples").iterdir()):
            name = example.name
            self.says(f"new {name} {name}", f"shelfbeam plan {name}/store.json -o {name}/plan")
            self.assertEqual(contents(self.folder / name), contents(example))
            self.says(f"inspect {name}/store.json -o plan.svg", "reflectance")
            self.assertTrue(self.text("plan.svg").startswith("<?xml"))
        chiller = self.answer("inspect chiller/store.json")
        self.assertEqual(chiller["transceiver_types"]["ring"]["file"], "batwing.ies")
        self.assertTrue(chiller["not_simulated"])
        self.assertEqual(chiller["warnings"], [])
        thesis = self.answer("inspect thesis/store.json")
        self.check_values(thesis, labels=390, transceivers=320, upper=[20, 16, 4])


class Plan(ShopTest):
    def test_offers_several_tilts_at_a_mounting_point(self):
        """Three grids of one extent with different axes are options of the same 12 mounting points."""
        grid = small_store()["transceivers"]["grids"][0]
        tilted = [{**grid, "axis": [0, lean, -1]} for lean in (0.4, -0.4)]
        self.write("store.json", store_with({"transceivers/grids": [grid, *tilted]}))
        self.check_values(self.answer("inspect store.json"), mounting_points=12)
        plan = "plan store.json -o plan --samples 640 --estimator uniform"
        self.says(plan, "from 36 candidates at 12 mounting points", "with 99 % confidence")
        self.assertIn("<dt>Mounting points</dt><dd>12</dd>", self.check_report())
        # In every grid, ix and iy of a unit name its mounting point.
        selected = self.json("plan/placement.json")["selected"]
        self.assertEqual(len({unit[2:] for unit in selected}), len(selected))
        self.holds("plan/placement.csv", *(f"{unit}," for unit in selected))
        self.told("export plan/signal.h5 -o model.lp")
        self.assertEqual(self.text("model.lp").count(" mount_"), 12)

    def test_leaves_every_file_of_the_contract(self):
        self.assertRegex(
            self.told("plan store.json -o plan --samples 640"),
            r"\A\d+ transceivers reach all 17 labels, .* with 99 % confidence\. This [^\n]*\n"
            r"Verified for assumed values\. [^\n]*\nreport: plan/report\.html\n"
            r"on the simulated signals: (.*\n)+simulation: 17 labels x",
        )
        plan = contents(self.folder / "plan")
        self.assertEqual(plan.keys(), PLAN_FILES)
        for name, begin in (
            ("report.html", b"<!DOCTYPE html>"),
            ("labels.csv", b"id,x,y,z,nx,ny,nz,type,"),
            ("placement.csv", b"id,x,y,z,ax,ay,az,roll_deg,type,"),
        ):
            self.assertTrue(plan[name].startswith(begin), name)
            (self.folder / "plan" / name).unlink()
        # `report` makes these three again from the other files.
        self.assertEqual(self.told("report plan"), "plan/report.html\n")
        self.assertEqual(contents(self.folder / "plan"), plan)
        # The plan is equal to the results of simulate and place with the same seed.
        self.told("simulate store.json -o signal.h5 --samples 640")
        self.assertEqual(self.bytes("signal.h5"), plan["signal.h5"])
        self.told("place signal.h5 -o placement.json")
        self.check_values("placement.json", selected=self.json("plan/placement.json")["selected"])
        # A plan of the plan's own store is the same plan.
        for other in ("again", "plan"):
            self.told(f"plan plan/store.json -o {other} --samples 640 --overwrite")
            for name in ("signal.h5", "store.json", "labels.csv", "placement.csv"):
                self.assertEqual(self.bytes(f"{other}/{name}"), plan[name], f"{other}/{name}")

    def test_file_names_may_have_blanks_and_other_letters(self):
        odd = 'Müller & Söhne \'Größe "7" 名前'
        store, plan, signals, table = (f"{odd}/{name}" for name in ("store of.json", "der Plan", "s.h5", "s.csv"))
        self.write(store, store_with({"name": odd, "fixtures/0/id": odd, "labels/0/id": "<b>, \"door\"; 'x'"}))
        self.told("plan", store, "-o", plan, "--estimator", "uniform")
        self.assertEqual(contents(self.folder / plan).keys(), PLAN_FILES)
        self.told("report", plan)
        simulated = self.told("simulate", store, "-o", signals, "--samples", 64, "--json")
        self.check_values(json.loads(simulated), signal=signals)
        self.told("export", signals, "-o", table)
        self.told("place", table, "--threshold", "1e-6")

    def test_prints_curve_and_sensitivity(self):
        plan = f"plan store.json -o plan {FEW} --no-certificate"
        parts = ("  units   labels reached: at least   at most\n", "\nsensitivity: ")
        self.says(f"{plan} --curve --sensitivity --reflectance-error 0.25", *parts)
        placement = self.json("plan/placement.json")
        self.assertEqual((len(placement["curve"]), placement["curve_complete"]), (placement["count"], True))
        sensitivity = placement["sensitivity"]
        self.assertEqual(sensitivity["assumed_error"], 0.25)
        for material in sensitivity["materials"]:
            self.assertAlmostEqual(material["range"][0], 0.75 * material["reflectance"], places=12)
        self.assertLess(sensitivity["low"]["smallest_margin"], sensitivity["high"]["smallest_margin"])
        page, curve = self.check_report(), '<section id="curve">'
        self.assertIn('<section id="sensitivity">', page)
        self.assertIn(curve, page)
        self.told(f"{plan} --overwrite")
        self.assertFalse({"sensitivity", "curve"} & self.json("plan/placement.json").keys())
        self.assertNotIn(curve, self.text("plan/report.html"))
