"""The choice of slow tests for a change (scripts/choose-tests)."""

import importlib.machinery
import importlib.util
import subprocess
import sys
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
    "study": "nightly",
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
        for number, _, path, _, _, test in faults:
            choice = choose.Choice({choose.concern_of(path)}, self.needs)
            self.assertTrue(test not in slow or choice.reason(test, slow[test]), number)

    def test_an_unknown_revision_is_no_revision(self):
        self.assertIsNone(choose.changed_since("nowhere"))
        self.assertIsNone(choose.changed_since(""))
        self.assertIsNotNone(choose.changed_since("HEAD"))

    @unittest.skipUnless((BUILD / "test/layers.txt").exists(), "needs the build")
    def test_slow_tests_have_layers(self):
        found = list(choose.slow_tests())
        self.assertGreater(len(found), 50)
        self.assertLessEqual({layer for _, _, layer in found}, self.needs.keys() | {"nightly"})


if __name__ == "__main__":
    unittest.main()
