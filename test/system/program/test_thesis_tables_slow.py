"""scripts/thesis-tables: our numbers for the paper's environment beside the paper's."""

import json
import os

from harness import PROGRAM, ROOT, ProgramTest, run


class ThesisTables(ProgramTest):
    def tables(self, limit):
        settings = {"SHELFBEAM": PROGRAM, "TIME_LIMIT": limit}
        end = run("--quick", self.folder, program=ROOT / "scripts/thesis-tables", env={**os.environ, **settings})
        self.assertEqual(end.status, 0, end.err)
        return end.out

    def test_are_compared_with_the_paper(self):
        optimal, heuristic = self.tables("5").split("Table 3.1")[1].split("Table 3.2")
        # Our number and the paper's in the first columns of the first two tables.
        for solver, table, paper in (("auto", optimal, "8 54%"), ("greedy", heuristic, "10 77%")):
            answer = self.json(f"5000-non-cooperative-count-{solver}.json")
            ours = f"{answer['count']} {100 * answer['redundant_share']:.0f}%"
            self.assertIn(f"    5000 | {ours:<14} {paper} ", table)
        self.assertEqual(self.json("5000-non-cooperative-count-auto.json")["status"], "optimal")

        # With another time limit, final results are reused and stopped ones are not.
        name = "5000-cooperative-count-auto-5s.json"
        stopped = self.json(name)
        self.assertEqual(stopped["status"], "optimal")
        self.write(name, json.dumps({**stopped, "status": "stopped"}))
        self.tables("6")
        for problem, is_solved_again in (
            ("non-cooperative-count-auto", False),
            ("non-cooperative-count-greedy", False),
            ("cooperative-count-auto", True),
        ):
            self.assertEqual((self.folder / f"5000-{problem}-6s.json").exists(), is_solved_again, problem)
