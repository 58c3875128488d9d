"""Files that ezdxf writes."""

from dxf.drawings import blocks, mirrored, mixed, new, shop, tilted
from dxf.facts import facts

VERSIONS = ["R12", "R2000", "R2004", "R2007", "R2010", "R2013", "R2018"]
TEXTS = {
    "cp1252": "Möbel für 5 € – Größe",
    "cp1250": "Łóżka, židle",
    "cp1251": "Отдел мебели",
    "cp1253": "Έπιπλα",
    "cp1254": "Şişe ğ",
    "cp932": "売場ソ表",
    "gbk": "货架平面图",
    "cp949": "선반 평면도",
    "cp950": "貨架許功蓋",
}


def write_versions(corpus):
    for version in VERSIONS:
        corpus.save(mixed(version), f"mixed_{version}.dxf")
        corpus.save(blocks(version), f"blocks_{version}.dxf", notes={"invisible": None})
    corpus.save(mirrored(), "mirrored.dxf")
    corpus.save(tilted(), "tilted.dxf", notes={"tilted": None})


def write_texts(corpus):
    for encoding, text in TEXTS.items():
        for version in ("R12", "R2000"):
            doc = new(version)
            doc.encoding = encoding
            shop(doc.modelspace())
            layer = text.split()[0].strip(",")
            doc.layers.new(layer)
            doc.modelspace().add_text(text, dxfattribs={"layer": layer, "height": 1})
            # Some characters that the code page lacks. Windows has more of them in page 950 than browsers.
            doc.modelspace().add_text(f"{text} 家具" + ("" if encoding == "cp950" else " Ж"), dxfattribs={"height": 1})
            corpus.save(doc, f"text_{encoding}_{version}.dxf")
    doc = new("R2018")
    shop(doc.modelspace())
    for text in TEXTS.values():
        doc.modelspace().add_text(text, dxfattribs={"height": 1})
    corpus.save(doc, "text_utf8.dxf")


def write_units(corpus):
    for code, unit, length in [(1, "in", 39.37), (2, "ft", 3.281), (4, "mm", 1000), (5, "cm", 100), (6, "m", 1)]:
        doc = new()
        doc.header["$INSUNITS"] = code
        doc.header["$MEASUREMENT"] = 0 if code < 3 else 1
        shop(doc.modelspace(), length)
        corpus.save(doc, f"unit_{unit}.dxf", unit=unit, proposed=[unit, "header"])
        doc.header["$INSUNITS"] = 0
        corpus.save(doc, f"unit_none_{unit}.dxf", proposed=[unit, "size"])
    doc = new()
    doc.header["$INSUNITS"] = 4
    doc.header["$MEASUREMENT"] = 1
    shop(doc.modelspace(), 39.37)
    for k, text in enumerate(["58'-0\"", "7'-2\"", "12'", "13' 6\""]):
        doc.modelspace().add_text(text, dxfattribs={"height": 10, "insert": (100 * k, -100)})
    corpus.save(doc, "unit_wrong_inches.dxf", unit="mm", proposed=["in", "texts"])
    doc = new()
    doc.header["$INSUNITS"] = 4
    shop(doc.modelspace(), 1)
    corpus.save(doc, "unit_wrong_metres.dxf", unit="mm", proposed=["m", "size"])
    doc = new()
    doc.header["$INSUNITS"] = 4
    shop(doc.modelspace(), 1000)
    doc.modelspace().add_line((5e6, 5e6), (5e6 + 10, 5e6), dxfattribs={"layer": "WALL"})
    corpus.save(doc, "unit_outlier.dxf", unit="mm", proposed=["mm", "header"])


def write_layers(corpus):
    """Layers, and what is not in model space."""
    doc = new()
    for name, is_off, is_frozen in [("OFF", True, False), ("FROZEN", False, True)]:
        layer = doc.layers.new(name, dxfattribs={"color": 3})
        if is_off:
            layer.off()
        if is_frozen:
            layer.freeze()
        doc.modelspace().add_line((0, 0), (5, 5), dxfattribs={"layer": name})
        part = doc.blocks.new(f"PART_{name}")
        part.add_line((0, 0), (1, 0))
        part.add_line((0, 0), (2, 0), dxfattribs={"layer": "WALL"})
        doc.modelspace().add_blockref(part.name, (10, 10), dxfattribs={"layer": name})
    doc.layout("Layout1").add_line((0, 0), (1000, 1000))
    doc.layout("Layout1").add_circle((0, 0), 1000)
    shop(doc.modelspace())
    corpus.save(doc, "layers.dxf", notes={"paper_space": None})

    doc = new()
    doc.layout("Layout1").add_line((0, 0), (1000, 1000))
    corpus.save(doc, "paper_only.dxf")
    corpus.expected["paper_only.dxf"] = {"error": "empty"}
    corpus.save(new(), "empty.dxf")
    corpus.expected["empty.dxf"] = {"error": "empty"}
    corpus.save(mixed("R2010"), "binary.dxf", kind="bin")
    corpus.expected["binary.dxf"] = {"error": "binary"}

    doc = new()
    shop(doc.modelspace())
    doc.add_xref_def("C:\\plans\\walls.dwg", "WALLS")
    doc.modelspace().add_blockref("WALLS", (0, 0))
    doc.modelspace().add_point((1, 1))
    doc.modelspace().add_ray((0, 0), (1, 0))
    doc.modelspace().add_polymesh((3, 3))
    save_doc = corpus.folder / "xref.dxf"
    doc.saveas(save_doc)
    for entity in [e for e in doc.modelspace() if e.dxftype() in ("RAY", "POLYLINE", "INSERT")]:
        doc.modelspace().delete_entity(entity)
    corpus.expected["xref.dxf"] = facts(
        doc, notes={"xref": ["C:\\plans\\walls.dwg"], "solid": ["POLYMESH"], "unsupported": ["RAY"]}
    )


def write_far(corpus):
    for name, scale, at in [("utm", 1, (512345.678, 5412345.678)), ("far", 1000, (5e9, -3e9))]:
        doc = new()
        part = doc.blocks.new("SHOP")
        shop(part, scale)
        doc.modelspace().add_blockref("SHOP", at)
        corpus.save(doc, f"{name}.dxf")
    doc.modelspace().add_line((0, 0), (10, 0), dxfattribs={"layer": "STRAY"})
    doc.saveas(corpus.folder / "stray.dxf")
    corpus.expected["stray.dxf"] = {**corpus.expected["far.dxf"], "notes": {"stray": [None]}}
