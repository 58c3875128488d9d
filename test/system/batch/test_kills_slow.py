"""A batch that is killed often ends with the results of an undisturbed one."""

import pathlib
import random
import signal
import subprocess
import tempfile
import unittest

import chain

KILLS = 20


class Killed(unittest.TestCase):
    def test_60_shops_killed_20_times(self):
        with tempfile.TemporaryDirectory() as temporary:
            folder = pathlib.Path(temporary)
            chain.make_chain(folder / "shops", "--count", 60)
            options = ["--", "--samples", "2000"]
            whole, killed = folder / "whole", folder / "killed"
            ended = chain.shelfbeam("batch", folder / "shops", "-o", whole, *options)
            self.assertEqual(ended.returncode, 1, ended.stderr)
            statuses = [row["status"] for row in chain.rows(whole)]
            self.assertEqual({name: statuses.count(name) for name in sorted(set(statuses))},
                             {"failed": 6, "infeasible": 6, "planned": 48})

            rng, kills = random.Random(1), 0
            command = [chain.PROGRAM, "batch", folder / "shops", "-o", killed, "--resume", *options]
            while True:
                process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                try:
                    _, err = process.communicate(timeout=rng.uniform(0.1, 3) if kills < KILLS else None)
                    self.assertEqual(process.returncode, 1, err)
                    break
                except subprocess.TimeoutExpired:
                    process.send_signal(signal.SIGKILL)
                    process.communicate()
                    kills += 1
            self.assertEqual(kills, KILLS, "the batch ended before all kills")
            self.assertEqual(chain.differences(killed, whole), [])
            # The control: one different byte is found.
            with open(killed / "plans/0001-valid/labels.csv", "ab") as file:
                file.write(b"\n")
            self.assertEqual(chain.differences(killed, whole), ["plans/0001-valid/labels.csv"])


if __name__ == "__main__":
    unittest.main()
