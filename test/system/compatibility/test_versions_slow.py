"""Tests that files of every released version (scripts/keep-formats) are read, or refused with a clear message."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import h5py

PROGRAM = os.environ["SHELFBEAM"]
HERE = pathlib.Path(__file__).parent
VERSIONS = sorted(folder.name for folder in HERE.iterdir() if re.fullmatch(r"\d+\.\d+\.\d+", folder.name))

SAMPLES = ("--samples", (HERE / "samples").read_text().strip())


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)


def present_version():
    return re.search(r"\d+\.\d+\.\d+", run("--version").stdout)[0]


class Kept(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def copy(self, version):
        folder = self.folder / version
        shutil.copytree(HERE / version, folder)
        return folder

    def each_version(self):
        for version in VERSIONS:
            with self.subTest(version=version):
                yield version, self.copy(version)

    def refused(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def test_files_of_the_present_version_are_kept(self):
        self.assertIn(present_version(), VERSIONS, "scripts/keep-formats writes them")

    def test_stores_are_read(self):
        for _, kept in self.each_version():
            shown = run("inspect", kept / "store.json", "--json")
            self.assertEqual(shown.returncode, 0, shown.stderr)
            listed = json.loads((kept / "plan/store.json").read_text())
            self.assertEqual(json.loads(shown.stdout)["labels"], len(listed["labels"]))

    def test_signals_give_the_placement_that_they_gave(self):
        for _, kept in self.each_version():
            answer = json.loads((kept / "plan/placement.json").read_text())
            placed = run("place", kept / "plan/signal.h5", "--model", answer["model"], "-o", kept / "again.json")
            self.assertEqual(placed.returncode, 0, placed.stderr)
            again = json.loads((kept / "again.json").read_text())
            self.assertEqual(again["count"], answer["count"])

    def test_reports_of_plans_are_made_anew(self):
        for _, kept in self.each_version():
            reported = run("report", kept / "plan")
            self.assertEqual(reported.returncode, 0, reported.stderr)
            page = (kept / "plan/report.html").read_text(encoding="utf-8")
            for unit in json.loads((kept / "plan/placement.json").read_text())["selected"]:
                self.assertIn(unit, page)

    def test_values_count_as_given_until_they_are_confirmed(self):
        badges = set()
        for _, kept in self.each_version():

            def badge(*options, plan=kept / "plan"):
                reported = run("report", plan, *options)
                self.assertEqual(reported.returncode, 0, reported.stderr)
                return re.search(r'class="verdict">([^<]*)<', (plan / "report.html").read_text(encoding="utf-8"))[1]

            badges.add(badge())
            self.assertNotIn("values", json.loads((kept / "plan/placement.json").read_text()))
            store = json.loads((kept / "plan/store.json").read_text())
            known = json.loads(run("inspect", kept / "plan/store.json", "--json").stdout)["values"]
            for value in known:
                *way, key = value["mark"].split("/")[1:]
                inner = store.setdefault("confirmed", {})
                for part in way:
                    inner = inner.setdefault(part, {})
                inner[key] = value["value"]
            (kept / "confirmed.json").write_text(json.dumps(store))
            badges.add(badge("--store", kept / "confirmed.json"))
        verified = {one for one in badges if one.startswith("Verified")}
        self.assertEqual(verified, {"Verified for the values of the store file", "Verified"})

    def test_plans_are_compared(self):
        present = HERE / present_version() / "plan"
        for version, kept in self.each_version():
            compared = run("diff", kept / "plan", present, "--json")
            self.assertEqual(compared.returncode, 0, compared.stderr)
            difference = json.loads(compared.stdout)
            self.assertEqual(difference["differs"], False, version)
            self.assertEqual(difference["before"]["certificate"], "certified", version)

    def test_plans_are_verified_and_replaced(self):
        for _, kept in self.each_version():
            plan = kept / "plan"
            command = ["verify", kept / "store.json", plan / "placement.json", "--confidence", "0.95"]
            self.assertEqual(run(*command).returncode, 0)
            self.refused(run("plan", kept / "store.json", "-o", plan, *SAMPLES), "finished plan")
            replaced = run("plan", kept / "store.json", "-o", plan, *SAMPLES, "--overwrite")
            self.assertIn(replaced.returncode, (0, 3), replaced.stderr)
            self.assertEqual(json.loads((plan / "placement.json").read_text())["format"], 2)

    def test_checkpoints_are_resumed_by_their_own_version_only(self):
        for version, kept in self.each_version():
            resumed = run("simulate", kept / "store.json", "-o", kept / "interrupted.h5", *SAMPLES, "--resume")
            if version == present_version():
                self.assertEqual(resumed.returncode, 0, resumed.stderr)
                self.assertIn("continued from the checkpoint", resumed.stdout)
            else:
                self.refused(resumed, "interrupted.h5.checkpoint", "program version", version, "--resume")


class Others(Kept):
    """The version in a file decides whether it is read."""

    def newest(self):
        return self.copy(VERSIONS[-1])

    def test_stores(self):
        kept = self.newest()
        text = (kept / "store.json").read_text()
        self.assertIn('"format": 1', text)
        (kept / "store.json").write_text(text.replace('"format": 1', '"format": 2, "new": true'))
        self.refused(run("inspect", kept / "store.json"), "store.json", "format version 2", "newer version")

    def test_signals(self):
        kept = self.newest()
        for version, words in [(2, "newer version"), (0, "version of shelfbeam that wrote it")]:
            with h5py.File(kept / "plan/signal.h5", "r+") as file:
                file.attrs.modify("format_version", version)
            content = (kept / "plan/signal.h5").read_bytes()  # without the checksum before the HDF5, which is now wrong
            (kept / "plan/signal.h5").write_bytes(content[content.index(b"\x89HDF") :])
            self.refused(run("place", kept / "plan/signal.h5"), "signal.h5", f"format version {version}", words)

    def test_placements(self):
        kept = self.newest()
        path = kept / "plan/placement.json"
        placement = json.loads(path.read_text())
        path.write_text(json.dumps({**placement, "format": 3, "new": True}))
        self.refused(run("report", kept / "plan"), "placement.json", "format version 3", "newer version")
        self.assertFalse((kept / "plan/report.html").exists())

    def test_checkpoints(self):
        kept = self.newest()
        path = kept / "interrupted.h5.checkpoint"
        content = path.read_bytes()
        self.assertTrue(content.startswith(b"shelfbeam checkpoint 1\n"))
        path.write_bytes(content.replace(b"checkpoint 1\n", b"checkpoint 2\n", 1))
        self.refused(
            run("simulate", kept / "store.json", "-o", kept / "interrupted.h5", *SAMPLES, "--resume"),
            "interrupted.h5.checkpoint",
            "version",
        )
        self.assertNotEqual(path.read_bytes(), content)


if __name__ == "__main__":
    unittest.main()
