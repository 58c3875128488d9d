"""Stores and signals of the Python package, against the command line."""

import filecmp
import os
import re
import threading
import unittest
from pathlib import Path

import numpy as np
import shelfbeam as sb
from support import FEW, ROOM, THESIS, InFolder, command


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

    def test_receivers_in_rooms_of_any_shape(self):
        outline = [[100, 0], [110, 0], [110, 5], [105, 5], [105, 10], [100, 10]]
        room = {"outline": outline, "height": 3, "floor": "grey", "ceiling": "white", "walls": "white"}
        store = sb.Store({**ROOM, "room": room, "measuring_planes": [], "transceivers": {}})
        store.add_receivers("q", plane=1, spacing=1, threshold=0.01)
        store.add_candidates(sb.Emitter.lambertian(1), spacing=2, below_ceiling=0.1)
        self.assertEqual(len(store.scene().labels), 75)
        self.assertEqual(store.bounds().tolist(), [[100, 0, 0], [110, 10, 3]])

    def test_states_are_those_of_the_command_line(self):
        store = sb.Store(ROOM).with_people(2)
        file = self.folder / "store.json"
        store.save(file)
        command("inspect", file, "--state", 3, "-o", self.folder / "state.json")
        states = list(sb.Store.read(file).scene().states(4))
        self.assertEqual(states[3].resolved().text(), (self.folder / "state.json").read_text())


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

        growth(100, str)
        self.assertLess(growth(1000, str), 3000)  # kB
        kept = []
        self.assertGreater(growth(500, kept.append), 3000)

    def test_the_lock_is_released(self):
        ended, counted = threading.Event(), []

        def count():
            while not ended.is_set():
                counted.append(0)
                ended.wait(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        begun = len(counted)
        sb.simulate(THESIS, samples=1000)
        passed = len(counted) - begun
        ended.set()
        thread.join()
        self.assertGreater(passed, 50)

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


if __name__ == "__main__":
    unittest.main()
