"""Extreme problems: one of everything, no label reached, all labels reached, equal candidates."""

from harness import ProgramTest, small_store, store_with


def smallest_store(threshold, reflectance=0.3, normal=(1, 0, 0)):
    """One candidate and one label."""
    candidate = {"id": "T", "position": [4, 3, 2.9], "type": "ceiling"}
    return store_with(
        {
            "fixtures": [],
            "materials/m/reflectance": reflectance,
            "label_types/standard/threshold": threshold,
            "labels/0/normal": normal,
            "transceivers": {"list": [candidate]},
        }
    )


class Extremes(ProgramTest):
    def planned(self, store, options="", status=0):
        self.write("store.json", store)
        self.told(f"plan store.json -o plan --samples 640 --overwrite {options}", status=status)
        return self.json("plan/placement.json")

    def test_one_label_and_one_candidate(self):
        answer = self.planned(smallest_store(0.001))
        self.assertEqual(answer, answer | {"status": "optimal", "selected": ["T"], "count_lower_bound": 1})

    def test_no_label_is_reached(self):
        dark = self.planned(smallest_store(1e-12, 0, (-1, 0, 0)), status=1)
        weak = self.planned(smallest_store(1e9), status=1)
        self.assertEqual((dark["status"], weak["status"]), ("infeasible", "infeasible"))
        self.assertEqual([label["most"] for label in dark["unreachable"]], [0])
        self.assertGreater(weak["unreachable"][0]["most"], 0)

    def test_every_unit_reaches_every_label(self):
        store = small_store(label_types={"standard": {"threshold": 1e-12}})
        for model in ("cooperative", "non-cooperative"):
            answer = self.planned(store, f"--model {model}")
            self.assertEqual(answer, answer | {"status": "optimal", "count": 1, "count_lower_bound": 1}, model)

    def test_all_candidates_are_alike(self):
        """The count is the smallest whose sum of 0.01 meets the requirement.

        The sum may be equal to the requirement, which 4 x 0.01 in single precision is not.
        """
        self.write("matrix.csv", ("0.01," * 11 + "0.01\n") * 3)
        optimal, none = {"status": "optimal"}, {"status": "infeasible"}
        for options, status, expected in (
            *(
                (threshold, 0, optimal | {"count": count, "count_lower_bound": count})
                for threshold, count in ((0.005, 1), (0.01, 1), (0.035, 4), (0.04, 4), (0.0401, 5), (0.12, 12))
            ),
            ("0.1201", 1, none),
            ("0.01 --model non-cooperative", 0, {"count": 1}),
            ("0.0101 --model non-cooperative", 1, none),
        ):
            self.told(f"place matrix.csv -o placement.json --threshold {options}", status=status)
            answer = self.json("placement.json")
            self.assertEqual(answer, answer | expected, options)
