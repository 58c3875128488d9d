"""The verb `diff`: two plans and their shops, side by side."""

from harness import PreparedTest, store_with


class Diff(PreparedTest):
    def prepare(self):
        """Plans for a kiosk, and for the same with a nearer door label, dearer units and one unit installed."""
        changed = store_with(
            {
                "labels/0/position/1": 2,
                "materials/m/reflectance": 0.35,
                "currency": "EUR",
                "transceiver_types/ceiling/cost": 90,
                "transceivers/installed": ["G1-4-3"],
            }
        )
        self.write("changed.json", changed)
        for store, plan in (("store.json", "one"), ("changed.json", "two")):
            self.told(f"plan {store} -o {plan} --samples 640 --no-certificate --quiet")

    def test_tells_the_changes(self):
        changes = "Shop: currency is now EUR", "m: reflectance 0.35 instead of 0.3", "ceiling: cost 90 instead of 1"
        labels = "Labels: 1 moved, door", "all 17 labels stay reached", "17 of 17", "Weakest labels of both plans"
        unit = "G1-4-3: installed is now true"
        text = self.says("diff one two", "Before", "Labels reached", "Units:", unit, *labels, *changes)
        for line, expected in (
            ("diff one/placement.json two/placement.json", text),
            ("diff one two --quiet", ""),
            ("diff one one", "The plans do not differ.\n"),
        ):
            self.assertEqual(self.told(line), expected)

    def test_writes_json_and_a_page(self):
        there = self.answer("diff one two -o page.html")
        self.assertEqual(there["report"], "page.html")
        page = self.text("page.html")
        self.assertTrue(page.startswith("<!DOCTYPE html>"))
        for part in ("G1-4-3", "Floor plan", "currency is now EUR"):
            self.assertIn(part, page)
        back = self.answer("diff two one")
        self.assertNotIn("report", back)
        self.assertEqual((there["before"], there["after"]), (back["after"], back["before"]))
        for one, other in (("added", "removed"), ("removed", "added")):
            self.assertEqual(there["units"][one], back["units"][other])
        self.assertEqual(len(there["labels"]["gained"]), len(back["labels"]["lost"]))
        self.assertEqual(len(there["store"]), len(back["store"]))
        self.assertEqual((there["after"]["installed"], there["differs"]), (1, True))
        self.assertIs(self.answer("diff one one")["differs"], False)

    def test_tells_another_question(self):
        """The same signals, prices and places."""
        parts = ("more: ", "Survives the failure of any unit", "The shop is the same.")
        self.told("plan store.json -o three --signal one --no-certificate --survive-failure --quiet")
        self.says("diff one three", *parts)
        question = self.answer("diff one three")["question"]
        self.assertEqual([part["key"] for part in question], ["survives_failure"])

    def test_refuses_other_input(self):
        self.write("empty/note.txt", "")
        (self.folder / "two/signal.h5").unlink()
        self.refused_each(
            ("diff one none", "none: does not exist", "'shelfbeam plan'"),
            ("diff store.json one", "store.json: is not the folder of a plan"),
            ("diff one empty", "empty/placement.json: ", "folder"),
            ("diff empty one", "empty/placement.json: "),
            ("diff one two", "two/signal.h5: cannot be read"),
            ("diff one one -o one/store.json", ".html"),
            ("diff one one -o one/report.html", "report.html: "),
            ("diff one one -o absent/page.html", "absent"),
            ("diff one", "PLAN2"),
        )

    def test_both_helps_tell_which_verb_compares_what(self):
        for verb, other in (("diff", "compare"), ("compare", "diff")):
            self.assertIn(f"'shelfbeam {other}'", self.told(f"{verb} --help"))
        self.assertNotIn("'shelfbeam diff'", self.told("report --help"), "negative control")
