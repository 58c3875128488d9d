"""Tests the printed report and the drawing for a fitter, with independent readers: Chromium, Poppler and ezdxf."""

import functools
import json
import os
import pathlib
import re
import shutil
import tempfile
import unittest

from harness import ROOT, ProgramTest, has, output

UNITS = 60


def plan_of(folder, store):
    output("plan", store, "-o", folder, *"--no-certificate --samples 200 --quiet".split())
    return folder


def with_units(folder, plan, units):
    """A copy of a plan with other units: without the record of its files, `report` accepts the change."""
    shutil.copytree(plan, folder)
    path = folder / "placement.json"
    placement = json.loads(path.read_text(encoding="utf-8"))
    for key in ("complete", "files", "alternatives"):
        placement.pop(key, None)
    placement.update(selected=units, count=len(units), status="stopped", count_lower_bound=1)
    path.write_text(json.dumps(placement), encoding="utf-8")
    output("report", folder, "--quiet")
    return folder


@functools.cache
def pages_of(folder, paper):
    """The text of each printed page, as laid out."""
    report = folder / "report.html"
    page = folder / f"{paper}.html"
    rule = f"<style>@page{{size:{paper};margin:12mm}}</style></head>"
    page.write_text(report.read_text(encoding="utf-8").replace("</head>", rule, 1), encoding="utf-8")
    pdf = folder / f"{paper}.pdf"
    options = "--headless --no-sandbox --disable-gpu --no-pdf-header-footer".split()
    output(*options, f"--print-to-pdf={pdf}", page.as_uri(), program="chromium")
    return output("-layout", pdf, "-", program="pdftotext").split("\f")


class Prints(ProgramTest):
    @classmethod
    def setUpClass(cls):
        if not (has("chromium") and has("pdftotext")):
            raise unittest.SkipTest("chromium or pdftotext is missing")
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        work = pathlib.Path(scratch.name)
        output("new", "grocery", work / "store", "--quiet")
        cls.few = plan_of(work / "few", work / "store/store.json")
        ids = re.findall(r'"id": "(G1-[^"]+)"', (cls.few / "store.json").read_text(encoding="utf-8"))
        cls.many = with_units(work / "many", cls.few, sorted(ids, key=ids.index)[:: len(ids) // UNITS][:UNITS])

    def expect_row(self, text, row):
        """A line of the sheet with the number of the unit and both its distances."""
        pattern = rf"^\s*{row['number']}\s.*\s{row['distance_1_cm']} cm .+\s{row['distance_2_cm']} cm .+{row['id']}"
        self.assertRegex(text, re.compile(pattern, re.MULTILINE))

    def test_first_page_is_for_the_manager_and_second_for_the_fitter(self):
        for paper in ("A4", "Letter"):
            for folder in (self.few, self.many):
                pages = pages_of(folder, paper)
                self.assertIn("Coverage", pages[0], paper)
                self.assertNotIn("Mounting sheet", pages[0], paper)
                self.assertRegex(pages[1].strip(), "^Mounting sheet", paper)

    def test_units_stand_beside_their_distances(self):
        text = pages_of(self.few, "A4")[1]
        for row in self.rows(self.few / "mounting.csv"):
            self.expect_row(text, row)
        wrong = dict(self.rows(self.few / "mounting.csv")[2], distance_1_cm="98765")
        with self.assertRaises(AssertionError):
            self.expect_row(text, wrong)

    def test_names_in_the_table_are_legible_on_the_drawing(self):
        pages_of(self.few, "A4")
        words = output("-bbox", "-f", "2", "-l", "2", self.few / "A4.pdf", "-", program="pdftotext")
        sizes = {}
        for x0, y0, x1, y1, word in re.findall(
            r'<word xMin="([\d.]+)" yMin="([\d.]+)" xMax="([\d.]+)" yMax="([\d.]+)">([^<]+)<', words
        ):
            size = min(float(x1) - float(x0), float(y1) - float(y0))  # names are horizontal or vertical
            sizes.setdefault(word, []).append(size)
        fixtures = {scene["id"] for scene in self.json(self.few / "store.json")["fixtures"]}
        texts = (row[key] for row in self.rows(self.few / "mounting.csv") for key in ("from_1", "from_2", "place"))
        named = {word for text in texts for word in text.split()} & fixtures
        self.assertTrue(named)
        for name in named:
            self.assertGreaterEqual(len(sizes[name]), 2, name)  # in the table and on the drawing
            self.assertGreaterEqual(min(sizes[name]), 6, name)  # pt

    def test_sixty_units_take_two_pages(self):
        rows = self.rows(self.many / "mounting.csv")
        self.assertEqual(len(rows), UNITS)
        for paper in ("A4", "Letter"):
            pages = pages_of(self.many, paper)
            sheet = pages[1] + pages[2]
            for row in rows:
                self.expect_row(sheet, row)
            self.assertIn("Coverage by shelf level", pages[3], paper)

    def test_numbers_are_those_of_the_sheet(self):
        by_id = {row["id"]: row for row in self.rows(self.few / "mounting.csv")}
        for unit in self.rows(self.few / "placement.csv"):
            row = by_id[unit["id"]]
            self.assertEqual(int(row["height_cm"]), round(100 * float(unit["z"])))
            if row["from_1"] == "wall at the left":
                self.assertEqual(int(row["distance_1_cm"]), round(100 * float(unit["x"])))
        self.assertEqual(sorted(int(row["number"]) for row in by_id.values()), list(range(1, len(by_id) + 1)))

    def ezdxf(self):
        try:
            import ezdxf
            import ezdxf.lldxf.encoding
            import ezdxf.tools.text
        except ImportError:
            if "CI" in os.environ:
                raise
            self.skipTest("ezdxf is missing")
        return ezdxf

    def test_drawing_shows_names_and_its_unit(self):
        ezdxf = self.ezdxf()

        def shown(text):
            return ezdxf.tools.text.plain_text(ezdxf.lldxf.encoding.decode_dxf_unicode(text)).replace("\u200b", "")

        names = ["Kühl 1", "Köhl 1", "\\U+00DC1", "at 45%%d", "a^J", "%%c%%c", "50%"]
        store = self.json(ROOT / "test/data/field/plain_store.json")
        store["transceivers"] = {
            "installed": names,
            "list": [{"id": name, "position": [0.5 + 0.5 * k, 2, 2.9], "type": "unit"} for k, name in enumerate(names)],
        }
        plan = plan_of(self.folder / "plan", self.write("names.json", store))
        drawing = ezdxf.readfile(plan / "mounting.dxf")
        self.assertEqual(drawing.audit().errors, [])
        blocks = drawing.modelspace().query("INSERT")
        ids = [attribute.dxf.text for block in blocks for attribute in block.attribs if attribute.dxf.tag == "ID"]
        self.assertEqual(sorted(map(shown, ids)), sorted(names))
        notes = [shown(text.dxf.text) for text in drawing.modelspace().query("TEXT[layer=='SHELFBEAM_NOTE']")]
        lacking = "Not certified: no independent samples have verified this result."
        self.assertEqual(notes, ["All lengths in metres: 1 drawing unit = 1 m", lacking])

    def test_drawing_has_a_numbered_block_for_every_unit(self):
        ezdxf = self.ezdxf()
        for folder in (self.few, self.many):
            placed = self.rows(folder / "placement.csv")
            at = {unit["id"]: tuple(float(unit[axis]) for axis in "xyz") for unit in placed}
            drawing = ezdxf.readfile(folder / "mounting.dxf")
            self.assertEqual(drawing.audit().errors, [])
            blocks = list(drawing.modelspace().query("INSERT"))
            self.assertEqual(len(blocks), len(at))
            numbers = {}
            for block in blocks:
                self.assertEqual(block.dxf.layer, "SHELFBEAM_UNITS")
                texts = {attribute.dxf.tag: attribute.dxf.text for attribute in block.attribs}
                numbers[texts["ID"]] = texts["NUMBER"]
                for found, wanted in zip(block.dxf.insert, at[texts["ID"]]):
                    self.assertAlmostEqual(found, wanted, places=5)
            self.assertEqual(numbers, {row["id"]: row["number"] for row in self.rows(folder / "mounting.csv")})
