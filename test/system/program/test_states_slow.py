"""Plans for a shop that changes."""

from harness import FEW, ProgramTest
from test_states import known_states

HEAD = "id,required,states,missed,availability\n"
CERTIFIED = "4 transceivers reach every label at least 95 % of the time, with 99 % confidence."


class States(ProgramTest):
    """Their signals are exact, because nothing reflects."""

    def test_are_planned_and_verified(self):
        self.write("store.json", known_states((0.005, 0.005), (0.08, 0.08), (0.005, 0.2)))
        self.says(f"plan store.json -o plan {FEW}", CERTIFIED)
        placement = self.json("plan/placement.json")
        counts = {"count": 100, "labels_below": 0, "sample_count": 4, "sample_lower_bound": 4, "certified_count": 4}
        self.check_values(placement["states"], availability=0.95, confidence=0.99, certified=True, **counts)
        self.check_values(placement["states"]["nominal"], labels_below=1)
        self.check_values(placement, verification="states")
        self.assertTrue(self.text("plan/verification.csv").startswith(f"{HEAD}L0,0.95,"))
        self.holds("plan/labels.csv", ",availability,description,fixture,face,board\n")
        self.assertIn("While the shop changes", self.check_report())

        verify = f"verify store.json {{}} --states 300 {FEW}"
        self.says(verify.format("plan/placement.json"), CERTIFIED)
        units = "".join(f"U{y},1,{y},2.9,0,0,-1,0,t\n" for y in (2, 6, 10))
        self.write("units.csv", f"id,x,y,z,ax,ay,az,roll_deg,type\n{units}")
        verify = verify.format("units.csv")
        parts = ("Undecided labels: L1, reached ", "The best addition is U11 at (11, 6, 2.9) m")
        self.says(f"{verify} -o units-states.csv", *parts, status=1)
        self.holds("units-states.csv", "L1,0.95,300,")
        self.refused(f"{verify} --availability 95% --mean-missed 2", "--mean-missed")

    def missed(self, state, selected, seed):
        """The labels that the pallets of a state cut off from all chosen units."""
        self.told(f"inspect store.json --seed {seed} --state {state} -o state.json --quiet")
        blocked = {f"U{fixture['id'][1:]}" for fixture in self.json("state.json")["fixtures"]}
        free = {unit[1] for unit in set(selected) - blocked}
        return [f"L{aisle}" for aisle in "012" if aisle not in free]

    def test_shown_are_those_that_were_examined(self):
        """With the seed of the plan, not of its signals. Unit tests (PageStates) prove that the page shows these."""
        self.write("store.json", known_states(*[(0.3, 0.3)] * 3))
        self.told(f"simulate store.json --seed 5 -o signal.h5 {FEW}")
        self.told(f"plan store.json --availability 50% --states 20 --signal signal.h5 --seed 2 -o plan {FEW}")
        placement = self.json("plan/placement.json")
        self.assertEqual(placement["seed"], 2)
        self.assertIn("2; 5 of the signals", self.check_report())
        examined = {one["state"]: one["missed"] for one in placement["states"]["shown_states"]}
        self.assertGreaterEqual(len(examined), 4)
        for seed, is_same in ((2, True), (5, False)):
            found = {state: self.missed(state, placement["selected"], seed) for state in examined}
            self.assertEqual(found == examined, is_same, seed)
