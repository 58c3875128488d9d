"""A few of the kills of test_kill_long.py."""

from kills import KilledServer


class Kill(KilledServer):
    def test_ten_times(self):
        self.kill_often(10)
