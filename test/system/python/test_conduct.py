"""Errors, warnings, progress and keywords of the Python package."""

import inspect
import json
import pickle
import re
import sys
import tempfile
from unittest import mock

import numpy as np
import shelfbeam as sb
from harness import output, run
from support import QUICK, ROOM, RoomTest


class Conduct(RoomTest):
    def test_errors_have_codes_and_sentences(self):
        self.write("store.json", {**ROOM, "label_types": {"pd": {"threshold": -1}}})
        with self.assertRaises(sb.InputError) as caught:
            sb.simulate(self.file)
        self.assertEqual(run("simulate", self.file, "-o", "signal.h5").err, f"error: {caught.exception}\n")
        self.assertEqual(caught.exception.code, 2)
        self.assertIn("store.json", caught.exception.where)
        self.assertIsInstance(caught.exception, ValueError)

    def test_a_keyword_is_named_in_an_error(self):
        with self.assertRaises(sb.InputError) as caught:
            sb.simulate(self.store, max_bounces=3, estimator="reuse")
        self.assertEqual(caught.exception.setting, "max_bounces")
        self.assertIn("(max_bounces)", str(caught.exception))

    def test_values_that_are_refused(self):
        store, file = self.store, self.file
        people, twice = store.with_people(2), sb.Store(ROOM)
        signals = sb.simulate(store, **QUICK)
        twice.document["transceivers"]["grids"] *= 2
        people.save(file)
        text = file.read_text()
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
            lambda: sb.evaluate([[1, 2]], [0, 0], requirement=1),
            lambda: sb.place([[1], [2, 3]], requirement=1),
            lambda: sb.place([[1, 2]], requirement=1, threshold=1),
            lambda: sb.place([[1, 2]], requirement=1, curve=True, at_most=1),
            lambda: sb.place([[1, 2]], requirement=1, time_limit=float("nan")),
            lambda: sb.verify(store, [3, 3]),
            lambda: sb.verify(store, []),
            lambda: sb.verify(twice, ["G1-1-1", "G2-1-1"]),
            lambda: sb.verify(people, [0], states=5, availability=95),
            lambda: sb.compare(signals, {"label": ["P-1-1"] * 3, "transceiver": ["G1-1-1"], "signal": [1] * 3}),
            lambda: sb.compare(signals, {"label": ["none"], "transceiver": ["G1-1-1"], "signal": [1]}),
            lambda: sb.compare(signals, {"label": ["P-1-1"], "signal": [1]}, confidence=95),
            lambda: signals.plot_coverage([0], unit="db"),
            lambda: sb.simulate(people, without="doors"),
            lambda: sb.simulate(people, states=3, relative_error=0.1),
            lambda: sb.simulate(people, states=2.5),
            lambda: sb.simulate(people, hard_labels=3),
            lambda: sb.simulate(store, by_length=-1, samples=256),
            lambda: sb.simulate(store, by_length=float("nan"), samples=256),
            lambda: sb.simulate(store, by_length=1, lengths=0, samples=256),
            lambda: sb.simulate(store, by_bounce=True, samples=256),
            lambda: sb.simulate(store, lengths=3, samples=256),
            lambda: sb.simulate(store, labels=[], samples=256),
            lambda: sb.simulate(store, units=np.zeros(12, bool), samples=256),
            lambda: sb.simulate(store, labels=[0, 0], samples=256),
            lambda: sb.simulate(people, hard_labels=0, states=2),
            lambda: sb.simulate(store, progress="yes", samples=256),
            lambda: sb.evaluate(signals, [1.9]),
            lambda: sb.evaluate(signals, [None]),
            lambda: sb.place(np.ma.masked_less([[0.4, 0.3]], 0.5), requirement=0.4),
            lambda: sb.place([[1, 2]], requirement=1, costs=5),
            lambda: sb.plan(store, costs=[1, 2]),
            lambda: sb.what_if(store, unit="1,1,2", refine=-1),
            lambda: sb.what_if(store, unit=[(1, 1, 2)]),
            lambda: sb.Store.parse("[1]"),
            lambda: sb.impulse_response(store, max_length=-1),
            lambda: people.add_receivers("other", plane=1, spacing=0, threshold=5),
            lambda: sb.simulate(store, resume=True, samples=256),
            lambda: sb.simulate(store, memory="much", samples=256),
            lambda: sb.simulate(store, threads=-1, samples=256),
            lambda: sb.simulate(file, output=file),
            lambda: sb.simulate(file, output=self.folder / "no" / "signal.h5"),
            lambda: sb.impulse_response(store, step=0.0001),
            lambda: sb.impulse_response(store, step=0),
            lambda: sb.plan(store, reflectance_error=0.1),
            lambda: sb.plan(store, resume=True),
            lambda: people.add_receivers("pd", plane=1, spacing=1, threshold=5),
            lambda: people.add_candidates(sb.Emitter.lambertian(2, name="led"), spacing=1, z=2),
            lambda: people.add_candidates(sb.Emitter.lambertian(2), spacing=1, z=2, below_ceiling=1),
            lambda: people.scene().state(-1),
            lambda: sb.LightOperator(people, threads=-1),
            lambda: sb.simulate(store, samples=3),
            lambda: sb.simulate(store, states=5),
            lambda: sb.simulate(self.folder / "none.json"),
            lambda: sb.Plan.read(self.folder),
        ):
            with self.assertRaises(sb.InputError) as caught:
                call()
            self.assertIn(caught.exception.code, (2, 3))
        self.assertEqual(file.read_text(), text)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["store.json"])

    def test_progress_and_its_errors(self):
        seen = []
        sb.simulate(self.store, samples=1000, progress=seen.append)
        self.assertTrue(seen)

        def show(state):
            seen.append(state)
            if state.task == "simulating":
                raise RuntimeError(state.task)

        with self.assertRaisesRegex(RuntimeError, "simulating"):
            sb.simulate(self.store, samples=10**9, progress=show)
        self.assertTrue(all(state.fraction is None or 0 <= state.fraction <= 1 for state in seen))

    def test_ctrl_c_ends_the_call(self):
        script = f"""
import sys, shelfbeam as sb
def ready(state):
    print("ready", flush=True)
try:
    sb.simulate({str(self.file)!r}, samples=10**9, progress=ready)
except KeyboardInterrupt:
    sys.exit(33)
"""
        process = self.start("-c", script, program=sys.executable)
        process.wait_until(lambda: "ready" in process.printed())
        self.assertEqual(process.end().status, 33)

    def test_keywords_are_the_flags_of_the_command_line(self):
        names = {"progress", "output", "no_certificate", "coarse", "refine"}
        only_there = {"help", "json", "quiet", "allow_outside", "version", "color", "part"}
        verbs = {"simulate": sb.simulate, "place": sb.place, "plan": sb.plan, "verify": sb.verify,
                 "preview": sb.what_if, "compare": sb.compare}  # fmt: skip
        only_here = {
            "simulate": {"labels", "units"},
            "place": {"requirement"},
            "plan": {"certificate"},
            "verify": {"selection"},
            "preview": {"plan"},
            "compare": {"measured"},
        }
        # Folders and files of `verify`; `--sampled` and others are named in the help of `simulate`.
        files_only = {
            "simulate": {"sampled"},
            "verify": {"signal", "overwrite", "resume", "checkpoint_interval", "output", "safe_csv"},
            "preview": {"from"},
            "compare": {"safe_csv", "threads", "seed"},
        }
        for verb, function in verbs.items():
            help_text = self.told(f"{verb} --help")
            flags = {flag.replace("-", "_") for flag in re.findall(r"^\s+(?:-\w, ?)?--([a-z][a-z-]+)", help_text, re.M)}
            keywords = set(inspect.signature(function).parameters)
            missing = flags - keywords - only_there - names - files_only.get(verb, set())
            self.assertEqual(missing, set(), verb)
            unknown = keywords - flags - names - only_here[verb] - {"shop", "signals"}
            self.assertEqual(unknown - {"strict", "safe_csv"}, set(), verb)

    def test_defaults_are_those_of_the_command_line(self):
        text = re.sub(r"\s+", " ", self.told("plan --help") + self.told("place --help"))
        for function in (sb.plan, sb.place, sb.verify):
            for name, parameter in inspect.signature(function).parameters.items():
                if isinstance(parameter.default, (int, float)) and not isinstance(parameter.default, bool):
                    found = re.search(rf"--{name.replace('_', '-')} [A-Z][^-]*?default ([0-9.]+[0-9])", text)
                    if found and name not in ("states", "seed", "threads"):
                        self.assertEqual(float(found[1]), parameter.default, name)

    def test_a_value_out_of_range_names_its_keyword(self):
        with self.assertRaises(sb.InputError) as caught:
            sb.simulate(self.store, samples=10)
        self.assertEqual(caught.exception.setting, "samples")
        self.assertTrue(str(caught.exception).startswith("samples: is 10"))

    def test_exceptions_of_other_libraries_stay(self):
        import contourpy  # noqa: PLC0415

        with self.assertRaises(ValueError) as caught:
            contourpy.contour_generator(z=np.zeros((3, 3))).filled(2, 1)
        self.assertNotIsInstance(caught.exception, sb.Error)

    def test_results_can_be_pickled(self):
        signals = sb.simulate(self.store, **QUICK)
        copy = pickle.loads(pickle.dumps(signals))
        np.testing.assert_array_equal(copy, signals.mean)
        self.assertEqual(copy.scene.hash, signals.scene.hash)
        self.assertEqual(copy.summary, signals.summary)

    def test_nothing_stays_after_an_error(self):
        with mock.patch.object(tempfile, "tempdir", str(self.folder)), self.assertRaises(sb.InputError):
            sb.plan(self.store, memory="much")
        self.assertEqual(list(self.folder.iterdir()), [self.file])

    def test_numpy_values_in_a_document(self):
        store = sb.Store.parse(json.dumps(ROOM))
        store.document["room"]["size"] = np.array([5.0, 4, 3])
        store.document["label_types"]["pd"]["threshold"] = np.float32(0.5)
        self.assertEqual(store.scene().labels["requirement"][0], 0.5)

    def test_results_are_dictionaries_and_html(self):
        signals = sb.simulate(self.store, **QUICK)
        best = sb.place(signals)
        results = [signals, best, sb.evaluate(signals, best), sb.verify(self.store, best)]
        for result in results:
            self.assertTrue(json.dumps(result.to_dict()))
            self.assertIn("<", result._repr_html_())
            self.assertTrue(repr(result).startswith("<"))

    def test_warnings_name_the_line_of_the_caller(self):
        self.store.document["materials"]["white"] = sb.material(0)
        with self.assertWarns(sb.ShelfbeamWarning) as caught:
            sb.simulate(self.store, **QUICK)
        self.assertEqual(caught.filename, __file__)

    def test_an_import_needs_numpy_alone(self):
        script = "import sys, shelfbeam; print(sorted({'matplotlib', 'pandas', 'xarray', 'tqdm'} & set(sys.modules)))"
        self.assertEqual(output("-c", script, program=sys.executable), "[]\n")
