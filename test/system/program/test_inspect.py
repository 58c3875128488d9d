"""The verb `inspect`: tables, JSON, floor plans and 3-D models."""

import math

from harness import ProgramTest, small_store, store_with

UNITS = (("S1", 1, 1, (0, 0, -1)), ("S2", 1, 1, (1, 0, -1)), ("S3", 4, 2, (2, 0, -2)), ("S4", 4, 2, (0, 1, -1)))
WIDE = {"responsivity": {"type": "cosine_power", "exponent": 2}, "size": [0.1, 0.05], "threshold": 0.01}
ROUGH = {"distribution": "ggx", "roughness": 0.5}
SPOT = {"type": "lambertian", "order": 20, "flux": 3}
LENS = {"type": "mesh", "file": "lens.obj", "at": [1, 1, 1], "scale": 0.001, "materials": {"*": "jar"}}
# A material of every kind, glass doors, several types and tilts, a mesh, and a label that faces the wall.
SHOP = store_with(
    {
        "materials/steel": {"type": "conductor", "eta": 1.4, "k": 8.0, **ROUGH},
        "materials/mirror": {"type": "conductor", "eta": 0.1, "k": 6.0},
        "materials/pane": {"type": "thin_dielectric", "ior": 1.5, "thickness": 0.006},
        "materials/jar": {"type": "dielectric", "ior": 1.5},
        "materials/frosted": {"type": "dielectric", "ior": 1.5, **ROUGH, "roughness": 0.2},
        "label_types/wide": {**WIDE, "safety_factor": 2},
        "transceiver_types/spot": {"emission": SPOT, "radius": 0.05, "cost": 2.5},
        "fixtures/0/doors": "pane",
        "fixtures/1": {"id": "lens", **LENS},
        "labels/1": {"id": "wrong", "position": [0.02, 2, 1], "normal": [-1, 0, 0], "type": "wide"},
        "transceivers/list": [
            {"id": name, "position": [x, y, 2.9], "axis": axis, "type": "spot"} for name, x, y, axis in UNITS
        ],
    }
)
# A closed corner block of 100 mm, and a triangle without area.
BLOCK = "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\nv 50 50 0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 2 5 3\n"


class Inspect(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("store.json", SHOP)
        self.write("lens.obj", BLOCK)

    def test_prints_json(self):
        shown = self.answer("inspect store.json")
        materials = shown["materials"]
        frosted, steel, jar, pane = (materials[name] for name in ("frosted", "steel", "jar", "pane"))
        # Fresnel at n = 1.5 and normal incidence: F = 0.04; a pane reflects 2 F / (1 + F). The hemispherical
        # reflectance of the surface is 0.0918 (closed form of Walsh); eight points give it to 1e-4. F itself would be
        # rejected. Rough glass reflects about as much as smooth glass. A smooth metal at normal incidence reflects
        # ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2).
        for material, key, expected, error in (
            ("m", "reflectance", 0.3, 0),
            ("m", "mean_reflectance", 0.3, 0),
            ("jar", "area_m2", 0.01 * (1.5 + math.sqrt(3) / 2), 1e-8),
            ("pane", "area_m2", 2 * 4 * (1.78 - 0.12), 1e-9),
            ("jar", "reflectance", 0.04, 1e-12),
            ("pane", "reflectance", 0.08 / 1.04, 1e-12),
            ("pane", "transmittance", 0.96 / 1.04, 1e-12),
            ("jar", "mean_reflectance", 0.0918, 1e-4),
            ("jar", "mean_transmittance", 1 - jar["mean_reflectance"], 1e-9),
            ("pane", "mean_transmittance", 1 - pane["mean_reflectance"], 1e-9),
            ("frosted", "reflectance", 0.04, 0.004),
            ("mirror", "reflectance", (0.81 + 36) / (1.21 + 36), 1e-12),
            ("steel", "mean_reflectance", steel["reflectance"], 0.05),
        ):
            self.assertAlmostEqual(materials[material][key], expected, msg=(material, key), delta=error)
        self.assertNotIn("transmittance", materials["m"])
        self.assertEqual((jar["triangles"], pane["triangles"]), (4, 4))
        # Single scattering of rough glass and metal loses some light.
        self.assertGreater(frosted["reflectance"] + frosted["transmittance"], 0.97)
        self.assertLessEqual(frosted["mean_reflectance"] + frosted["mean_transmittance"], 1)
        self.assertLess(steel["reflectance"], (0.16 + 64) / (5.76 + 64) * 0.75)
        self.assertNotEqual(steel["mean_reflectance"], steel["reflectance"])

        self.assertEqual(shown["label_types"]["standard"]["responsivity"], "cosine")
        wide = {"responsivity": "cosine_power", "size_m": [0.1, 0.05], "labels": 1, "requirement": 0.02}
        self.assertEqual(shown["label_types"]["wide"], wide)
        # S2 and S3 look the same way. The grid has 4 x 3 points, including S1 and S2; S3 and S4 are at other points.
        spot, ceiling = (shown["transceiver_types"][name] for name in ("spot", "ceiling"))
        expected = {"emission": "lambertian", "radius_m": 0.05, "flux_w": 3, "transceivers": 4, "axes": 3, "cost": 2.5}
        self.assertEqual(spot, spot | expected)
        self.assertAlmostEqual(spot["peak_w_per_sr"], 3 * 21 / (2 * math.pi), delta=1e-12)
        self.assertAlmostEqual(ceiling["peak_w_per_sr"], 1, delta=1e-15)
        counts = {"transceivers": 16, "mounting_points": 13, "mounting_points_with_several_options": 2}
        self.assertEqual(shown, shown | counts)
        self.assertEqual(len(shown["warnings"]), 6, shown["warnings"])
        for warning, field in zip(shown["warnings"], ("fixtures[1]", "labels[1]"), strict=False):
            self.assertTrue(warning.startswith(f"store.json: {field}: "), warning)

    def precedes_tables(self, text, result):
        places = [text.index(part) for part in ("\nwarning: ", result, "  material  ")]
        self.assertEqual(places, sorted(places))

    def test_prints_text(self):
        self.says(
            "inspect store.json",
            "\n  8.00 x 6.00 x 3.00 m, 940 nm, ",
            "\n  2 fixtures, 18 labels, 16 candidate transceivers at ",
            " at 13 mounting points, 2 of them with several options\n",
            "  reflectance  ",
            "  transmittance  ",
            "\n  pane      thin_dielectric     13.28          4        0.077  0.155          0.923  0.845\n",
            "\n  wide        cosine_power  100 x 50       1         0.02\n",
            "\n  spot              lambertian      0.05       3      10.03      4     3   2.5\n",
        )
        self.precedes_tables(self.told("inspect store.json -o plan.svg"), "\nfloor plan: plan.svg\n\n")
        self.assertIn('class="door"', self.text("plan.svg"))
        # A store with neither glass nor mistakes.
        self.write("plain.json", small_store())
        self.assertNotRegex(self.told("inspect plain.json"), "transmittance|warning")

    def test_a_model_is_a_mesh_with_fixtures_labels_and_units(self):
        self.precedes_tables(self.told("inspect store.json -o store.glb"), "\n3-D model: store.glb\n\n")
        first = self.answer("inspect store.json -o again.GLB")
        self.assertEqual(self.bytes("again.GLB"), self.bytes("store.glb"))
        mesh = {"type": "mesh", "id": "all", "file": "store.glb", "at": [0, 0, 0], "materials": {"*": "m"}}
        store = small_store(fixtures=[mesh])
        del store["room"]
        self.write("model.json", store)
        second = self.answer("inspect model.json")
        self.assertEqual(second["triangles"], first["triangles"] + 2 * first["labels"] + 8 * first["transceivers"])
        for read, written in zip(second["upper"], first["upper"], strict=True):
            self.assertAlmostEqual(read, written, delta=2e-5)
        self.refused("inspect model.json -o store.glb", "store.glb", "model.json: fixtures[0]")

    def test_refuses_unknown_drawings_before_it_reads(self):
        remedy = "; use .svg for the floor plan, .glb for the 3-D model or .json for the store\n"
        for store in ("store.json", "missing.json"):
            for name, mistake in (("plan.png", "has the unknown extension '.png'"), ("plan", "has no extension")):
                self.refused(f"inspect {store} -o {name}", f"error: {name}: {mistake}{remedy}")

    def test_adds_ids_to_the_plan_if_asked_for(self):
        error = "error: --ids: has no effect without a floor plan; add '-o plan.svg', or remove it\n"
        self.refused_each(("", error), ("-o store.glb", error), command="inspect store.json --ids")
        self.told("inspect store.json -o plan.svg")
        self.told("inspect store.json -o ids.svg --ids")
        self.assertNotIn(">S3", self.text("plan.svg"))
        self.assertIn(">S3 +1<", self.text("ids.svg"), "S4 is at the same point")

    def test_counts_inner_walls_and_zones(self):
        walls = [{"id": name, "from": [6.5, y], "to": [6.5, y + 2]} for name, y in (("N", 0), ("S", 4))]
        low = {"id": "low", "polygon": [[0, 0], [2, 0], [2, 2], [0, 2]], "height": 2.5}
        changes = {"room/zones": [low], "room/inner_walls": walls, "transceivers/grids/0/z": 2.4}
        self.write("walls.json", store_with(changes))
        line = "\n  1 fixtures, 2 inner walls, 1 ceiling zone, 17 labels, "
        self.says("inspect walls.json -o walls.glb", line)
        for node in ("N", "S", "ceiling low", "ceiling", "room"):
            self.assertIn(f'"name":"{node}"'.encode(), self.bytes("walls.glb"))
        counts = self.answer("inspect walls.json")
        self.assertEqual(counts, counts | {"fixtures": 1, "inner_walls": 2, "ceiling_zones": 1})
