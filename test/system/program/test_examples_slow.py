"""Plans of examples, from the template to the report."""

from harness import PLAN_FILES, ProgramTest, contents


class Examples(ProgramTest):
    def test_the_chiller_is_planned(self):
        """Profiles, meshes, doors and several orientations. Of three seeds two gave six units, and one gave five."""
        self.told("new chiller chiller")
        self.told("plan chiller/store.json -o plan --samples 1000 --no-certificate")
        placement = self.json("plan/placement.json")
        self.assertEqual(placement["status"], "optimal")
        self.assertEqual(placement["count_lower_bound"], placement["count"])
        self.assertAlmostEqual(placement["count"], 6, delta=1)
        self.assertIn("over-till", placement["selected"])
        self.assertNotIn("certificate", placement)
        self.assertEqual(contents(self.folder / "plan").keys(), PLAN_FILES - {"verification.csv"})

    def test_the_paper_environment_is_certified(self):
        statement = "4 transceivers reach all 390 labels, and 3 are not enough"
        self.told("new thesis thesis --quiet")
        out = self.told("plan thesis/store.json -o plan --samples 1000")
        self.assertTrue(out.startswith(f"{statement}, with 99 % confidence. This "), out)
        certificate = self.json("plan/placement.json")["certificate"]
        self.assertEqual((certificate["reached"], certificate["count_lower_bound"]), (390, 4))
        self.assertEqual((certificate["missed"], certificate["undecided"]), ([], []))
        self.assertEqual(self.rows("plan/verification.csv")[0]["id"], "A1-front-1-1")
        self.assertIn(statement, self.text("plan/report.html"))
