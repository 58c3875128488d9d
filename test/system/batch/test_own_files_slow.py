"""A batch replaces only files that a batch has written; its records survive all other files beside them."""

import os
import re
import signal

import chain
from chain import QUICK, TINY
from harness import PROGRAM


class OwnFiles(chain.BatchTest):
    def setUp(self):
        super().setUp()
        self.add_shop("a")
        self.add_shop("b")

    def refused(self, options, *parts, **process):
        end = self.batch(options, 2, **process)
        for part in parts:
            self.assertIn(part, end.err)

    def programs(self, **scripts):
        """The environment in which programs of these names run these scripts."""
        for name, text in scripts.items():
            self.write(f"bin/{name}", f"#!/bin/sh\n{text}\n").chmod(0o755)
        return {**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}"}

    def edit(self, name):
        return self.write(f"r/{name}", self.bytes(f"r/{name}") + b"my note\n").read_bytes()

    def test_edited_results_are_not_replaced(self):
        self.batch(QUICK)
        for name in ("results.csv", "results.html"):
            edited = self.edit(name)
            for mode in ("--resume", "--collect", "--only=failed"):
                self.refused(f"{mode} {QUICK}", f"r/{name}: was changed since a batch wrote it", "(--overwrite)")
            self.assertEqual(self.bytes(f"r/{name}"), edited)
            self.batch(f"--collect --overwrite {QUICK}")
            self.assertNotIn("my note", self.text(f"r/{name}"))
        (self.results / "results.csv").unlink()  # is not edited
        self.batch(f"--resume {QUICK}")
        edited = self.edit("results.csv")
        self.batch(f"--overwrite {QUICK}")
        self.assertNotEqual(self.bytes("r/results.csv"), edited)
        # Nothing was lost or planned again: the records have one run.
        self.assertEqual(set(self.statuses().values()), {"planned"})

    def test_results_edited_during_the_batch(self):
        self.batch(QUICK)
        slow = QUICK.replace("64", "300000")
        process = self.start(f"batch t -o r --overwrite --threads 1 {slow}")
        process.wait_until(lambda: not (self.results / "records/b.json").exists())  # until the batch has begun
        edited = self.edit("results.csv")
        end = process.wait()
        self.assertEqual(end.status, 2, end.err)
        self.assertIn("'--collect' writes the results", end.err)
        self.assertEqual(self.bytes("r/results.csv"), edited)
        (self.results / "results.csv").unlink()
        self.batch("--collect")

    def test_edited_plans_are_not_replaced(self):
        self.batch(QUICK)
        edited = self.edit("plans/a/labels.csv")
        self.batch(f"--overwrite {QUICK}", 1)
        self.assertEqual(self.bytes("r/plans/a/labels.csv"), edited)
        answers = {row["name"]: row["answer"] for row in chain.rows(self.results)}
        changed = "labels.csv: was not written by an earlier run in this folder, or was changed since"
        self.assertIn(changed, answers["a"])
        (self.results / "plans/a/labels.csv").unlink()
        self.batch(f"--resume {QUICK}")

    def test_damaged_records_are_written_again(self):
        self.batch(QUICK)
        whole = chain.contents(self.results)
        record, text = self.results / "records/b.json", self.text("r/records/b.json")
        failed = {"a": "planned", "b": "failed"}
        for damaged in (
            "",
            text[:100],
            "null",
            "[]",
            text.replace('"format": 1', '"format": "1"'),
            text.replace('"name": "b"', '"name": "a"'),
            text.replace('"planned"', '"fine"'),
        ):
            self.write(record, damaged)
            self.refused("--collect", "r/records/b.json")
            self.assertEqual(self.statuses(), failed)
            self.batch(f"--resume {QUICK}")
            self.assertEqual(chain.contents(self.results), whole)
        self.write(record, text.replace('"format": 1', '"format": 9'))
        self.refused(f"--resume {QUICK}", "use a newer version")
        # A folder where the record should be: only this store fails.
        record.unlink()
        record.mkdir()
        self.batch(f"--resume {QUICK}", 1)
        self.assertEqual(self.statuses(), failed)
        self.refused(f"--part 2/2 {QUICK}", "is not planned")

    def test_checkpoints_of_other_inputs(self):
        self.batch(QUICK)
        mesh = {"type": "mesh", "id": "m", "file": "wall.obj", "at": [0, 0, 0], "materials": {"*": "w"}}
        shop = self.json(TINY)
        shop["fixtures"].append(mesh)
        self.add_shop("a", shop)
        self.write("t/a/wall.obj", "v 1 1 0\nv 2 1 0\nv 1 1 1\nf 1 2 3\n")
        slow = "-- --samples 3000000 --checkpoint-interval 0 --no-certificate"
        process = self.start(f"batch t -o r --resume --threads 1 {slow}")
        process.wait_until((self.results / "plans/a/signal.h5.checkpoint").exists)
        process.kill()
        # The record names the input of the checkpoint, which does not include the mesh.
        self.write("t/a/wall.obj", "v 1 1 0\nv 2 1 0\nv 1 1 2\nf 1 2 3\n")
        record = self.json("r/records/a.json")
        self.assertFalse(record["final"])
        self.assertEqual(self.run_here(f"batch t -o other {QUICK}").status, 0)
        self.write("r/records/a.json", {**record, "input": self.json("other/records/a.json")["input"]})
        self.batch(f"--resume {QUICK}")

    def test_edited_scripts_are_not_replaced(self):
        slurm = {"env": self.programs(sbatch="echo 7")}
        self.batch(f"--slurm {QUICK}", **slurm)
        self.batch(f"--slurm --resume {QUICK}", **slurm)
        edited = self.edit("slurm/plan.sh")
        self.refused(f"--slurm --resume {QUICK}", "r/slurm/plan.sh: was changed", **slurm)
        self.assertEqual(self.bytes("r/slurm/plan.sh"), edited)
        self.batch("--collect", 1)  # does not write it
        self.batch(f"--slurm --overwrite {QUICK}", **slurm)
        self.assertNotEqual(self.bytes("r/slurm/plan.sh"), edited)

    def test_a_refusal_of_slurm_names_the_option(self):
        failed = "Batch job submission failed: "
        for reason, option in (
            (failed + "Invalid job array specification", "--tasks"),
            (failed + "Requested time limit is invalid (missing or exceeds some limit)", "--task-time"),
            ("Memory specification can not be satisfied", "--memory"),
            ("CPU count per node can not be satisfied", "--threads"),
            ("invalid partition specified: lnog", "--sbatch"),
        ):
            path = self.programs(sbatch=f"echo 'sbatch: error: {reason}' >&2\nexit 1")
            error = self.batch(f"--slurm --resume {QUICK}", 2, env=path).err
            self.assertIn(reason, error)
            self.assertEqual(re.findall(r"'(--[a-z-]+)", error), [option], error)

    def test_a_signal_before_the_program_of_a_task_handles_it(self):
        path = self.programs(sbatch="echo 7", scontrol='echo "$@" >>requeued', slow="touch begun\nexec sleep 60")
        self.batch(f"--slurm {QUICK}", env=path)
        script, program = self.text("r/slurm/plan.sh"), f"'{os.path.realpath(PROGRAM)}'"
        self.assertIn(program, script)
        self.write("task.sh", script.replace(program, "slow"))
        task = {"SLURM_ARRAY_TASK_ID": "1", "SLURM_ARRAY_JOB_ID": "7"}
        process = self.start("task.sh", program="bash", env={**path, **task})
        process.wait_until((self.folder / "begun").exists)
        self.assertEqual(process.end().status, 128 + signal.SIGTERM)
        self.assertEqual(self.text("requeued"), "requeue 7_1\n")
