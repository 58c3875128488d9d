"""Compares the signals in a store written with computed shapes with those in a store whose triangles come from an
independent script."""

import json
import pathlib
import tempfile
import unittest

import numpy as np

import program
import shop_twin

SAMPLES = 107000
ENTRIES = 156
SIGMAS = 4
SHARE = 0.03


class Agreement:
    """How well two independent estimates of a signal matrix agree."""

    def __init__(self, one, other):
        difference, error = np.abs(one.mean - other.mean), np.hypot(one.error, other.error)
        large, totals = one.mean > one.mean.max() / 10, one.mean.sum(axis=1)
        self.sigmas = np.max(difference / error)
        self.share = max(
            np.max((difference / one.mean)[large]), np.max(np.abs(totals - other.mean.sum(axis=1)) / totals)
        )
        # The entries of a row share paths; the sum of their standard errors is an upper bound for that of their sum.
        self.share_error = max(np.max((error / one.mean)[large]), np.max(error.sum(axis=1) / totals))

    def passes(self):
        return self.sigmas <= SIGMAS and self.share <= SHARE


class Signals(unittest.TestCase):
    """No entry may differ by more than 4 standard errors, and no large entry and no total of a label by more than 3 %,
    which must be at least 4 standard errors. Equal stores fail with a probability of at most (156 entries + 26 totals)
    x 6.3e-5 = 1.2 % (Bonferroni): a large entry that differs by 3 % also differs by 4 standard errors.
    """

    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        cls.shop = program.simulate(program.SHOP, cls.folder / "shop.h5", "--samples", SAMPLES, "--seed", 1)

    def agreement(self, shop):
        store = self.folder / "twin.json"
        store.write_text(json.dumps(shop_twin.store(program.read_shop(), shop)), encoding="utf-8")
        twin = program.simulate(store, self.folder / "twin.h5", "--samples", SAMPLES, "--seed", 2)
        self.assertEqual(set(twin.labels), set(self.shop.labels))
        self.assertEqual(set(twin.units), set(self.shop.units))
        return Agreement(self.shop, twin)

    def test_the_twin_has_equal_signals(self):
        found = self.agreement(shop_twin.Shop())
        self.assertEqual(self.shop.mean.size, ENTRIES)
        self.assertLessEqual(found.sigmas, SIGMAS)
        self.assertLessEqual(found.share, SHARE)
        self.assertLessEqual(found.share_error, SHARE / SIGMAS)

    def test_controls_are_rejected(self):
        for shop in (shop_twin.Shop(zone_height=2.6), shop_twin.Shop(fascia="cream")):
            self.assertFalse(self.agreement(shop).passes(), shop)
