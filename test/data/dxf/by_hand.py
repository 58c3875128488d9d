"""Files that ezdxf does not write, because they are wrong or too large."""

import math

from dxf.tags import END, block, insert, line, section, tags

square = {"length": 4, "bounds": [0, 0, 1, 1], "texts": 0, "on": True}
sides = line(0, 0, 1, 0) + line(1, 0, 1, 1) + line(1, 1, 0, 1) + line(0, 1, 0, 0)
plain = {"version": "AC1009", "unit": None, "texts": [], "layers": {"0": square}}


def mixed(corpus):
    return (corpus.folder / "mixed_R2010.dxf").read_bytes().replace(b"\r\n", b"\n")


def write_line_ends(corpus):
    original = mixed(corpus)
    for name, content in [
        ("lf", original),
        ("crlf", original.replace(b"\n", b"\r\n")),
        ("cr", original.replace(b"\n", b"\r")),
        ("bom", b"\xef\xbb\xbf" + original),
        ("comment", b"999\nby hand\n" + original),
        ("no_last_end", original.rstrip(b"\n")),
        ("after_end", original + b"\x1a\x00"),
    ]:
        corpus.write(f"ends_{name}.dxf", content, **corpus.expected["mixed_R2010.dxf"])


def write_cut(corpus):
    original = mixed(corpus)
    for percent in (1, 5, 20, 50, 80, 95, 99):
        cut = original[: len(original) * percent // 100]
        corpus.write(f"cut_{percent}.dxf", cut, error="truncated")
        at_line = cut[: cut.rindex(b"\n") + 1]
        corpus.write(f"cut_line_{percent}.dxf", at_line, error="truncated")
    corpus.write("cut_end.dxf", original[: original.rindex(b"EOF")], error="truncated")
    corpus.write("cut_end_2.dxf", original[: original.rindex(b"EOF") + 2], error="truncated")


def write_wrong(corpus):
    """Files that are none, or wrong."""
    corpus.write("none.dxf", b"", error="not_dxf")
    corpus.write("text.dxf", "This is a letter.\nIt has lines.\n", error="not_dxf")
    corpus.write("numbers.dxf", "1\n2\n3\n4\n", error="not_dxf")
    corpus.write("picture.dxf", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", error="not_dxf")
    corpus.write("drawing.dxf", b"AC1032\0\0\0\0\0" + bytes(200), error="dwg")
    wrong = section("ENTITIES", line(0, 0, 1, 1), "{}", line(0, 0, 1, 1)) + END
    for name, value, error in [
        ("nan", "nan", "bad_number"),
        ("infinity", "inf", "bad_number"),
        ("indefinite", "-1.#IND", "bad_number"),
        ("huge", "1e999", "bad_number"),
        ("comma", "1,5", "bad_number"),
        ("nothing", "", "bad_number"),
    ]:
        corpus.write(f"number_{name}.dxf", wrong.format(line(value, 0, 1, 1)), error=error)
    for name, code in [
        ("huge", "99999999999999999999"),
        ("high", "1072"),
        ("word", "ten"),
        ("blank", ""),
        ("real", "1.5"),
    ]:
        corpus.write(f"code_{name}.dxf", wrong.format(f"{code}\n5\n"), error="bad_code")


def write_blocks(corpus):
    """Blocks that are not as they should be."""
    corpus.write(
        "recursive.dxf",
        section("BLOCKS", block("SELF", sides, insert("self")), block("A", insert("B")), block("B", insert("A")))
        + section("ENTITIES", insert("SELF"), insert("A"))
        + END,
        **plain,
        notes={"recursive_block": ["A", "SELF"]},
    )
    hidden = tags(0, "LINE", 8, "0", 60, 1, 10, -5, 20, -5, 11, 9, 21, 9)
    corpus.write("hidden.dxf", section("ENTITIES", sides, hidden, hidden) + END, **plain, notes={"invisible": None})
    corpus.write(
        "missing.dxf", section("ENTITIES", sides, insert("NONE")) + END, **plain, notes={"missing_block": ["NONE"]}
    )
    proxy = tags(0, "ACAD_PROXY_ENTITY", 8, "0", 90, 498, 91, 501, 92, 4, 310, "00FF00FF")
    classes = [tags(0, "CLASS", 1, name, 3, "AecArch", 90, 0) for name in ("AEC_DOOR", "AEC_WALL")]
    solid = tags(0, "3DSOLID", 8, "0", 1, "m", 1, "nan")
    corpus.write(
        "proxies.dxf",
        section("CLASSES", *classes) + section("ENTITIES", sides, proxy, proxy, solid) + END,
        **plain,
        notes={"aec": ["AEC_WALL"], "solid": ["3DSOLID"]},
    )
    ten = "".join(insert("B{}", 41, k + 1) for k in range(10))
    bomb = [block("B0", *[line(k, 0, k, 1) for k in range(10)])]
    bomb += [block(f"B{k + 1}", ten.format(*[k] * 10)) for k in range(10)]
    corpus.write("bomb.dxf", section("BLOCKS", *bomb) + section("ENTITIES", insert("B10")) + END, error="too_many")
    many = insert("B0", 70, 32767, 71, 32767)
    corpus.write("bomb_array.dxf", section("BLOCKS", *bomb[:1]) + section("ENTITIES", many) + END, error="too_many")
    hollow = [block("H0")] + [block(f"H{k + 1}", ten.replace("B", "H").format(*[k] * 10)) for k in range(20)]
    corpus.write(
        "hollow.dxf", section("BLOCKS", *hollow) + section("ENTITIES", sides, insert("H20", 70, 32767)) + END, **plain
    )
    deep = [block("D0", sides)] + [block(f"D{k + 1}", insert(f"D{k}")) for k in range(16)]
    corpus.write("deep.dxf", section("BLOCKS", *deep) + section("ENTITIES", insert("D16")) + END, **plain)
    deep += [block(f"D{k + 1}", insert(f"D{k}")) for k in range(16, 20000)]
    corpus.write(
        "too_deep.dxf", section("BLOCKS", *deep) + section("ENTITIES", insert("D20000")) + END, error="too_deep"
    )
    rounds = "".join(tags(0, "CIRCLE", 8, "0", 10, 3 * (k % 200), 20, 3 * (k // 200), 40, 1) for k in range(30000))
    facts_of_rounds = {
        "length": 30000 * 100 * math.sin(math.pi / 50),
        "bounds": [-1, -1, 598, 448],
        "texts": 0,
        "on": True,
    }
    corpus.write(
        "circles.dxf",
        section("ENTITIES", rounds) + END,
        **{**plain, "layers": {"0": facts_of_rounds}},
        notes={"coarse": None, "outlines_left_out": None},
    )


def lattice(count):
    return "".join(
        f"0\nLINE\n8\n0\n10\n{k % 1000}.25\n20\n{k // 1000}.125\n11\n{k % 1000 + 1}.25\n21\n{k // 1000}.125\n"
        for k in range(count)
    )


def write_large(corpus):
    """As large as it may be, and larger: a lattice."""
    most = 2_000_000
    large = {"length": most, "bounds": [0.25, 0.125, 1000.25, 1999.125], "texts": 0, "on": True}
    corpus.write("large.dxf", section("ENTITIES", lattice(most)) + END, **{**plain, "layers": {"0": large}})
    corpus.write("too_large.dxf", section("ENTITIES", lattice(most), line(0, 0, 1, 1)) + END, error="too_many")
    zigzag = "".join(f"10\n{k % 1000}.123456789\n20\n{k // 1000}.987654321\n" for k in range(most))
    closed = tags(0, "LWPOLYLINE", 8, "0", 90, most, 70, 1) + zigzag
    corpus.write(
        "large_polyline.dxf",
        section("ENTITIES", closed) + END,
        **{
            **plain,
            "layers": {
                "0": {
                    "length": None,
                    "bounds": [0.123456789, 0.987654321, 999.123456789, 1999.987654321],
                    "texts": 0,
                    "on": True,
                }
            },
        },
        notes={"outlines_left_out": None},
    )
