"""Placements, plans, previews and comparisons of the Python package, against the command line."""

import filecmp

import numpy as np
import shelfbeam as sb
from harness import ROOT
from support import FEW, QUICK, ROOM, RoomTest, untimed


class Answers(RoomTest):
    ARRAY = np.array([[1.2, 0.3, 0.0], [0.6, 0.5, 0.0], [0.0, 1.1, 0.4], [0.3, 0.8, 0.9]])

    def test_any_array_is_placed(self):
        best = sb.place(self.ARRAY, requirement=1)
        self.assertEqual((best.count, best.bound, best.status), (2, 2, "optimal"))
        self.assertEqual(best.selected.tolist(), [0, 1])
        self.assertTrue(sb.evaluate(self.ARRAY, best, requirement=1).feasible)
        self.assertEqual(sb.evaluate(self.ARRAY, [2], requirement=1).missed.tolist(), [0, 1, 2, 3])
        self.assertEqual(sb.place(self.ARRAY, requirement=1, costs=[1, 5, 1]).value, 6)
        self.assertEqual(sb.place(self.ARRAY, requirement=1, at_most=1).reached, 1)
        self.assertEqual(sb.place(self.ARRAY, requirement=1, exclude="T1").status, "infeasible")

    def test_answers_are_those_of_the_command_line(self):
        np.save(self.folder / "matrix.npy", self.ARRAY)
        for options, keywords in (
            ("", {}),
            ("--model non-cooperative --objective links", {"model": "non-cooperative", "objective": "links"}),
            ("--at-most 1", {"at_most": 1}),
            ("--reach 0.5 --survive-failure", {"reach": 0.5, "survive_failure": True}),
            ("--pin T3 --curve", {"pin": "T3", "curve": True}),
        ):
            with self.subTest(options):
                best = sb.place(self.folder / "matrix.npy", threshold=1, **keywords)
                told = self.told(f"place matrix.npy --threshold 1 -o placement.json {options}", status=best.code)
                self.assertEqual(best.to_dict(), self.json("placement.json"))
                best.save(self.folder / "saved.json")
                self.assertEqual(self.text("saved.json"), self.text("placement.json"))
                self.assertEqual(untimed(best.text), untimed(told))

    def test_plans_one_after_another_are_those_of_the_command_line(self):
        dark = sb.Store({**ROOM, "materials": {**ROOM["materials"], "white": sb.material(0.1)}})
        for name, store in (("bright", sb.Store(ROOM)), ("dark", dark), ("again", sb.Store(ROOM))):
            store.save(self.folder / "store.json")
            one = self.folder / f"{name}-alone"
            self.told(f"plan store.json -o {one} --samples 500")
            plan = sb.plan(store, self.folder / name, samples=500)
            names = {file.name for file in one.iterdir()}
            self.assertEqual(names, {file.name for file in plan.folder.iterdir()})
            _, different, failed = filecmp.cmpfiles(one, plan.folder, names - {"run.json"}, shallow=False)
            self.assertEqual((different, failed), ([], []))
        self.assertEqual(sb.Plan.read(one).ids, plan.ids)
        self.assertIn("<svg", plan._repr_html_())
        self.assertEqual(sb.plan(store, signal=plan, certificate=False).ids, plan.ids)
        signals = [self.bytes(f"{name}/signal.h5") for name in ("bright", "dark")]
        self.assertNotEqual(*signals, "control")

    def test_a_temporary_plan_ends_with_its_last_reference(self):
        plan = sb.plan(self.store, certificate=False, **QUICK)
        folder = plan.folder
        self.assertTrue(plan.report.is_file())
        del plan
        self.assertFalse(folder.exists())

    def test_verify_what_if_and_preview(self):
        ids = ["G1-1-1", "G1-4-3"]
        found = sb.verify(self.store, ids, budget=60)
        self.assertEqual(found.verdict.tolist(), ["reached"] * 20)
        self.assertEqual((found.code, found.units), (0, ids))
        states = sb.verify(self.store.with_people(3), [0, 11], states=5)
        self.assertEqual(states.to_dict()["examined"][-1]["states"], 5)
        found.save(self.folder / "one.csv")
        signals = sb.simulate(self.store, **QUICK)
        excluded = [id for id in signals.units["id"].tolist() if id not in ids]
        sb.place(signals, threshold=1e-6, pin=ids, exclude=excluded).save(self.folder / "placement.json")
        self.told("verify store.json placement.json -o two.csv")
        self.assertEqual(self.bytes("one.csv"), self.bytes("two.csv"))
        change = sb.what_if(self.store, unit="2.5,2,2.9", coarse=True)
        self.assertEqual(change.to_dict(), self.answer("preview store.json --unit 2.5,2,2.9 --coarse"))
        light = sb.LightOperator(self.store, coarse=True)
        column = light.column([2.5, 2, 2.9])
        preview = light.signals()
        self.assertEqual(preview.shape, signals.shape)
        self.assertEqual(column.signal.shape, (20,))
        direct = sb.simulate(self.store, **QUICK, direct="exact").direct
        np.testing.assert_allclose(preview.direct, direct, rtol=0.05)

    def test_a_placement_keeps_its_question(self):
        signals = sb.simulate(self.store, **QUICK, direct="exact")
        best = sb.place(signals, threshold=0.04, model="non-cooperative", survive_failure=True, costs=[2] * 12)
        found, plain = sb.evaluate(signals, best), sb.evaluate(signals, best.ids, threshold=0.04)
        self.assertTrue(found.feasible)
        self.assertEqual(found.cost, 2 * best.count)
        self.assertEqual(found.requirement.tolist(), [0.04] * 20)
        self.assertGreater(plain.margin_db.min(), found.margin_db.min())
        strong = sb.place(signals, model="non-cooperative", survive_failure=True)
        for found in (sb.verify(self.store, strong), sb.verify(self.store, strong.ids, survive_failure=True)):
            self.assertIn("even if any one unit fails", found.answer)

    def test_other_means_keep_exclusions(self):
        self.store.document["transceivers"]["grids"] *= 2  # two options of each mounting point
        signals = sb.simulate(self.store, **QUICK)
        careful = signals.with_mean(np.maximum(signals.mean - 2 * signals.error, 0))
        need = 0.6 * signals.mean.sum(axis=1).min()
        best = sb.place(careful, threshold=need)
        points = [tuple(one) for one in careful.units["position"][best.selected]]
        self.assertEqual(len(set(points)), len(points))
        self.assertFalse(sb.evaluate(careful, [0, 12]).allowed)

    def test_choices_of_units(self):
        signals = sb.simulate(self.store, **QUICK)
        best = sb.place(signals, pin=[0], exclude=np.arange(12) > 9, forbid=[("G1-1-1", "G1-2-1")], costs=[2] * 12)
        self.assertIn("G1-1-1", best.ids)
        self.assertEqual(sb.evaluate(signals, best).cost, 2 * best.count)
        plan = sb.plan(self.store, survive_failure=True, certificate=False, **QUICK)
        self.assertEqual(
            sb.evaluate(signals, plan).margin_db.min(),
            sb.evaluate(signals, plan.folder / "placement.json", survive_failure=True).margin_db.min(),
        )

    def test_files_of_a_placement(self):
        files = [self.folder / "one.npy", self.folder / "two.npy"]
        np.save(files[0], self.ARRAY)
        np.save(files[1], self.ARRAY[:, ::-1])
        costs = self.write("costs.csv", "id,cost\nT1,1\nT2,5\nT3,1\n")
        weights = self.write("weights.csv", "id,weight\nL1,5\nL2,1\nL3,1\nL4,1\n")
        best = sb.place(self.ARRAY, requirement=1, costs=costs)
        self.assertEqual(best.value, 6)
        best.save(self.folder / "placement.json")
        self.assertEqual(sb.place(self.ARRAY, requirement=1, start=self.folder / "placement.json").ids, ["T1", "T2"])
        heavy = {"at_most": 1, "requirement": 1}
        self.assertEqual(sb.place(self.ARRAY, weights=weights, **heavy).ids, ["T1"])
        self.assertEqual(sb.place(self.ARRAY, weights=[5, 1, 1, 1], **heavy).value, 5)
        both = sb.place(files, threshold=1)
        self.told("place one.npy two.npy --threshold 1 -o both.json")
        self.assertEqual(both.to_dict(), self.json("both.json"))

    def test_measurements_are_compared(self):
        signals = sb.simulate(self.store, samples=1000, estimator="uniform")
        pairs = [(row, column) for row in range(20) for column in (0, 5)]
        measured = {
            "label": [signals.labels["id"][row] for row, _ in pairs],
            "transceiver": [signals.units["id"][column] for _, column in pairs],
            "signal": [2 * signals.mean[pair] for pair in pairs],
        }
        fit = sb.compare(signals, measured)
        self.assertAlmostEqual(fit.factor, 2, places=5)
        self.assertLessEqual(fit.interval[0], 2)
        measured["signal"][7] *= 30
        outliers = sb.compare(signals, measured).outliers
        self.assertEqual([one["label"] for one in outliers], [measured["label"][7]])


class WishList(RoomTest):
    """The lines that a researcher wished for, on a room from a mesh."""

    def test_it_runs(self):
        examples, lab = ROOT / "examples/chiller", ROOT / "docs/python/lab.glb"
        scene = sb.Store.from_mesh(lab, materials={"Wall*": 0.7, "Floor*": 0.3, "Window": sb.glass(1.5), "*": 0.5})
        led = sb.Emitter.from_ies(examples / "batwing.ies", flux=1.0)
        spot = sb.Emitter.from_ldt(examples / "narrow-aisle.ldt", flux=1.0)
        scene.add_receivers("pd", plane=0.85, spacing=1, responsivity=sb.cosine(cutoff_deg=60), threshold=0.02)
        scene.add_candidates([led, spot], area="room", spacing=2.0, below_ceiling=0.05)
        np.testing.assert_allclose(scene.scene().units["position"][:, 2], 2.95)
        signals = sb.simulate(scene, seed=7, **FEW)
        response = sb.impulse_response(scene, signals.labels[:8], signals.units[0], step=0.5, samples=64)
        self.assertEqual(response.delay_spread_ns.shape, (8, 1))
        best = sb.place(signals, survive_failure=True)
        self.assertEqual(best.lower_bound, best.count)
        mine = signals.mean.sum(axis=0).argsort()[-3:]
        self.assertEqual(sb.evaluate(signals, mine).margin_db.shape, signals.requirement.shape)
        self.assertEqual(len(sb.verify(scene, mine, confidence=0.99, budget=5).verdict), len(signals.labels))
        states = sb.simulate(scene.with_people(3), states=2, hard_labels=len(signals.labels)).states
        self.assertEqual(states.signal.shape, (2, *signals.shape))
        signals.to_dict()
        scene.save(self.folder / "store.json")
        self.assertEqual(sb.Store.read(self.folder / "store.json", allow_outside=True).scene().hash, scene.scene().hash)

    def test_a_room_whose_faces_look_outwards(self):
        corners = [(x, y, z) for x in (0, 4) for y in (0, 4) for z in (0, 3)]
        faces = [(0, 2, 6, 4), (1, 5, 7, 3), (0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6)]
        for turn in (1, -1):
            text = "".join(f"v {x} {y} {z}\n" for x, y, z in corners)
            text += "".join("f " + " ".join(str(k + 1) for k in face[::turn]) + "\n" for face in faces)
            store = sb.Store.from_mesh(self.write("room.obj", text), {"*": 0.5})
            store.add_candidates(sb.Emitter.lambertian(1), spacing=2, below_ceiling=0.5)
            self.assertEqual([unit["position"][2] for unit in store.document["transceivers"]["list"]], [2.5] * 4)
