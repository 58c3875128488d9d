"""Files that cannot be written. scripts/hardening/inject-faults found these faults; it injects many more."""

import errno
import os
import resource
import shutil
import signal
import unittest

from harness import BUILD, FEW, PreparedTest, ShopTest, contents, sanitizers

SHIM = os.environ.get("SHELFBEAM_FAULT_SHIM", str(BUILD / "test/libfault_shim.so"))
PLAN = f"plan store.json -o plan {FEW} --no-certificate --quiet"


class FaultTest(ShopTest):
    def with_largest_file(self, size, line, *parts):
        """Expects that the program fails with these parts of the error if its files may not exceed a size."""
        end = self.run_here(line, limits=[(resource.RLIMIT_FSIZE, size)])
        self.check_failed(end, *parts)

    def check_failed(self, end, *parts):
        self.assertEqual(end.status, 2, end)
        for part in parts:
            self.assertIn(part, end.err)

    def with_failing_renaming(self, number, error, line, more=0):
        """The end of a run in which the n-th renaming and `more` after it fail, or which is killed there (error 0)."""
        (self.folder / "tmp").mkdir(exist_ok=True)
        fault = {"FAULT_OF": "rename", "FAULT_AT": number, "FAULT_ERRNO": error, "FAULT_LASTS": more}
        settings = {"LD_PRELOAD": SHIM, "TMPDIR": self.folder / "tmp", **fault}
        return self.run_here(line, env={**os.environ, **{name: str(value) for name, value in settings.items()}})

    def kept(self):
        """The only folder among the temporary files, in which a result was kept."""
        (folder,) = (self.folder / "tmp").iterdir()
        return folder

    def check_all_but_checkpoint(self, folder, before):
        """A checkpoint of the complete simulation is all that was added to a folder."""
        found = contents(folder)
        added = found.keys() - before.keys()
        self.assertEqual({name.removeprefix("plan/") for name in added}, {"signal.h5.checkpoint"})
        self.assertEqual({name: found.get(name) for name in before}, before)


class FileSizes(FaultTest):
    def test_simulations_stay(self):
        simulate = "simulate store.json -o signal.h5 --samples 640"
        before = contents(self.folder)
        self.with_largest_file(8192, simulate, "signal.h5: ", "File too large", "(--resume)")
        self.check_all_but_checkpoint(self.folder, before)
        self.says(f"{simulate} --resume", "continued from the checkpoint, which contained ")
        resumed = self.bytes("signal.h5")
        self.told(simulate)
        self.assertEqual(self.bytes("signal.h5"), resumed)
        before = contents(self.folder)
        # Not even the checkpoint can be written.
        self.with_largest_file(4096, f"{simulate} --seed 2", "signal.h5: ", "File too large", "unchanged")
        self.assertEqual(contents(self.folder), before)

    def test_the_old_plan_stays(self):
        """The report is the largest file and is written last."""
        plan = "plan store.json -o plan --samples 640 --estimator uniform"
        self.told(plan)
        before = contents(self.folder)
        signals, report = (len(before[f"plan/{name}"]) for name in ("signal.h5", "report.html"))
        self.assertGreater(report, signals + 20_000, "nothing to tell the two apart by")
        other = f"{plan} --seed 2 --overwrite"
        self.with_largest_file((signals + report) // 2, other, "report.html: ", "File too large", "unchanged")
        self.check_all_but_checkpoint(self.folder, before)
        self.told("report plan")


@unittest.skipIf(sanitizers(), "faults cannot be preloaded before sanitizers")
class Renaming(FaultTest, PreparedTest):
    def prepare(self):
        self.told(PLAN)

    def test_an_unchanged_plan_needs_no_restoration(self):
        """A folder that permits no renaming permits no restoration by renaming either."""
        before = contents(self.folder / "plan")
        for number in (2, 3):  # the journal, the first file of the plan
            end = self.with_failing_renaming(number, errno.EIO, f"{PLAN} --overwrite --seed 2", 100)
            self.check_failed(end)
            self.check_all_but_checkpoint(self.folder / "plan", before)

    def files(self):
        found = contents(self.folder / "plan", "signal.h5.checkpoint", "run.json")
        return {name: content for name, content in found.items() if not name.startswith(".")}

    def test_no_failure_loses_a_file_of_a_plan(self):
        """If any renaming fails, the old plan stays.

        If the program is killed at any renaming, each file is the old or the new one, the report exists, and there is
        no placement beside a mixture of both.
        """
        plan = f"{PLAN} --overwrite --seed"
        before = self.files()
        self.told(f"{plan} 2")
        after = self.files()
        self.told(f"{plan} 1")
        failed = mixed = 0
        for error in (errno.EIO, 0):
            # The first renaming is of the checkpoint, without which a plan is complete, too.
            for number in range(2, 60):
                end = self.with_failing_renaming(number, error, f"{plan} 2")
                if end.status == 0:
                    break
                found = self.files()
                with self.subTest(error=error, number=number):
                    if error:
                        self.assertEqual(end.status, 2)
                        self.assertIn("unchanged", end.err)
                        self.assertEqual(found, before)
                        # Only run.json and the checkpoint are beside it.
                        self.assertEqual(len(contents(self.folder / "plan")), len(before) + 2)
                    else:
                        self.assertEqual(end.status, -signal.SIGKILL)
                        for name, content in found.items():
                            self.assertIn(content, (before[name], after[name]), name)
                        self.assertIn("report.html", found)
                        if found not in (before, after):
                            mixed += 1
                            self.assertNotIn("placement.json", found)
                        self.told(f"{plan} 1")
                        self.assertEqual(self.files(), before)
                        # Nothing is left of the killed run.
                        self.assertEqual(len(contents(self.folder / "plan")), len(before) + 1)
                failed += 1
        self.assertGreaterEqual(failed, 2 * len(before))
        self.assertGreaterEqual(mixed, len(before) - 1)

    def test_results_that_cannot_be_written_are_kept_elsewhere(self):
        plan = f"plan store.json {FEW} -o"
        self.told(f"{plan} whole")
        # The first renaming is of the checkpoint.
        end = self.with_failing_renaming(2, errno.ENOSPC, f"{plan} other")
        self.check_failed(end, f"; the plan is kept in '{self.kept()}'")
        kept, whole = contents(self.kept()), contents(self.folder / "whole")
        self.assertEqual((kept.keys(), kept["signal.h5"]), (whole.keys(), whole["signal.h5"]))
        self.assertEqual(contents(self.folder / "other").keys(), {"signal.h5.checkpoint"})

        shutil.rmtree(self.kept())
        simulate = "simulate store.json --samples 160 -o"
        self.told(f"{simulate} whole.h5")
        # The checkpoint cannot be written either.
        end = self.with_failing_renaming(1, errno.ENOSPC, f"{simulate} signal.h5", 1)
        self.check_failed(end, f"; the simulated signals are kept in '{self.kept()}/signal.h5'")
        self.assertEqual((self.kept() / "signal.h5").read_bytes(), self.bytes("whole.h5"))


class Hangup(ShopTest):
    def test_stops_like_an_interruption(self):
        """A batch of two billion samples per label never ends."""
        process = self.start("simulate store.json -o signal.h5 --samples 60000000000 --estimator uniform")
        process.wait_until((self.folder / ".signal.h5.shelfbeam-locked").exists)
        end = process.end(signal.SIGHUP)
        self.assertEqual(end.status, 3)
        self.assertTrue(end.err.startswith("stopped: "), end.err)
