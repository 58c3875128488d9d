"""Simulations in parts, killed, resumed and merged."""

import itertools
import signal
from concurrent.futures import ThreadPoolExecutor

from harness import ProgramTest, contents, small_store, store_with


def spaced(metres):
    """The small store with a label at each multiple of a distance.

    0.1 m gives enough labels for four groups of neighbours, 0.2 m for two.
    """
    return store_with({"fixtures/0/labels/spacing": metres})


class PartsTest(ProgramTest):
    def simulate_with_kills(self, name, options):
        """Simulates with kills: before the first checkpoint, then a little later each time. Returns their number."""
        line = f"simulate store.json {options} -o {name} --checkpoint-interval 0 --resume --threads 1"
        for kills in itertools.count():
            process = self.start(line)
            if kills == 0:
                process.wait_for_changes(self.folder / f".{name}.shelfbeam-locked")
            else:
                # The first change of a resumed run is the file that it finds.
                process.wait_for_changes(self.folder / f"{name}.checkpoint", (kills - 1) ** 2 + 1)
            end = process.end(signal.SIGKILL)
            if end.status != -signal.SIGKILL:
                self.assertEqual(end.status, 0, end)
                return kills

    def check_that_parts_give_the_bytes_of_one_run(self, options):
        """Simulates four parts, two at a time, with kills, and merges them in another order."""
        self.told(f"simulate store.json {options} -o whole.h5")
        with ThreadPoolExecutor(2) as pool:
            parts = {f"{k}.h5": f"{options} --part {k}/4" for k in range(1, 5)}
            kills = sum(pool.map(self.simulate_with_kills, parts, parts.values()))
        self.assertGreater(kills, 9)
        self.assertIn("from 4 parts", self.told("merge 3.h5 1.h5 4.h5 2.h5 -o merged.h5"))
        self.assertEqual(self.bytes("merged.h5"), self.bytes("whole.h5"))
        self.assertEqual(contents(self.folder).keys(), {*parts, "merged.h5", "store.json", "whole.h5"})


class Parts(PartsTest):
    def test_parts_of_bounces_give_the_bytes_of_one_run(self):
        self.write("store.json", spaced(0.1))
        self.check_that_parts_give_the_bytes_of_one_run("--samples 1000 --max-bounces 3 --by-bounce --seed 5")

    def test_parts_of_states_give_the_bytes_of_one_run(self):
        self.write("store.json", small_store(variation={"unit_power_db": 1}))
        self.check_that_parts_give_the_bytes_of_one_run("--states 40 --hard-labels 3")

    def test_merged_parts_give_the_plan_of_one_run(self):
        self.write("store.json", spaced(0.2))
        for line in (
            "plan store.json --samples 640 -o one",
            "simulate store.json --samples 640 --part 1/2 -o 1.h5",
            "simulate store.json --samples 640 --part 2/2 -o 2.h5",
            "merge 1.h5 2.h5 -o signal.h5",
        ):
            self.told(line)
        self.says("plan store.json --signal signal.h5 -o merged", "read from ")
        self.refused_each(
            ("plan store.json --signal 1.h5 -o other", "1.h5: is part 1 of 2", "merge all parts"),
            ("place 1.h5", "1.h5: is part 1 of 2"),
            ("merge 1.h5 -o again.h5", "number 2 is missing", "simulate them, or name their files"),
            ("merge 1.h5 2.h5 -o 1.h5", "is also the input"),
            ("simulate store.json --part 3/2 -o 3.h5", "--part: '3/2' is not a part such as 2/4"),
            ("simulate store.json --part 1/2 --time 5 -o 3.h5", "--time", "--part"),
            ("simulate store.json --part 1/5000 -o 3.h5", "is too small: the labels form", "use at most"),
            ("simulate store.json --part 1/2 --strategy particle -o 3.h5", "requires walks from labels"),
        )
        for name in ("signal.h5", "store.json", "labels.csv", "placement.csv", "mounting.csv"):
            self.assertEqual(self.bytes(f"merged/{name}"), self.bytes(f"one/{name}"), name)
        self.check_values("merged/placement.json", selected=self.json("one/placement.json")["selected"])

    def test_a_stopped_part_writes_its_checkpoint_only(self):
        self.write("store.json", small_store())
        simulate = "simulate store.json --estimator uniform --samples 500000 -o 1.h5"
        process = self.start(f"{simulate} --part 2/4 --checkpoint-interval 0")
        process.wait_for_changes(self.folder / "1.h5.checkpoint", 2)
        self.assertIn("the part was stopped before it was complete", self.interrupt(process).err)
        self.assertEqual(contents(self.folder).keys(), {"1.h5.checkpoint", "store.json"})
        other = ("1.h5.checkpoint: belongs to another simulation", "part is '2 of 4' instead of '3 of 4'")
        self.refused(f"{simulate} --part 3/4 --resume", *other)
