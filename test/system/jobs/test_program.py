"""The verb `job`: JSON in, lines of JSON out (docs/formats/job.md)."""

import json
import os
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).parents[3]
PROGRAM = os.environ["SHELFBEAM"]
STORE = ROOT / "test/data/field/batch/tiny.json"
CHANGING = ROOT / "examples/chiller/store.json"


def files(folder):
    """The bytes of a plan's files; run.json has the times."""
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.name != "run.json"}


class Job(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def run_job(self, job, code=0):
        """The events of a job; a text is passed as it is."""
        text = job if isinstance(job, str) else json.dumps(job)
        ended = subprocess.run([PROGRAM, "job"], input=text, capture_output=True, text=True, check=False)
        self.assertEqual(ended.stderr, "")
        events = [json.loads(line) for line in ended.stdout.splitlines()]
        self.assertEqual(ended.returncode, code, events[-1:])
        self.assertEqual(events[-1]["code"], code)
        read = [event for event in events if event["event"] == "read"]
        self.assertLessEqual(len(read), 1)
        events = [event for event in events if event["event"] != "read"]
        self.assertTrue(all(event["event"] == "progress" for event in events[:-1]))
        return events

    def plan(self, name, *options):
        folder = self.folder / name
        command = [PROGRAM, "plan", STORE, "-o", folder, "--quiet", *options]
        subprocess.run(command, check=True)
        return folder

    def job(self, name, store=STORE, **more):
        return {"store": str(store), "folder": str(self.folder / name), **more}

    def test_the_verb_plan_gives_the_same_bytes(self):
        whole = self.plan("verb", "--samples", "640", "--curve", "--survive-failure", "--seed", "7")
        request = {"seed": 7, "curve": True, "simulation": {"samples": 640}, "problem": {"survives_failure": True}}
        *progress, end = self.run_job(self.job("job", plan=request))
        self.assertEqual(files(whole), files(self.folder / "job"))
        placement = json.loads((whole / "placement.json").read_text(encoding="utf-8"))
        self.assertEqual((end["event"], end["complete"]), ("result", True))
        self.assertEqual((end["labels"], end["units"]), (placement["labels"], placement["count"]))
        self.assertEqual(end["selected"], placement["selected"])
        self.assertIn("transceiver", end["answer"])
        self.assertGreater(len(progress), 0)

    def test_results_are_the_same_bytes_but_for_the_run(self):
        one, other = self.plan("one", "--samples", "640"), self.plan("other", "--samples", "640", "--threads", "1")
        self.assertEqual(files(one), files(other))
        self.assertNotEqual((one / "run.json").read_bytes(), (other / "run.json").read_bytes())

    def test_a_first_answer_has_no_files(self):
        job = self.job("job", preview=str(self.folder))
        *_, end = self.run_job(job)
        self.assertGreater(end["units"], 0)
        self.assertEqual(len(end["selected"]), end["units"])
        self.assertEqual([path.name for path in self.folder.iterdir()], ["coarse.operator"])
        # The signals of a plan replace previews, and give its answer.
        plan = self.plan("plan", "--samples", "640", "--no-certificate")
        *_, end = self.run_job({**job, "signal": str(plan)})
        placement = json.loads((plan / "placement.json").read_text(encoding="utf-8"))
        self.assertEqual(end["selected"], placement["selected"])

    def test_errors_are_events(self):
        (end,) = self.run_job('{"store": "a.json", "folder": "b", "plan": {"confidence": 2}}', 2)
        self.assertEqual(end["event"], "error")
        self.assertIn("job: plan.confidence", end["message"])
        (end,) = self.run_job(self.job("job", store="missing.json"), 2)
        self.assertIn("missing.json", end["message"])
        *_, end = self.run_job(self.job("job", plan={"simulation": {"memory": 1000}}), 5)
        self.assertIn("memory", end["message"])
        (end,) = self.run_job(self.job("job", file_size=100), 2)
        self.assertIn("tiny.json", end["message"])
        self.assertFalse((self.folder / "job").exists())

    def test_an_interrupted_job_continues(self):
        request = {"simulation": {"samples": 1_000_000}}
        job = self.job("job", plan=request, checkpoint_interval=0)
        process = subprocess.Popen([PROGRAM, "job"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        process.stdin.write(json.dumps(job))
        process.stdin.close()
        checkpoint = self.folder / "job/signal.h5.checkpoint"
        while process.poll() is None and not checkpoint.exists():
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        events = [json.loads(line) for line in process.stdout]
        process.stdout.close()
        self.assertEqual(process.wait(), 3)
        self.assertEqual((events[-1]["event"], events[-1]["complete"]), ("result", False))
        placement = json.loads((self.folder / "job/placement.json").read_text(encoding="utf-8"))
        self.assertFalse(placement["complete"])
        self.run_job({**job, "resume": True})
        whole = self.plan("whole", "--samples", "1000000")
        self.assertEqual(files(self.folder / "job"), files(whole))


if __name__ == "__main__":
    unittest.main()
