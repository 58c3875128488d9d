"""The verb `preview`: the labels that given units reach, with and without a plan."""

from harness import PreparedTest, small_store

UNIT = "--unit 2,1.5,2.9"


class Preview(PreparedTest):
    def prepare(self):
        self.told("plan store.json -o plan --samples 2000 --no-certificate --quiet")

    def setUp(self):
        super().setUp()
        self.chosen = self.json("plan/placement.json")["selected"][0]

    def previewed(self, options, store="store.json"):
        return self.answer(f"preview {store} {options}")

    def agree(self, labels, signals):
        """With previews of 17 labels at four errors, one run in a thousand would fail."""
        for label, signal in zip(labels, signals, strict=True):
            self.assertAlmostEqual(label["signal"], signal, delta=4 * label["error"] + 0.03 * signal)

    def test_shows_the_labels_that_a_unit_reaches(self):
        self.assertRegex(self.told(f"preview store.json {UNIT}"), "(?s)of 17 labels reached.*weakest label")
        self.assertEqual(self.told(f"preview store.json {UNIT} --quiet"), "")
        shown = self.previewed(f"{UNIT} --unit 3,1.5,2.9,0,0.3,-1")
        self.assertEqual((shown["simulated"], len(shown["labels"]), len(shown["added"])), (False, 17, 2))
        for label in shown["labels"]:
            self.assertGreater(min(label["signal"], label["error"]), 0, label)
            self.assertNotIn("before", label)

    def test_agrees_with_the_plan(self):
        """A candidate of the plan at its own place has the signals of the plan, within their errors."""
        row = next(row for row in self.rows("plan/placement.csv") if row["id"] == self.chosen)
        move = f"--from plan --move {self.chosen},{row['x']},{row['y']},{row['z']}"
        for options, simulated in ((move, False), (f"{move} --refine 0.5", True)):
            moved = self.previewed(options)
            self.assertEqual(moved["simulated"], simulated)
            self.agree(moved["labels"], [label["before"] for label in moved["labels"]])
        removed = self.previewed(f"--from plan --remove {self.chosen}")
        self.assertEqual(removed["simulated"], True)
        self.assertLess(removed["labels_reached"], moved["labels_reached"], "control")

    def test_keeps_the_light_of_the_shop(self):
        first = self.previewed(f"--from plan {UNIT}")
        kept = self.bytes("plan/light.operator")
        self.assertEqual(self.previewed(f"--from plan {UNIT} --threads 1"), first)
        self.assertEqual(self.bytes("plan/light.operator"), kept)
        damaged = bytearray(kept)
        damaged[len(kept) // 2] ^= 1
        self.write("plan/light.operator", bytes(damaged))
        self.refused(f"preview store.json --from plan {UNIT}", "light.operator", "is corrupt")

    def test_follows_the_problem_of_the_plan(self):
        """Units are found by their places, and a plan that survives a failure omits the strongest."""
        self.told("plan store.json -o safe --signal plan --no-certificate --survive-failure --quiet")
        shown = self.previewed(f"--from safe --remove {self.json('safe/placement.json')['selected'][0]}")
        self.assertEqual(shown["survives_failure"], True)
        self.assertGreater(shown["labels_lost"], 0)

    def test_takes_an_axis_of_any_length(self):
        """The squares of some lengths overflow or vanish."""
        for unit in ("--unit ", f"--from plan --move {self.chosen},"):
            usual, long, short, other = (
                self.previewed(f"{unit}2,1.5,2.9,{axis} --coarse")["labels"]
                for axis in ("0,0.3,-1", "0,0.3e200,-1e200", "0,0.3e-170,-1e-170", "0,1e200,-1e200")
            )
            self.assertEqual((long, short), (usual, usual))
            self.assertNotEqual(other, usual, "control")

    def test_refuses_other_units(self):
        for options, part in (
            ("--unit 2,1.5", "2 numbers"),
            ("--unit 2,1.5,29", "outside the room"),
            (f"{UNIT},0,0,0", "zero vector"),
            (f"{UNIT},lamp", "unknown type"),
            (f"{UNIT},ceiling,more", "more than a type"),
            ("", "selects no unit"),
            ("--from plan", "has no unit"),
            ("--from plan --remove nobody", "not among the mounted units"),
            ("--from plan --move nobody,2,1.5,2.9", "the id of no unit"),
            (f"--from nowhere {UNIT}", "nowhere"),
        ):
            self.refused(f"preview store.json {options}", part)

    def test_examines_the_units_that_the_store_selects(self):
        """They are those of a plan that selects them."""
        store = small_store()
        store["transceivers"]["selected"] = self.json("plan/placement.json")["selected"]
        self.write("chosen.json", store)
        alone = self.previewed("", "chosen.json")
        self.assertEqual((alone["simulated"], alone["labels_gained"]), (False, 0))
        self.assertNotIn("gained", self.told("preview chosen.json"))
        without = self.previewed(f"--remove {self.chosen}", "chosen.json")["labels"][0]
        self.assertLess(without["signal"], alone["labels"][0]["signal"])
        self.assertEqual(without["before"], alone["labels"][0]["signal"])
        refined = self.previewed("--refine 0.2", "chosen.json")
        self.assertEqual(refined["simulated"], True)
        of_plan = self.previewed(f"--from plan --remove {self.chosen}")
        self.agree(refined["labels"], [label["before"] for label in of_plan["labels"]])
        self.assertIn("reach all 17 labels", self.told("verify chosen.json"))
        self.refused("verify store.json", "selects no transceivers")
