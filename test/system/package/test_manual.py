"""The manual pages and completion scripts say what the command line is."""

import os
import pathlib
import re
import shutil
import subprocess
import unittest

PROGRAM = os.environ["SHELFBEAM"]
MANUAL = pathlib.Path(os.environ["SHELFBEAM_MANUAL"])
BASH = MANUAL / "bash-completion/completions/shelfbeam"
ZSH = MANUAL / "zsh/vendor-completions/_shelfbeam"


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def verbs():
    listed = output(PROGRAM, "--help").split("Subcommands:")[1].split("Exit codes:")[0]
    return re.findall(r"^  (\w+) ", listed, re.MULTILINE)


def options(*verb):
    """Long names in the help of a verb, where an option begins."""
    return re.findall(r"^  (?:-\w,)?(--[\w-]+)", output(PROGRAM, *verb, "--help"), re.MULTILINE)


def page(name):
    return (MANUAL / "man/man1" / (name + ".1")).read_text(encoding="utf-8").replace("\\-", "-")


def completed(*words):
    script = f'source "{BASH}"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _shelfbeam; echo "${{COMPREPLY[@]}}"'
    return output("bash", "-c", script, "bash", "shelfbeam", *words).split()


class Manual(unittest.TestCase):
    def test_has_a_page_for_every_verb_and_no_other(self):
        self.assertGreaterEqual(len(verbs()), 9)
        pages = {file.stem for file in (MANUAL / "man/man1").iterdir()}
        self.assertEqual(pages, {"shelfbeam"} | {"shelfbeam-" + verb for verb in verbs()})

    def test_has_every_option(self):
        for verb in verbs():
            self.assertGreaterEqual(len(options(verb)), 3, verb)
            for option in options(verb):
                self.assertIn(f"\\fB{option}\\fR", page("shelfbeam-" + verb), verb)
        for option in options():
            self.assertIn(f"\\fB{option}\\fR", page("shelfbeam"))

    @unittest.skipUnless(shutil.which("groff"), "groff is missing")
    def test_is_roff_without_warnings(self):
        for file in (MANUAL / "man/man1").iterdir():
            run = subprocess.run(["groff", "-man", "-ww", "-z", file], capture_output=True, text=True)
            self.assertEqual((run.returncode, run.stderr), (0, ""), file.name)


class Completion(unittest.TestCase):
    def test_completes_verbs_options_and_choices(self):
        self.assertEqual(completed("pla"), ["place", "plan"])
        self.assertEqual(set(completed("")) & set(verbs()), set(verbs()))
        self.assertEqual(completed("simulate", "--estimator", "u"), ["uniform"])
        self.assertEqual(completed("new", "g"), ["grocery"])
        self.assertEqual(completed("plan", "--nothing"), [])
        for verb in verbs():
            self.assertEqual(set(options(verb)) - set(completed(verb, "--")), set(), verb)

    @unittest.skipUnless(shutil.which("zsh"), "zsh is missing")
    def test_zsh_reads_its_script(self):
        output("zsh", "-n", ZSH)
        for verb in verbs():
            self.assertIn(f"    {verb})\n", ZSH.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
