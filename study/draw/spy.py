"""Which entries of a matrix are above zero, as a picture of one pixel an entry."""

import base64
import struct
import zlib

import numpy as np


def png(is_set):
    """A PNG of a boolean matrix: colour where set, transparent elsewhere, so it fits light and dark pages."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    height, width = is_set.shape
    rows = np.packbits(is_set, axis=1)
    lines = b"".join(b"\0" + row.tobytes() for row in rows)
    head = struct.pack(">IIBBBBB", width, height, 1, 3, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", head)
        + chunk(b"PLTE", bytes([255, 255, 255, 60, 130, 200]))
        + chunk(b"tRNS", bytes([0, 255]))
        + chunk(b"IDAT", zlib.compress(lines, 9))
        + chunk(b"IEND", b"")
    )


def picture(is_set, description):
    data = base64.b64encode(png(is_set)).decode()
    height, width = is_set.shape
    return (
        f'<img class="spy" width="{width}" height="{height}" alt="{description}" '
        f'src="data:image/png;base64,{data}"/>'
    )
