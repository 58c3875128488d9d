"""The verb `job`: JSON in, lines of JSON out (docs/formats/job.md)."""

import json

from harness import ROOT, ProgramTest

STORE = ROOT / "test/data/field/batch/tiny.json"


class Job(ProgramTest):
    def files(self, folder):
        """The bytes of a plan's files; run.json has the times."""
        return {path.name: path.read_bytes() for path in (self.folder / folder).iterdir() if path.name != "run.json"}

    def read(self, end, code):
        """The events that a job has printed."""
        self.assertEqual(end.err, "")
        events = [json.loads(line) for line in end.out.splitlines()]
        self.assertEqual((end.status, events[-1]["code"]), (code, code), events[-1:])
        self.assertLessEqual(sum(event["event"] == "read" for event in events), 1)
        events = [event for event in events if event["event"] != "read"]
        self.assertTrue(all(event["event"] == "progress" for event in events[:-1]))
        return events

    def run_job(self, job, code=0):
        """The events of a job; a text is passed as it is."""
        text = job if isinstance(job, str) else json.dumps(job)
        return self.read(self.run_here("job", input=text.encode()), code)

    def plan(self, name, options):
        self.told(f"plan {STORE} -o {name} --quiet {options}")

    def job(self, name, store=STORE, **more):
        return {"store": str(store), "folder": str(self.folder / name), **more}

    def test_the_verb_plan_gives_the_same_bytes(self):
        self.plan("verb", "--samples 640 --curve --survive-failure --seed 7")
        request = {"seed": 7, "curve": True, "simulation": {"samples": 640}, "problem": {"survives_failure": True}}
        *progress, end = self.run_job(self.job("job", plan=request))
        self.assertEqual(self.files("verb"), self.files("job"))
        placement = self.json("verb/placement.json")
        self.assertEqual((end["event"], end["complete"]), ("result", True))
        self.assertEqual((end["labels"], end["units"]), (placement["labels"], placement["count"]))
        self.assertEqual(end["selected"], placement["selected"])
        self.assertIn("transceiver", end["answer"])
        self.assertGreater(len(progress), 0)

    def test_results_are_the_same_bytes_but_for_the_run(self):
        self.plan("one", "--samples 640")
        self.plan("other", "--samples 640 --threads 1")
        self.assertEqual(self.files("one"), self.files("other"))
        self.assertNotEqual(self.bytes("one/run.json"), self.bytes("other/run.json"))

    def test_a_first_answer_has_no_files(self):
        job = self.job("job", preview=str(self.folder))
        *_, end = self.run_job(job)
        self.assertGreater(end["units"], 0)
        self.assertEqual(len(end["selected"]), end["units"])
        self.assertEqual([path.name for path in self.folder.iterdir()], ["coarse.operator"])
        # The signals of a plan replace previews, and give its answer.
        self.plan("plan", "--samples 640 --no-certificate")
        *_, end = self.run_job({**job, "signal": str(self.folder / "plan")})
        self.assertEqual(end["selected"], self.json("plan/placement.json")["selected"])

    def test_errors_are_events(self):
        for job, code, part in (
            ('{"store": "a.json", "folder": "b", "plan": {"confidence": 2}}', 2, "job: plan.confidence"),
            (self.job("job", store="missing.json"), 2, "missing.json"),
            (self.job("job", plan={"simulation": {"memory": 1000}}), 5, "memory"),
            (self.job("job", file_size=100), 2, "tiny.json"),
        ):
            *others, end = self.run_job(job, code)
            self.assertEqual((end["event"], len(others) if code == 2 else 0), ("error", 0))
            self.assertIn(part, end["message"])
        self.assertFalse((self.folder / "job").exists())

    def test_an_interrupted_job_continues(self):
        request = {"simulation": {"samples": 100_000, "estimator": "uniform"}}
        job = self.job("job", plan=request, checkpoint_interval=0)
        with open(self.write("job.json", job), "rb") as file:
            process = self.start("job", stdin=file)
        process.wait_until((self.folder / "job/signal.h5.checkpoint").exists)
        *_, end = self.read(process.end(), 3)
        self.assertEqual((end["event"], end["complete"]), ("result", False))
        self.assertFalse(self.json("job/placement.json")["complete"])
        self.run_job({**job, "resume": True})
        self.plan("whole", "--samples 100000 --estimator uniform")
        self.assertEqual(self.files("job"), self.files("whole"))
