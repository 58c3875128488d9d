"""A batch replaces only files that a batch has written; its records survive all other files beside them."""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import chain

TINY = chain.ROOT / "test/data/field/batch/tiny.json"
QUICK = ["--", "--samples", "64", "--budget", "1", "--no-certificate"]


class OwnFiles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.results = self.folder / "r"
        for name in "ab":
            (self.folder / "t" / name).mkdir(parents=True)
            shutil.copy(TINY, self.folder / "t" / name / "store.json")

    def batch(self, *arguments, code=0, **options):
        ended = chain.shelfbeam("batch", "t", "-o", "r", *arguments, cwd=self.folder, **options)
        self.assertEqual(ended.returncode, code, ended.stderr)
        return ended

    def edit(self, name):
        path = self.results / name
        with open(path, "a", encoding="utf-8") as file:
            file.write("my note\n")
        return path.read_bytes()

    def test_edited_results_are_not_replaced(self):
        self.batch(*QUICK)
        for name in ("results.csv", "results.html"):
            edited = self.edit(name)
            for mode in ("--resume", "--collect", "--only=failed"):
                ended = self.batch(mode, *QUICK, code=2)
                self.assertIn(f"r/{name}: was changed since a batch wrote it", ended.stderr)
                self.assertIn("(--overwrite)", ended.stderr)
            self.assertEqual((self.results / name).read_bytes(), edited)
            self.batch("--collect", "--overwrite", *QUICK)
            self.assertNotIn(b"my note", (self.results / name).read_bytes())
        (self.results / "results.csv").unlink()  # is not edited
        self.batch("--resume", *QUICK)
        edited = self.edit("results.csv")
        self.batch("--overwrite", *QUICK)
        self.assertNotEqual((self.results / "results.csv").read_bytes(), edited)
        # Nothing was lost or planned again: the records have one run.
        self.assertEqual({row["status"] for row in chain.rows(self.results)}, {"planned"})

    def test_results_edited_during_the_batch(self):
        self.batch(*QUICK)
        process = subprocess.Popen(
            [chain.PROGRAM, "batch", "t", "-o", "r", "--overwrite", "--threads", "1", *QUICK[:2], "300000", *QUICK[3:]],
            cwd=self.folder,
            stderr=subprocess.PIPE,
            text=True,
        )
        while (self.results / "records/b.json").exists():  # until the batch has begun
            time.sleep(0.001)
        edited = self.edit("results.csv")
        _, err = process.communicate()
        self.assertEqual(process.returncode, 2, err)
        self.assertIn("'--collect' writes the results", err)
        self.assertEqual((self.results / "results.csv").read_bytes(), edited)
        (self.results / "results.csv").unlink()
        self.batch("--collect")

    def test_edited_plans_are_not_replaced(self):
        self.batch(*QUICK)
        edited = self.edit("plans/a/labels.csv")
        self.batch("--overwrite", *QUICK, code=1)
        self.assertEqual((self.results / "plans/a/labels.csv").read_bytes(), edited)
        answers = {row["name"]: row["answer"] for row in chain.rows(self.results)}
        self.assertIn(
            "labels.csv: was not written by an earlier run in this folder, or was changed since", answers["a"]
        )
        (self.results / "plans/a/labels.csv").unlink()
        self.batch("--resume", *QUICK)

    def test_damaged_records_are_written_again(self):
        self.batch(*QUICK)
        whole = chain.contents(self.results)
        record = self.results / "records/b.json"
        text = record.read_text(encoding="utf-8")
        for damaged in (
            "",
            text[:100],
            "null",
            "[]",
            text.replace('"format": 1', '"format": "1"'),
            text.replace('"name": "b"', '"name": "a"'),
            text.replace('"planned"', '"fine"'),
        ):
            record.write_text(damaged, encoding="utf-8")
            ended = self.batch("--collect", code=2)
            self.assertIn("r/records/b.json", ended.stderr)
            self.assertEqual(
                {row["name"]: row["status"] for row in chain.rows(self.results)}, {"a": "planned", "b": "failed"}
            )
            self.batch("--resume", *QUICK)
            self.assertEqual(chain.contents(self.results), whole)
        record.write_text(text.replace('"format": 1', '"format": 9'), encoding="utf-8")
        self.assertIn("use a newer version", self.batch("--resume", *QUICK, code=2).stderr)
        # A folder where the record should be: only this store fails.
        record.unlink()
        record.mkdir()
        self.batch("--resume", *QUICK, code=1)
        self.assertEqual(
            {row["name"]: row["status"] for row in chain.rows(self.results)}, {"a": "planned", "b": "failed"}
        )
        self.assertIn("is not planned", self.batch("--part", "2/2", *QUICK, code=2).stderr)

    def test_checkpoints_of_other_inputs(self):
        self.batch(*QUICK)
        mesh = self.folder / "t/a/wall.obj"
        shop = json.loads(TINY.read_text(encoding="utf-8"))
        shop["fixtures"].append(
            {"type": "mesh", "id": "m", "file": "wall.obj", "at": [0, 0, 0], "materials": {"*": "w"}}
        )
        (self.folder / "t/a/store.json").write_text(json.dumps(shop), encoding="utf-8")
        mesh.write_text("v 1 1 0\nv 2 1 0\nv 1 1 1\nf 1 2 3\n", encoding="utf-8")
        slow = ["--", "--samples", "3000000", "--checkpoint-interval", "0", "--no-certificate"]
        process = subprocess.Popen(
            [chain.PROGRAM, "batch", "t", "-o", "r", "--resume", "--threads", "1", *slow],
            cwd=self.folder,
            stderr=subprocess.DEVNULL,
        )
        while not (self.results / "plans/a/signal.h5.checkpoint").exists():
            time.sleep(0.005)
        process.kill()
        process.wait()
        # The record names the input of the checkpoint, which does not include the mesh.
        mesh.write_text("v 1 1 0\nv 2 1 0\nv 1 1 2\nf 1 2 3\n", encoding="utf-8")
        record = self.results / "records/a.json"
        self.assertFalse(json.loads(record.read_text())["final"])
        record.write_text(record.read_text().replace(json.loads(record.read_text())["input"], self.input_of_a()))
        self.batch("--resume", *QUICK)

    def input_of_a(self):
        """The input of the store, which a batch in another folder records."""
        subprocess.run(
            [chain.PROGRAM, "batch", "t", "-o", "other", *QUICK], cwd=self.folder, check=True, stdout=subprocess.DEVNULL
        )
        return json.loads((self.folder / "other/records/a.json").read_text())["input"]

    def test_edited_scripts_are_not_replaced(self):
        (self.folder / "bin").mkdir()
        (self.folder / "bin/sbatch").write_text("#!/bin/sh\necho 7\n", encoding="utf-8")
        (self.folder / "bin/sbatch").chmod(0o755)
        path = {"env": {**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}"}}
        self.batch("--slurm", *QUICK, **path)
        self.batch("--slurm", "--resume", *QUICK, **path)
        edited = self.edit("slurm/plan.sh")
        self.assertIn("r/slurm/plan.sh: was changed", self.batch("--slurm", "--resume", *QUICK, code=2, **path).stderr)
        self.assertEqual((self.results / "slurm/plan.sh").read_bytes(), edited)
        self.batch("--collect", code=1)  # does not write it
        self.batch("--slurm", "--overwrite", *QUICK, **path)
        self.assertNotEqual((self.results / "slurm/plan.sh").read_bytes(), edited)

    def test_a_refusal_of_slurm_names_the_option(self):
        (self.folder / "bin").mkdir()
        sbatch = self.folder / "bin/sbatch"
        path = {"env": {**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}"}}
        for reason, option in (
            ("Batch job submission failed: Invalid job array specification", "--tasks"),
            (
                "Batch job submission failed: Requested time limit is invalid (missing or exceeds some limit)",
                "--task-time",
            ),
            ("Memory specification can not be satisfied", "--memory"),
            ("CPU count per node can not be satisfied", "--threads"),
            ("invalid partition specified: lnog", "--sbatch"),
        ):
            sbatch.write_text(f"#!/bin/sh\necho 'sbatch: error: {reason}' >&2\nexit 1\n", encoding="utf-8")
            sbatch.chmod(0o755)
            error = self.batch("--slurm", "--resume", *QUICK, code=2, **path).stderr
            self.assertIn(reason, error)
            named = re.findall(r"'(--[a-z-]+)", error)
            self.assertEqual(named, [option], error)

    def test_a_signal_before_the_program_of_a_task_handles_it(self):
        (self.folder / "bin").mkdir()
        for name, text in (("sbatch", "echo 7"), ("scontrol", 'echo "$@" >>requeued'), ("slow", "exec sleep 60")):
            (self.folder / "bin" / name).write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
            (self.folder / "bin" / name).chmod(0o755)
        path = {
            "env": {
                **os.environ,
                "PATH": f"{self.folder}/bin:{os.environ['PATH']}",
                "SLURM_ARRAY_TASK_ID": "1",
                "SLURM_ARRAY_JOB_ID": "7",
            }
        }
        self.batch("--slurm", *QUICK, **path)
        script = (self.results / "slurm/plan.sh").read_text(encoding="utf-8")
        program = f"'{os.path.realpath(chain.PROGRAM)}'"
        self.assertIn(program, script)
        (self.folder / "task.sh").write_text(script.replace(program, "slow"), encoding="utf-8")
        process = subprocess.Popen(["bash", "task.sh"], cwd=self.folder, **path)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(30), 128 + signal.SIGTERM)
        self.assertEqual((self.folder / "requeued").read_text(), "requeue 7_1\n")


if __name__ == "__main__":
    unittest.main()
