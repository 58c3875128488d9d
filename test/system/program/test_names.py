"""Names in a store, through the program: unprintable and very long ones, formulas; and tables of a plan."""

from harness import FEW, ShopTest, small_store, store_with

HUGE = 1_000_000 * "x"


class Names(ShopTest):
    def error_of(self, content, most):
        """The program's error for a store, which must be one short line of printable text."""
        self.write("store.json", content)
        end = self.run_here("inspect store.json")
        self.assertEqual((end.status, end.out), (2, ""), end)
        self.assertRegex(end.err, r"\Aerror: [^\n\x1b\u202e]*\n\Z")
        self.assertLess(len(end.err.encode()), most, end.err)
        return end.err

    def test_unprintable_ones_are_refused_and_escaped(self):
        material = small_store()["materials"]["m"]
        for name, escape in (("a\u202eb", "\\u202e"), ("a\x1b[31m", "\\x1b")):
            character = f"has the unprintable character '{escape}"
            for values, part in (
                ({"name": name}, f"store.json: name: {character}'"),
                ({"fixtures/0/id": name}, f"fixtures[0].id: {character}"),
                ({f"materials/{name}": material}, f"materials.a{escape}"),
                ({"room/floor": name}, f"unknown material 'a{escape}"),
            ):
                self.assertIn(part, self.error_of(store_with(values), 1100))

    def test_errors_of_a_megabyte_are_short(self):
        material, label = small_store()["materials"]["m"], small_store()["labels"][0]
        twins = [{**label, "id": HUGE}, {**label, "id": HUGE}]
        for content, part in (
            (store_with({"room/floor": HUGE}), "names the unknown material 'xxxx"),
            (store_with({HUGE: 1}), "has the unknown key 'xxxx"),
            (store_with({"fixtures/0/type": HUGE}), "has the unknown value 'xxxx"),
            (store_with({f"materials/{HUGE}": {"type": "lambertian"}}), ": is missing the key"),
            (store_with({"labels": {"csv": HUGE}}), "is outside the folder"),
            (store_with({"labels": twins}), "has the duplicate label id 'xxxx"),
            (store_with({f"materials/{HUGE}": material, "room/floor": "other"}), "known: m, xxxx"),
            (store_with({"materials/m/reflectance": HUGE}), "unknown reflectance 'xxxx"),
            (f'{{"name": "{HUGE}', "line 1"),  # a text without its end
            (f'{{"name": 1{1_000_000 * "0"}}}', "line 1"),
        ):
            self.assertIn(part, self.error_of(content, 500))
        # A long name is valid, and its warning is short.
        buried = {"position": [0.01, 3, 1.5], "normal": [-1, 0, 0]}
        self.write("store.json", store_with({"labels/0": {**label, "id": HUGE, **buried}}))
        self.assertLess(len(self.told("inspect store.json").encode()), 3000)

    def test_formulas_are_made_safe(self):
        unit = {"id": "@T", "position": [4, 1, 2.9], "type": "ceiling"}
        installed = {"transceivers/list": [unit], "transceivers/installed": ["@T"]}
        self.write("store.json", store_with({"labels/0/id": "=1+1", **installed}))
        pairs = "label;transceiver;signal\r\n'=1+1;'@T;0,5\r\nA-front-1-1;@T;0,25\r\nA-front-1-2;@T;0,5\r\n"
        self.write("measured.csv", pairs)
        label = "\n'=1+1,"
        self.told("plan store.json -o plan --no-certificate --samples 256 --quiet --safe-csv")
        self.assertIn("\n'@T,", self.text("plan/placement.csv"))
        self.assertIn(label, self.text("plan/labels.csv"))
        for line, name, *parts in (
            ("report plan", "plan/labels.csv", "\n=1+1,"),
            ("report plan --safe-csv", "plan/labels.csv", label),
            ("export plan/signal.h5 -o matrix.csv --safe-csv", "matrix.csv", label, ",'@T\n"),
            ("compare plan/signal.h5 measured.csv -o found.csv --safe-csv", "found.csv", f"{label}'@T,0.5,"),
            ("verify store.json plan/placement.csv --samples 64 -o reached.csv --safe-csv", "reached.csv", label),
        ):
            self.told(f"{line} --quiet")
            for part in parts:
                self.assertIn(part, self.text(name), line)
        self.refused_each(
            ("export plan/signal.h5 -o matrix.npy --safe-csv", "--safe-csv: applies to CSV files only"),
            ("verify store.json plan/placement.json --safe-csv", "--safe-csv requires --output"),
        )

    def test_tables_of_a_plan_are_in_metres(self):
        """Also beside a store in millimetres."""
        sizes = {"at": [2000, 2500], "length": 4000, "depth": 900, "height": 1800, "shelves": [500, 1200]}
        changes = {f"fixtures/0/{key}": value for key, value in {**sizes, "labels/spacing": 1000}.items()}
        grid = {"min": [1000, 1000], "max": [7000, 5000], "spacing": 2000, "z": 2900}
        changes |= {f"transceivers/grids/0/{key}": value for key, value in grid.items()}
        changes |= {"units": "mm", "room/size": [8000, 6000, 3000], "labels/0/position": [100, 3000, 1500]}
        self.write("mm.json", store_with(changes))
        self.told(f"plan store.json -o plan --no-certificate {FEW} --quiet")
        hashes = [self.answer(f"inspect {name}.json")["store_hash"] for name in ("mm", "store")]
        self.assertEqual(*hashes)
        for name in ("mm", "store"):
            self.told(f"verify {name}.json plan/placement.csv {FEW} --quiet -o {name}.csv")
        self.assertEqual(self.bytes("mm.csv"), self.bytes("store.csv"))
        # The control: without the columns of a plan, the numbers are millimetres, outside the shop.
        self.write("units.csv", "id,x,y,z,ax,ay,az,roll_deg,type\nT,9000,1000,2900,0,0,-1,0,ceiling\n")
        outside = "'T' at (9, 1, 2.9) is outside the room"
        self.refused("verify mm.json units.csv", "units.csv: line 2", outside)
