"""Stores and signals of the Python package, against the command line."""

import ctypes
import gc
import os
import sys
import threading

import numpy as np
import shelfbeam as sb
from support import FEW, QUICK, ROOM, THESIS, RoomTest


class Memory(ctypes.Structure):
    """struct mallinfo2"""

    _fields_ = [(name, ctypes.c_size_t) for name in "arena o s h mapped u f in_use free top".split()]


mallinfo = ctypes.CDLL(None).mallinfo2
mallinfo.restype = Memory


def memory():
    """The bytes that malloc has given out, and the number of blocks that Python holds."""
    gc.collect()
    found = mallinfo()
    return np.array([found.in_use + found.mapped, sys.getallocatedblocks()])


class Stores(RoomTest):
    def test_a_document_is_edited_and_resolved(self):
        self.store.document["transceivers"]["grids"][0]["z"] = 2.5
        resolved = self.store.scene().resolved()
        self.assertEqual({unit["position"][2] for unit in resolved.document["transceivers"]["list"]}, {2.5})
        self.assertEqual(resolved.scene().hash, self.store.scene().hash)
        self.assertEqual(ROOM["transceivers"]["grids"][0]["z"], 2.9)

    def test_all_problems_are_listed(self):
        self.store.document["room"]["floor"] = "gras"
        self.store.document["label_types"]["pd"]["threshold"] = -1
        paths = [problem.path for problem in self.store.problems()]
        self.assertEqual(len(paths), 2)
        self.assertIn("label_types.pd.threshold", paths)
        self.assertEqual(sb.Store(ROOM).problems(), [])

    def test_comments_and_lines_of_a_file(self):
        self.write("store.json", '{ // a shop\n  "room": [1,]\n  "materials": {} }')
        with self.assertRaises(sb.InputError) as caught:
            sb.Store.read(self.file)
        self.assertIn("line 3", str(caught.exception))

    def test_saved_elsewhere_it_finds_its_files(self):
        store = sb.Store.read(THESIS.parents[1] / "chiller" / "store.json")
        file = self.folder / "deep" / "store.json"
        file.parent.mkdir()
        store.save(file)
        self.assertEqual(sb.Store.read(file, allow_outside=True).scene().hash, store.scene().hash)

    def test_tables_have_fields(self):
        scene = self.store.scene()
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
        self.store.with_people(2).save(self.file)
        self.told("inspect store.json --state 3 -o state.json")
        states = list(sb.Store.read(self.file).scene().states(4))
        self.assertEqual(states[3].resolved().text(), self.text("state.json"))


class Signals(RoomTest):
    def test_arrays_are_views(self):
        signals = sb.simulate(self.store, **QUICK)
        first, second = signals.mean, signals._core.mean
        self.assertEqual(first.ctypes.data, second.ctypes.data)
        self.assertFalse(first.flags.writeable)
        self.assertFalse(first.flags.owndata)
        copy = first.copy()
        del signals, second
        np.testing.assert_array_equal(first, copy)  # the array keeps its memory

    def test_bytes_are_those_of_the_command_line(self):
        self.told("simulate store.json -o one.h5 --samples 256 --seed 3")
        one = self.bytes("one.h5")
        for threads in (1, 2):
            sb.simulate(self.file, seed=3, threads=threads, **FEW).save(self.folder / "two.h5")
            self.assertEqual(self.bytes("two.h5"), one)
        sb.simulate(self.file, output=self.folder / "three.h5", seed=3, **FEW)
        self.assertEqual(self.bytes("three.h5"), one)
        self.assertEqual(sb.Signals.read(self.folder / "one.h5").seed, 3)

    def test_layers_add_up(self):
        signals = sb.simulate(self.store, max_bounces=2, by_bounce=True, by_length=0.5, lengths=40, **FEW)
        for layers, count in ((signals.by_bounce, 3), (signals.by_length, 40)):
            self.assertEqual(len(layers), count)
            np.testing.assert_allclose(sum(mean for mean, _ in layers), signals.mean, rtol=1e-5)

    def test_impulse_response_of_direct_light_alone(self):
        for name in ("white", "grey"):
            self.store.document["materials"][name] = sb.material(0)
        response = sb.impulse_response(self.store, ["P-1-1"], [0], step=0.05, max_bounces=1, samples=64)
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
        tables = self.store.scene()
        response = sb.ImpulseResponse(tables.labels[:1], tables.units[:1], step, bins, bins)
        np.testing.assert_allclose(response.bandwidth_MHz, 25, rtol=0.001)
        np.testing.assert_allclose(response.delay_spread_ns, 5, rtol=1e-6)

    def test_states(self):
        signals = sb.simulate(self.store.with_people(3), states=3, hard_labels=5, **FEW)
        self.assertEqual(signals.states.signal.shape, (3, 5, 12))
        self.assertEqual(signals.states.deviation.shape, (20, 12))
        self.assertFalse(signals.states.signal.flags.owndata)

    def test_other_libraries(self):
        signals = sb.simulate(self.store, **QUICK)
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
        scene = self.store.scene()

        def growth(count, keep):
            """The smallest growth per call of five rounds: caches fill in some rounds, a leak shows in each."""
            rounds = []
            for _ in range(5):
                begun = memory()
                for _ in range(count):
                    keep(sb.simulate(scene, samples=64, threads=1, estimator="uniform"))
                rounds.append((memory() - begun) / count)
            return np.min(rounds, axis=0)

        np.testing.assert_array_less(growth(50, str), [1000, 2])
        kept = []
        np.testing.assert_array_less([10_000, 4], growth(20, kept.append), "the control")

    def test_the_lock_is_released(self):
        ended, counted = threading.Event(), []

        def count():
            while not ended.is_set():
                counted.append(0)
                ended.wait(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        begun = len(counted)
        sb.simulate(self.store, samples=15000, threads=1, estimator="uniform")
        passed = len(counted) - begun
        ended.set()
        thread.join()
        self.assertGreater(passed, 50)

    def test_two_threads_at_once(self):
        scene, seeds = self.store.scene(), (1, 2)
        alone = [sb.simulate(scene, seed=seed, **FEW).mean for seed in seeds]
        found = {}

        def simulate(seed):
            found[seed] = sb.simulate(scene, seed=seed, **FEW).mean

        threads = [threading.Thread(target=simulate, args=[seed]) for seed in seeds]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for seed, mean in zip(seeds, alone):
            np.testing.assert_array_equal(found[seed], mean)
