"""Tests that the manual pages and the completion agree with the help of the program."""

import functools
import os
import pathlib
import re
import shutil
import subprocess
import unittest

PROGRAM = os.environ["SHELFBEAM"]
PAGES = pathlib.Path(os.environ["SHELFBEAM_BUILD"]) / "manual/man1"
COMPLETION = pathlib.Path(__file__).parents[3] / "data/completion.bash"


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def has(program):
    """True in continuous integration, too: there a test without its program fails instead of being skipped."""
    return "CI" in os.environ or shutil.which(program)


@functools.cache
def verbs():
    listed = output(PROGRAM, "--help").split("Verbs:")[1].split("Exit codes:")[0]
    return re.findall(r"^  (\w+) ", listed, re.MULTILINE)


@functools.cache
def options(*verb):
    """The long option names in the help of a verb."""
    return re.findall(r"^  (?:-\w,)?(--[\w-]+)", output(PROGRAM, *verb, "--help"), re.MULTILINE)


@unittest.skipUnless(has("help2man"), "help2man is missing, so there are no manual pages")
class Manual(unittest.TestCase):
    def test_has_a_page_for_every_verb_and_no_other(self):
        self.assertGreaterEqual(len(verbs()), 9)
        pages = {file.stem for file in PAGES.iterdir()}
        self.assertEqual(pages, {"shelfbeam"} | {"shelfbeam-" + verb for verb in verbs()})

    def test_describes_every_option(self):
        for verb in [[], *([verb] for verb in verbs())]:
            page = (PAGES / ("-".join(["shelfbeam", *verb]) + ".1")).read_text(encoding="utf-8")
            self.assertGreaterEqual(len(options(*verb)), 2, verb)
            for option in options(*verb):
                plain = re.sub(r"\\f.|\\(?=-)", "", page)
                self.assertRegex(plain, rf"\n\.TP\n(-\w,)?{option}\b.*\n[^.].*\n", verb)

    @unittest.skipUnless(has("groff"), "groff is missing")
    def test_is_roff_without_warnings(self):
        for file in PAGES.iterdir():
            run = subprocess.run(["groff", "-man", "-ww", "-z", file], capture_output=True, text=True)
            self.assertEqual((run.returncode, run.stderr), (0, ""), file.name)


class Completion(unittest.TestCase):
    LOAD = {"bash": "", "zsh": "autoload -Uz compinit; compinit -u -D; "}
    ASK = (
        f'source "{COMPLETION}"; [ -z "$ZSH_VERSION" ] || emulate sh; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); '
        '_shelfbeam; echo "${COMPREPLY[@]}"'
    )

    def completed(self, shell, *words):
        return output(shell, "-c", self.LOAD[shell] + self.ASK, shell, PROGRAM, *words).split()

    def test_bash_completes_verbs_options_and_choices(self):
        self.assertEqual(self.completed("bash", ""), verbs())
        self.assertEqual(self.completed("bash", "pla"), ["place", "plan"])
        self.assertEqual(self.completed("bash", "simulate", "--estimator", "u"), ["uniform"])
        self.assertEqual(self.completed("bash", "new", "g"), ["grocery"])
        self.assertEqual(self.completed("bash", "plan", "--nothing"), [])
        self.assertEqual(self.completed("bash", "plan", "store.json", "-o", ""), [])
        for verb in verbs():
            self.assertEqual(self.completed("bash", verb, "--"), options(verb))

    # zsh itself removes candidates that do not begin with the word.
    @unittest.skipUnless(has("zsh"), "zsh is missing")
    def test_zsh_reads_the_same_file(self):
        self.assertEqual(self.completed("zsh", "pla"), verbs())
        self.assertEqual(self.completed("zsh", "plan", "--"), options("plan"))
        self.assertIn("uniform", self.completed("zsh", "simulate", "--estimator", "u"))


if __name__ == "__main__":
    unittest.main()
