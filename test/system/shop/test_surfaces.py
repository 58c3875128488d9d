"""Compares the surfaces, labels and candidates of a store written with computed shapes with those of an independent
script, without simulating."""

import pathlib
import tempfile
import unittest

import numpy as np

import program
import shop_twin
from harness import output

RAYS = 60  # per device
DEVICES = ("labels", "candidates")


def joined(surfaces):
    """All triangles, and the material of each."""
    materials, triangles = zip(*surfaces)
    return np.concatenate(triangles), np.repeat(materials, [len(part) for part in triangles])


def areas(triangles, materials):
    """Material -> area"""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    return {one: np.linalg.norm(normals[materials == one], axis=1).sum() / 2 for one in set(materials)}


def first_hits(origins, directions, triangles, materials):
    """Distance and material of the first hit of each ray (Moeller and Trumbore 1997)."""
    a, b, c = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    normal = np.cross(b, c)

    def of_part(o, d):
        """The factors of the rays' directions, infinite where a ray (row) does not meet a triangle (column)."""
        with np.errstate(divide="ignore", invalid="ignore"):
            scale = -1 / (d @ normal.T)
            # (o - a) x d = o x d - a x d, and (a x d) c = d (c x a)
            u = (np.cross(o, d) @ c.T - d @ np.cross(c, a).T) * scale
            v = (d @ np.cross(b, a).T - np.cross(o, d) @ b.T) * scale
            t = (o @ normal.T - np.sum(a * normal, axis=1)) * scale
        return np.where((u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0), t, np.inf)

    parts = [of_part(*part) for part in zip(np.array_split(origins, 16), np.array_split(directions, 16))]
    hit = np.concatenate([np.argmin(part, axis=1) for part in parts])
    return np.concatenate([part.min(axis=1) for part in parts]), materials[hit]


class Surfaces(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            output("inspect", program.SHOP, "-o", folder / "shop.glb")
            cls.model = [part for part in program.model_surfaces(folder / "shop.glb") if part[0] not in DEVICES]
            cls.signals = program.simulate(program.SHOP, folder / "shop.h5", "--samples", 64, "--estimator", "uniform")
        places = [label[0] for label in shop_twin.labels().values()] + list(shop_twin.candidates().values())
        origins = np.repeat(np.array(places), RAYS, axis=0)
        directions = np.random.default_rng(1).normal(size=origins.shape)
        cls.rays = origins, directions / np.linalg.norm(directions, axis=1, keepdims=True)
        cls.hits = first_hits(*cls.rays, *joined(part[1:] for part in cls.model))

    def different_rays(self, surfaces):
        """The number of rays that do not meet the same material at the same distance as in the program's model."""
        (expected, expected_material), (distance, material) = self.hits, first_hits(*self.rays, *joined(surfaces))
        self.assertTrue(np.isfinite(distance).all())
        return np.count_nonzero((np.abs(distance - expected) > 1e-5) | (material != expected_material))

    def test_rays_from_all_devices_meet_the_same_surfaces(self):
        self.assertEqual(self.different_rays(shop_twin.surfaces()), 0)

    def test_rays_notice_changes(self):
        for change in ({"zone_height": 2.51}, {"fascia": "cream"}, {"turn": 0.1}):
            self.assertGreater(self.different_rays(shop_twin.surfaces(shop_twin.Shop(**change))), 5, change)

    def test_fixtures_have_equal_areas(self):
        # Where these touch, the program omits the parts that the others cover.
        room = ("room", "ceiling", "ceiling bakery", "W")
        model = areas(*joined(part[1:] for part in self.model if part[0] not in room))
        twin = areas(*joined(shop_twin.fixtures()))
        self.assertEqual(set(model), {"steel", "carton", "wood", "brick"})
        for material, area in model.items():
            self.assertAlmostEqual(twin[material], area, delta=1e-4, msg=material)

    def test_labels(self):
        expected = shop_twin.labels()
        self.assertEqual(set(self.signals.labels), set(expected))
        for name, (position, normal, kind) in self.signals.labels.items():
            np.testing.assert_allclose(position, expected[name][0], atol=1e-9, err_msg=name)
            np.testing.assert_allclose(normal, expected[name][1], atol=1e-9, err_msg=name)
            self.assertEqual(kind, expected[name][2], name)

    def test_candidates(self):
        expected = shop_twin.candidates()
        self.assertEqual(set(self.signals.units), set(expected))
        for name, (position, axis) in self.signals.units.items():
            np.testing.assert_allclose(position, expected[name], atol=1e-9, err_msg=name)
            np.testing.assert_array_equal(axis, [0, 0, -1])
