"""The test environment (2.10)."""

from study.core import page
from study.core.findings import Section
from study.draw.store_map import legend


def section(study):
    signals = study.reference
    store = study.store
    result = Section("The test environment", "2.10, Figs 2.7 and 2.8", "What is simulated?")
    marks = [("cross", signals.units[:, :2]), ("once", study.map.places(signals))]
    result.add(
        page.figure(
            "Top-down view",
            study.map.picture(marks, "Floor plan with labels and candidates")
            + legend([("once", "labels (several above each other)"), ("cross", "candidate transceiver")]),
            reference="as Fig. 2.8",
        )
    )
    size = store["room"]["size"]
    shelves = [f for f in store["fixtures"] if f["type"] == "gondola"]
    rows = [
        ("room", "ceiling 4 m", f"{size[0]:g} x {size[1]:g} x {size[2]:g} m"),
        (
            "shelving",
            "2 m high, three rows of labels",
            (
                f"{len(shelves)} of {shelves[0]['length']:g} x "
                f"{shelves[0]['depth']:g} x {shelves[0]['height']:g} m, rows at "
                f"{', '.join(f'{z:g}' for z in shelves[0]['shelves'])} m on both faces"
            ),
        ),
        ("freezer", "a freezer-like section", "one, 0.9 m high; its labels belong to level two"),
        ("labels", "a few hundred", f"{len(signals.labels)}"),
        ("candidates", "a grid at the ceiling, about 1 m apart", f"{len(signals.units)}, 1 m apart"),
        ("surfaces", "Lambertian, albedo 0.7", f"Lambertian, albedo {store['materials']['paper']['reflectance']:g}"),
        ("emission", "maximum at an angle; arbitrary strength", "I sin 2θ, 1 W/sr at 45°"),
        ("threshold", "arbitrary", f"{signals.requirement[0]:g} W/m²"),
    ]
    result.tables["environment"] = (("property", "paper", "here"), rows)
    result.add(page.table(("", "paper", "here"), rows, paper=(1,), wide=(1, 2)))
    result.tell(
        (
            "The paper describes its environment in words. The dimensions here are ours, so the counts of"
            " transceivers may differ from the paper's, but the trends should agree."
        ),
        ("`shelfbeam new thesis` writes this store. The threshold was fixed before any of these results."),
    )
    return result
