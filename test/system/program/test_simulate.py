"""Signals of `simulate`, their forms, and their summaries."""

import json

import h5py
import numpy as np
from harness import FEW, PreparedTest, ShopTest, small_store, store_with


class Simulate(ShopTest):
    def test_a_matrix_for_each_number_of_bounces(self):
        """The sum of nine layers is exact in single precision. The control omits one layer."""
        self.told("simulate store.json -o signal.h5 --samples 640 --max-bounces 8 --by-bounce")
        names = ("mean", "direct", *(f"bounces/{k}/mean" for k in range(9)))
        mean, direct, *layers = (np.array(values) for values in self.signals("signal.h5", *names))
        self.assertEqual(layers[0].tolist(), direct.tolist())
        self.assertLess(abs(sum(layers) / mean - 1).max(), 1e-6)
        self.assertGreater(abs(sum(layers[:8]) / mean - 1).max(), 1e-6)

    def test_strategies_agree(self):
        """Their sums of signals agree within 4 standard errors, estimated from 12 seeds. The control lacks paths."""
        self.write("store.json", store_with({"materials/m/reflectance": 0.7, "transceiver_types/ceiling/radius": 0.2}))

        def total(options):
            self.told(f"simulate store.json -o signal.h5 --samples 2000 {options}")
            return np.sum(self.signals("signal.h5"))

        reference = total("")
        for options, expected, error in (
            ("--strategy walk", 1, 0.09),
            ("--strategy nee --direct exact", 1, 0.02),
            ("--strategy mis --heuristic power", 1, 0.02),
            ("--strategy particle", 1, 0.02),
            ("--max-bounces 1", 0.5, 0.1),
        ):
            self.assertAlmostEqual(total(options) / reference, expected, delta=error, msg=options)

    def test_threads_do_not_change_signals_and_seeds_do(self):
        for direct in ("sampled", "exact"):
            found = []
            for options in (*(f"--seed 7 --threads {threads}" for threads in (1, 2, 5, 0)), "--seed 8 --threads 1"):
                self.told(f"simulate store.json -o signal.h5 --samples 640 --quiet --direct {direct} {options}")
                found.append(self.bytes("signal.h5"))
            self.assertEqual([one == found[0] for one in found], 4 * [True] + [False], direct)


class Signals(PreparedTest):
    def prepare(self):
        self.told("simulate store.json -o signal.h5 --samples 2000 --direct exact")
        self.told("place signal.h5 -o placement.json")

    def test_are_placed(self):
        mean, samples, batches = self.signals("signal.h5", "mean", "labels/samples", "labels/batches")
        self.assertEqual((len(mean), len(mean[0]), batches[0]), (17, 12, 32))
        self.assertGreaterEqual(samples[0], 2000)
        count = len(self.json("placement.json")["selected"])
        self.assertGreaterEqual(count, 2)
        self.check_values("placement.json", status="optimal", count=count, count_lower_bound=count)

    def test_are_exported(self):
        for name, begin, part in (
            ("model.mps", b"", b"ENDATA"),
            ("model.lp", b"", b"End"),
            ("mean.csv", b"label,G1-1-1,", b""),
            ("mean.npy", b"\x93NUMPY", b""),
        ):
            self.assertEqual(self.told(f"export signal.h5 -o {name}"), f"{name}\n")
            self.assertTrue(self.bytes(name).startswith(begin), name)
            self.assertIn(part, self.bytes(name))
        for what in ("direct", "standard-error"):
            self.told(f"export signal.h5 -o {what}.csv --what {what}")
        self.assertEqual(len({self.bytes(f"{what}.csv") for what in ("mean", "direct", "standard-error")}), 3)
        # The exported matrix has the same placement; NPY has no ids.
        for name, key in (("mean.csv", "selected"), ("mean.npy", "count")):
            self.told(f"place {name} --threshold 0.03 -o again.json")
            self.assertEqual(self.json("again.json")[key], self.json("placement.json")[key])

    def test_below_0_are_exported_as_0(self):
        """`place` counts such noise as 0, too."""
        noisy = self.write("noisy.h5", self.bytes("signal.h5")[512:])  # without the checksum
        with h5py.File(noisy, "a") as file:
            file["mean"][1, 0] = -0.5 * file["standard_error"][1, 0]
        mean = np.array(self.signals("noisy.h5"))
        self.assertLess(mean[1, 0], 0)
        self.told("export noisy.h5 -o noisy.csv")
        table = np.array([[float(cell) for cell in list(row.values())[1:]] for row in self.rows("noisy.csv")])
        self.assertEqual((table[1, 0], (table < 0).sum(), (table > 0).sum()), (0, 0, (mean > 0).sum()))


class Summaries(ShopTest):
    def simulated(self, options, status=0):
        return self.told(f"simulate store.json -o signal.h5 {options}", status=status)

    def summary(self, options, status=0):
        return json.loads(self.simulated(f"{options} --json", status))

    def flagged(self, share):
        """The number of flagged entries above a share of their label's requirement."""
        names = ("mean", "flags", "labels/requirement")
        means, flags, requirements = (np.array(values) for values in self.signals("signal.h5", *names))
        return ((means > share * requirements[:, None]) & (flags != 0)).sum()

    def test_flagged_entries_are_counted(self):
        """Two walks per batch find some transceivers only rarely; analytic direct light has no errors."""
        found = self.summary(FEW)["relative_errors"]
        count = found[0]["flagged"]
        self.assertTrue(0 < count <= found[0]["entries"], found)
        for errors in found:
            self.assertEqual(errors["flagged"], self.flagged(errors["above"]))
        text = self.simulated(FEW)
        self.assertIn(f"; {count} of them flagged\n", text)
        self.assertIn("the error is not reliable", text)

        exact = "--estimator uniform --direct exact --max-bounces 0"
        for errors in self.summary(exact)["relative_errors"]:
            self.assertGreater(errors["entries"], 0)
            self.assertEqual(errors["flagged"], 0)
        self.assertNotIn("flagged", self.simulated(exact))

    def test_extra_samples_are_reported(self):
        self.write("store.json", small_store(fixtures=[]))
        reason = ": at least 16 batches are needed to estimate errors\n"
        self.assertIn(f"\n2096 samples per label instead of 64{reason}", self.simulated("--samples 64"))
        plan = self.told("plan store.json -o plan --samples 64 --no-certificate")
        self.assertIn(f"\n  2096 samples per label instead of 64{reason}", plan)
        summary = self.summary("--samples 64")
        self.assertEqual((summary["asked"], summary["samples"]), (64, [2096, 2096]))
        # Sixteen batches of 131 rays cover 1966 to 2096 samples; the uniform estimator has 32 batches, each of a whole
        # number of samples.
        self.assertIn(f"instead of 1965{reason}", self.simulated("--samples 1965"))
        for options in ("--samples 1966", "--samples 2500", "--samples 65 --estimator uniform", "--time 0.1"):
            self.assertNotIn("instead of", self.simulated(options), options)
        self.assertIsNone(self.summary("--time 0.1")["asked"])

    def test_warnings_of_the_store_come_first(self):
        place = "materials/m/reflectance"
        self.write("store.json", store_with({place: 0.98}))
        warning = "store.json: materials.m.reflectance: material 'm' reflects 0.98 of the light"
        plan = self.told(f"plan store.json -o plan {FEW} --no-certificate")
        for out in (self.simulated(FEW), plan):
            self.assertTrue(out.startswith(f"warning: {warning}"), out)
        summary = self.summary(FEW)
        self.assertTrue(summary["warnings"][0].startswith(warning), summary)
        self.assertEqual(summary["found_by_chance"], [])
        self.assertEqual(self.simulated(f"{FEW} --quiet"), "")
        self.write("store.json", store_with({place: 0.96}))
        self.assertNotIn("warning", self.simulated(FEW))

    def test_entries_that_fall_short_are_named(self):
        """A run that cannot reach the wanted error fails, unless a certificate quantifies the error."""
        self.write("store.json", small_store(fixtures=[]))
        wanted = "--relative-error 1e-5 --max-samples 2620"
        text = self.simulated(wanted, status=3)
        summary = self.summary(wanted, status=3)
        self.assertEqual(summary["unmet"]["error"], 1e-5)
        self.assertGreater(summary["unmet"]["entries"], 0)
        self.assertLessEqual(summary["samples"][1], 2620)
        worst = summary["unmet"]["worst"][0]
        self.assertIs(worst["out_of_reach"], True)
        self.assertIn(f"label '{worst['label']}' from '{worst['transceiver']}': ", text)
        plan = f"plan store.json -o plan {wanted}"
        for out in (text, self.told(f"{plan} --no-certificate", status=3), self.told(f"{plan} --overwrite")):
            self.assertIn("0.001 %", out)
