"""Simulations in parts of the estimator with path reuse, and plans over states from parts."""

import test_parts
from harness import small_store


class Parts(test_parts.PartsTest):
    def test_parts_with_path_reuse_give_the_bytes_of_one_run(self):
        self.write("store.json", test_parts.spaced(0.05))
        self.check_that_parts_give_the_bytes_of_one_run("--samples 6000")

    def test_parts_serve_a_plan_over_states(self):
        """The plan reads the states of all parts as if it had simulated them."""
        sure, vague = (small_store(variation={"unit_power_db": 3}) for _ in range(2))
        vague["materials"]["m"]["reflectance_range"] = [0.25, 0.35]
        states = "store.json --states 6"
        plan = f"plan {states} --no-certificate --samples 64 --seed 3 -o"
        self.write("store.json", vague)
        self.told(f"{plan} one")
        for k in (1, 2, 3):
            self.told(f"simulate {states} --for-plan --seed 3 --part {k}/3 -o {k}.h5")
        self.told(f"{plan} sampled --sampled 3.h5 1.h5 2.h5")
        self.told(f"simulate {states} --seed 3 --part 1/1 -o whole.h5")
        sampled = "--sampled 1.h5 2.h5 3.h5"
        self.refused_each(
            (f"plan {states} -o other {sampled}", "1.h5: has the seed 3 instead of 1"),
            (f"{plan} other --sampled 1.h5 3.h5", "number 2 is missing"),
            (f"plan store.json --states 7 --seed 3 -o other {sampled}", "6 states, but the plan needs 7"),
            # States in which another set of causes changes are those of another store.
            (f"{plan} other --without mounting {sampled}", "1.h5: is of another store"),
            (f"plan store.json --states 0 --seed 3 -o other {sampled}", "--sampled"),
            ("merge 1.h5 2.h5 3.h5 -o merged.h5", "1.h5: serves a plan"),
            (f"plan {states} --seed 3 -o other --sampled whole.h5", "whole.h5: is not a part"),
        )
        self.write("store.json", sure)
        self.told(f"{plan} control")
        self.refused(f"plan {states} -o other {sampled} --seed 3", "1.h5: is of another store")
        one, read, control = (self.json(f"{name}/placement.json")["states"] for name in ("one", "sampled", "control"))
        self.assertEqual(read, one)
        self.assertNotEqual(control, one, "states of other signals give other numbers")
