"""`compare`: measurements in a kiosk in millivolts, up to 0.3 dB off the simulated signals."""

import math

from harness import PreparedTest, contents


def noise(k):
    return 10 ** (0.03 * math.sin(12.9898 * k))


class Compare(PreparedTest):
    def prepare(self):
        self.told("simulate store.json -o signal.h5 --samples 4000 --estimator uniform")

    def setUp(self):
        super().setUp()
        self.mean, *ids = self.signals("signal.h5", "mean", "labels/id", "transceivers/id")
        self.labels, self.units = ([id.decode() for id in of] for of in ids)

    def pairs(self, wrong=""):
        """Measurements of all pairs, 250 mV per W/m^2. Those that begin with `wrong` are far too large."""
        lines = []
        for i, label in enumerate(self.labels):
            for j, unit in enumerate(self.units):
                value = 250 * self.mean[i][j] * noise(i * len(self.units) + j)
                pair = f"{label},{unit},"
                lines.append(f"{pair}{'9' if pair == wrong else ''}{value},{0.06 * value + 0.01}\n")
        return "label,transceiver,signal,error\n" + "".join(lines)

    def check_factor(self, answer, expected):
        self.assertTrue(answer["factor_low"] < expected < answer["factor_high"], answer)

    def test_finds_the_factor_of_pairs(self):
        self.write("m.csv", self.pairs())
        parts = ("times the simulated signals", "errors explain the differences", "No pair is an outlier.")
        self.says("compare signal.h5 m.csv -o out", *parts, "comparison.csv", "comparison.html")
        self.assertEqual(contents(self.folder / "out").keys(), {"comparison.csv", "comparison.html"})
        answer = self.answer("compare signal.h5 m.csv")
        self.check_values(answer, pairs=len(self.labels) * len(self.units), one_factor=True, outliers=[])
        self.check_factor(answer, 250)
        self.assertAlmostEqual(answer["factor"], 250, delta=5)
        self.write("wrong.csv", self.pairs("door,G1-1-1,"))
        found = self.answer("compare signal.h5 wrong.csv")
        self.assertEqual(([outlier["label"] for outlier in found["outliers"]], found["one_factor"]), (["door"], False))

    def test_finds_the_factor_of_a_placement(self):
        self.told("place signal.h5 -o placement.json")
        selected = [self.units.index(unit) for unit in self.json("placement.json")["selected"]]
        lines = [
            f"{label},{8 * noise(i) * sum(self.mean[i][j] for j in selected)}\n" for i, label in enumerate(self.labels)
        ]
        self.write("m.csv", "label,signal\n" + "".join(lines))
        answer = self.answer("compare signal.h5 m.csv --placement placement.json -o c.html")
        self.assertTrue(self.text("c.html").startswith("<!DOCTYPE html>"))
        self.check_values(answer, report="c.html", p_value=None)
        self.check_values(answer["worst"][0], transceiver=None)
        self.check_factor(answer, 8)

    def test_refuses_values_beyond_its_range(self):
        """Ratios and squares of these values would overflow."""
        head = "label,transceiver,signal,error\ndoor,G1-1-1,"
        for values, problem in (
            ("1e160,1", "field 3: is greater than 1e18"),
            ("-1e160,1", "field 3: is less than -1e18"),
            ("1,1e160", "field 4: is greater than 1e18"),
            ("1e-160,1", "field 3: is 1e-160, which is nearer to 0 than 1e-18"),
            ("1,1e-160", "field 4: is 1e-160, which is nearer to 0 than 1e-18"),
        ):
            self.write("m.csv", f"{head}{values}\n")
            self.refused("compare signal.h5 m.csv", f"m.csv: line 2, {problem}")
        # Control: the limits themselves.
        self.write("m.csv", f"{head}1e18,1e-18\ndoor,G1-2-1,-1e18,1e18\ndoor,G1-3-1,1e-18,1\ndoor,G1-4-1,0,1\n")
        self.assertLess(self.run_here("compare signal.h5 m.csv").status, 3)

    def test_refuses_what_cannot_be_compared(self):
        good = self.pairs()
        self.write("placement.json", "{}")
        for content, options, *parts in (
            ("label,signal\ndoor,1\n", "", "m.csv", "--placement"),
            ("label,transceiver,signal\ndor,G1-1-1,1\n", "", "m.csv: line 2", "'door'"),
            ("label,transceiver,signal\ndoor,G1-1-1,1\n", "", "m.csv", "three"),
            (good, "--placement placement.json", "remove --placement"),
            (good, "-o m.csv", "m.csv: "),
            (good, "-o page.txt", ".csv or .html"),
            (good, "-o missing/page.html", "missing"),
            (good, "--confidence 1", "--confidence"),
        ):
            self.write("m.csv", content)
            self.refused(f"compare signal.h5 m.csv {options}", *parts)
