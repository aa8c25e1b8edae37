"""PNG files of every kind, made without carom and without libpng (PNG, third edition)."""

import struct
import zlib

GREY, RGB, PALETTE, GREY_ALPHA, RGBA = 0, 2, 3, 4, 6
CHANNELS = {GREY: 1, RGB: 3, PALETTE: 1, GREY_ALPHA: 2, RGBA: 4}
ADAM7 = ((0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2))


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def packed(samples, depth):
    """One row of samples as bytes."""
    if depth == 16:
        return struct.pack(f">{len(samples)}H", *samples)
    bits, row = "".join(format(s, f"0{depth}b") for s in samples), b""
    bits += "0" * (-len(bits) % 8)
    for k in range(0, len(bits), 8):
        row += bytes([int(bits[k:k + 8], 2)])
    return row


def png(width, height, at, colour=GREY, depth=8, interlaced=False, extra=b""):
    """at(x, y) gives a pixel: a number, or a tuple of samples; `extra`: chunks before the pixels."""
    def pixel(x, y):
        value = at(x, y)
        return value if isinstance(value, tuple) else (value,)
    raw = b""
    for x0, y0, dx, dy in ADAM7 if interlaced else ((0, 0, 1, 1),):
        for y in range(y0, height, dy):
            samples = [s for x in range(x0, width, dx) for s in pixel(x, y)]
            if samples:
                assert len(samples) % CHANNELS[colour] == 0
                raw += b"\0" + packed(samples, depth)
    head = struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, int(interlaced))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + extra + chunk(b"IDAT", zlib.compress(raw)) +
            chunk(b"IEND", b""))


def palette(colours, alphas=()):
    chunks = chunk(b"PLTE", bytes(v for c in colours for v in c))
    return chunks + (chunk(b"tRNS", bytes(alphas)) if alphas else b"")


def gamma(value):
    return chunk(b"gAMA", struct.pack(">I", round(100000 * value)))


SRGB = chunk(b"sRGB", b"\0")
