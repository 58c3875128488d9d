"""Files that require far more memory than they contain.

A program with half a gigabyte of addresses and a few seconds of processor time must refuse them.
"""

import gzip
import os
import re
import resource
import unittest

from harness import ROOT, ProgramTest, sanitizers, small_store, store_with

GONDOLA = {key: value for key, value in small_store()["fixtures"][0].items() if key != "labels"}
PRISM = {"type": "prism", "id": "P{n}", "top": 1, "material": "m", "polygon": [[1, 1], [2, 1], [2, 2]]}


def shop(size=(30, 20, 3), **keys):
    return store_with({"room/size": size, **keys})


def store_of(gondolas):
    """A store with gondolas of a million labels each."""
    gondola = {**GONDOLA, "length": 900, "shelves": [0.5], "labels": {"type": "standard", "spacing": 0.002}}
    return shop((1000, 9, 3), fixtures=[{**gondola, "id": f"G{k}"} for k in range(gondolas)])


def mesh_store(file):
    mesh = {"type": "mesh", "id": "M", "at": [0, 0, 0], "file": file, "materials": {"*": "m"}}
    return small_store(fixtures=[mesh])


def gltf(count, length, uri, nodes=1):
    """A mesh of `count` positions that `nodes` nodes instantiate."""
    return {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": list(range(nodes))}],
        "nodes": nodes * [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": length}],
        "buffers": [{"byteLength": length, "uri": f"data:;base64,{uri}"}],
    }


class Hostile(ProgramTest):
    limits = ((resource.RLIMIT_AS, 500_000 * 1024), (resource.RLIMIT_CPU, 20))

    def run_here(self, *arguments):
        return super().run_here(*arguments, limits=self.limits)

    def rejected(self, line, *parts):
        """Expects the exit code of wrong input only: there are several errors, or files too large to be compared."""
        end = self.run_here(line)
        self.assertEqual(end.status, 2, f"{line}: {end}")
        for part in parts:
            self.assertIn(part, end.err, line)

    def check_inspect(self, *rows, status=2):
        """`inspect` refuses stores; a row is a store and parts of the error."""
        for store, *parts in rows:
            with self.subTest(parts=parts):
                self.write("store.json", store)
                self.refused("inspect store.json", *parts, status=status)


@unittest.skipIf(sanitizers(), "sanitizers reserve all addresses")
class Limited(Hostile):
    def test_stores_that_multiply(self):
        self.write("store.json", store_of(2))
        simulate = "simulate store.json -o signal.h5 --memory"
        self.refused_each(
            (f"{simulate} 300M", "(--memory)"),
            # With a higher limit than the address space, the memory runs out.
            (f"{simulate} 500G", "store.json: requires about 1.86 GB of memory, more than is "),
            # Without an option, the limit is that of the process.
            ("inspect store.json", "the limit is 0.4"),
            # The light of 5,000 labels for previews requires more than 0.4 GB.
            (f"preview {ROOT}/examples/supermarket/store.json --unit 2,2,2.9", "GB of memory"),
            status=5,
        )

    def test_shapes_that_multiply(self):
        def areas(area, spacing):
            return shop(transceivers={"areas": [{"type": "ceiling", "area": area, "spacing": spacing, "z": 2}]})

        def copies(count, step, name):
            return shop(fixtures=[{**PRISM, "id": name, "repeat": {"count": count, "step": [step, 0]}}])

        rail = {"type": "ceiling", "id": "R", "points": [[-9e3, 1, 2], [9e3, 1, 2]], "spacing": 0.001}
        chain = {str(k): {"preset": str(k + 1)} for k in range(999)} | {"999": {}}
        walls = [{"id": str(k), "from": [1 + 0.02 * k, 1], "to": [29 - 0.02 * k, 19]} for k in range(1000)]
        outline = {**small_store()["room"], "height": 3, "outline": [[0, 0], *([20, 5e-4 * k] for k in range(20_000))]}
        del outline["size"]
        self.write("p.csv", "article,fixture,face,level,position\n1,A,front,1,1000000000\n")
        planogram = {"file": "p.csv", "type": "standard"}
        self.check_inspect(
            (areas("room", 1e-9), "areas[0].spacing: is 1e-09"),
            (shop(**{"transceivers/rails": [rail]}), "rails[0].spacing: produces 18000001 candidates"),
            (copies(1_000_000_000, 1, "P{n}"), "repeat.count: is 1000000000"),
            (shop(**{"room/inner_walls": walls}), "room: has edges that meet in more than 20,000 points of its plan"),
            (small_store(room=outline), "room.outline: has 20001 corners"),
            (shop(fixtures=[GONDOLA], planogram=planogram), "p.csv: line 2, field 5: is 1e+09"),
        )
        self.write("store.json", shop(presets=chain, fixtures=1001 * [{"preset": "0"}]))
        self.rejected("inspect store.json", "is the end of a chain of 100 presets")
        triangle = [[-9e3, 0], [9e3, 0], [0, 9e3]]
        self.check_inspect(
            (areas("room", 0.025), "areas[0]: the store up to here requires about 0.9"),
            (areas(triangle, 0.025), "areas[0]: the store up to here requires about 0.9"),
            status=5,
        )
        self.write("store.json", copies(10_000, 0.001, 200_000 * "{n}"))
        part = "fixtures[0]: the store up to here requires about 0.1"
        self.refused("simulate store.json -o signal.h5 --memory 100M", part, status=5)

    def test_deeply_nested_brackets(self):
        self.check_inspect((3_000_000 * "[", "100 "), (500_000 * '{"a":', "100 "))

    def test_meshes(self):
        xyz = "".join(f"property float {axis}\n" for axis in "xyz")
        self.write("a.ply", f"ply\nformat binary_little_endian 1.0\nelement vertex 4294967295\n{xyz}end_header\n1234")
        self.write("a.gltf", gltf(4_000_000_000, 3, "AAAA"))
        self.check_inspect((mesh_store("a.ply"), "a.ply'"), (mesh_store("a.gltf"), "accessors[0]: "))
        # Triangles in base64, 48 characters each, with all positions 0.
        triangles = 2000
        self.write("a.gltf", gltf(3 * triangles, 36 * triangles, 48 * triangles * "A", nodes=20_000))
        self.refused("simulate store.json -o signal.h5 --memory 300M", "triangles")

    def test_matrices_that_claim_more(self):
        shape = "(4294967294, 4294967294)"
        header = f"{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}\n".encode()
        self.write("a.npy", b"\x93NUMPY\x01\0" + bytes([len(header), 0]) + header + b"1234")
        self.write("a.txt", "4000000000 4000000000 1\n0\n")
        self.write("b.txt", "4000000000 4000000000\n1 1\n")
        claims = (("a.npy", shape), ("a.txt", "m is 4000000000"), ("b.txt", "m is 4000000000"))
        self.refused_each(*claims, command="place -o placement.json --threshold 1")

    def test_files_that_are_too_large(self):
        signal = "shelfbeam signal file, XXH3-128 of what follows this line: "
        for name in ("a.stl", "a.npy", "a.csv", "a.h5", "a.json", "b.h5"):
            path = self.write(name, signal if name == "b.h5" else "")
            os.truncate(path, 200 << 30)  # they take no room on the disk
        self.write("store.json", mesh_store("a.stl"))
        self.rejected("inspect store.json", "a.stl: has 214,748,364,800 bytes; the maximum is ")
        for line in ("inspect a.json", *(f"place --threshold 1 {name}" for name in ("a.npy", "a.csv", "a.h5", "b.h5"))):
            self.rejected(line, f"{line.split()[-1]}: has 214,748,364,800 bytes; the maximum is ")

    def test_files_that_are_not_regular(self):
        os.mkfifo(self.folder / "pipe")
        self.write("store.json", store_of(0))
        for line in ("inspect pipe", "inspect /dev/zero", "place pipe", "place /dev/zero", "verify store.json pipe"):
            self.refused(line, f"{line.split()[-1]}: is not a regular file")


class Unlimited(Hostile):
    limits = ()

    def test_the_memory_of_the_machine(self):
        self.write("store.json", store_of(1000))
        end = self.run_here("inspect store.json")
        self.assertEqual(end.status, 5, end)
        limit = float(re.search(r"; the limit is (\S+) GB", end.err)[1])
        physical = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") / 1e9
        self.assertTrue(0 < limit < 0.81 * physical, end)

    def test_labels_times_candidates(self):
        """All signals would be 360 GB."""
        sizes = {"room/size": [1000, 1000, 3], "fixtures/0/length": 500, "fixtures/0/labels/spacing": 0.02}
        grid = {"transceivers/grids/0/max": [999, 999], "transceivers/grids/0/spacing": 3.2}
        self.write("store.json", store_with({**sizes, **grid}))
        parts = ("memory: 100001 labels and 97969 candidates ", " GB", "(--memory)")
        self.refused("plan store.json -o new", *parts, status=5)

    def test_files_that_unpack_to_much_more(self):
        # 300 members of a megabyte each.
        self.write("a.txt.gz", gzip.compress(b"1 1 1\n") + 300 * gzip.compress((1 << 20) * b" "))
        self.refused("place a.txt.gz", "a.txt.gz: has more than 268,435,456 bytes")
