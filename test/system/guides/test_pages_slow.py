"""Runs all commands of the guides with the program in $SHELFBEAM. A page counts as skipped if other programs that it
uses (Octave, solvers) are not installed; continuous integration has none of them. The pages of docs/howto continue the
tutorial, each in a copy of its folder."""

import json
import shutil

import guide
import h5py
from harness import PROGRAM, ROOT, ProgramTest


def run_page(page, folder):
    return guide.run_page(page, folder, guide.environment(PROGRAM))


class Pages(ProgramTest):
    def test_tutorial_and_tasks(self):
        finished = self.folder / "tutorial"
        finished.mkdir()
        ran, missing = run_page(guide.DOCS / "tutorial.md", finished)
        self.assertGreaterEqual(ran, 7)
        self.assertEqual(missing, set())
        tasks = sorted((guide.DOCS / "howto").glob("*.md"))
        self.assertGreaterEqual(len(tasks), 9)
        for page in tasks:
            with self.subTest(page=page.name):
                ran, missing = run_page(page, shutil.copytree(finished, self.folder / page.stem))
                self.assertGreaterEqual(ran, 1)
                self.assertEqual(missing, set())

    def test_planner(self):
        self.assertEqual(run_page(guide.DOCS / "planner.md", self.folder), (3, set()))

    def test_research(self):
        ran, missing = run_page(guide.DOCS / "research.md", self.folder)
        self.assertGreaterEqual(ran, 8)
        if missing:
            self.skipTest(f"{ran} blocks ran; not installed for the others: {', '.join(sorted(missing))}")

    def test_octave_can_read_texts(self):
        """Octave cannot read texts that are marked as UTF-8, so only texts that need it are marked."""
        text = self.text(ROOT / "test/data/room_s1/store.json")
        store = json.loads(text[text.index("{") :])  # without its comment
        store["labels"] = [{**store["labels"][0], "id": "Größe"}]
        self.write("store.json", store)
        self.told("simulate store.json -o signal.h5 --samples 64 --quiet")
        with h5py.File(self.folder / "signal.h5") as file:

            def encoding(name):
                return h5py.check_string_dtype(file[name].dtype).encoding

            self.assertEqual(encoding("labels/id"), "utf-8")
            self.assertEqual(file["labels/id"].asstr()[0], "Größe")
            self.assertEqual(encoding("labels/type"), "ascii")
            self.assertEqual(encoding("transceivers/id"), "ascii")
