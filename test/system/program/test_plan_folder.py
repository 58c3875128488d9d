"""`plan` never replaces a finished plan or a file of the user, and never shares its folder."""

import json
import os
import re
import shutil
import signal

from compatibility import old_plan
from harness import FEW, PreparedTest, contents, store_with

PLAN = f"plan store.json -o plan {FEW} --no-certificate --quiet"
OVERWRITE = f"{PLAN} --overwrite"
LONG = "plan store.json -o plan --samples 4000000 --no-certificate --checkpoint-interval 0 --threads 1"
FOREIGN = "was not written by an earlier run"


class PlanFolder(PreparedTest):
    """Its folder has a finished plan in `whole`."""

    def prepare(self):
        self.told(PLAN.replace("-o plan", "-o whole"))

    def setUp(self):
        super().setUp()
        self.whole = contents(self.folder / "whole")
        self.plan = self.folder / "plan"

    def finish_plan(self):
        shutil.copytree(self.folder / "whole", self.plan)

    def files(self):
        return contents(self.plan, "signal.h5.checkpoint")

    def interrupt(self, line, times=3, meanwhile=lambda: None):
        """The end of a plan that is interrupted when its checkpoint has changed `times` times."""
        process = self.start(line, env={**os.environ, "TMPDIR": str(self.folder)})
        process.wait_for_changes(self.plan / "signal.h5.checkpoint", times)
        meanwhile()
        return process.end(signal.SIGINT)

    def stops(self, line, state, times=3):
        end = self.interrupt(line, times)
        again = "repeat the command with '--resume' to continue\n"
        self.assertEqual((end.status, end.err), (3, f"stopped early: {state}; {again}"))
        self.assertTrue((self.plan / "signal.h5.checkpoint").exists())


class Finished(PlanFolder):
    def setUp(self):
        super().setUp()
        self.finish_plan()

    def test_is_replaced_on_request_only(self):
        for more in ("", "--seed 2", "--resume"):
            self.refused(f"{PLAN} {more}", "plan: contains a finished plan", "(--overwrite, --signal)")
        for seed, is_same in ((2, False), (1, True)):
            self.told(f"{OVERWRITE} --seed {seed}")
            self.assertEqual(self.bytes("plan/signal.h5") == self.whole["signal.h5"], is_same)
        self.assertEqual(contents(self.plan).keys(), self.whole.keys())

    def test_keeps_files_that_the_user_changed(self):
        both, names = (OVERWRITE, "report plan"), ("labels.csv", "placement.csv", "report.html", "placement.json")
        placement = self.whole["placement.json"]
        for name, content, lines in (
            *((name, self.whole[name] + b"\n", both) for name in names),
            *((name, self.whole[name] + b"\n", [OVERWRITE]) for name in ("signal.h5", "store.json")),
            # Before, behind and in the record.
            ("placement.json", b"{ " + placement[1:], both),
            ("placement.json", placement + b"// mine\n", both),
            ("placement.json", placement[:-2] + b', "mine": 1 }\n', [OVERWRITE]),
        ):
            self.write(f"plan/{name}", content)
            for line in lines:
                self.refused(line, f"plan/{name}: ", "was changed since")
            self.write(f"plan/{name}", self.whole[name])
        (self.plan / "labels.csv").unlink()
        self.told("report plan")
        foreign = self.write("plan/verification.csv", "id,verdict\n")  # not part of this plan
        self.refused(OVERWRITE, "plan/verification.csv: ")
        foreign.unlink()
        self.told(OVERWRITE)

    def test_report_refuses_an_invalid_record(self):
        placement = self.json("plan/placement.json")
        del placement["files"]
        for more, where in (
            ({"files": 7}, ": files"),
            ({"files": {"x": 3}}, ": files.x"),
            ({}, ": "),
            ({"files": {"x": "y"}}, ": was changed"),
        ):
            self.write("plan/placement.json", json.dumps({**placement, **more}, indent=2) + "\n")
            self.refused("report plan", f"plan/placement.json{where}")
        self.write("plan/placement.json", b"// mine\n" + self.whole["placement.json"])
        self.refused("report plan", "plan/placement.json: was changed")

    def test_keeps_links(self):
        link = self.plan / "labels.csv"
        link.rename(self.folder / "shared.csv")
        for target in ("../shared.csv", "../missing.csv"):
            link.symlink_to(target)
            end = self.run_here(OVERWRITE)
            self.assertEqual((end.status, os.readlink(link)), (2, target))
            self.assertIn("plan/labels.csv: was not written by", end.err)
            link.unlink()
        self.told(OVERWRITE)

    def test_is_replaced_if_its_run_was_killed(self):
        """A journal of a run that was killed while it renamed its files."""
        journal = "".join(f"{name} {hash}\n" for name, hash in self.json("plan/placement.json")["files"].items())
        (self.plan / "placement.json").unlink()
        self.refused(PLAN, "was not written by")
        record = self.write("plan/.plan.shelfbeam-record", journal)
        self.write("plan/labels.csv", self.whole["labels.csv"] + b"\n")
        self.refused(PLAN, "plan/labels.csv: was not written by")
        self.write("plan/labels.csv", self.whole["labels.csv"])
        self.told(PLAN)
        self.check_values("plan/placement.json", complete=True)
        self.assertFalse(record.exists())

    def test_survives_an_interruption(self):
        self.stops(f"{LONG} --overwrite", "the finished plan in plan is unchanged")
        self.assertEqual(self.files(), self.whole)


class Other(PlanFolder):
    def test_files_of_the_user_are_never_replaced(self):
        """Without a record nothing shows whether the user has edited a file. A simulation may have taken hours."""
        self.told(f"plan store.json -o certified {FEW} --quiet")
        certified = contents(self.folder / "certified", "run.json")
        for name, content, part in (
            *((name, "mine", FOREIGN) for name in certified),
            *((name, certified[name], FOREIGN) for name in certified if name not in ("placement.json", "store.json")),
            *((name, "mine", "") for name in (".plan.shelfbeam-record", "signal.h5.checkpoint")),
        ):
            self.write(f"plan/{name}", content)
            self.refused(OVERWRITE, f"plan/{name}: {part}")
            shutil.rmtree(self.plan)
        self.write("plan/store.json", certified["store.json"])  # would not change
        self.write("plan/notes.txt", "mine")
        self.told(PLAN)
        self.assertEqual(self.text("plan/notes.txt"), "mine")

    def test_a_refused_plan_leaves_no_new_folders(self):
        self.write("wrong.json", store_with({"label_types/standard/threshold": -1}))
        self.write("old/notes.txt", "mine")
        long = f"n1/n2/{300 * 'x'}"
        for name in ("n1/n2/n3", "n1/n2/n3/", long):
            self.refused(f"plan wrong.json -o {name}")
        self.refused(f"plan store.json -o {long}", "File name too long")
        for name in ("n1/n2/n3", "n1/n2/n3/", "old/n2/n3"):
            self.refused(f"plan store.json --memory 1K -o {name}", "memory", status=5)

    def test_a_plan_of_an_earlier_version_is_replaced_on_request(self):
        old_plan("0.2.0", self.plan)
        self.refused(PLAN, "plan: contains a finished plan", "(--overwrite)")
        self.told(OVERWRITE)
        self.check_values("plan/placement.json", complete=True)

    def test_the_checkpoint_of_a_complete_simulation_survives(self):
        """The only checkpoint is that of the complete simulation. `--sensitivity` makes the later steps long."""
        floor = {"type": "lambertian", "reflectance": 0.3, "reflectance_range": [0.2, 0.4]}
        self.write("store.json", store_with({"materials/floor": floor, "room/floor": "floor"}))
        plan = "plan store.json -o plan --samples 2000 --no-certificate --threads 1"
        self.stops(f"{plan} --sensitivity", "the simulation is complete, but the later steps are not", 1)
        self.says(f"{plan} --sensitivity --resume", "continued from the checkpoint", "\nsensitivity: ")
        self.stops(f"{plan} --sensitivity --overwrite", "the finished plan in plan is unchanged", 1)
        self.says(f"{plan} --resume --overwrite", "continued from the checkpoint")
        self.assertEqual(contents(self.plan).keys(), self.whole.keys())

    def test_an_interrupted_plan_may_be_replaced(self):
        self.assertEqual(self.interrupt(LONG).status, 3)
        self.check_values("plan/placement.json", complete=False)
        self.told(PLAN)
        self.check_values("plan/placement.json", complete=True)

    def test_files_that_appear_during_the_run_are_kept(self):
        """A file that the user saves, or a plan that is copied there, while the simulation runs."""
        for appears, problem in (
            (self.whole, "plan: has received a finished plan since"),
            ({"labels.csv": b"mine"}, "plan/labels.csv: was not written by"),
        ):

            def save(files=appears):
                for name, content in files.items():
                    self.write(f"plan/{name}", content)

            end = self.interrupt(f"{LONG} --overwrite", meanwhile=save)
            self.assertEqual(end.status, 2)
            self.assertIn(problem, end.err)
            kept = re.search("the plan is kept in '([^']*)'", end.err)[1]
            self.assertEqual(contents(self.folder / kept).keys(), self.whole.keys())
            self.assertTrue((self.plan / "signal.h5.checkpoint").exists())
            self.assertEqual(self.files(), appears)
            shutil.rmtree(self.plan)

    def test_an_output_in_use_is_refused(self):
        for line, output, lock in (
            ("plan store.json -o plan", "plan", "plan/.signal.h5.shelfbeam-locked"),
            ("simulate store.json -o signal.h5", "signal.h5", ".signal.h5.shelfbeam-locked"),
        ):
            process = self.start(f"{line} --samples 60000000000 --estimator uniform --threads 1")
            lock = self.folder / lock
            process.wait_until(lambda lock=lock: lock.exists() and lock.read_text(encoding="utf-8"))
            pid = lock.read_text(encoding="utf-8").split("\n", 1)[0]
            # Meanwhile, the first process may still add and remove files.
            second = self.run_here(f"{line} {FEW}")
            self.assertEqual(second.status, 2)
            self.assertIn(f"{output}: is in use by another run of shelfbeam (process {pid})", second.err)
            process.kill()
            # The kernel has removed the lock, though not its file.
            self.assertTrue(lock.exists())
            self.told(f"{line} {FEW}")
            self.assertFalse(lock.exists())
