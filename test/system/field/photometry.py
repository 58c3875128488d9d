"""Photometric files as laboratories and programs write them."""

import re

from rows import Row, between, ends, equals, output, refuses


def peak(store):
    """W/sr"""

    def measure(_):
        text = output("inspect", store)
        return float(re.search(r"^ +unit +\S+ +\S+ +\S+ +(\S+)", text, re.MULTILINE)[1])

    return measure


ROWS = [
    Row("planes_flow_ies.json", "0.3864 W/sr, as in lines", peak("planes_flow_ies.json"), equals(0.3864)),
    Row("one_line_ies.json", "0.3864 W/sr", peak("one_line_ies.json"), equals(0.3864)),
    Row("uplight_ldt.json", "0.259 W/sr", peak("uplight_ldt.json"), between(0.258, 0.26)),
    Row(
        "all_planes_ldt.json",
        "the number of planes does not fit the symmetry",
        ends("inspect all_planes_ldt.json"),
        refuses("line 3", "symmetry 2", "C-planes"),
    ),
]
