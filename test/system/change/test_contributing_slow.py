"""Tests that the first change of CONTRIBUTING.md works as the page states, that no step can be omitted, and that the
scripts that check changes notice faults.
"""

import os
import pathlib
import re
import unittest

import example


class FirstChange(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if reason := example.cannot_run(pathlib.Path(os.environ["SHELFBEAM_BUILD"])):
            if "CI" in os.environ:
                raise AssertionError(reason)
            raise unittest.SkipTest(reason)
        blocks = example.blocks(example.PAGE.read_text(encoding="utf-8"), "Your first change")
        cls.code, cls.test, cls.documentation = (text for kind, text in blocks if kind == "diff")
        cls.commands = [line for kind, text in blocks if kind == "sh" for line in text.splitlines()]
        (cls.command,) = {line for line in cls.commands if line.startswith("scripts/test ")}
        cls.copy = example.Copy({"test_report"})
        cls.copy.run(
            "git init --quiet --initial-branch main; git config user.name test; git config user.email test; "
            "git add --all; git commit --quiet --message base; scripts/install-hook"
        )

    @classmethod
    def tearDownClass(cls):
        cls.copy.close()

    def failed_tests(self):
        code, printed = self.copy.run(self.command)
        failed = set(re.findall(r"^\s*\d+ - report\.(\S+) \([^)]+\)", printed, re.MULTILINE))
        self.assertEqual(code == 0, not failed, printed)
        self.assertEqual("100% tests passed" in printed, not failed, printed)
        return failed

    def test_all_steps_are_needed(self):
        values, names = "LabelsCsv.AgreesWithThePlacement", "LabelsCsv.DocumentationNamesAllColumns"
        self.assertEqual(self.failed_tests(), set())
        self.copy.apply(self.code)
        self.assertEqual(self.failed_tests(), {values, names})
        self.copy.apply(self.test)
        self.assertEqual(self.failed_tests(), {names})
        self.copy.apply(self.documentation)
        self.assertEqual(self.failed_tests(), set())
        self.assertEqual(self.commands[-2:], ["scripts/check/changed", "git commit --all"])
        code, printed = self.copy.run("scripts/check/changed")
        self.assertEqual(code, 0, printed)
        self.assertRegex(printed, r"changed files: 3\n(.*\n)*changed: tests of .*report.*: \d(.*\n)*changed: tidy: \d")
        self.assertEqual(self.copy.run("git commit --quiet --all --message 'Add a column'"), (0, ""))
        self.assertEqual(self.copy.run("git status --short"), (0, ""))
        self.copy.apply(self.code, "--reverse")
        self.addCleanup(self.copy.run, "git checkout --quiet .")
        self.assertEqual(self.failed_tests(), {values, names})

    def test_the_hook_checks_style(self):
        self.assertIn("scripts/install-hook", self.commands)
        self.put("study/wrong.py", "import os\n")
        code, printed = self.copy.run("git add study/wrong.py; git commit --quiet --message wrong")
        self.assertNotEqual(code, 0)
        self.assertIn("`os` imported but unused", printed)
        self.copy.run("git reset --quiet")

    def put(self, path, text):
        (self.copy.tree / path).parent.mkdir(exist_ok=True)
        (self.copy.tree / path).write_text(text, encoding="utf-8")
        self.addCleanup((self.copy.tree / path).unlink)

    def test_style_is_checked(self):
        wrong = {
            "src/app/wrong.cpp": ("int  main() {}\n", "not formatted"),
            "study/wrong.py": ("import os\n", r"1: .*`os` imported but unused \[F401\]"),
            "scripts/wrong": ("#!/usr/bin/env python3\nx = 'a'\n", "not formatted"),
            "src/page/wrong.ts": ("export function f() {\n  debugger;\n}\n", r"2: .*\[lint/suspicious/noDebugger\]"),
            "src/page/wrong.css": ("a { color: red; color: blue; }\n", r"1: .*\[lint/suspicious/\w+\]"),
            "src/shelfbeam/math/wrong.hpp": ('#include "shelfbeam/plan/plan.hpp"\n', "1: .* is not for 'math'.*"),
        }
        for path, (text, _) in wrong.items():
            self.put(path, text)
        code, printed = self.copy.run("scripts/check/style " + " ".join(wrong))
        self.assertEqual(code, 1, printed)
        for path, (_, problem) in wrong.items():
            self.assertRegex(printed, rf"(?m)^{path}:{' ?'}{problem}$")
        self.assertEqual(len(printed.splitlines()), len(wrong) + 1, printed)

    def test_changed_files_are_checked(self):
        self.assertEqual(self.copy.run("scripts/check/changed"), (0, "changed: nothing has changed since main\n"))
        self.put("/".join(("docs", "note.md")), "A page that no test names.\n")
        code, printed = self.copy.run("scripts/check/changed")
        self.assertEqual(code, 0, printed)
        self.assertRegex(printed, r"changed files: 1\n(.*\n)*changed: style: \d+\.\d s\n")
        self.put("study/wrong.py", "import os\n")
        code, printed = self.copy.run("scripts/check/changed")
        self.assertEqual(code, 1, printed)
        self.assertIn("style: failed", printed)
        self.assertNotIn("study.parts", printed)
        self.assertNotEqual(self.copy.run("scripts/check/changed no-such-branch")[0], 0)

    def test_deleted_files_count_as_changed(self):
        self.copy.run("rm LICENSE")
        self.addCleanup(self.copy.run, "git checkout --quiet LICENSE")
        code, printed = self.copy.run("scripts/check/changed")
        self.assertEqual(code, 0, printed)
        self.assertIn("changed files: 1\n", printed)


if __name__ == "__main__":
    unittest.main()
