"""Shadow rays in vain: the explanation of 2.11.2 for the variance."""

from study.core import page
from study.core.findings import Section, verdict
from study.core.text import grouped, percent


def section(study):
    result = Section(
        "Occluded shadow rays",
        "2.11.2",
        "How many of the uniformly chosen transceivers does a vertex not see?",
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
        "samples a label",
        "connections tried",
        "shadow rays traced",
        "occluded",
        "share occluded",
        "connections that bring light",
    )
    result.tables["shadow_rays"] = (header, rows)
    result.add(
        page.table(header, rows, numeric=range(1, 6)),
        page.paragraph(
            (
                "A connection whose unshadowed contribution is zero (the transceiver lies behind the surface,"
                " or sends nothing that way) needs no ray and is not among the traced ones."
            ),
            "note",
        ),
    )
    result.find(
        "A randomly chosen transceiver often fails the visibility test, so many samples are in vain",
        "no number",
        f"{percent(share)} of the shadow rays occluded, {percent(used)} of the connections bring light",
        verdict(used < 0.5, used < 0.75),
        (
            f"{percent(share)} of the shadow rays are occluded; only {percent(used)} of all connections bring"
            " any light."
        ),
        (
            f"That explains a part: if no connection were in vain, {percent(used)} of the samples would do, a"
            f" factor of {1 / used:.1f}. The larger part is that each connection serves one transceiver of"
            f" {len(study.reference.unit_ids)} (compare the section on path reuse)."
        ),
    )
    return result
