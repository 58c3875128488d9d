"""`verify`: verdicts on a plan, on a part of it, and on mounted units."""

from harness import FEW, PreparedTest

HEAD = "id,x,y,z,ax,ay,az,roll_deg,type\n"


class Verify(PreparedTest):
    def prepare(self):
        self.told(f"plan store.json -o first {FEW}")

    def setUp(self):
        super().setUp()
        self.placement = self.json("first/placement.json")

    def test_confirms_a_plan(self):
        self.check_report("first")
        verify = f"verify store.json first/placement.json {FEW}"
        self.check_values(self.answer(f"{verify} -o verification.csv"), reached=17)
        head = "id,verdict,requirement,signal,standard_error,lower,upper,samples\nA-front-1-1,reached,"
        self.holds("verification.csv", head)
        self.refused(f"{verify} -o store.json", "store.json")  # it would be overwritten

    def test_gives_a_report_on_the_whole_plan(self):
        self.told(f"verify store.json first/placement.json -o same --signal first {FEW}")
        self.check_values("same/placement.json", selected=self.placement["selected"])
        self.assertEqual(self.json("same/placement.json")["partial"]["goal"], "given")
        self.assertEqual(self.signals("same"), self.signals("first"))
        self.holds("same/report.html", "This selection was given")
        self.refused("verify store.json first/placement.json -o first", "finished plan", "--overwrite")
        self.refused("verify store.json first/placement.json --overwrite", "--overwrite")

    def test_misses_labels_without_a_unit(self):
        del self.placement["selected"][0]
        self.write("changed.json", {**self.placement, "count": len(self.placement["selected"])})
        verify = f"verify store.json changed.json {FEW}"
        self.told(f"{verify} -o changed --signal first", status=1)
        self.told(f"{verify} -o changed.csv", status=1)
        self.assertEqual(self.bytes("changed/verification.csv"), self.bytes("changed.csv"))
        self.check_report("changed")

    def test_reads_lists_of_units(self):
        verify = f"verify store.json list.csv {FEW}"
        units = self.text("first/placement.csv")
        self.write("list.csv", units)
        statement = f"{self.placement['count']} transceivers reach all 17 labels, with 99 % confidence."
        self.says(verify, statement)
        self.write("list.csv", units[: units.rindex("\n", 0, -1) + 1])
        self.says(f"{verify} --budget 5", "labels are missed.", status=1)
        self.write("list.csv", f"{HEAD}U,1,1,2,0,0,-1,0,nonsense\n")
        self.refused(verify, "list.csv", "nonsense")

    def test_mounted_units_need_not_be_candidates(self):
        """Two units, at first apart, then at one place."""
        for name, second in (("mounted", "5,4,2.8,0,0"), ("pair", "2,2,2.8,1,0")):
            self.write("list.csv", f"{HEAD}old-1,2,2,2.8,0,0,-1,0,ceiling\nold-2,{second},-1,0,ceiling\n")
            self.told(f"verify store.json list.csv -o {name} {FEW}", status=1)
            self.check_values(f"{name}/placement.json", selected=["old-1", "old-2"])
            self.assertEqual(len(self.signals(name)[0]), 2)
            page = self.check_report(name)
            for word in ("greedy", "simple method", "--sensitivity"):
                self.assertNotIn(word, page)
        self.refused("verify store.json list.csv -o other --availability 0.9", "--availability")
