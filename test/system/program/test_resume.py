"""Simulations and plans that are killed, and resumed to the bytes of one run."""

import signal

from harness import contents, small_store, store_with
from test_parts import PartsTest


class Killed(PartsTest):
    def setUp(self):
        super().setUp()
        self.write("store.json", small_store())

    def kill_at_work(self, line, checkpoint):
        """Kills a run when its first checkpoint has appeared."""
        process = self.start(f"{line} --checkpoint-interval 0 --threads 1")
        process.wait_for_changes(self.folder / checkpoint)
        self.assertEqual(process.end(signal.SIGKILL).status, -signal.SIGKILL)

    def test_a_simulation_resumes_to_the_same_bytes(self):
        for rule in ("--samples 4000", "--relative-error 0.2 --direct exact"):
            self.told(f"simulate store.json -o whole.h5 {rule}")
            self.assertGreater(self.simulate_with_kills("signal.h5", rule), 2)
            self.assertEqual(self.bytes("signal.h5"), self.bytes("whole.h5"))
            self.assertEqual(contents(self.folder).keys(), {"signal.h5", "store.json", "whole.h5"})
            (self.folder / "signal.h5").unlink()

    def test_a_checkpoint_is_for_its_own_simulation_only(self):
        simulate = "simulate store.json -o signal.h5 --samples"
        resume = f"{simulate} 400000 --resume"
        self.kill_at_work(f"{simulate} 400000", "signal.h5.checkpoint")
        # The next run would remove these files, and `refused` would count that as a change.
        for abandoned in self.folder.glob(".*"):
            abandoned.unlink()
        self.refused(f"{resume} --seed 2", "signal.h5.checkpoint: ", "seed is '1'", "(--resume)")
        self.write("store.json", store_with({"materials/m/reflectance": 0.31}))
        self.refused(resume, "signal.h5.checkpoint", "store hash is '")
        # Without --resume the checkpoint is replaced, and removed at the end.
        self.told(f"{simulate} 64")
        self.assertEqual(contents(self.folder).keys(), {"signal.h5", "store.json"})

    def test_a_plan_resumes_to_the_same_bytes(self):
        plan = "plan store.json --samples 8000"
        self.told(f"{plan} -o whole")
        self.kill_at_work(f"{plan} -o plan", "plan/signal.h5.checkpoint")
        self.says(f"{plan} -o plan --resume", "continued from the checkpoint")
        self.assertEqual(self.bytes("plan/signal.h5"), self.bytes("whole/signal.h5"))
        self.assertEqual(contents(self.folder / "plan").keys(), contents(self.folder / "whole").keys())
