"""Questions to `place`, and its answers."""

import itertools
import shutil

from harness import FEW, ROOT, ProgramTest, ShopTest

WEIGHTS = "--weights weights.csv"


class Small(ProgramTest):
    """Matrices of a few labels, with the requirement 1."""

    def setUp(self):
        super().setUp()
        self.write("m.csv", "label,A,B,C\nL1,1,0,1\nL2,1,0,1\nL3,1,0,0\nL4,0,1,1\nL5,0,1,1\nL6,0,1,0\n")
        self.write("dark.csv", "label,A\nL1,1\nL2,0\n")
        self.write("pairs.csv", "a,b\nA,B\n")
        self.write("day.csv", "label,A,B,C\nL1,2,0,1\nL2,0,4,1\n")
        self.write("night.csv", "label,C,B,A\nL1,0,3,0\n")
        self.write("weights.csv", "id,weight\nL3,5\nL6,0.5\n")
        self.write("ones.csv", "id,weight\nL3,1\nL6,1.0\n")

    def place(self, line, *parts, status=0):
        with self.subTest(line=line):
            self.says(f"place --threshold 1 {line}", *parts, status=status)

    def placed(self, options, status=0):
        """The result for m.csv, without the steps and the wall time."""
        answer = self.answer(f"place m.csv --threshold 1 {options}", status)
        return {key: value for key, value in answer.items() if key not in ("steps", "seconds")}

    def test_prints_the_documented_sentences(self):
        """The blocks of test/data/messages.txt, by line."""
        reach = "2 transceivers reach all 6 labels (cooperative)"
        best = f"{reach}; it is proven that 1 is not enough.\n"
        for line, *parts in (
            (
                "m.csv",
                best,
                "\n  chosen: A, B\n",
                ": A 3, B 3\n",
                "\n  optimal: value 2, lower bound 2, gap 0.0 %; ",
                ", solver search\n",
                "\n  bound: exhaustive search, log checked; among equally good",
            ),
            ("m.csv --solver search", "optimal", "solver search\n"),
            (
                "m.csv --solver greedy",
                "labels (cooperative); at least 2 transceivers are needed.\n",
                "\n  feasible: value 3, lower bound 2, gap 33.3 %; ",
                "solver greedy\n",
            ),
            # The curve contains a better placement than the greedy one, and proves that none is better.
            ("m.csv --solver greedy --curve", best, "      1                     66.6 %    66.7 %\n"),
            (
                "m.csv --at-most 1",
                "1 transceiver reaches 4 of 6 labels, 66.7 % (cooperative); it is proven that no single "
                "transceiver reaches more.\n  chosen: C\n  optimal: reached 4, upper bound 4, gap 0.0 %; ",
            ),
            (f"m.csv --at-most {2**32}", f"{reach}.\n"),
            (f"m.csv --at-most {2**64 - 1}", f"{reach}.\n"),
            (
                "day.csv --survive-failure",
                "3 transceivers reach all 2 labels (cooperative, even if any one unit fails)",
            ),
            (
                "day.csv night.csv",
                "2 transceivers reach all 3 labels",
                "day: 2 labels; the label with the minimum margin (day:L1) receives 2 times",
                "night: 1 label; the label with the minimum margin (night:L1) receives 3 times",
            ),
        ):
            self.place(line, *parts)

    def test_prints_the_reason_if_no_selection_reaches_all(self):
        lost = "L3: maximum signal 0, requirement 1 (light arrives from only one mounting point"
        excluded = (
            "because some candidates must not be chosen together (proven by",
            "\n  1 pair of candidates is excluded",
        )
        together = "2 cannot be reached even by all candidates together if"
        two_units = "if any one unit fails: 2 cannot be reached by two units.\n"
        for line, *parts in (
            ("m.csv --survive-failure", together, lost, "\n  infeasible; ", "solver not needed\n"),
            ("m.csv --survive-failure --model non-cooperative", two_units, lost),
            ("m.csv --forbid pairs.csv", *excluded),
            ("dark.csv", "L2: maximum signal 0, requirement 1 (no light arrives; "),
        ):
            self.place(line, *parts, status=1)
        self.says("place m.csv --threshold 2 --curve", "'--at-most K'", status=1)

    def test_describes_coverage(self):
        weighed = "1 transceiver reaches 3 of 6 labels, 73.7 % of the weight (cooperative); it is proven that no single"
        fewest = "1 transceiver reaches 4 of 6 labels, 66.7 % (cooperative); 60 % are required, and it is proven that"
        value = "\n  chosen: A\n  optimal: reached weight 7 of 9.5, upper bound 7, gap 0.0 %"
        table = "  units   weight reached: at least   at most\n", "      1                     73.6 %    73.7 %\n"
        for options, *parts in (
            (f"--at-most 1 {WEIGHTS}", f"{weighed} transceiver reaches more.{value}"),
            ("--reach 60%", f"{fewest} fewer are not enough.\n  chosen: C\n  optimal: count 1, lower bound 1; "),
            ("--reach 0.7", "2 transceivers reach", "70 % are required, and it is proven that 1 is not enough"),
            (f"--reach 80 {WEIGHTS}", "2 transceivers reach", "80 % are required"),
            (f"--curve {WEIGHTS}", *table),
        ):
            self.place(f"m.csv {options}", *parts)
        none = "No selection reaches 100 % of the 6 labels (cooperative, even if any one unit fails); "
        most = "it is proven that none reaches more than 66.7 %.\n  infeasible; "
        self.place("m.csv --reach 1 --survive-failure", f"{none}{most}", status=1)

    def test_writes_coverage(self):
        missed = {"missed": ["L4", "L5", "L6"]}
        weighed = {"reached_weight": 7, "weight_upper_bound": 7, "total_weight": 9.5, **missed}
        none = {"status": "infeasible", "count": None, "count_lower_bound": None, "reachable": 4}
        for options, status, expected in (
            (f"--at-most 1 {WEIGHTS} -o reach.json", 0, weighed),
            ("--reach 60%", 0, {"target": 4, "count": 1, "count_lower_bound": 1}),
            (f"--reach 60% {WEIGHTS}", 0, {"reached_weight": 7}),
            ("--reach 100% --survive-failure", 1, none),
        ):
            answer = self.placed(options, status)
            self.assertEqual(answer, answer | expected, options)
        self.assertEqual(self.json("reach.json"), self.json("reach.json") | missed)
        curve = self.placed(f"--curve {WEIGHTS}")
        one, two, *_ = curve["curve"]
        self.assertEqual((curve["total_weight"], two["at_most"]), (9.5, 6))
        self.assertEqual((one["weight_at_least"], one["weight_at_most"]), (7, 7))

    def test_weights_of_one_are_no_weights(self):
        for options in ("--at-most 1", "--curve", "--reach 70%"):
            self.assertEqual(self.placed(f"{options} --weights ones.csv"), self.placed(options), options)

    def test_coverage_by_two_units_is_proven_in_the_thesis_store(self):
        """Linear programming bounds leave some thirty labels open."""
        shutil.copy(ROOT / "examples/thesis/store.json", self.folder)
        self.told(f"simulate store.json -o signal.h5 {FEW}")
        place = "place signal.h5 --threshold 0.03 --at-most 2 --solver"
        two, greedy = (self.answer(f"{place} {solver}") for solver in ("search", "greedy"))
        self.assertEqual((two["status"], two["bound_proof"], two["solver"]), ("optimal", "log", "search"))
        self.assertEqual(two["reached"], two["reached_upper_bound"])
        self.assertGreaterEqual(two["reached"], greedy["reached"])
        self.assertLess(two["reached"], greedy["reached_upper_bound"])

    def test_starts_with_an_earlier_answer(self):
        self.told("place m.csv --threshold 1 -o best.json")
        self.place("m.csv --solver greedy --start best.json", "2 transceivers reach all 6 labels", "\n  chosen: A, B\n")
        # The printed object is a placement file, too; units that it lacks are added if they are pinned.
        self.write("printed.json", self.told("place m.csv --threshold 1 --json"))
        self.place("m.csv --solver greedy --start printed.json --pin C", "3 transceivers reach all 6 labels")

    def test_prints_json(self):
        best, reach, whole, two = (
            self.answer(f"place --threshold 1 {line}")
            for line in (
                "m.csv",
                "m.csv --at-most 1 -o reach.json",
                "m.csv --curve",
                "day.csv --forbid pairs.csv night.csv",
            )
        )
        self.check_values(best["steps"][0], name="greedy", value_before=None, value=3)
        self.assertEqual(best["steps"][-1]["value"], 2)
        self.check_values(reach, missed=["L3", "L6"], reached_upper_bound=4)
        self.check_values("reach.json", missed=reach["missed"])
        self.assertEqual((len(whole["curve"]), whole["curve_complete"]), (2, True))
        self.assertEqual((whole["curve"][0]["at_most"], whole["critical"][0]["count"]), (4, 3))
        self.assertEqual((two["selected"], two["scenarios"][1]["name"]), (["B", "C"], "night"))

    def test_a_file_holds_one_objective(self):
        self.write("two.csv", "label,A,B\nL1,1,1\n")
        links = "export two.csv -o m.lp --threshold 1 --objective links --model non-cooperative"
        self.refused(links, "--objective links", "--weighted")
        self.told(f"{links} --weighted")
        self.holds("m.lp", "\n cost: + 2 A + 2 B\n")  # a unit and its link


class Simulated(ShopTest):
    def simulate(self, name):
        (self.folder / name).parent.mkdir(exist_ok=True)
        self.told(f"simulate store.json -o {name} --samples 640 --direct exact --quiet")

    def test_every_problem_has_a_placement(self):
        self.simulate("signal.h5")
        for model, objective, combination, solver in itertools.product(
            ("cooperative", "non-cooperative"),
            ("count", "links", "effective-links", "signal"),
            ("lexicographic", "weighted"),
            ("mip", "greedy"),
        ):
            problem = f"--model {model} --objective {objective} --{combination} --solver {solver}"
            self.told(f"place signal.h5 -o placement.json {problem}")
            self.check_values("placement.json", model=model, objective=objective, combination=combination)
            # Multipliers may prove that the greedy placement is optimal.
            status = self.json("placement.json")["status"]
            self.assertTrue(status == "optimal" if solver == "mip" else status != "infeasible", problem)

    def test_scenarios_are_named_by_their_folders(self):
        self.simulate("full/signal.h5")
        self.simulate("empty/signal.h5")
        # The shortest unambiguous names, with the extension if nothing else differs.
        for name in ("night.h5", "night.hdf5"):
            shutil.copy(self.folder / "full/signal.h5", self.folder / name)
        for files, *names in (
            ("full/signal.h5 empty/signal.h5", "full/signal", "empty/signal"),
            ("full/signal.h5 empty/signal.h5 night.h5", "full/signal", "empty/signal", "night"),
            ("night.h5 night.hdf5", "night.h5", "night.hdf5"),
        ):
            answer = self.answer(f"place {files}")
            self.assertEqual([scenario["name"] for scenario in answer["scenarios"]], names)
            self.assertTrue(answer["critical"][0]["labels"][0].startswith(f"{names[0]}:"), answer)
        self.refused("place night.h5 full/../night.h5", "night.h5", "scenario")
