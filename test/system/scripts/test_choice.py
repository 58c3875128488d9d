"""The choice of slow tests for a change (scripts/choose-tests)."""

import importlib.machinery
import importlib.util
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from harness import BUILD, ROOT

sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("choose_tests", str(ROOT / "scripts/choose-tests"))
choose = importlib.util.module_from_spec(importlib.util.spec_from_loader("choose_tests", loader))
loader.exec_module(choose)

# A change of these files -> tests that it concerns, and tests that it does not.
CHANGES = [
    ({"src/shelfbeam/report/page/a.cpp"}, ["claims.AllSlow", "planner.SlowDxf"], ["plan.ASlow", "physics.ASlow"]),
    ({"src/shelfbeam/plan/certify.cpp"}, ["plan.ASlow", "physics.ASlow", "batch.chain_slow"], ["signal.ASlow"]),
    ({"src/shelfbeam/plan/certify.cpp"}, ["transport.ResumeSlow.A"], ["transport.ZooSlow.A"]),
    ({"src/shelfbeam/math/vec3.hpp"}, ["signal.ASlow", "plan.ASlow", "planner.SlowDxf"], ["study.quick_slow"]),
    ({"src/page/planner/a.ts"}, ["planner.SlowDxf"], ["python.types_slow", "batch.chain_slow"]),
    ({"src/page/report/a.ts"}, ["report.print_slow"], ["claims.AllSlow"]),
    ({"src/page/planner/english.json"}, ["batch.chain_slow"], ["study.quick_slow"]),
    ({"test/system/viewer/browser.mjs"}, ["planner.SlowDxf"], ["batch.chain_slow"]),
    ({"test/system/viewer/charts_test.mjs"}, ["viewer.SlowBrowser"], ["planner.SlowDxf"]),
    ({"test/unit/scene/sample_store.hpp"}, ["transport.ASlow", "plan.ASlow"], ["material.ASlow"]),
    ({"test/physics/bare_scene.hpp"}, ["physics.ASlow", "plan.ASlow"], ["material.ASlow"]),
    ({"docs/python/first_plan.ipynb"}, ["python.gallery_slow", "guides.readme_slow"], ["batch.chain_slow"]),
    ({"study/core/printed_tables.py"}, ["program.thesis_tables_slow", "study.quick_slow"], ["batch.chain_slow"]),
    ({"test/unit/signal/a_test.cpp"}, ["signal.ASlow"], ["plan.ASlow"]),
    ({"test/system/study/test_quick_slow.py"}, ["study.quick_slow"], ["batch.chain_slow"]),
    ({"README.md", "CHANGELOG.md"}, ["guides.readme_slow"], ["batch.chain_slow"]),
    ({"scripts/build"}, ["signal.ASlow", "batch.chain_slow"], ["study.quick_slow"]),
    ({"CHANGELOG.md", ".ci/green"}, [], ["guides.readme_slow", "signal.ASlow"]),
]
LAYERS = {
    "batch": "app",
    "claims": "app",
    "guides": "app",
    "physics": "transport",
    "planner": "page",
    "program": "app",
    "report": "page",
    "study": "nightly",
    "viewer": "page",
}


class Choosing(unittest.TestCase):
    def setUp(self):
        self.needs = choose.needs_of_layers()

    def test_a_change_concerns_its_layer_and_those_above(self):
        for paths, run, omit in CHANGES:
            choice = choose.Choice({choose.concern_of(path) for path in paths}, self.needs)
            chosen = {
                name: choice.reason(name, LAYERS.get(folder := name.split(".")[0], folder)) for name in [*run, *omit]
            }
            self.assertEqual([name for name, reason in chosen.items() if reason], run, paths)

    def test_all_layers_are_known(self):
        folders = [*(ROOT / "src").iterdir(), *(ROOT / "src/shelfbeam").iterdir()]
        layers = {path.name for path in folders if path.is_dir()} - {"shelfbeam"}
        self.assertEqual(layers, self.needs.keys())
        self.assertEqual(choose.layers_above({"base"}, self.needs), layers)

    def test_every_tracked_file_has_a_concern_that_exists(self):
        tracked = subprocess.check_output(["git", "ls-files"], cwd=ROOT, text=True).splitlines()
        for path in tracked:
            kind, _, name = choose.concern_of(path).partition(" ")
            if kind == "layer":
                self.assertIn(name, self.needs, path)

    @unittest.skipUnless((BUILD / "test/layers.txt").exists(), "needs the build")
    def test_the_test_that_notices_a_planted_fault_is_chosen(self):
        slow = {name: layer for _, name, layer in choose.slow_tests()}
        lines = (ROOT / "scripts/hardening/planted.tsv").read_text(encoding="utf-8").splitlines()
        faults = [line.split("\t") for line in lines if not line.startswith("#")]
        self.assertEqual(len(faults), 30)
        slow_only = [fault for fault in faults if fault[-1] in slow]
        self.assertGreaterEqual(len(slow_only), 5)
        for number, _, path, _, _, test in slow_only:
            self.assertTrue(choose.Choice({choose.concern_of(path)}, self.needs).reason(test, slow[test]), number)
            self.assertFalse(choose.Choice(set(), self.needs).reason(test, slow[test]), "the control: nothing changed")

    def test_files_that_differ_from_a_revision(self):
        with tempfile.TemporaryDirectory() as folder:
            checkout = pathlib.Path(folder)

            def git(*words):
                settings = ("-c", "user.name=a", "-c", "user.email=a@example.org", "-c", "commit.gpgsign=false")
                return subprocess.check_output(["git", *settings, *words], cwd=checkout, text=True).strip()

            def commit(files):
                for name, text in files.items():
                    (checkout / name).write_text(text, encoding="utf-8")
                git("add", "--all")
                git("commit", "--quiet", "--message=a")
                return git("rev-parse", "HEAD")

            git("init", "--quiet", ".")
            first = commit({"kept": "1", "edited": "2", "deleted": "3", "renamed": "4" * 100})
            self.assertEqual(choose.changed_since(first, checkout), [])
            git("mv", "renamed", "name")
            (checkout / "deleted").unlink()
            second = commit({"edited": "5"})
            (checkout / "untracked").touch()
            found = choose.changed_since(first, checkout)
            self.assertEqual(found, ["deleted", "edited", "name", "renamed", "untracked"])
            git("checkout", "--quiet", "-b", "other", first)
            commit({"kept": "6"})
            self.assertEqual(choose.changed_since(second, checkout)[:3], ["deleted", "edited", "kept"])
            for unknown in ("nowhere", "", "--help"):
                self.assertIsNone(choose.changed_since(unknown, checkout), unknown)
            tree = git("rev-parse", f"{second}^{{tree}}")
            (checkout / ".git/objects" / tree[:2] / tree[2:]).unlink()
            self.assertIsNone(choose.changed_since(second, checkout), "a part of the revision is lost")

    @unittest.skipUnless((BUILD / "test/layers.txt").exists(), "needs the build")
    def test_slow_tests_have_layers(self):
        found = list(choose.slow_tests())
        listed = subprocess.check_output(["ctest", "--test-dir", BUILD, "-N", "-L", "slow"], text=True)
        self.assertEqual(len(found), int(re.search(r"Total Tests: (\d+)", listed)[1]))
        self.assertLessEqual({layer for _, _, layer in found}, self.needs.keys() | {"nightly"})


if __name__ == "__main__":
    unittest.main()
