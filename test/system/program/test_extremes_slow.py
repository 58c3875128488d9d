"""Very many labels."""

from harness import FEW, ProgramTest, store_with


class Extremes(ProgramTest):
    def test_a_hundred_thousand_labels_under_four_units(self):
        """The matrix is complete, and every label has a result."""
        label = {"normal": [0, 0, 1], "type": "standard"}
        places = ([0.1 + 0.25 * (k % 400), 0.1 + 0.3 * (k // 400), 1.2] for k in range(100_000))
        grid = {"type": "ceiling", "min": [25, 20], "max": [75, 60], "spacing": 25, "z": 3.9}
        store = store_with(
            {
                "fixtures": [],
                "label_types/standard/threshold": 1e-6,
                "room/size": [100, 80, 4],
                "labels": [{"id": f"L{k}", "position": place, **label} for k, place in enumerate(places)],
                "transceivers": {"grids": [grid]},
            }
        )
        self.write("store.json", store)
        self.told(f"plan store.json -o plan {FEW} --max-bounces 1 --no-certificate")
        answer = self.json("plan/placement.json")
        self.assertEqual(answer, answer | {"labels": 100_000, "unreachable": [], "status": "optimal"})
