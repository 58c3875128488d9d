"""Occluded shadow rays, by which 2.11.2 explains the variance."""

from study.core import page
from study.core.findings import Section, verdict
from study.core.text import grouped, percent


def section(study):
    result = Section(
        "Occluded shadow rays",
        "2.11.2",
        "How many of the uniformly chosen transceivers are invisible from their vertex?",
    )
    rows = []
    for samples in study.effort.samples:
        counts = study.simulation(study.uniform_file(samples))["shadow_rays"]
        tried, traced, occluded = counts["connections"], counts["traced"], counts["occluded"]
        rows.append(
            (
                grouped(samples),
                grouped(tried),
                grouped(traced),
                grouped(occluded),
                percent(occluded / traced, 2),
                percent((traced - occluded) / tried, 2),
            )
        )
    share, used = occluded / traced, (traced - occluded) / tried
    header = (
        "samples per label",
        "connections tried",
        "shadow rays traced",
        "occluded",
        "share occluded",
        "connections with light",
    )
    result.tables["shadow_rays"] = (header, rows)
    result.add(
        page.table(header, rows, numeric=range(1, 6)),
        page.paragraph(
            (
                "A connection whose unshadowed contribution is zero is not traced: the transceiver is behind"
                " the surface, or emits nothing in this direction."
            ),
            "note",
        ),
    )
    result.find(
        "A randomly chosen transceiver often fails the visibility test, so many samples are wasted",
        "no number",
        f"{percent(share)} of the shadow rays occluded, {percent(used)} of the connections with light",
        verdict(used < 0.5, used < 0.75),
        (
            f"{percent(share)} of the shadow rays are occluded; only {percent(used)} of all connections"
            " contribute light."
        ),
        (
            f"This explains a part of the variance: if every connection contributed, {percent(used)} of the"
            f" samples would suffice, a factor of {1 / used:.1f}. The larger part is due to connections to only"
            f" one of {len(study.reference.unit_ids)} transceivers (compare the section on path reuse)."
        ),
    )
    return result
