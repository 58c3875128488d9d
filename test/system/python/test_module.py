"""Tests of the Python package against the command line, and of what only the package promises."""

import filecmp
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import textwrap
import threading
import unittest
from pathlib import Path

import numpy as np
import shelfbeam as sb

PROGRAM = os.environ["SHELFBEAM"]
THESIS = Path(__file__).parents[3] / "examples" / "thesis" / "store.json"
ROOM = {
    "room": {"size": [5, 4, 3], "floor": "grey", "ceiling": "white", "walls": "white"},
    "materials": {"white": sb.material(0.8), "grey": sb.material(0.3)},
    "label_types": {"pd": {"threshold": 0.01}},
    "transceiver_types": {"led": {"emission": {"type": "lambertian", "flux": 1}}},
    "measuring_planes": [
        {"id": "P", "type": "pd", "origin": [0, 0, 1], "axes": [[1, 0, 0], [0, 1, 0]], "size": [5, 4], "spacing": 1}
    ],
    "transceivers": {"grids": [{"type": "led", "min": [1, 1], "max": [4, 3], "spacing": 1, "z": 2.9}]},
}
FEW = {"samples": 256}


def command(*words, codes=(0,)):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)
    if done.returncode not in codes:
        raise AssertionError(f"{words}: exit code {done.returncode}\n{done.stderr}")
    return done


def untimed(text):
    return re.sub(r"[0-9.]+ s, solver", "solver", text)


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)


class Stores(InFolder):
    def test_a_document_is_edited_and_resolved(self):
        store = sb.Store(ROOM)
        store.document["transceivers"]["grids"][0]["z"] = 2.5
        resolved = store.scene().resolved()
        self.assertEqual({unit["position"][2] for unit in resolved.document["transceivers"]["list"]}, {2.5})
        self.assertEqual(resolved.scene().hash, store.scene().hash)
        self.assertEqual(ROOM["transceivers"]["grids"][0]["z"], 2.9)

    def test_all_problems_are_listed(self):
        store = sb.Store(ROOM)
        store.document["room"]["floor"] = "gras"
        store.document["label_types"]["pd"]["threshold"] = -1
        paths = [problem.path for problem in store.problems()]
        self.assertEqual(len(paths), 2)
        self.assertIn("label_types.pd.threshold", paths)
        self.assertEqual(sb.Store(ROOM).problems(), [])

    def test_comments_and_lines_of_a_file(self):
        file = self.folder / "store.json"
        file.write_text('{ // a shop\n  "room": [1,]\n  "materials": {} }')
        with self.assertRaises(sb.InputError) as caught:
            sb.Store.read(file)
        self.assertIn("line 3", str(caught.exception))

    def test_saved_elsewhere_it_finds_its_files(self):
        store = sb.Store.read(THESIS.parents[1] / "chiller" / "store.json")
        file = self.folder / "deep" / "store.json"
        file.parent.mkdir()
        store.save(file)
        self.assertEqual(sb.Store.read(file, allow_outside=True).scene().hash, store.scene().hash)

    def test_tables_have_fields(self):
        scene = sb.Store(ROOM).scene()
        self.assertEqual(scene.labels.shape, (20,))
        self.assertEqual(scene.labels[0]["id"], "P-1-1")
        np.testing.assert_allclose(scene.labels["position"][0], [0.5, 0.5, 1])
        np.testing.assert_allclose(scene.units["axis"], np.tile([0, 0, -1], (12, 1)))
        self.assertEqual(scene.triangles.max(), len(scene.vertices) - 1)
        self.assertIn("<svg", scene._repr_html_())

    def test_states_are_those_of_the_command_line(self):
        store = sb.Store(ROOM).with_people(2)
        file = self.folder / "store.json"
        store.save(file)
        command("inspect", file, "--state", 3, "-o", self.folder / "state.json")
        states = list(sb.Store.read(file).scene().states(4))
        self.assertEqual(states[3].text(), (self.folder / "state.json").read_text())


class Signals(InFolder):
    def test_arrays_are_views(self):
        signals = sb.simulate(sb.Store(ROOM), **FEW)
        first, second = signals.mean, signals._core.mean
        self.assertEqual(first.ctypes.data, second.ctypes.data)
        self.assertFalse(first.flags.writeable)
        self.assertFalse(first.flags.owndata)
        copy = first.copy()
        del signals, second
        np.testing.assert_array_equal(first, copy)  # the array keeps its memory

    def test_bytes_are_those_of_the_command_line(self):
        file = self.folder / "store.json"
        sb.Store(ROOM).save(file)
        command("simulate", file, "-o", self.folder / "one.h5", "--samples", 256, "--seed", 3)
        for threads in (1, 2):
            sb.simulate(file, seed=3, threads=threads, **FEW).save(self.folder / "two.h5")
            self.assertTrue(filecmp.cmp(self.folder / "one.h5", self.folder / "two.h5", shallow=False))
        sb.simulate(file, output=self.folder / "three.h5", seed=3, **FEW)
        self.assertTrue(filecmp.cmp(self.folder / "one.h5", self.folder / "three.h5", shallow=False))
        self.assertEqual(sb.Signals.read(self.folder / "one.h5").seed, 3)

    def test_layers_add_up(self):
        signals = sb.simulate(sb.Store(ROOM), max_bounces=2, by_bounce=True, by_length=0.5, lengths=40, **FEW)
        for layers, count in ((signals.by_bounce, 3), (signals.by_length, 40)):
            self.assertEqual(len(layers), count)
            np.testing.assert_allclose(sum(mean for mean, _ in layers), signals.mean, rtol=1e-5)

    def test_impulse_response_of_direct_light_alone(self):
        black = sb.Store(ROOM)
        for name in ("white", "grey"):
            black.document["materials"][name] = sb.material(0)
        response = sb.impulse_response(black, ["P-1-1"], [0], step=0.05, max_bounces=1, samples=64)
        # Lambertian flux 1 at (1, 1, 2.9), label at (0.5, 0.5, 1): 1 / pi cos^2 / d^2 after d / c.
        d2 = 0.5**2 + 0.5**2 + 1.9**2
        np.testing.assert_allclose(response.signal, 1.9**2 / d2**2 / np.pi, rtol=1e-5)
        np.testing.assert_allclose(response.mean_delay_ns, np.sqrt(d2) / 0.299792458, atol=0.1)
        np.testing.assert_allclose(response.delay_spread_ns, 0, atol=1e-6)
        self.assertEqual(response.bandwidth_MHz[0, 0], np.inf)

    def test_bandwidth_of_two_equal_pulses(self):
        # |1 + e^(-i w T)|^2 = 2 (1 + cos w T) is half of 4 at w T = pi / 2: f = 1 / (4 T).
        step = 0.299792458  # 1 ns
        bins = np.zeros((1, 1, 64), np.float32)
        bins[0, 0, [3, 13]] = 1
        tables = sb.Store(ROOM).scene()
        response = sb.ImpulseResponse(tables.labels[:1], tables.units[:1], step, bins, bins)
        np.testing.assert_allclose(response.bandwidth_MHz, 25, rtol=0.001)
        np.testing.assert_allclose(response.delay_spread_ns, 5, rtol=1e-6)

    def test_states(self):
        signals = sb.simulate(sb.Store(ROOM).with_people(3), states=3, hard_labels=5, **FEW)
        self.assertEqual(signals.states.signal.shape, (3, 5, 12))
        self.assertEqual(signals.states.deviation.shape, (20, 12))
        self.assertFalse(signals.states.signal.flags.owndata)

    def test_other_libraries(self):
        signals = sb.simulate(sb.Store(ROOM), **FEW)
        try:
            import xarray  # noqa: F401, PLC0415
        except ImportError:
            self.assertFalse(os.environ.get("CI"), "python3-xarray is missing")
            return
        data = signals.to_xarray()
        entry = signals.mean[signals.label_numbers("P-2-3"), signals.unit_numbers("G1-3-2")][0]
        self.assertEqual(float(data["mean"].sel(label="P-2-3", unit="G1-3-2")), entry)
        self.assertEqual(signals.to_pandas().loc["P-2-3", "G1-3-2"], entry)

    def test_nothing_leaks(self):
        store = sb.Store(ROOM).scene()

        def memory():
            return int(re.search(r"VmRSS:\s+(\d+)", Path("/proc/self/status").read_text())[1])

        def growth(count, keep):
            begun = memory()
            for _ in range(count):
                keep(sb.simulate(store, samples=64, threads=1, estimator="uniform"))
            return memory() - begun

        growth(200, str)
        self.assertLess(growth(1000, str), 3000)  # kB
        kept = []
        self.assertGreater(growth(1000, kept.append), 6000)

    def test_two_threads_at_once(self):
        store = sb.Store(ROOM).scene()
        alone = [sb.simulate(store, seed=seed, **FEW).mean for seed in range(4)]
        found = {}
        threads = [
            threading.Thread(target=lambda seed=seed: found.update({seed: sb.simulate(store, seed=seed, **FEW).mean}))
            for seed in range(4)
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for seed in range(4):
            np.testing.assert_array_equal(found[seed], alone[seed])


class Answers(InFolder):
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
        for words, keywords in (
            ([], {}),
            (
                ["--model", "non-cooperative", "--objective", "links"],
                {"model": "non-cooperative", "objective": "links"},
            ),
            (["--at-most", "1"], {"at_most": 1}),
            (["--reach", "0.5", "--survive-failure"], {"reach": 0.5, "survive_failure": True}),
            (["--pin", "T3", "--curve"], {"pin": "T3", "curve": True}),
        ):
            with self.subTest(words):
                file = self.folder / "placement.json"
                done = command("place", self.folder / "matrix.npy", "--threshold", 1, "-o", file, *words, codes=(0, 1))
                best = sb.place(self.folder / "matrix.npy", threshold=1, **keywords)
                self.assertEqual(best.to_dict(), json.loads(file.read_text()))
                best.save(self.folder / "saved.json")
                self.assertEqual((self.folder / "saved.json").read_text(), file.read_text())
                self.assertEqual(untimed(best.text), untimed(done.stdout))
                self.assertEqual(best.code, done.returncode)

    def test_a_plan_is_that_of_the_command_line(self):
        store = sb.Store(ROOM)
        store.save(self.folder / "store.json")
        command("plan", self.folder / "store.json", "-o", self.folder / "one", "--samples", 500)
        plan = sb.plan(store, self.folder / "two", samples=500)
        names = {file.name for file in (self.folder / "one").iterdir()}
        self.assertEqual(names, {file.name for file in plan.folder.iterdir()})
        _, different, failed = filecmp.cmpfiles(self.folder / "one", plan.folder, names - {"run.json"}, shallow=False)
        self.assertEqual((different, failed), ([], []))
        self.assertEqual(sb.Plan.read(self.folder / "one").ids, plan.ids)
        self.assertIn("<svg", plan._repr_html_())
        self.assertEqual(sb.plan(store, signal=plan, certificate=False).ids, plan.ids)

    def test_a_temporary_plan_ends_with_its_last_reference(self):
        plan = sb.plan(sb.Store(ROOM), certificate=False, **FEW)
        folder = plan.folder
        self.assertTrue(plan.report.is_file())
        del plan
        self.assertFalse(folder.exists())

    def test_verify_what_if_and_preview(self):
        store = sb.Store(ROOM)
        found = sb.verify(store, ["G1-1-1", "G1-4-3"], budget=60)
        self.assertEqual(found.verdict.tolist(), ["reached"] * 20)
        self.assertEqual((found.code, found.units), (0, ["G1-1-1", "G1-4-3"]))
        states = sb.verify(store.with_people(3), [0, 11], states=20)
        self.assertEqual(states.to_dict()["states"]["examined"] if "states" in states.to_dict() else 20, 20)
        change = sb.what_if(store, add="2.5,2,2.9", coarse=True)
        self.assertIn("20 of 20 labels", change.answer)
        self.assertEqual(len(change.to_dict()["labels"]), 20)
        light = sb.LightOperator(store, coarse=True)
        column = light.column([2.5, 2, 2.9])
        exact = sb.simulate(store, samples=2000)
        preview = light.signals()
        self.assertEqual(preview.shape, exact.shape)
        self.assertEqual(column.signal.shape, (20,))
        np.testing.assert_allclose(preview.direct, exact.direct, rtol=0.05)

    def test_measurements_are_compared(self):
        signals = sb.simulate(sb.Store(ROOM), samples=1000)
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


class Conduct(InFolder):
    def test_errors_have_codes_and_sentences(self):
        file = self.folder / "store.json"
        document = json.loads(json.dumps(ROOM))
        document["label_types"]["pd"]["threshold"] = -1
        file.write_text(json.dumps(document))
        done = command("simulate", file, "-o", self.folder / "signal.h5", codes=(2,))
        with self.assertRaises(sb.InputError) as caught:
            sb.simulate(file)
        self.assertEqual(done.stderr.strip(), f"error: {caught.exception}")
        self.assertEqual(caught.exception.code, 2)
        self.assertIn("store.json", caught.exception.where)
        self.assertIsInstance(caught.exception, ValueError)

    def test_a_keyword_is_named_in_an_error(self):
        with self.assertRaises(sb.InputError) as caught:
            sb.simulate(sb.Store(ROOM), max_bounces=3, estimator="reuse")
        self.assertEqual(caught.exception.setting, "max_bounces")
        self.assertIn("(max_bounces)", str(caught.exception))

    def test_values_that_are_refused(self):
        for call in (
            lambda: sb.place([[1, float("nan")]], requirement=1),
            lambda: sb.place([[1, 2]], requirement=[1, 2]),
            lambda: sb.place([[1, 2]]),
            lambda: sb.place([1, 2], requirement=1),
            lambda: sb.place([[1, 2]], requirement=0),
            lambda: sb.place([[1, 2]], requirement=1, model="both"),
            lambda: sb.place([[1, 2]], requirement=1, weights=[1]),
            lambda: sb.place([[1, 2]], requirement=1, costs=[1, -1]),
            lambda: sb.evaluate([[1, 2]], ["T3"], requirement=1),
            lambda: sb.evaluate([[1, 2]], [2], requirement=1),
            lambda: sb.simulate(sb.Store(ROOM), samples=3),
            lambda: sb.simulate(sb.Store(ROOM), states=5),
            lambda: sb.simulate(self.folder / "none.json"),
            lambda: sb.Plan.read(self.folder),
        ):
            with self.assertRaises(sb.InputError):
                call()

    def test_progress_and_its_errors(self):
        seen = []
        sb.simulate(THESIS, samples=1000, progress=seen.append)
        self.assertIn("simulating", {state.task for state in seen})
        self.assertTrue(all(state.fraction is None or 0 <= state.fraction <= 1 for state in seen))

        def fail(state):
            raise RuntimeError(state.task)

        with self.assertRaises(RuntimeError):
            sb.simulate(THESIS, samples=10**7, progress=fail)

    def test_ctrl_c_ends_the_call(self):
        script = textwrap.dedent(f"""
            import sys, shelfbeam as sb
            def ready(state):
                print("ready", flush=True)
            try:
                sb.simulate({str(THESIS)!r}, samples=10**8, progress=ready)
            except KeyboardInterrupt:
                sys.exit(33)
        """)
        with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True) as process:
            process.stdout.readline()
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=60)
        self.assertEqual(process.returncode, 33)

    def test_keywords_are_the_flags_of_the_command_line(self):
        import inspect  # noqa: PLC0415

        names = {"progress", "output", "no_certificate"}
        only_there = {"help", "json", "quiet", "allow_outside", "version", "color", "part"}
        verbs = {"simulate": sb.simulate, "place": sb.place, "plan": sb.plan, "verify": sb.verify}
        only_here = {
            "simulate": {"labels", "units"},
            "place": {"requirement"},
            "plan": {"certificate"},
            "verify": {"selection"},
        }
        # Folders and files of `verify`; `--sampled` and others are named in the help of `simulate`.
        files_only = {
            "simulate": {"sampled"},
            "verify": {"signal", "overwrite", "resume", "checkpoint_interval", "output", "safe_csv"},
        }
        for verb, function in verbs.items():
            help_text = command(verb, "--help").stdout
            flags = {flag.replace("-", "_") for flag in re.findall(r"^\s+(?:-\w, ?)?--([a-z][a-z-]+)", help_text, re.M)}
            keywords = set(inspect.signature(function).parameters)
            missing = flags - keywords - only_there - names - files_only.get(verb, set())
            self.assertEqual(missing, set(), verb)
            unknown = keywords - flags - names - only_here[verb] - {"shop", "signals"}
            self.assertEqual(unknown - {"strict", "safe_csv"}, set(), verb)

    def test_an_import_needs_numpy_alone(self):
        script = "import sys, shelfbeam; print(sorted({'matplotlib', 'pandas', 'xarray', 'tqdm'} & set(sys.modules)))"
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.strip(), "[]")


if __name__ == "__main__":
    unittest.main()
