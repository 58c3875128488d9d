"""A hundred kills: no acknowledged edit is lost, store.json is whole, and the history goes on."""

from kills import KilledServer


class Kill(KilledServer):
    def test_a_hundred_times(self):
        self.kill_often(100, seed=2)
