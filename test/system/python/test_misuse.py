"""Misuse of the Python package: it is refused, and never ends or damages the process."""

import decimal
import json
import os
import random
import sys
import threading
import warnings
from pathlib import Path

import numpy as np
import shelfbeam as sb
from shelfbeam import _core
from harness import ProgramTest, run
from support import QUICK, ROOM

MATRIX = np.array([[1.2, 0.3, 0.0], [0.6, 0.5, 0.0], [0.0, 1.1, 0.4]])


class OwnError(Exception):
    pass


class Raises:
    """A value all of whose conversions raise."""

    def __index__(self):
        raise OwnError

    def __float__(self):
        raise OwnError

    def __getitem__(self, key):
        raise OwnError

    def __len__(self):
        raise OwnError

    def __fspath__(self):
        raise OwnError


class CallsBack:
    """A value whose conversions call the package."""

    def __index__(self):
        return len(sb.place(MATRIX, requirement=1))

    def __float__(self):
        return float(sb.place(MATRIX, requirement=1).value)


class Array(np.ndarray):
    pass


def nested(levels=3):
    """A progress function that simulates with progress."""

    def show(state):
        if levels:
            sb.simulate(ROOM_STORE, progress=nested(levels - 1), **QUICK)
        raise OwnError

    return show


ROOM_STORE = sb.Store(ROOM)

# No value names a file outside the working directory, or asks for long work.
NUMBERS = [None, True, False, 0, 1, -1, 2, 2**31, 2**32, 2**63, 2**64, 10**30, -(2**63), 0.0, -0.0, 1.5, 1e-320, 1e18,
           1.1e18, 1e39, 1e300, -1e300, float("nan"), float("inf"), -float("inf"), 1j, np.float32(1), np.int8(-1),
           np.datetime64("2020"), decimal.Decimal(1)]  # fmt: skip
TEXTS = ["", "T1", "L1", "G1-1-1", "P-1-1", "*", "a\0b", "\ud800", "x" * 10000, b"bytes", b"\xff", Path("none")]
LISTS = [[], [[]], (), {}, {"a": 1}, [0], [0, 0], [0, 1], ["T1", "T1"], [None], [float("nan")], [1e300], [-1], [2**40],
         ["\ud800"], [1, 2, 3], [0, 0, -1], [0, 0, 0], (1e200, 0, 0), ["a", "b", "c"], range(3), {0, 1}, bytearray(8),
         memoryview(b"12345678"), slice(0, 1)]  # fmt: skip
ARRAYS = [MATRIX, MATRIX[::-1], MATRIX[:, ::2], np.asfortranarray(MATRIX), MATRIX.astype("f4"), MATRIX.astype(">f8"),
          MATRIX.astype(int), MATRIX.astype(complex), MATRIX.astype(object), MATRIX.astype(str), -MATRIX,
          MATRIX * np.nan, MATRIX * 1e300, np.zeros((0, 0)), np.zeros((0, 3)), np.zeros((3, 0)), np.zeros(0),
          np.zeros((3, 3, 3)), np.array(1.0), np.array(None), np.array(["T1"]), np.array([True, False, True]),
          np.array([2**63], dtype="u8"), np.void(b"abc"), np.ma.masked_array(MATRIX), MATRIX.view(Array),
          np.broadcast_to(1.0, (100, 100)), np.frombuffer(bytes(72)).reshape(3, 3),
          np.lib.stride_tricks.as_strided(MATRIX, (2, 2), (0, 0))]  # fmt: skip
ODD = [Raises(), [Raises()], CallsBack(), [CallsBack()], object(), int, print, lambda *_: None, nested(), Ellipsis,
       NotImplemented, OwnError()]  # fmt: skip


class Fuzz:
    """Calls with random values, the same for each seed."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.scene = ROOM_STORE.scene()
        self.signals = sb.simulate(self.scene, **QUICK)
        self.light = sb.LightOperator(self.scene, coarse=True)
        self.best = sb.place(MATRIX, requirement=1)
        self.values = [NUMBERS, TEXTS, LISTS, ARRAYS, ODD, [self.scene, self.signals, self.light, self.best, ROOM_STORE,
                       self.signals.labels, self.signals.units, self.signals.units[0]]]  # fmt: skip

    def any(self):
        return self.random.choice(self.random.choice(self.values))

    def mostly(self, usual):
        return usual if self.random.random() < 0.6 else self.any()  # noqa: PLR2004

    def some(self, names, most=2):
        names = names.split()
        return {name: self.any() for name in self.random.sample(names, self.random.randint(0, most))}

    def of_package(self):
        mostly, some = self.mostly, self.some
        store = mostly(ROOM_STORE)
        unit, ten = {"time_limit": 1, "requirement": mostly(1.0)}, {"samples": 256}
        calls = [
            lambda: sb.place(mostly(MATRIX), **unit | some(
                "requirement threshold model survive_failure objective weighted share at_most reach curve weights "
                "start costs min_spacing forbid pin exclude solver seed threads progress")),
            lambda: sb.evaluate(mostly(MATRIX), mostly([0, 1]), requirement=mostly(1.0),
                                **some("threshold model survive_failure costs")),
            lambda: sb.simulate(store, **ten | some(
                "estimator direct strategy by_bounce by_length lengths labels units hard_labels for_plan state without "
                "seed threads memory resume checkpoint_interval progress")),
            lambda: sb.verify(store, mostly([0]), budget=0.1, **ten | some(
                "confidence model survive_failure availability all_at_once without seed threads memory progress")),
            lambda: self.light.column(mostly([2, 2, 2]), mostly([0, 0, -1]), mostly("")),
            lambda: self.light.signals(self.any()),
            lambda: sb.what_if(store, coarse=True, **{"unit": mostly("2,2,2")} | some("plan move remove seed threads")),
            lambda: sb.compare(self.signals, {"label": mostly(["P-1-1"]), "transceiver": mostly(["G1-1-1"]),
                                              "signal": mostly([1.0])}, mostly(None), confidence=mostly(0.9)),
            lambda: self.signals.with_mean(self.any()),
            lambda: (self.signals.label_numbers(self.any()), self.signals.unit_numbers(self.any())),
            lambda: sb.impulse_response(store, **ten | {"max_bounces": 1} | some("step max_length labels units")),
            lambda: self.scene.state(self.any(), mostly(1), mostly(())),
            lambda: sb.Store(self.any(), mostly("."), mostly("store")).problems(),
            lambda: sb.Store.parse(self.any(), mostly("."), mostly("store")).problems(),
            lambda: ROOM_STORE.with_people(mostly(2), mostly([0.5, 0.3, 1.7]), mostly(0.5)).problems(),
            lambda: sb.Signals.read(self.any()),
            lambda: sb.Plan.read(self.any()),
            self.changed_document,
        ]  # fmt: skip
        self.random.choice(calls)()

    def changed_document(self):
        store = ROOM_STORE.copy()
        store.document[self.random.choice(list(store.document))] = self.any()
        store.problems()
        store.scene()

    def of_compiled_part(self):
        """The functions behind the package, which have checks of their own against crashes."""
        table = _core.Table.of_array(MATRIX, ["a", "b", "c"], ["x", "y", "z"])
        job = json.dumps({"store": "store", "folder": ".", "plan": {"simulation": {"samples": 256}, "budget": 0.1}})
        parts = [table, self.signals._core, self.scene._core, self.light._core]
        lists = [[0], [0, 5], [2**31], {"labels": [0, 99]}, {"units": [99]}, {}]
        usual = [*parts, job, job, *lists, None, True, 0, 0.9, ""]
        functions = [_core.simulate, _core.verify, _core.compare, _core.problems_of, _core.plain_json, _core.what_if]
        for part in parts:
            functions += [getattr(part, name) for name in dir(part)
                          if not name.startswith(("_", "write")) and callable(getattr(part, name))]  # fmt: skip
        function = self.random.choice(functions)
        count = (function.__doc__ or "").split("->")[0].count(": ")
        function(*[self.random.choice(usual) if self.random.random() < 0.8 else self.any()  # noqa: PLR2004
                   for _ in range(max(0, count - hasattr(function, "__self__")))])  # fmt: skip


#: What a wrong argument may raise. An error of the package with the code 4 is a defect of it.
REFUSALS = (TypeError, ValueError, AttributeError, LookupError, OSError, OverflowError, OwnError, sb.OutOfMemory)
DEFECT = 4


def fuzz(seed, count):
    """Prints the numbers of calls that have ended, and of those that were refused."""
    warnings.simplefilter("ignore")
    calls = Fuzz(seed)
    before = calls.signals.mean.copy()
    refused = 0
    for k in range(count):
        try:
            calls.of_compiled_part() if k % 2 else calls.of_package()
        except REFUSALS as error:
            refused += 1
            assert getattr(error, "code", 0) != DEFECT, repr(error)
        except RuntimeError as error:
            assert "cast" in str(error), repr(error)
    assert (sb.simulate(calls.scene, **QUICK).mean == before).all()
    assert (calls.signals.mean == before).all()
    assert sb.place(MATRIX, requirement=1).ids == calls.best.ids
    print(count, refused)


class Misuse(ProgramTest):
    SEEDS = (1,)  # test_more_slow.py has more

    def test_random_values(self):
        for seed in self.SEEDS:
            end = run("-B", __file__, seed, 600, program=sys.executable, cwd=self.folder, timeout=300)
            self.assertEqual(end.status, 0, end.err[-3000:])
            count, refused = map(int, end.out.split()[-2:])
            self.assertTrue(count / 4 < refused < count, f"refused {refused} of {count}")

    def test_arrays_have_the_limits_of_files(self):
        huge = MATRIX.copy()
        huge[1, 1] = 1.1e18
        for call in (
            lambda: sb.place(MATRIX, requirement=1e300),
            lambda: sb.place(MATRIX, threshold=1.1e18),
            lambda: sb.place(huge, requirement=1),
            lambda: sb.place(MATRIX, requirement=1, costs=[1, 1, 1.1e18]),
            lambda: sb.place(MATRIX, requirement=1, costs=[[1, 1, 1]]),
            lambda: sb.place(MATRIX, requirement=1, at_most=1, weights=[1, 1, 1.1e18]),
            lambda: sb.evaluate(MATRIX, [0], requirement=1, costs=[[1, 1, 1]]),
            lambda: sb.place(np.zeros((0, 3)), requirement=1),
            lambda: sb.simulate(ROOM_STORE, **QUICK).with_mean(np.full((20, 12), 1.1e18)),
            lambda: sb.impulse_response(ROOM_STORE, step=1e-320),
        ):
            with self.assertRaises(sb.InputError) as caught:
                call()
            self.assertEqual(caught.exception.code, 2)
        huge[1, 1] = 1e18
        self.assertEqual(sb.place(huge, requirement=1).count, 2, "the control: the largest signal")

    def test_a_position_and_an_axis_have_three_numbers_each(self):
        light = sb.LightOperator(ROOM_STORE, coarse=True)
        usual = light.column([2, 2, 2.5], axis=[0, 0.3, -1]).signal
        for scale in (1e200, 1e-170):
            found = light.column([2, 2, 2.5], axis=[0, 0.3 * scale, -scale]).signal
            np.testing.assert_allclose(found, usual, rtol=1e-6)
        other = light.column([2, 2, 2.5], axis=[0, 1, -1]).signal
        self.assertFalse(np.allclose(other, usual, rtol=1e-3), "the control")
        for position, axis in (
            ([], [2, 2, 2.5]),
            ([2, 2, 2.5, 0], [0, -1]),
            ([2, 2, 2.5], []),
            ([2, 2, 2.5], [0, 0, 0]),
            ([2, 2, 2.5], [0, 0, float("nan")]),
            ([2, 2, float("inf")], [0, 0, -1]),
            ([[2, 2, 2.5]], [0, 0, -1]),
        ):
            with self.assertRaises(sb.InputError):
                light.column(position, axis)

    def test_names_of_files_that_are_not_utf8(self):
        for name in (b"\xff.h5", "x" * 300, "y" * 10000):
            with self.assertRaises(sb.InputError) as caught:
                sb.Signals.read(name)
            self.assertEqual(caught.exception.where, os.fsdecode(name))

    def test_one_object_in_several_threads(self):
        light, scene = sb.LightOperator(ROOM_STORE, coarse=True), ROOM_STORE.scene()
        signals = sb.simulate(scene, **QUICK)

        def all_results():
            return (light.column([2, 2, 2]).signal.tolist(), light.signals().mean.tolist(), scene.svg(),
                    sb.simulate(scene, **QUICK).mean.tolist(), sb.place(signals, threshold=1e-3, time_limit=10).count,
                    scene.resolved().text())  # fmt: skip

        expected, found = all_results(), []
        threads = [threading.Thread(target=lambda: found.append(all_results())) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(found), len(threads))
        self.assertTrue(all(one == expected for one in found))

    def test_arrays_outlive_their_objects(self):
        def mean():
            return sb.simulate(ROOM_STORE.scene(), **QUICK).mean

        kept = mean()
        others = [mean() for _ in range(3)]
        np.testing.assert_array_equal(kept, others[0])
        with self.assertRaises(ValueError):
            kept.flags.writeable = True
        with self.assertRaises(ValueError):
            kept[0, 0] = 1


if __name__ == "__main__":
    fuzz(*map(int, sys.argv[1:]))
