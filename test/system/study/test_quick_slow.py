"""Tests the files of `scripts/reproduce --quick`, and that a second run has nothing left to do."""

import csv
import json
import re
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from harness import ROOT, run

SCRIPT = ROOT / "scripts/reproduce"
SVG = ".//{*}svg"


class QuickStudy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = Path(scratch.name) / "study"
        cls.first = cls.reproduce()
        html = (cls.folder / "study.html").read_text(encoding="utf-8")
        cls.root = ElementTree.fromstring(html.split("\n", 1)[1])
        cls.words = " ".join("".join(cls.root.find("{*}body").itertext()).split())

    @classmethod
    def reproduce(cls):
        """The messages of the script."""
        end = run("--quick", cls.folder, program=SCRIPT)
        if end.status:
            raise AssertionError(end.err)
        return end.err

    def rows(self, name):
        with open(self.folder / f"{name}.csv", encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file)) if name == "findings" else list(csv.reader(file))

    def figures(self):
        return {
            re.sub(r"\s+", " ", "".join(figure.find("{*}figcaption").itertext())): figure
            for figure in self.root.iter()
            if figure.tag.endswith("}figure")
        }

    def test_every_figure_of_the_paper_has_its_like(self):
        captions = self.figures()
        for number in "2.8 2.9 2.10 2.11 2.12 2.13 3.2a 3.2b 3.3a 3.3b 3.4a 3.4b 3.5a 3.5b 3.6 3.7".split():
            name = re.escape(f"Fig. {number}") + r"\b"
            found = [figure for caption, figure in captions.items() if re.search(name, caption)]
            self.assertTrue(found, number)
            for figure in found:
                self.assertTrue(figure.findall(SVG) or figure.findall(".//{*}img"), number)
        for caption, figure in captions.items():
            if caption.startswith("Fig. 2."):
                self.assertEqual(len([svg for svg in figure.findall(SVG) if svg.get("class") == "m"]), 6, caption)

    def test_references_lead_somewhere(self):
        ids = [element.get("id") for element in self.root.iter() if element.get("id")]
        targets = {element.get("href") for element in self.root.iter() if element.get("href")}
        self.assertGreater(len(targets), 20)
        self.assertEqual(targets - {f"#{one}" for one in ids}, set())
        self.assertEqual(len(ids), len(set(ids)))

    def test_tables_are_those_of_the_answers(self):
        table = self.rows("table_3_1")
        self.assertEqual([row[2] for row in table[1:]], ["8", "6"])
        self.assertEqual(table[1][4], "54 %")
        for row, samples in zip(table[1:], (5000, 25000)):
            file = self.folder / f"work/tables/{samples}-non-cooperative-count-auto.json"
            answer = json.loads(file.read_text(encoding="utf-8"))
            self.assertEqual(answer["status"], "optimal")
            self.assertEqual(row[1], str(answer["count"]))
            self.assertEqual(row[3], f"{100 * answer['redundant_share']:.0f} %")
        self.assertEqual([row[2] for row in self.rows("table_3_3")[1:]], ["6", "5"])
        self.assertEqual([row[2] for row in self.rows("table_3_2")[1:]], ["10", "9"])
        self.assertGreater(int(self.rows("table_3_2")[1][1]), int(table[1][1]))

    # The z-tests run at 1 % each on fixed seeds; the controls pair labels with transceivers that are not opposite.
    def test_symmetry_passes_and_its_control_does_not(self):
        for row in self.rows("symmetry")[1:]:
            self.assertEqual(row[-1], "rejected" if "displaced" in row[0] else "passes", row[0])

    def test_shadow_rays_and_errors(self):
        shares = [float(row[4].split()[0]) for row in self.rows("shadow_rays")[1:]]
        # Shares of millions of rays depend on the scene, not on the number of samples.
        self.assertAlmostEqual(shares[0], shares[1], delta=0.3)
        self.assertTrue(20 < shares[0] < 60)
        errors = [float(row[7].split()[0]) for row in self.rows("samples")[1:3]]
        # With five times the samples, the error falls by sqrt(5) = 2.24.
        self.assertTrue(1.9 < errors[0] / errors[1] < 2.6, errors)
        zeros = self.rows("zeros")
        self.assertEqual(zeros[0][1:], ["5,000", "25,000", "reference"])
        for column in range(1, 4):
            values = [float(row[column].split()[0]) for row in zeros[1:]]
            self.assertEqual(values, sorted(values))

    def test_every_finding_is_in_the_document(self):
        findings = self.rows("findings")
        self.assertGreater(len(findings), 30)
        for one in findings:
            self.assertIn(one["verdict"], ("agrees", "in part", "differs", "ours"))
            self.assertIn(one["sentence"], self.words)
        judged = [one["verdict"] for one in findings if one["verdict"] != "ours"]
        self.assertIn(f"{len(judged)} statements of the paper can be examined here", self.words)
        self.assertIn(f"{judged.count('agrees')} agree with our figures", self.words)

    def test_a_second_run_has_nothing_to_do(self):
        before = (self.folder / "study.html").read_bytes()
        self.assertRegex(self.first, r" [1-9]\d* runs of the program")
        again = self.reproduce()
        self.assertIn(" 0 runs of the program", again)
        self.assertNotIn("simulating", again)
        self.assertEqual((self.folder / "study.html").read_bytes(), before)

    def test_wrong_arguments(self):
        for arguments in ("--fast", "--time-limit -1"):
            self.assertEqual(run(arguments, program=SCRIPT).status, 2)
