"""Wrong inputs: each causes one error that names file and position, and no file changes, appears or vanishes."""

import itertools
import pathlib

from harness import FEW, ShopTest, small_store, store_with

MESH = {"type": "mesh", "id": "B", "file": "../secret.obj", "at": [1, 1, 0], "materials": {"*": "m"}}
TWIN = {"id": "G1-1-1", "position": [1, 1, 1], "type": "ceiling"}
LABELS = "id,x,y,z,nx,ny,nz,type\ndoor,0.1,3,1.5,1,0,0,standard\nsign,1,1,1,x,0,0,standard\n"

# Content of store.json, and parts of the error. The tests of the readers have more wrong values.
STORES = (
    (store_with({"fixtures/1": MESH}), "fixtures[1].file", "'../secret.obj'", "(--allow-outside)"),
    ("", "line 1"),
    ('{\n  "wavelength_nm": 1e999 }', "1e999", "line 2"),
    (b"\x89HDF\r\n\x1a\n", "JSON"),
    (store_with({"fixtures/0/labels/spaceing": 1}), "'spacing'"),
    (store_with({"materials/m/two\nlines": 1}), "'two\\nlines'"),
    (store_with({"transceivers/list": [TWIN]}), ": transceivers.list[0]: "),
    (store_with({"labels/0/position": [-0.1, 3, 1.5]}), ": labels[0]: label 'door' at (-0.1, 3, 1.5)"),
)

VERBS = ("inspect {} -o {}.svg", "simulate {} --samples 64 -o {}.h5", "plan {} --samples 64 -o {}")
PLAN = ("signal.h5", "placement.json", "store.json", "labels.csv", "report.html")


class Stores(ShopTest):
    def setUp(self):
        super().setUp()
        for name in ("old.h5", "old.svg", *(f"old/{name}" for name in PLAN)):
            self.write(name, f"content of {name}")
        self.outputs = itertools.cycle(("old", "new"))

    def refused_by_all(self, file, *parts, outputs=1):
        """Every verb that reads stores refuses the file, with one or two outputs, of which one exists already."""
        for verb in VERBS:
            for _ in range(outputs):
                self.refused(verb.format(file, next(self.outputs)), *parts)

    def test_wrong_content(self):
        for content, *parts in STORES:
            self.write("store.json", content)
            self.refused_by_all("store.json", "error: store.json", *parts)

    def test_a_wrong_table(self):
        self.write("labels.csv", LABELS)
        self.write("store.json", small_store(labels={"csv": "labels.csv"}))
        self.refused_by_all("store.json", "error: labels.csv: line 3, field 5: ", "'x'", outputs=2)

    def test_missing_files(self):
        self.refused_by_all("none.json", "none.json: ", "No such file or directory", outputs=2)
        self.refused_by_all("old.h5/store.json", "Not a directory")
        self.refused_by_all("./", "folder")
        self.refused_by_all(300 * "x", "File name too long")
        self.refused_each(*((f"inspect none.json --{form}", "none.json: ") for form in ("json", "quiet")))

    def test_more_than_the_memory(self):
        # 17 x 12 entries with three sums in double and a column index each, plus the memory of an item.
        simulate = "simulate store.json -o new.h5 --estimator uniform --memory"
        parts = ("memory: 17 labels and 12 candidates ", "6e-06 GB", "(--memory)")
        self.refused(f"{simulate} 6K", *parts, status=5)
        self.told(f"{simulate} 12K --samples 64 --quiet")

    def test_ranges_of_reflectances(self):
        plan = "plan store.json -o plan"
        wrong = (f"--reflectance-error {value} --sensitivity" for value in ("-0.1", "1.1", "much"))
        self.refused_each(("--reflectance-error 0.1", "--reflectance-error", "--sensitivity"), *wrong, command=plan)
        self.write("store.json", store_with({"materials/m/reflectance_range": [0.9, 0.95]}))
        place = "store.json: materials.m.reflectance_range: "
        self.refused(f"{plan} --sensitivity", place, "0.9", "0.95", "0.3")

    def test_unwritable_outputs(self):
        # Below a regular file, and where even root, who ignores permissions, cannot write.
        for lines, places in (
            (("inspect store.json -o {}/plan.svg", "simulate store.json -o {}/signal.h5"), ("old.h5/sub", "none")),
            (("plan store.json -o {}", "new thesis {}"), ("old.h5/sub", "old.h5")),
        ):
            for place in (*places, "/proc/shelfbeam"):
                self.refused_each(*((line.format(place), f"error: {place}") for line in lines))

    def test_outputs_that_are_folders_or_devices(self):
        (self.folder / "full/report.html").mkdir(parents=True)
        self.refused_each(
            ("simulate store.json -o full", "full: "),
            ("plan store.json -o full", "full/report.html: "),
            ("simulate store.json -o /dev/null --samples 64", "/dev/null: "),
        )
        self.assertTrue(pathlib.Path("/dev/null").is_char_device())

    def test_outputs_that_are_inputs(self):
        self.write("matrix.csv", "1,2\n3,4\n")
        self.write("costs.csv", "id,cost\n1,2\n")
        self.refused_each(
            ("simulate store.json -o old/../store.json", "error: old/../store.json: "),
            ("inspect store.json -o store.json", "error: store.json: "),
            (f"plan store.json -o {self.folder}", f"{self.folder}: "),
            (f"new thesis {self.folder}", "store.json: "),
            ("place matrix.csv -o matrix.csv --threshold 1", "error: matrix.csv: "),
            ("place matrix.csv -o costs.csv --costs costs.csv", "error: costs.csv: "),
            ("export matrix.csv -o matrix.csv", "error: matrix.csv: "),
        )


class Matrices(ShopTest):
    def setUp(self):
        super().setUp()
        self.write("old.json", "old placement")
        self.write("old.mps", "old model")

    def test_wrong_entries(self):
        self.told(f"simulate store.json -o signal.h5 {FEW} --quiet")
        whole = self.bytes("signal.h5")
        outputs = itertools.cycle(("old", "new"))
        for content, *parts in (
            ("label,T1,T2\nL1,1,2\nL2,3,nan\n", "line 3, field 3", "NaN"),
            ("label,T1,T2\nL1,1,2\nL1,3,4\n", "L1"),
            ("label,T1,T2\n",),
            ("",),
            ('{"name": 3}',),
            (whole[: len(whole) // 2],),
            (whole[:600] + bytes([whole[600] ^ 1]) + whole[601:], "checksum"),
        ):
            output = next(outputs)
            self.write("matrix", content)
            self.refused_each(
                (f"place matrix --threshold 1 -o {output}.json", "error: matrix", *parts),
                (f"export matrix --threshold 1 -o {output}.mps", "error: matrix", *parts),
            )
        self.write("matrix", whole)
        self.told("place matrix -o new.json")

    def test_options_that_do_not_fit(self):
        """Flags, lists and further matrices."""
        for name, content in {
            "m.csv": "label,T1,T2\nL1,1,2\n",
            "plain.csv": "1,2\n3,4\n",
            "shut.csv": "label,T2,T3\nL1,1,2\n",
            "pairs.csv": "a,b\nT1,T2\nT1,T9\n",
            "one.json": {"format": 2, "selected": ["T1"]},
            "two.json": {"format": 2, "selected": ["T1", "T2"]},
            "other.json": {"format": 2, "selected": ["T9"]},
            "weights.csv": "id,weight\nL9,1\n",
            "unit.csv": "id,cost\nT9,2\n",
            "column.csv": "id,price\nT1,2\n",
        }.items():
            self.write(name, content)
        taken = ("pairs.csv", "line 3", "'T9'")
        self.refused_each(
            ("place plain.csv -o new.json", "--threshold"),
            ("export plain.csv -o new.mps", "--threshold"),
            ("export plain.csv -o new.csv", "plain.csv"),
            ("place m.csv --forbid pairs.csv -o pairs.csv", "error: pairs.csv: "),
            ("place m.csv shut.csv -o shut.csv", "error: shut.csv: "),
            ("place m.csv shut.csv --threshold 1", "error: shut.csv", "'T3'", "m.csv"),
            ("place m.csv m.csv --threshold 1", "error: m.csv", "'m'"),
            ("place m.csv none.csv --threshold 1", "error: none.csv: "),
            ("export m.csv --min-spacing 2 -o new.csv", "--min-spacing"),
            ("export m.csv --threshold 1 --forbid pairs.csv -o new.mps", *taken),
        )
        for limit, wrong in (("--at-most 1", ("0", "-1", "1.5")), ("--reach 0.5", ("0", "101%", "1.5"))):
            option = limit.split()[0]
            self.refused_each(
                *(f"{option} {value}" for value in wrong),
                (f"{limit} --curve", option, "--curve"),
                (f"{limit} --objective links", option, "objective"),
                (f"{limit} --weighted", option, "sum of costs"),
                command="place m.csv --threshold 1",
            )
        self.refused_each(
            ("--reach 0.5 --at-most 1", "--reach", "--at-most"),
            ("--weights weights.csv", "--weights", "--at-most, --reach or --curve"),
            ("--at-most 1 --weights weights.csv -o new.json", "weights.csv", "line 2", "'L9'"),
            ("--at-most 1 --weights none.csv", "none.csv"),
            ("--reach 0.5 --weights weights.csv -o weights.csv", "error: weights.csv: "),
            ("--forbid pairs.csv -o new.json", *taken),
            ("--forbid pairs.csv -o old.json", *taken),
            ("--min-spacing 2", "m.csv", "position", "--forbid"),
            "--min-spacing -2",
            ("--costs unit.csv -o new.json", "error: unit.csv: "),
            ("--costs column.csv -o new.json", "error: column.csv: "),
            command="place m.csv --threshold 1",
        )
        self.refused_each(
            ("one.json", "one.json", "does not reach 1 of 1 labels"),
            ("two.json --at-most 1", "two.json", "selects 2 units"),
            ("other.json", "other.json", "'T9'"),
            ("one.json -o one.json", "one.json"),
            command="place m.csv --threshold 2 --start",
        )


class PlanFolders(ShopTest):
    def test_report_refuses_damaged_files(self):
        self.told(f"plan store.json -o plan {FEW} --no-certificate --quiet")
        other = self.json("plan/store.json")
        other["materials"]["m"]["reflectance"] = 0.31
        self.refused("report none", "none/store.json: ")
        for name, content, *parts in (
            ("store.json", None, "error: plan/store.json"),
            ("signal.h5", None, "error: plan/signal.h5"),
            ("placement.json", None, "error: plan/placement.json"),
            ("store.json", "{", "error: plan/store.json", "JSON"),
            ("signal.h5", "old", "error: plan/signal.h5"),
            ("placement.json", "{}", "error: plan/placement.json", "'format'"),
            ("store.json", other, "signal.h5: "),
        ):
            path = self.folder / "plan" / name
            whole = path.read_bytes()
            if content is None:
                path.unlink()
            else:
                self.write(f"plan/{name}", content)
            self.refused("report plan", *parts)
            path.write_bytes(whole)
