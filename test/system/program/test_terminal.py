"""The program on a pseudo-terminal."""

import fcntl
import os
import pty
import re
import struct
import termios

from harness import PROGRAM, ShopTest, words_of

BOLD = "\033[1m"
ERROR = "\033[1;31merror:\033[0m "


class Terminal(ShopTest):
    def shown(self, line, columns=80, **variables):
        """Everything that the program writes to a terminal of this width."""
        environment = {name: value for name, value in os.environ.items() if name != "NO_COLOR"}
        environment |= {"TERM": "xterm", **variables}
        child, terminal = pty.fork()
        if child == 0:
            try:
                os.chdir(self.folder)
                fcntl.ioctl(0, termios.TIOCSWINSZ, struct.pack("4H", 0, columns, 0, 0))
                os.execve(PROGRAM, [PROGRAM, *words_of([line])], environment)
            finally:
                os._exit(127)
        parts = []
        with open(terminal, "rb", buffering=0) as stream:
            try:
                while part := stream.read(4096):
                    parts.append(part)
            except OSError:  # Linux reports the end of the output as this error.
                pass
        _, status = os.waitpid(child, 0)
        text = b"".join(parts).decode()
        self.assertTrue(os.WIFEXITED(status), text)
        return text

    def drawn(self, line, columns, **variables):
        """The progress lines; the result follows the last clearing."""
        _, *lines = self.shown(line, columns, **variables).split("\r\033[K")
        return [re.split("[\r\n]", one)[0] for one in lines[:-1]]

    def test_progress_fits_narrow_windows(self):
        run = "simulate store.json -o signal.h5 --samples 4000 --threads 1"
        for columns in (40, 100):
            lines = self.drawn(run, columns)
            self.assertGreater(len(lines), 1)
            for line in lines:
                self.assertTrue(line.isascii() and len(line) < columns, line)
            self.assertTrue(any(line.startswith("simulating") for line in lines), lines)
        self.assertEqual(self.drawn(run, 40, TERM="dumb"), [])
        self.assertEqual(self.drawn(f"{run} --quiet", 40), [])

    def test_colours_are_for_terminals_that_want_them(self):
        self.write("matrix.csv", "label,T1,T2\nL1,1,2\nL2,3,0\n")
        place, none = "place matrix.csv --threshold 2", "place none.csv"
        for line, part in (
            (place, f"{BOLD}2 transceivers reach"),
            (none, ERROR),
            ("plan store.json --sampels 3", f"{ERROR}unknown option"),
        ):
            self.assertIn(part, self.shown(line))
        for line in (place, none):
            for variable in ({"NO_COLOR": "1"}, {"TERM": "dumb"}):
                self.assertNotIn("\033[1", self.shown(line, **variable))
        self.assertNotIn("\033[1", self.shown(f"{place} --json"))
        self.assertNotIn("\033", self.told(place))
