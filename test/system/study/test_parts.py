"""Tests the parts of the study without the program."""

import base64
import csv
import io
import json
import math
import os
import re
import stat
import tempfile
import time
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import h5py
import numpy as np
from matplotlib.image import imread

from study.core import page
from study.core.answers import read_answer
from study.core.findings import AGREES, DIFFERS, PARTLY, Section, verdict
from study.core.hypothesis import pair_test
from study.core.mirror import distance_to_mirror_image, partners
from study.core.program import Failure, Program
from study.core.signals import read_signals, write_variant
from study.core.study import QUICK, STORE, read_store
from study.draw import matrix_picture
from study.draw.charts import histogram
from study.draw.store_map import CLASSES, StoreMap, class_floor, signal_class
from study.sections import certificate
from study.sections.coarse_grid import grids, interchangeable
from study.sections.greedy import nearest_distances, picks
from study.sections.redundancy import corners_and_centre, redundancy


def signal_file(path, mean, positions=None):
    """A small signal file; labels and transceivers are on two lines."""
    m, n = mean.shape
    with h5py.File(path, "w", libver="latest") as file:
        for name in ("mean", "standard_error", "direct"):
            file[name] = mean.astype("<f4")
        file["labels/id"] = np.array([f"L{i}" for i in range(m)], dtype="S4")
        file["labels/type"] = np.array(["t"] * m, dtype="S1")
        file["labels/position"] = np.array([[i, 0.0, 1.0] for i in range(m)])
        file["labels/normal"] = np.array([[0.0, 1.0, 0.0]] * m)
        for name, value in (("requirement", 1.0), ("link_cost", 0.0), ("signal_cost", 0.0)):
            file[f"labels/{name}"] = np.full(m, value)
        file["labels/batches"] = np.full(m, 32, dtype="<u4")
        file["labels/samples"] = np.full(m, 640, dtype="<u8")
        file["transceivers/id"] = np.array([f"T{j}" for j in range(n)], dtype="S4")
        file["transceivers/type"] = np.array(["t"] * n, dtype="S1")
        file["transceivers/position"] = np.array([[j, 1.0, 3.0] for j in range(n)]) if positions is None else positions
        file["transceivers/axis"] = np.array([[0.0, 0.0, -1.0]] * n)
        file["transceivers/cost"] = np.ones(n)
        file["transceivers/installed"] = np.zeros(n, dtype="u1")
        file.attrs["estimator"] = np.bytes_("test")
    return Path(path)


class PairTests(unittest.TestCase):
    def pairs(self, random, shift=0.0, n=600):
        """Tests pairs of means and standard errors of 32 normal batches."""
        a, b = random.normal(1, 1, (n, 32)), random.normal(1 + shift, 1, (n, 32))
        error = [one.std(axis=1, ddof=1) / math.sqrt(32) for one in (a, b)]
        return pair_test(a.mean(axis=1), b.mean(axis=1), *error, 31)

    # At 1 %, about 3 of 300 true claims are rejected; more than 12 have a probability below 1e-4.
    def test_keeps_its_level(self):
        random = np.random.default_rng(1)
        self.assertLessEqual(sum(not self.pairs(random).passes for _ in range(300)), 12)

    def test_rejects_what_differs(self):
        random = np.random.default_rng(2)
        self.assertTrue(all(not self.pairs(random, 0.3).passes for _ in range(20)))
        one = np.ones(50)
        outlier = one.copy()
        outlier[7] = 2
        self.assertFalse(pair_test(one, outlier, 0.1 * one, 0.1 * one, 31).passes)
        self.assertTrue(pair_test(one, one, 0.1 * one, 0.1 * one, 31).passes)

    def test_needs_errors(self):
        with self.assertRaises(ValueError):
            pair_test(np.ones(3), np.ones(3), np.zeros(3), np.zeros(3), 31)


class Mirrors(unittest.TestCase):
    def test_partners(self):
        points = np.array([[1.0, 2, 0], [9, 2, 0], [5, 1, 0], [2, 2, 1], [8, 2, 1]])
        normals = np.array([[1.0, 0, 0], [-1, 0, 0], [0, 1, 0], [0, 1, 0], [0, 1, 0]])
        self.assertEqual(list(partners(points, normals, 5)), [1, 0, 2, 4, 3])
        with self.assertRaises(ValueError):
            partners(points, np.abs(normals), 5)
        with self.assertRaises(ValueError):
            partners(points, normals, 4.9)

    def test_distance(self):
        symmetric = np.array([[1.0, 2, 3], [9, 2, 3], [5, 7, 3]])
        self.assertAlmostEqual(distance_to_mirror_image(symmetric, 10), 0)
        self.assertAlmostEqual(distance_to_mirror_image(symmetric + [1, 0, 0], 10), 2)


class Placements(unittest.TestCase):
    def test_greedy(self):
        reach = np.array([[1, 0, 0], [1, 0, 1], [1, 1, 0], [0, 1, 0], [0, 0, 1]], dtype=bool)
        self.assertEqual(picks(reach, False), [(0, 3), (1, 1), (2, 1)])
        with self.assertRaises(ValueError):
            picks(np.zeros((1, 2), dtype=bool), False)
        self.assertEqual(
            list(nearest_distances(np.array([[0.0, 0, 0], [3, 4, 0], [0, 1, 0]]))), [1, math.hypot(3, 3), 1]
        )

    def test_redundancy(self):
        with tempfile.TemporaryDirectory() as folder:
            signals = read_signals(
                signal_file(f"{folder}/a.h5", np.array([[1.0, 1.0, 0.0], [0.6, 0.6, 0.1], [2.0, 0.1, 0.0]]))
            )
            self.assertEqual(redundancy(signals, [0, 1]), (2 / 3, 1 / 3))
            self.assertEqual(redundancy(signals, [0, 2])[1], 0)

    def test_layouts(self):
        with tempfile.TemporaryDirectory() as folder:
            positions = np.array([[x + 0.5, y + 0.5, 3.0] for y in range(4) for x in range(6)])
            signals = read_signals(signal_file(f"{folder}/a.h5", np.ones((2, 24)), positions))
            layouts = dict(corners_and_centre(signals, 6, 4))
            self.assertEqual(len(layouts), 6)
            self.assertEqual(sorted(layouts[0.5, 0.5][:4]), [0, 5, 18, 23])
            coarse = {(spacing, start): list(columns) for spacing, start, columns in grids(signals.units)}
            self.assertEqual(coarse[2, (1, 0)], [1, 3, 5, 13, 15, 17])
            self.assertEqual(sum(len(columns) for (spacing, _), columns in coarse.items() if spacing == 2), 24)

    def test_interchangeable(self):
        reach = np.array([[1, 1, 1, 0], [0, 0, 1, 0], [0, 0, 0, 1]], dtype=bool)
        self.assertEqual(interchangeable(reach), (2, 2))

    def test_answers(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.json"
            answer = {
                "format": 2,
                "selected": ["T1", "T2"],
                "count": 2,
                "count_lower_bound": 2,
                "status": "optimal",
                "redundant_share": 0.254,
                "seconds": 1,
                "solver": "x",
            }
            for change, units in (
                ({}, "2"),
                ({"status": "stopped", "count_lower_bound": 1}, "[1, 2]"),
                ({"status": "stopped"}, "2~"),
                ({"status": "feasible", "count_lower_bound": 1}, "2"),
            ):
                path.write_text(json.dumps({**answer, **change}), encoding="utf-8")
                self.assertEqual(read_answer(path).units, units)
            self.assertEqual(read_answer(path).with_share, "2 25%")
            path.write_text(json.dumps({**answer, "format": 1}), encoding="utf-8")
            with self.assertRaises(ValueError):
                read_answer(path)


class Files(unittest.TestCase):
    def test_variants(self):
        with tempfile.TemporaryDirectory() as folder:
            mean = np.arange(6.0).reshape(2, 3)
            source = signal_file(f"{folder}/a.h5", mean)
            variant = read_signals(
                write_variant(source, f"{folder}/b.h5", mean=np.where(mean >= 2, mean, 0), columns=[0, 2])
            )
            self.assertEqual(variant.mean.tolist(), [[0, 2], [3, 5]])
            self.assertEqual(variant.unit_ids, ["T0", "T2"])
            self.assertEqual(read_signals(source).mean.tolist(), mean.tolist())

    def test_program_goes_on_where_it_was(self):
        with tempfile.TemporaryDirectory() as folder:
            binary = fake_program(
                folder, 'echo ran >>"$(dirname "$0")/log"\ncase $1 in fail) exit 4 ;; esac\nprintf x >"${@: -2:1}"'
            )
            source, log = Path(folder) / "in", Path(folder) / "log"
            source.write_text("1", encoding="utf-8")
            program = Program(binary, f"{folder}/work")
            for arguments, runs in (
                (["place", source], 1),
                (["place", source], 1),
                (["place", source, "--model", "m"], 2),
            ):
                program.run("out", arguments, [source])
                self.assertEqual(log.read_text(encoding="utf-8").count("ran"), runs)
            os.utime(source, (time.time() + 9, time.time() + 9))
            program.run("out", ["place", source, "--model", "m"], [source])
            self.assertEqual(log.read_text(encoding="utf-8").count("ran"), 3)
            os.utime(source, (0, 0))
            os.utime(binary, (time.time() + 9, time.time() + 9))
            program.run("out", ["place", source, "--model", "m"], [source])
            self.assertEqual(log.read_text(encoding="utf-8").count("ran"), 4)
            with self.assertRaises(Failure):
                program.run("other", ["fail"])
            self.assertEqual(program.record("out")["exit_code"], 0)

    def test_store(self):
        store = read_store(STORE)
        self.assertEqual(store["room"]["size"], [20, 16, 4])
        self.assertEqual(store["label_types"]["standard"]["threshold"], 0.021)


def fake_program(folder, script):
    path = Path(folder) / "program"
    path.write_text(f"#!/usr/bin/env bash\n{script}\n", encoding="utf-8")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path


class Certificates(unittest.TestCase):
    HELP = 'case $* in *--help*) echo "  --confidence FLOAT  Certify"; exit ;; esac\n'
    PLAN = """mkdir -p "${@: -2:1}"
cat >"${@: -2:1}/placement.json" <<END
{"count": 4, "count_lower_bound": 4, "status": "optimal", "certificate": {"confidence": 0.99, "verdict": "certified"}}
END"""

    def study(self, folder, script):
        class Study:
            effort = QUICK
            program = Program(fake_program(folder, script), f"{folder}/work")

        return Study()

    def test_section_where_the_program_certifies(self):
        with tempfile.TemporaryDirectory() as folder:
            study = self.study(folder, self.HELP + self.PLAN)
            self.assertTrue(certificate.is_there(study))
            section = certificate.section(study)
            self.assertEqual(
                [row[:3] for row in section.tables["certified_plan"][1]],
                [("cooperative", 4, 4), ("non-cooperative", 4, 4)],
            )
            self.assertIn(("verdict", "certified"), section.tables["certificate_cooperative"][1])
            self.assertIn("equal", section.findings[0].why)

    def test_no_section_where_it_does_not(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertFalse(certificate.is_there(self.study(folder, 'echo "  --confidential  no"')))


class Pages(unittest.TestCase):
    def test_verdicts(self):
        self.assertEqual([verdict(True), verdict(False, True), verdict(False)], [AGREES, PARTLY, DIFFERS])

    def test_document_is_well_formed(self):
        section = Section("A & B", "3.5", "Is 1 < 2?")
        section.find("a < b", "1", "2", AGREES, 'It is "so".', "As <measured>.")
        section.tell("Ours.")
        section.add(
            page.table(("a", "b"), [("<", 1)], numeric=(1,)),
            page.figure("c", histogram([0, 1, 2], [3, 0], "x", "y", "d", (1, "mark"), [0, 1, 2])),
        )
        html = page.document("T", "", [("n", "v", "w")], [section], "f")
        root = ElementTree.fromstring(html.split("\n", 1)[1])
        self.assertEqual(len(root.findall(".//{*}section")), 2)
        self.assertIn("1 statement of the paper can be examined here: ", html)

    def test_csv(self):
        rows = list(csv.reader(io.StringIO(page.csv_text(("a", "b"), [("x, y", 0.1), ("12\u00a0%", 3)]))))
        self.assertEqual(rows, [["a", "b"], ["x, y", "0.1"], ["12 %", "3"]])


class Pictures(unittest.TestCase):
    def test_histogram_has_bars_in_proportion_and_the_page_s_colours(self):
        text = histogram([0.001, 0.002, 0.003, 0.004], [3, 0, 1], "x", "y", "d", (0.002, "mark"), ticks=[0.001, 0.004])
        picture = ElementTree.fromstring(text)
        words = {element.text.strip() for element in picture.iter("text")}
        self.assertEqual(words - {"0.001", "0.004", "0", "1", "2", "3"}, {"x", "y", "mark"})
        bars = [path.get("d") for path in picture.iter("path") if "fill: var(--s0)" in path.get("style", "")]
        heights = [np.ptp([float(y) for y in re.findall(r"[ML] [\d.]+ ([\d.]+)", bar)]) for bar in bars]
        self.assertEqual(len(heights), 2)
        self.assertAlmostEqual(heights[0] / heights[1], 3, delta=0.01)
        self.assertNotRegex(text, "#[0-9a-f]{6}")

    def test_signal_classes(self):
        self.assertEqual([signal_class(share) for share in (1, 0.01, 0.0099, 0)], [CLASSES - 1, 0, -1, -1])
        self.assertEqual([signal_class(class_floor(k)) for k in range(CLASSES)], list(range(CLASSES)))

    def test_map_marks_every_label_by_its_class(self):
        with tempfile.TemporaryDirectory() as folder:
            signals = read_signals(signal_file(f"{folder}/a.h5", np.array([[2.0], [1.0], [0.5], [0.002]])))
        store = {"room": {"size": [5, 4, 3]}, "fixtures": []}

        def fills(threshold):
            text = StoreMap(store).signals(signals, [0, 1, 2, 3], 0, 2, threshold, "d")
            return sorted(re.findall(r"<use [^>]*fill(?:: var\(--|-opacity: )(\w+)", text))

        self.assertEqual(fills(None), ["0", "g5", "g6", "g7", "source"])
        self.assertEqual(fills(signals.requirement), ["cand", "cand", "g6", "g7", "source"])

    def test_matrix(self):
        bits = np.random.default_rng(3).random((5, 19)) < 0.4
        data = re.search('base64,([^"]*)', matrix_picture.picture(bits, "d"))[1]
        self.assertTrue(((imread(io.BytesIO(base64.b64decode(data)))[:, :, 3] > 0) == bits).all())


if __name__ == "__main__":
    unittest.main()
