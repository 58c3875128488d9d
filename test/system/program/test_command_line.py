"""Help, forms of output, and wrong use."""

import json

from harness import FEW, ProgramTest, ShopTest

VERBS = ("new", "inspect", "simulate", "place", "plan", "verify", "report", "compare", "diff", "export")


class Help(ProgramTest):
    def test_pages(self):
        pages = {verb: self.told(verb, "--help") for verb in VERBS}
        general = self.told("--help")
        for page in (general, *pages.values()):
            for line in page.splitlines():
                self.assertLessEqual(len(line.encode()), 80, line)
        self.assertIn("Exit codes: 0 success; 1", general)
        for verb, page in pages.items():
            self.assertIn(f"\n  {verb} ", general)
            for part in (f":\n  shelfbeam {verb} ", "--seed", "--threads", "--quiet", "--json"):
                self.assertIn(part, page, verb)
        for solver in ("auto (default): ", "search: ", "mip: ", "greedy: "):
            self.assertIn(solver, pages["place"])
            self.assertIn(solver, pages["plan"])
        self.assertIn("\nUsage: shelfbeam plan STORE -o PATH [OPTIONS]\n", pages["plan"])
        for line, page in (("", general), ("-h", general), ("help", general), ("help plan", pages["plan"])):
            self.assertEqual(self.told(line), page, line)
        self.assertEqual(self.told("plan -h"), pages["plan"])

    def test_version(self):
        self.assertRegex(self.told("--version"), r"\A\d+\.\d+\.\d+\n\Z")


class Forms(ShopTest):
    def setUp(self):
        super().setUp()
        self.write("matrix.csv", "label,T1,T2\nL1,1,2\nL2,3,0\n")

    def outputs(self, flag):
        """The output of every verb, run once with the flag."""
        return {
            line: self.told(f"{line} {flag}")
            for line in (
                "new thesis 'thesis\"1\"'",
                "inspect store.json -o plan.svg",
                f"simulate store.json -o signal.h5 {FEW}",
                "place matrix.csv --threshold 2 -o placement.json",
                f"plan store.json -o plan {FEW}",
                "report plan",
                "export matrix.csv -o model.lp --threshold 2",
            )
        }

    def test_quiet_prints_nothing(self):
        self.assertEqual(set(self.outputs("--quiet").values()), {""})

    def test_json_is_an_object(self):
        for line, out in self.outputs("--json").items():
            self.assertIsInstance(json.loads(out), dict, line)
        self.assertEqual(self.json("placement.json")["count"], 2)

    def test_wrong_use(self):
        required = "does not exist, and --output is required"
        self.refused_each(
            ("simulat", "'simulat'; did you mean 'simulate'?\n"),
            ("simulat --help", "'simulat'; did you mean 'simulate'?\n"),
            ("help simulat", "'simulat'; did you mean 'simulate'?\n"),
            ("certify store.json", "'certify'"),
            ("--frobnicate", "unknown option '--frobnicate'; see 'shelfbeam --help'"),
            ("--quiet inspect store.json", "'--quiet' must follow the verb: shelfbeam inspect ... --quiet"),
            ("--budget 3", "'--budget' belongs to 'plan' and 'verify' and must follow the verb"),
            ("new thesi out", "'thesi'; did you mean 'thesis'?"),
            ("new thesis", "DIR is required"),
            ("inspect", "STORE is required; for example: shelfbeam inspect store.json -o plan.svg; see "),
            ("inspect ''", "STORE: "),
            ("simulate store.json", "error: --output is required"),
            ("simulate none.json", f"none.json: {required}"),
            ("simulate store.json -o", "--output: PATH is missing"),
            ("plan store.json", "--output is required; for example: shelfbeam plan store.json -o plan; see "),
            ("plan none.json", f"none.json: {required}"),
            ("plan none.json -o out --confidence 99", "none.json"),
            ("plan --sampels=100 store.json", "error: unknown option '--sampels'; did you mean '--samples'?\n"),
            ("plan store.json -output=out", "'-output'; did you mean '--output'?"),
            ("batch none.txt", f"none.txt: {required}"),
            ("diff none", "none: does not exist, and PLAN2 is required"),
            ("export matrix.csv -o model.xml", "model.xml: "),
            ("export matrix.csv -o model", "model: "),
            ("export signal.h5 -o a.csv --what variance", "--what"),
        )

    def test_wrong_options(self):
        """Each error names the option. A row that is only a text begins with that option.

        More values of --state: test/system/field/limits.py.
        """
        self.refused_each(
            ("--frobnicate", "'--frobnicate'; see 'shelfbeam inspect --help'"),
            ("extra", "unexpected argument 'extra'"),
            ("-o ''", "--output: "),
            "--threads -1",
            "--seed 1.5",
            command="inspect store.json",
        )
        self.refused_each(
            ("--sampels 100", "error: unknown option '--sampels'; did you mean '--samples'?\n"),
            ("-samples 100", "'-samples'; did you mean '--samples'?"),
            ("--conf 0.9", "'--conf'; did you mean '--confidence'?"),
            ("-x", "unknown option '-x'; see "),
            ("--by-bounce", "'--by-bounce' belongs to 'simulate', not to 'plan'; see "),
            ("-o out", "--output is given more than once"),
            ("--model coperative", "--model: unknown value 'coperative'; did you mean 'cooperative'?"),
            (f"--samples {500 * '7'}", f"--samples: '{26 * '7'}...{13 * '7'}' is not a whole number from 64 to"),
            ("--states ''", "--states: '' is not a whole number from 0 to 10000"),
            ("--relative-error 0.1 --samples 100", "excludes"),
            ("--confidence 1", "--confidence: '1' is not a share from 0.5 to"),
            ("--memory 4X", "--memory: '4X' is not a size such as 4G or 500M"),
            "--by-bounce --max-bounces 3",
            "--by-length 1",
            "--relative-error 0",
            "--above 0.1",
            "--above 0.1 --samples 640",
            "--time -1",
            "--checkpoint-interval -1",
            command="plan store.json -o out",
        )
        self.refused_each(
            ("--budget 3", "'--budget' belongs to 'plan' and 'verify', not to 'simulate'; see "),
            ("--state 18446744073709551616", "--state: '18446744073709551616'"),
            ("--states 100001", "--states: '100001' is not a whole number from 1 to"),
            ("--states 99999999999999999999", "--states: '9999"),
            ("--by-bounce", "--max-bounces"),
            ("--lengths 3", "--by-length"),
            "--samples 0",
            "--samples 1e99",
            "--strategy bdpt",
            "--max-bounces -1",
            "--by-length 0",
            "--max-bounces 3 --estimator reuse",
            "--direct sampled --estimator reuse",
            "--direct exact --by-length 1",
            "--by-length 1 --estimator reuse",
            "--strategy particle --by-length 1",
            command="simulate store.json -o out",
        )
        self.refused_each(
            ("--threshold 0", "--threshold: '0'"),
            ("--threshold inf", "--threshold"),
            ("--threshold 2 --weighted --lexicographic", "excludes"),
            ("--at-most 99999999999999999999999 --threshold 2", "--at-most: '99999999999999999999999'"),
            "--time-limit 0 --threshold 2",
            "--share -1 --threshold 2",
            "--model coop --threshold 2",
            "--backend cplex --threshold 2",
            command="place matrix.csv",
        )
