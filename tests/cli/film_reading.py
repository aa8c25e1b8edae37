"""Films decoded again: samples, time stamps and texts, by FFmpeg and by the formats' own words."""

import fractions
import json
import pathlib
import struct
import subprocess
import tempfile

# Every step of FFmpeg's conversion to RGB with full precision, so that what is measured is the film.
EXACT = "accurate_rnd+full_chroma_int+full_chroma_inp+bicubic"


def ffmpeg(*arguments):
    return subprocess.run(["ffmpeg", "-v", "error", *map(str, arguments)], stdout=subprocess.PIPE, check=True).stdout


def rgba(path, before=(), filters=None):
    """All samples of a film (or of PNGs by a pattern), straight alpha, as bytes."""
    words = ["-vf", filters] if filters else []
    return ffmpeg(*before, "-i", path, *words, "-sws_flags", EXACT, "-vsync", "passthrough", "-f", "rawvideo",
                  "-pix_fmt", "rgba", "-")


def probe(path, *words):
    return json.loads(subprocess.run(["ffprobe", "-v", "error", *words, "-show_streams", "-show_format", "-of", "json",
                                      str(path)], capture_output=True, check=True).stdout)


def stamps(path):
    """The packets' times in seconds as fractions, in order of showing."""
    found = probe(path, "-show_packets")
    tick = fractions.Fraction(found["streams"][0]["time_base"])
    return sorted(packet["pts"] * tick for packet in found["packets"])


def apng_stamps(path):
    """By the frame controls themselves: FFmpeg rounds their fractions to 1/100000 s."""
    data, at, now, times = pathlib.Path(path).read_bytes(), 8, fractions.Fraction(0), []
    while at < len(data):
        size, name = struct.unpack_from(">I4s", data, at)
        if name == b"fcTL":
            times.append(now)
            now += fractions.Fraction(*struct.unpack_from(">HH", data, at + 8 + 20))
        at += 12 + size
    return times


def chunks(data):
    """RIFF's: four letters and content, one behind the other."""
    at = 0
    while at + 8 <= len(data):
        name, size = data[at:at + 4], struct.unpack_from("<I", data, at + 4)[0]
        yield name, data[at + 8:at + 8 + size]
        at += 8 + size + size % 2
    assert at == len(data), "a chunk goes beyond the file"


class AnimatedWebp:
    """An animated WebP by its container specification; FFmpeg 5.1 reads only the still pictures in it."""

    def __init__(self, path):
        data = pathlib.Path(path).read_bytes()
        assert data[:4] == b"RIFF" and data[8:12] == b"WEBP"
        assert struct.unpack_from("<I", data, 4)[0] == len(data) - 8
        parts = list(chunks(data[12:]))
        head = dict(parts)
        flags = head[b"VP8X"][0]
        self.has_alpha = bool(flags & 16)
        assert flags & 2, "no animation"
        self.width = int.from_bytes(head[b"VP8X"][4:7], "little") + 1
        self.height = int.from_bytes(head[b"VP8X"][7:10], "little") + 1
        self.text = head.get(b"XMP ", b"").decode()
        self.frames = [content for name, content in parts if name == b"ANMF"]

    def stamps(self):
        times, now = [], 0
        for frame in self.frames:
            times.append(fractions.Fraction(now, 1000))
            now += int.from_bytes(frame[12:15], "little")
        self.end = fractions.Fraction(now, 1000)
        return times

    def rgba(self):
        """Each frame as the canvas stands after it."""
        canvas = bytearray(4 * self.width * self.height)
        for frame in self.frames:
            x, y, w, h = (int.from_bytes(frame[i:i + 3], "little") for i in (0, 3, 6, 9))
            x, y, w, h = 2 * x, 2 * y, w + 1, h + 1
            assert frame[15] == 2, "each replaces its rectangle"
            still = b"WEBP" + frame[16:]
            with tempfile.NamedTemporaryFile(suffix=".webp") as file:
                file.write(b"RIFF" + struct.pack("<I", len(still)) + still)
                file.flush()
                pixels = rgba(file.name)
            assert len(pixels) == 4 * w * h
            for row in range(h):
                at = 4 * ((y + row) * self.width + x)
                canvas[at:at + 4 * w] = pixels[4 * w * row:4 * w * (row + 1)]
            yield bytes(canvas)


class Difference:
    """How far a film is from the pictures that were drawn; colours as they are seen, over black.

    `flat` is of blocks of 8 by 8 pixels in which the drawn picture is of one colour: the mean of such
    a block, which neither an edge nor a dither changes.
    """

    def __init__(self, drawn, film, width, height):
        assert len(drawn) == len(film), (len(drawn), len(film))
        self.alpha = max(abs(a - b) for a, b in zip(drawn[3::4], film[3::4]))
        drawn, film = over_black(drawn), over_black(film)
        self.largest = max(abs(a - b) for a, b in zip(drawn, film))
        self.mean = sum(abs(a - b) for a, b in zip(drawn, film)) / len(drawn)
        self.flat, self.blocks = 0, 0
        frame = 3 * width * height
        for start in range(0, len(drawn), frame):
            for y in range(0, height - 7, 8):
                for x in range(0, width - 7, 8):
                    rows = [slice(start + 3 * ((y + i) * width + x), start + 3 * ((y + i) * width + x + 8))
                            for i in range(8)]
                    for c in range(3):
                        a = [v for r in rows for v in drawn[r][c::3]]
                        if max(a) - min(a) > 2:
                            continue
                        b = [v for r in rows for v in film[r][c::3]]
                        self.flat = max(self.flat, abs(sum(a) - sum(b)) / 64)
                        self.blocks += 1


def over_black(pixels):
    """RGB times alpha."""
    result = bytearray(len(pixels) // 4 * 3)
    alpha = pixels[3::4]
    for c in range(3):
        result[c::3] = bytes((v * a + 127) // 255 for v, a in zip(pixels[c::4], alpha))
    return bytes(result)
