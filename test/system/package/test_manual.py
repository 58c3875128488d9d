"""Tests that the manual pages and the completion agree with the help of the program."""

import functools
import re
import shlex
import unittest

from harness import BUILD, PROGRAM, ROOT, has, output, run

PAGES = BUILD / "manual/man1"
COMPLETION = ROOT / "data/completion.bash"


@functools.cache
def verbs():
    listed = output("--help").split("Verbs:")[1].split("Exit codes:")[0]
    return re.findall(r"^  (\w+) ", listed, re.MULTILINE)


@functools.cache
def options(verb=""):
    """The long option names in the help of a verb."""
    return re.findall(r"^  (?:-\w,)?(--[\w-]+)", output(f"{verb} --help"), re.MULTILINE)


@unittest.skipUnless(has("help2man"), "help2man is missing, so there are no manual pages")
class Manual(unittest.TestCase):
    def test_has_a_page_for_every_verb_and_no_other(self):
        self.assertGreaterEqual(len(verbs()), 9)
        pages = {file.stem for file in PAGES.iterdir()}
        self.assertEqual(pages, {"shelfbeam"} | {"shelfbeam-" + verb for verb in verbs()})

    def test_describes_every_option(self):
        for verb in ("", *verbs()):
            page = (PAGES / f"shelfbeam-{verb}.1".replace("-.", ".")).read_text(encoding="utf-8")
            self.assertGreaterEqual(len(options(verb)), 2, verb)
            for option in options(verb):
                plain = re.sub(r"\\f.|\\(?=-)", "", page)
                self.assertRegex(plain, rf"\n\.TP\n(-\w,)?{option}\b.*\n[^.].*\n", verb)

    @unittest.skipUnless(has("groff"), "groff is missing")
    def test_is_roff_without_warnings(self):
        for file in PAGES.iterdir():
            end = run("-man", "-ww", "-z", file, program="groff")
            self.assertEqual((end.status, end.err), (0, ""), file.name)


class Completion(unittest.TestCase):
    LOAD = {"bash": "", "zsh": "autoload -Uz compinit; compinit -u -D; "}
    SOURCE = f'source "{COMPLETION}"; [ -z "$ZSH_VERSION" ] || emulate sh'
    ASK = 'COMPREPLY=(); COMP_WORDS=({}); COMP_CWORD={}; _shelfbeam; echo "${{COMPREPLY[@]}}"'

    def completes(self, shell, *rows):
        """Expects the choices after words; a row is a list of words, the last of which is incomplete, and choices."""
        asks = [self.ASK.format(shlex.join([PROGRAM, *words]), len(words)) for words, _ in rows]
        found = output("-c", "\n".join([self.LOAD[shell] + self.SOURCE, *asks]), program=shell).splitlines()
        for (words, choices), line in zip(rows, found, strict=True):
            self.assertEqual(line.split(), choices, words)

    def test_bash_completes_verbs_options_and_choices(self):
        self.completes(
            "bash",
            ([""], verbs()),
            (["pla"], ["place", "plan"]),
            (["simulate", "--estimator", "u"], ["uniform"]),
            (["new", "g"], ["grocery"]),
            (["plan", "--nothing"], []),
            (["plan", "store.json", "-o", ""], []),
            *(([verb, "--"], options(verb)) for verb in verbs()),
        )

    # zsh itself removes candidates that do not begin with the word.
    @unittest.skipUnless(has("zsh"), "zsh is missing")
    def test_zsh_reads_the_same_file(self):
        estimators = ["reuse", "uniform"]
        self.completes(
            "zsh", (["pla"], verbs()), (["plan", "--"], options("plan")), (["simulate", "--estimator", "u"], estimators)
        )
