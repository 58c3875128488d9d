"""scripts/check/peer without Radiance: its files, its arithmetic, and what it does with numbers from a stand-in.

The stand-in for rcontrib is a fake. It computes no light: it prints numbers that the test gives it.
"""

import contextlib
import csv
import importlib.machinery
import importlib.util
import io
import json
import os
import pathlib
import re
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np
from harness import ROOT, ProgramTest, output, run

SCRIPT = ROOT / "scripts/check/peer"
loader = importlib.machinery.SourceFileLoader("peer", str(SCRIPT))
peer = importlib.util.module_from_spec(importlib.util.spec_from_loader("peer", loader))
sys.modules["peer"] = peer
loader.exec_module(peer)

FAKE_RCONTRIB = """#!/bin/sh
# A fake for tests: keeps its input, and prints the given numbers for any scene.
[ "$1" != -version ] || { echo "FAKE, NOT RADIANCE"; exit; }
/bin/cat >"$0.input"
exec /bin/cat "$0.output"
"""


def read_scene(path):
    """(reflectances by modifier, [(modifier, triangle)], [unit]) of scene.rad; a reader of its own."""
    words = iter(path.read_text(encoding="ascii").split())
    greys, triangles, patterns, lights, units = {}, [], {}, {}, []
    for modifier in words:
        kind, name = next(words), next(words)
        strings = [next(words) for _ in range(int(next(words)))]
        next(words)  # no integers
        values = np.array([float(next(words)) for _ in range(int(next(words)))])
        if kind == "plastic":
            greys[name] = values[0]
        elif kind == "polygon":
            triangles.append((modifier, values.reshape(3, 3)))
        elif kind == "brightfunc":
            patterns[name] = strings[0], values
        elif kind == "light":
            lights[name] = (values[0], *patterns[modifier])
        elif kind == "sphere":
            units.append((values[:3], values[3], *lights[modifier]))
    return greys, triangles, units


def brightness(cal, variable, direction, arguments):
    """A variable of a .cal file for rays along the directions (n x 3)."""
    known = {
        "sqrt": np.sqrt,
        "choose": lambda a, b, c: np.where(a > 0, b, c),
        **dict(zip(("Dx", "Dy", "Dz"), direction.T)),
        **dict(zip(("A1", "A2", "A3", "A4"), [*arguments, 0])),
    }
    for definition in re.sub(r"{.*?}", "", cal).split(";")[:-1]:
        name, value = (side.strip() for side in definition.replace("if(", "choose(").replace("^", "**").split("=", 1))
        function = re.fullmatch(r"(\w+)\((\w+)\)", name)
        code = f"lambda {function[2]}: {value}" if function else value
        known[function[1] if function else name] = eval(code, known)  # pylint: disable=eval-used
    return known[variable]


def is_free(start, end, corners):
    """Whether no triangle (n x 3 x 3) is strictly between two points."""
    a, u, v = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    way = end - start
    normal = np.cross(u, v)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = np.einsum("ij,ij->i", a - start, normal) / (normal @ way)
        p = start + t[:, None] * way - a
        scale = np.einsum("ij,ij->i", normal, normal)
        s = np.einsum("ij,ij->i", np.cross(p, v), normal) / scale
        r = np.einsum("ij,ij->i", np.cross(u, p), normal) / scale
    return not ((t > 1e-5) & (t < 1 - 1e-5) & (s >= 0) & (r >= 0) & (s + r <= 1)).any()


class Conversion(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.store = peer.prepare(cls.folder, "market-hall", 20, 10)
        cls.greys, cls.triangles, cls.units = read_scene(cls.folder / "scene.rad")
        cls.corners = np.array([corners for _, corners in cls.triangles])

    def test_areas_and_reflectances_are_those_of_the_program(self):
        summary = json.loads(output("inspect", self.folder / "store.json", "--json"))
        modifiers, (a, b, c) = np.array([one for one, _ in self.triangles]), self.corners.transpose(1, 0, 2)
        areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
        self.assertEqual(list(summary["materials"]), list(self.store["materials"]))
        for modifier, material in zip(self.greys, summary["materials"].values()):
            self.assertAlmostEqual(areas[modifiers == modifier].sum() / material["area_m2"], 1, 6)
            self.assertAlmostEqual(self.greys[modifier], material["mean_reflectance"], 9)

    def test_direct_light_is_that_of_the_program(self):
        cal = (self.folder / "emission.cal").read_text(encoding="ascii")
        probes = np.loadtxt(self.folder / "probes.txt")
        found = np.zeros((len(probes), len(self.units)))
        for j, (centre, radius, radiance, variable, arguments) in enumerate(self.units):
            way = centre - probes[:, :3]
            distance = np.linalg.norm(way, axis=1)
            cosine = (way * probes[:, 3:]).sum(axis=1) / distance
            intensity = np.pi * radius**2 * radiance * brightness(cal, variable, way / distance[:, None], arguments)
            for i in np.flatnonzero((cosine > 0) & (intensity > 0)):
                if is_free(probes[i, :3] + 1e-4 * probes[i, 3:], centre, self.corners):
                    found[i, j] = intensity[i] * cosine[i] / distance[i] ** 2
        simulate, quick = peer.program.simulate, "--estimator uniform --direct exact --max-bounces 2".split()
        with mock.patch.object(peer.program, "simulate", lambda *words: simulate(*words, *quick)):
            signals, seconds = peer.our_signals(self.folder, 64, 1)
        output("export", self.folder / "1.h5", "--what", "direct", "-o", self.folder / "direct.csv")
        with open(self.folder / "direct.csv", newline="", encoding="utf-8") as file:
            header, *lines = csv.reader(file)
        self.assertEqual(header[1:], [unit["id"] for unit in self.store["transceivers"]["list"]])
        self.assertEqual([line[0] for line in lines], [label["id"] for label in self.store["labels"]])
        expected = np.array([line[1:] for line in lines], dtype=float)
        self.assertGreater((expected > 0).mean(), 0.1)
        self.assertGreater((expected == 0).mean(), 0.1)
        np.testing.assert_allclose(found, expected, rtol=1e-4, atol=1e-9)
        self.assertTrue((signals[0] >= 0.999 * expected).all())  # rows and columns in the same order
        self.assertGreater(seconds, 0)

    def test_what_has_no_equal_in_radiance_is_refused(self):
        glass = {"type": "thin_dielectric", "ior": 1.5}
        with self.assertRaisesRegex(ValueError, "material 'door' of type 'thin_dielectric'"):
            peer.radiance.reflectance("door", glass)
        with self.assertRaisesRegex(ValueError, "emission 'table'"):
            peer.radiance.emission({"radius": 0, "emission": {"type": "table"}})


class Arithmetic(unittest.TestCase):
    def signals(self, seed, spread, factor=1.0):
        noise = np.random.default_rng(seed).normal(size=(16, 20, 5))
        return factor * (1 + np.arange(5)) * (1 + spread * noise)

    def compare(self, **theirs):
        return peer.compare(self.signals(1, 0.01), 2.0, self.signals(2, **theirs), 10.0, np.zeros(20))

    def test_ratio_error_and_efficiency(self):
        found = self.compare(spread=0.04)
        self.assertAlmostEqual(found.ratio, 1, delta=0.004)
        # 16 x 20 entries of each unit, weighted by 1 to 5
        expected = np.sqrt(55 / 15**2 / 320) * np.hypot(0.01, 0.04)
        self.assertAlmostEqual(found.error / expected, 1, delta=0.5)
        for efficiency in (found.typical, found.of_all):  # variance x 16, time x 5
            self.assertAlmostEqual(efficiency / 80, 1, delta=0.25)
        self.assertEqual(found.of_units.shape, (5,))
        self.assertLessEqual(found.of_units.min(), found.typical)
        self.assertLess(found.deviation, 4)
        self.assertEqual(found.verdict, "right")

    def test_difference_of_2_percent_is_wrong(self):
        found = self.compare(spread=0.04, factor=1.02)
        self.assertEqual(found.verdict, "WRONG")
        self.assertAlmostEqual(found.ratio, 1 / 1.02, delta=0.004)
        self.assertGreater(found.deviation, 4)

    def test_a_large_error_or_none_decides_nothing(self):
        self.assertEqual(self.compare(spread=1.0).verdict, "NOISY")
        with self.assertRaises(RuntimeError):
            self.compare(spread=0)


class Script(ProgramTest):
    def run_main(self, *arguments):
        """(exit code, output) of the script where only the folder is on the PATH."""
        out = io.StringIO()
        with mock.patch.dict(os.environ, PATH=str(self.folder)), mock.patch.object(sys, "argv", ["peer", *arguments]):
            with contextlib.redirect_stdout(out):
                return peer.main(), out.getvalue()

    def test_without_radiance_it_is_skipped(self):
        end = run(program=SCRIPT, env={**os.environ, "PATH": str(self.folder)})
        self.assertEqual((end.status, end.out.split(":")[0]), (0, "skipped"))

    def test_numbers_of_the_fake_are_read_and_judged(self):
        ours, theirs = (1 + 0.01 * np.random.default_rng(seed).normal(size=(16, 4, 3)) for seed in (1, 2))
        for name, text in (("oconv", "#!/bin/sh\n"), ("rcontrib", FAKE_RCONTRIB)):
            self.write(name, text).chmod(0o755)
        for factor, status, verdict in ((1, 0, " right "), (1.02, 1, " WRONG ")):
            given = np.repeat(factor * theirs.reshape(64, 3), 3, axis=1)  # red, green, blue
            np.savetxt(self.folder / "rcontrib.output", given, "%.6e", "\t", "\t\n")
            with mock.patch.object(peer, "our_signals", lambda *_: (ours, 1.0)):
                end, out = self.run_main("grocery", "--labels", "4", "--units", "3")
            self.assertEqual(end, status, out)
            probes = self.text("rcontrib.input").splitlines()
            self.assertEqual((len(probes), len(set(probes)), probes[:4]), (64, 4, probes[4:8]))
            self.assertIn("FAKE, NOT RADIANCE", out)
            self.assertIn(verdict, out)
            self.assertAlmostEqual(float(out.split("+-")[0].split()[-1]), 1 / factor, delta=0.005)
