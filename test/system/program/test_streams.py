"""Closed and full standard streams, and pipes without a reader."""

import os
import signal
import subprocess

from harness import FEW, PROGRAM, ShopTest, run, words_of

SIMULATE = f"simulate store.json {FEW} -o"


class Streams(ShopTest):
    def redirected(self, line, redirection):
        """The end of a run with a redirection of the shell."""
        command = ["-c", f'exec "$0" "$@" {redirection}', PROGRAM, *words_of([line])]
        return run(*command, program="/bin/sh", cwd=self.folder)

    def without_reader(self, line, stream):
        """The end of a run with one stream into a pipe without a reader."""
        reader, writer = os.pipe()
        os.close(reader)
        streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, stream: writer}
        done = subprocess.run([PROGRAM, *words_of([line])], cwd=self.folder, check=False, **streams)
        os.close(writer)
        return done

    def test_messages_that_cannot_be_written_keep_the_exit_code(self):
        for redirection in ("", "2>&-", "2>/dev/full", "2>&- >&- <&-"):
            for line, status in (("inspect missing.json", 2), ("unknown", 2), (f"{SIMULATE} signal.h5 --quiet", 0)):
                self.assertEqual(self.redirected(line, redirection).status, status, f"{line} {redirection}")
        done = self.without_reader("inspect missing.json", "stderr")
        self.assertEqual((done.returncode, done.stdout), (2, b""))

    def test_results_that_cannot_be_printed_are_an_error(self):
        lines = ("inspect store.json", "inspect store.json --json", "--help", "--version", f"{SIMULATE} signal.h5")
        for redirection in (">&-", ">/dev/full"):
            for line in lines:
                end = self.redirected(line, redirection)
                self.assertEqual(end.status, 2, f"{line} {redirection}")
                self.assertRegex(end.err, r"\Aerror: standard output: cannot be written \(", f"{line} {redirection}")
        self.told("place signal.h5 --quiet")  # it was written nevertheless

    def test_closed_streams_do_not_overwrite_outputs(self):
        """Without replacements, the first file of the program takes the number of standard output or error."""
        self.told(f"{SIMULATE} expected.h5 --quiet")
        self.assertEqual(self.redirected(f"{SIMULATE} signal.h5", "<&- >&- 2>&-").status, 2)
        self.assertEqual(self.bytes("signal.h5"), self.bytes("expected.h5"))

    def test_a_closed_pipe_ends_the_program_quietly(self):
        done = self.without_reader("inspect store.json", "stdout")
        self.assertEqual((done.returncode, done.stderr), (-signal.SIGPIPE, b""))
