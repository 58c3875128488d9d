"""Tests that files of every released version (scripts/keep-formats) are read, or refused with a clear message."""

import re

import h5py
from compatibility import SAMPLES, VERSIONS, old_files, old_plan
from harness import ProgramTest, run

PRESENT = re.search(r"\d+\.\d+\.\d+", run("--version").out)[0]
RESUME = f"simulate store.json -o interrupted.h5 --samples {SAMPLES} --resume"


class Kept(ProgramTest):
    def each_version(self):
        """The versions, each with its files in the folder of the test."""
        top = self.folder
        for version in VERSIONS:
            with self.subTest(version=version):
                self.folder = old_files(version, top / version)
                yield version

    def badge(self, *options):
        self.told("report", "plan", *options)
        return re.search(r'class="verdict">([^<]*)<', self.text("plan/report.html"))[1]

    def test_files_of_the_present_version_are_kept(self):
        self.assertIn(PRESENT, VERSIONS, "scripts/keep-formats writes them")

    def test_stores_are_read(self):
        for _ in self.each_version():
            self.assertEqual(self.answer("inspect store.json")["labels"], len(self.json("plan/store.json")["labels"]))

    def test_signals_give_the_placement_that_they_gave(self):
        for _ in self.each_version():
            answer = self.json("plan/placement.json")
            self.told(f"place plan/signal.h5 --model {answer['model']} -o again.json")
            self.assertEqual(self.json("again.json")["count"], answer["count"])

    def test_reports_of_plans_are_made_anew(self):
        for _ in self.each_version():
            self.told("report plan")
            for unit in self.json("plan/placement.json")["selected"]:
                self.assertIn(unit, self.text("plan/report.html"))

    def test_values_count_as_given_until_they_are_confirmed(self):
        badges = set()
        for _ in self.each_version():
            badges.add(self.badge())
            self.assertNotIn("values", self.json("plan/placement.json"))
            store = self.json("plan/store.json")
            for value in self.answer("inspect plan/store.json")["values"]:
                *way, key = value["mark"].split("/")[1:]
                inner = store.setdefault("confirmed", {})
                for part in way:
                    inner = inner.setdefault(part, {})
                inner[key] = value["value"]
            badges.add(self.badge("--store", self.write("confirmed.json", store)))
        verified = {one for one in badges if one.startswith("Verified")}
        self.assertEqual(verified, {"Verified for the values of the store file", "Verified"})

    def test_plans_are_compared(self):
        present = old_plan(PRESENT, self.folder / "present")
        for _ in self.each_version():
            difference = self.answer(f"diff plan {present}")
            self.assertEqual(difference["differs"], False)
            self.assertEqual(difference["before"]["certificate"], "certified")

    def test_plans_are_verified_and_replaced(self):
        for _ in self.each_version():
            self.told("verify store.json plan/placement.json --confidence 0.95")
            replace = "plan store.json -o plan --samples 64 --estimator uniform --no-certificate"
            self.refused(replace, "finished plan")
            replaced = self.run_here(f"{replace} --overwrite")
            self.assertIn(replaced.status, (0, 3), replaced.err)
            self.assertEqual(self.json("plan/placement.json")["format"], 2)

    def test_checkpoints_are_resumed_by_their_own_version_only(self):
        for version in self.each_version():
            if version == PRESENT:
                self.assertIn("continued from the checkpoint", self.told(RESUME))
            else:
                self.refused(RESUME, "interrupted.h5.checkpoint", "program version", version, "--resume")


class Others(ProgramTest):
    """The version in a file decides whether it is read."""

    def setUp(self):
        super().setUp()
        old_files(VERSIONS[-1], self.folder)

    def replace(self, name, before, after):
        content = self.bytes(name)
        self.assertIn(before, content)
        self.write(name, content.replace(before, after, 1))

    def test_stores(self):
        self.replace("store.json", b'"format": 1', b'"format": 2, "new": true')
        self.refused("inspect store.json", "store.json", "format version 2", "newer version")

    def test_signals(self):
        for version, words in [(2, "newer version"), (0, "version of shelfbeam that wrote it")]:
            with h5py.File(self.folder / "plan/signal.h5", "r+") as file:
                file.attrs.modify("format_version", version)
            content = self.bytes("plan/signal.h5")  # without the checksum before the HDF5, which is now wrong
            self.write("plan/signal.h5", content[content.index(b"\x89HDF") :])
            self.refused("place plan/signal.h5", "signal.h5", f"format version {version}", words)

    def test_placements(self):
        self.write("plan/placement.json", {**self.json("plan/placement.json"), "format": 3, "new": True})
        self.refused("report plan", "placement.json", "format version 3", "newer version")

    def test_checkpoints(self):
        self.replace("interrupted.h5.checkpoint", b"shelfbeam checkpoint 1\n", b"shelfbeam checkpoint 2\n")
        self.refused(RESUME, "interrupted.h5.checkpoint", "version")
