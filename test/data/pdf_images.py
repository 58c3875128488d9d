#!/usr/bin/env python3
"""pdf_images.py FOLDER: writes a PDF file for each codec of images, with the same picture.

The picture is white with a dark square at its upper left quarter, and a dark bar at its lower side. `FOLDER/NAME.pdf`
has it on a page of 300 x 200 points. Needs Pillow (package python3-pil) with JPEG, JPEG 2000 and TIFF.
"""

import base64
import io
import struct
import sys
import zlib
from pathlib import Path

from PIL import Image, ImageChops, ImageDraw

SIZE = (600, 400)
DRAW = b"300 0 0 200 0 0 cm /I Do"


def picture(mode):
    image = Image.new("L", SIZE, 255)
    draw = ImageDraw.Draw(image)
    draw.rectangle((60, 40, 240, 160), fill=0)
    draw.rectangle((60, 340, 540, 380), fill=0)
    return image.convert(mode, dither=Image.Dither.NONE) if mode == "1" else image.convert(mode)


def encoded(image, kind, **options):
    out = io.BytesIO()
    image.save(out, kind, **options)
    return out.getvalue()


def fax():
    """The only strip of a TIFF file in Group 4, whose runs of 0 are white; TIFF files of Pillow have them black."""
    inverted = ImageChops.invert(picture("1"))
    image = Image.open(io.BytesIO(encoded(inverted, "TIFF", compression="group4", tiffinfo={278: SIZE[1]})))
    (offset,), (count,) = image.tag_v2[273], image.tag_v2[279]
    assert image.tag_v2[262] == 1
    image.fp.seek(offset)
    return image.fp.read(count)


def jbig2(data):
    """A page with one generic region, which is coded as in Group 4 (ITU-T T.88, 7.4.6)."""

    def segment(number, kind, content):
        return struct.pack(">IBBBI", number, kind, 0, 1, len(content)) + content

    page = struct.pack(">IIIIBH", *SIZE, 0, 0, 0, 0)
    region = struct.pack(">IIIIB", *SIZE, 0, 0, 0) + bytes([1]) + data
    return segment(0, 48, page) + segment(1, 38, region)


def run_length(data):
    """Every run of at most 128 equal bytes."""
    out = bytearray()
    at = 0
    while at < len(data):
        count = 1
        while count < 128 and at + count < len(data) and data[at + count] == data[at]:
            count += 1
        out += bytes([257 - count, data[at]]) if count > 1 else bytes([0, data[at]])
        at += count
    return bytes(out) + b"\x80"


def lzw(data):
    """Codes of 9 bits alone: the table is cleared before it grows beyond them (ISO 32000-1, 7.4.4)."""
    codes = [code for at, byte in enumerate(data) for code in ((256, byte) if at % 200 == 0 else (byte,))]
    bits = "".join(format(code, "09b") for code in (*codes, 257))
    bits += "0" * (-len(bits) % 8)
    return bytes(int(bits[k : k + 8], 2) for k in range(0, len(bits), 8))


def pdf(data, entries):
    objects = [
        b"<< /Type /Catalog /Pages 2 0 R >>",
        b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        b"<< /Type /Page /Parent 2 0 R /MediaBox [0 0 300 200] /Contents 4 0 R /Resources << /XObject << /I 5 0 R >> >> >>",
        b"<< /Length %d >>\nstream\n%s\nendstream" % (len(DRAW), DRAW),
        b"<< /Type /XObject /Subtype /Image /Width %d /Height %d /Length %d %s >>\nstream\n%s\nendstream"
        % (*SIZE, len(data), entries.encode(), data),
    ]
    out = bytearray(b"%PDF-1.7\n%\xe2\xe3\xcf\xd3\n")
    places = []
    for number, body in enumerate(objects, 1):
        places.append(len(out))
        out += b"%d 0 obj\n%s\nendobj\n" % (number, body)
    start = len(out)
    out += b"xref\n0 %d\n0000000000 65535 f \n" % (len(objects) + 1)
    out += b"".join(b"%010d 00000 n \n" % place for place in places)
    out += b"trailer\n<< /Size %d /Root 1 0 R >>\nstartxref\n%d\n%%%%EOF\n" % (len(objects) + 1, start)
    return bytes(out)


def main(folder):
    grey = picture("L").tobytes()
    bits = picture("1").tobytes()
    g4 = fax()
    plain = "/ColorSpace /DeviceGray /BitsPerComponent 8 /Filter"
    bitonal = "/ColorSpace /DeviceGray /BitsPerComponent 1"
    files = {
        "flate": (zlib.compress(grey), f"{plain} /FlateDecode"),
        "lzw": (lzw(grey), f"{plain} /LZWDecode"),
        "run-length": (run_length(grey), f"{plain} /RunLengthDecode"),
        "ascii85": (base64.a85encode(zlib.compress(grey), adobe=False) + b"~>", f"{plain} [/ASCII85Decode /FlateDecode]"),
        "hex": (zlib.compress(grey).hex().encode() + b">", f"{plain} [/ASCIIHexDecode /FlateDecode]"),
        "bits": (zlib.compress(bits), f"{bitonal} /Filter /FlateDecode"),
        "jpeg": (encoded(picture("RGB"), "JPEG", quality=90), "/ColorSpace /DeviceRGB /BitsPerComponent 8 /Filter /DCTDecode"),
        "jpeg-cmyk": (
            encoded(picture("CMYK"), "JPEG", quality=90),
            # Pillow writes the complement of each ink.
            "/ColorSpace /DeviceCMYK /BitsPerComponent 8 /Decode [1 0 1 0 1 0 1 0] /Filter /DCTDecode",
        ),
        "jpeg-2000": (encoded(picture("RGB"), "JPEG2000"), "/Filter /JPXDecode"),
        "fax": (
            g4,
            f"{bitonal} /Filter /CCITTFaxDecode /DecodeParms << /K -1 /Columns {SIZE[0]} /Rows {SIZE[1]} >>",
        ),
        "jbig2": (jbig2(g4), f"{bitonal} /Filter /JBIG2Decode"),
    }
    for name, (data, entries) in files.items():
        (folder / f"{name}.pdf").write_bytes(pdf(data, entries))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
