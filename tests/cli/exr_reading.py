"""Reads what of OpenEXR the layers are: one part, tiles of one level, 32-bit floats, ZIP.

After "OpenEXR File Layout" (https://openexr.com/en/latest/OpenEXRFileLayout.html).
"""

import array
import itertools
import math
import struct
import sys
import zlib


def text_until_zero(data, at):
    end = data.index(0, at)
    return data[at:end].decode(), end + 1


def header(data):
    """name -> bytes of the attribute's value, and where the header ends."""
    magic, version = struct.unpack_from("<ii", data)
    assert magic == 20000630 and version & 255 == 2 and version >> 8 & 2, "no EXR file of tiles"
    attributes, at = {}, 8
    while data[at]:
        name, at = text_until_zero(data, at)
        _, at = text_until_zero(data, at)
        size, = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def channel_names(value):
    names, at = [], 0
    while value[at]:
        name, at = text_until_zero(value, at)
        kind, _, x_sampling, y_sampling = struct.unpack_from("<iIii", value, at)
        assert (kind, x_sampling, y_sampling) == (2, 1, 1), "no channel of 32-bit floats"
        names.append(name)
        at += 16
    return names


def unpacked(chunk, size):
    """ZIP's bytes: differences of neighbours, the even ones before the odd ones."""
    if len(chunk) == size:
        return bytes(chunk)
    coded = zlib.decompress(chunk)
    assert len(coded) == size
    summed = bytes(itertools.accumulate(coded, lambda before, step: (before + step - 128) & 255))
    result = bytearray(size)
    result[0::2], result[1::2] = summed[:(size + 1) // 2], summed[(size + 1) // 2:]
    return bytes(result)


def read_exr(path):
    """(width, height, {channel: array of floats, row by row})."""
    data = path.read_bytes()
    attributes, at = header(data)
    left, top, right, bottom = struct.unpack("<iiii", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    tile_width, tile_height, mode = struct.unpack("<IIB", attributes["tiles"])
    assert mode == 0 and attributes["compression"] == b"\x03"
    names = channel_names(attributes["channels"])
    channels = {name: array.array("f", bytes(4 * width * height)) for name in names}
    columns, rows = math.ceil(width / tile_width), math.ceil(height / tile_height)
    seen = set()
    for offset in struct.unpack_from(f"<{columns * rows}Q", data, at):
        column, row, level_x, level_y, size = struct.unpack_from("<5i", data, offset)
        assert level_x == level_y == 0
        seen.add((column, row))
        x, y = column * tile_width, row * tile_height
        w, h = min(tile_width, width - x), min(tile_height, height - y)
        floats = array.array("f", unpacked(data[offset + 20:offset + 20 + size], 4 * w * h * len(names)))
        if sys.byteorder == "big":
            floats.byteswap()
        for line in range(h):
            for i, name in enumerate(names):
                begin = (line * len(names) + i) * w
                place = (y + line) * width + x
                channels[name][place:place + w] = floats[begin:begin + w]
    assert len(seen) == columns * rows, "tiles are missing"
    return width, height, channels
