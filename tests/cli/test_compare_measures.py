"""carom compare: PSNR and SSIM against closed forms and a plain double loop, and every kind of PNG."""

import json
import math
import random
import subprocess
import unittest

from png_making import GREY, GREY_ALPHA, PALETTE, RGB, RGBA, SRGB, gamma, palette, png
from program import ProgramTest, run

C1, C2 = (0.01 * 255) ** 2, (0.03 * 255) ** 2


def luma(r, g, b):
    return 0.2126 * r + 0.7152 * g + 0.0722 * b


def one_window(x, y, weights):
    """Equation 13 of Wang et al. 2004 of lists of brightness and weights that sum to 1."""
    mx = sum(w * v for w, v in zip(weights, x))
    my = sum(w * v for w, v in zip(weights, y))
    vx = sum(w * (v - mx) ** 2 for w, v in zip(weights, x))
    vy = sum(w * (v - my) ** 2 for w, v in zip(weights, y))
    xy = sum(w * (u - mx) * (v - my) for w, u, v in zip(weights, x, y))
    return (2 * mx * my + C1) * (2 * xy + C2) / ((mx * mx + my * my + C1) * (vx + vy + C2))


def ssim(width, height, x, y):
    """Mean over all windows, each summed by itself; x and y map (column, row) to brightness."""
    if width < 11 or height < 11:
        places = [(c, r) for r in range(height) for c in range(width)]
        return one_window([x(*p) for p in places], [y(*p) for p in places], [1 / len(places)] * len(places))
    weights = [math.exp(-((i - 5) ** 2 + (j - 5) ** 2) / (2 * 1.5 ** 2)) for j in range(11) for i in range(11)]
    weights = [w / sum(weights) for w in weights]
    values = []
    for top in range(height - 10):
        for left in range(width - 10):
            places = [(left + i, top + j) for j in range(11) for i in range(11)]
            values.append(one_window([x(*p) for p in places], [y(*p) for p in places], weights))
    return sum(values) / len(values)


class MeasuresTest(ProgramTest):
    def file(self, name, *arguments, **keywords):
        path = self.folder / name
        path.write_bytes(png(*arguments, **keywords))
        return path

    def compared(self, a, b, *options, codes=(0, 5)):
        result = run("compare", a, b, "--json", *options)
        self.assertIn(result.returncode, codes, result.stderr)
        return json.loads(result.stdout)


class Psnr(MeasuresTest):
    def test_a_constant_difference(self):
        a = self.file("a.png", 20, 30, lambda x, y: 100)
        for off in (1, 7, 155):
            found = self.compared(a, self.file("b.png", 20, 30, lambda x, y: 100 + off))
            self.assertAlmostEqual(20 * math.log10(255 / off), found["psnr_db"], places=9)
            self.assertAlmostEqual(20 * math.log10(255 / off), found["psnr_luma_db"], places=9)
            self.assertEqual((off, 600, 600, 1), tuple(found[k] for k in (
                "largest", "differing_pixels", "pixels", "differing_fraction")))

    def test_one_channel_of_one_pixel(self):
        # The mean square over n pixels of three channels is d^2 / (3 n).
        a = self.file("a.png", 10, 10, lambda x, y: (9, 9, 9), colour=RGB)
        b = self.file("b.png", 10, 10, lambda x, y: (9, 9, 49 if (x, y) == (3, 8) else 9), colour=RGB)
        found = self.compared(a, b)
        self.assertAlmostEqual(10 * math.log10(255 ** 2 * 300 / 40 ** 2), found["psnr_db"], places=9)
        self.assertAlmostEqual(10 * math.log10(255 ** 2 * 100 / (0.0722 * 40) ** 2), found["psnr_luma_db"], places=9)
        self.assertEqual(1, found["differing_pixels"])

    def test_alpha_is_a_fourth_channel_where_there_is_any(self):
        a = self.file("a.png", 4, 4, lambda x, y: (0, 0, 0, 200), colour=RGBA)
        b = self.file("b.png", 4, 4, lambda x, y: (0, 0, 0, 190), colour=RGBA)
        self.assertAlmostEqual(10 * math.log10(255 ** 2 / (100 / 4)), self.compared(a, b)["psnr_db"], places=9)

    def test_identical_pictures_have_none(self):
        a = self.file("a.png", 4, 4, lambda x, y: 3)
        found = self.compared(a, a)
        self.assertIsNone(found["psnr_db"])
        self.assertEqual((1, None), (found["ssim"], found["first_not_identical"]))
        self.assertIn("all identical", run("compare", a, a).stdout)


class Ssim(MeasuresTest):
    def test_constant_pictures_differ_in_light_only(self):
        for u, v in ((100, 110), (0, 255), (30, 31)):
            a = self.file("a.png", 40, 25, lambda x, y: u)
            b = self.file("b.png", 40, 25, lambda x, y: v)
            want = (2 * u * v + C1) / (u * u + v * v + C1)
            self.assertAlmostEqual(want, self.compared(a, b)["ssim"], places=5)

    def test_any_pictures_against_a_plain_double_loop(self):
        random.seed(4)
        for width, height in ((24, 19), (11, 11), (12, 30), (10, 40), (40, 7), (1, 1)):
            pixels = {(x, y): tuple(random.randrange(256) for _ in range(3))
                      for x in range(width) for y in range(height)}
            noise = {p: tuple(min(255, v + random.randrange(60)) for v in c) for p, c in pixels.items()}
            a = self.file("a.png", width, height, lambda x, y: pixels[x, y], colour=RGB)
            b = self.file("b.png", width, height, lambda x, y: noise[x, y], colour=RGB)
            want = ssim(width, height, lambda x, y: luma(*pixels[x, y]), lambda x, y: luma(*noise[x, y]))
            self.assertAlmostEqual(want, self.compared(a, b)["ssim"], places=5, msg=f"{width} x {height}")

    def test_a_difference_in_a_corner(self):
        # Only windows around the difference are summed; in each corner there are fewer.
        base = lambda x, y: (7 * x + 13 * y) % 200
        for corner in ((0, 0), (31, 0), (0, 27), (31, 27), (16, 14)):
            other = lambda x, y: base(x, y) + (50 if (x, y) == corner else 0)
            a, b = self.file("a.png", 32, 28, base), self.file("b.png", 32, 28, other)
            self.assertAlmostEqual(ssim(32, 28, base, other), self.compared(a, b)["ssim"], places=6, msg=corner)

    def test_transparent_pictures_are_seen_over_black_and_white(self):
        # Black that can be seen through is nothing over black, and grey over white.
        a = self.file("a.png", 12, 12, lambda x, y: (0, 0, 0, 255), colour=RGBA)
        b = self.file("b.png", 12, 12, lambda x, y: (0, 0, 0, 155), colour=RGBA)
        self.assertAlmostEqual(C1 / (100 ** 2 + C1), self.compared(a, b)["ssim"], places=5)


class Kinds(MeasuresTest):
    """One picture as every kind of PNG that can hold it is the same picture."""

    def test_grey_of_every_depth_palette_and_interlacing(self):
        want = self.file("want.png", 19, 13, lambda x, y: 255 * ((x + y) % 2))
        bit = lambda x, y: (x + y) % 2
        colours = palette([(0, 0, 0), (255, 255, 255)])
        for interlaced in (False, True):
            for depth in (1, 2, 4, 8, 16):
                one = 2 ** depth - 1
                grey = self.file("g.png", 19, 13, lambda x, y: one * bit(x, y), depth=depth, interlaced=interlaced)
                self.assertEqual(0, self.compared(want, grey, codes=(0,))["differing_pixels"], (depth, interlaced))
                if depth < 16:
                    mapped = self.file("p.png", 19, 13, bit, colour=PALETTE, depth=depth, interlaced=interlaced,
                                       extra=colours)
                    self.assertEqual(0, self.compared(want, mapped, codes=(0,))["differing_pixels"], depth)

    def test_colour_alpha_and_transparent_colours(self):
        colour = lambda x, y: (40 * x, 30 * y, 77)
        want = self.file("want.png", 6, 7, lambda x, y: (*colour(x, y), 100), colour=RGBA)
        deep = self.file("deep.png", 6, 7, lambda x, y: tuple(257 * v for v in (*colour(x, y), 100)), colour=RGBA,
                         depth=16, interlaced=True)
        # Premultiplied in 16 bits the same colour is off by the rounding of 8 bits at most.
        self.assertLessEqual(self.compared(want, deep)["largest"], 0.5)
        self.assertGreater(self.compared(want, deep)["largest"], 0)
        table = palette([(40 * x, 30 * y, 77) for y in range(7) for x in range(6)], [100] * 42)
        mapped = self.file("p.png", 6, 7, lambda x, y: 6 * y + x, colour=PALETTE, extra=table)
        self.assertEqual(0, self.compared(want, mapped)["differing_pixels"])
        grey = self.file("ga.png", 6, 7, lambda x, y: (9 * x, 100), colour=GREY_ALPHA)
        rgba = self.file("ga4.png", 6, 7, lambda x, y: (9 * x, 9 * x, 9 * x, 100), colour=RGBA)
        self.assertEqual(0, self.compared(grey, rgba)["differing_pixels"])

    def test_16_bits_are_not_thrown_away(self):
        a = self.file("a.png", 8, 8, lambda x, y: 30000, depth=16)
        b = self.file("b.png", 8, 8, lambda x, y: 30001, depth=16)
        found = self.compared(a, b, "--max-differing", 1, codes=(0,))
        self.assertAlmostEqual(1 / 257, found["largest"], places=12)
        self.assertEqual(64, found["differing_pixels"])
        self.assertAlmostEqual(20 * math.log10(65535), found["psnr_db"], places=9)
        self.compared(a, b, "--tolerance", 0, codes=(5,))
        eight = self.file("c.png", 8, 8, lambda x, y: 117)  # 257 * 117 = 30069
        self.assertAlmostEqual(69 / 257, self.compared(a, eight)["largest"], places=12)

    def test_gamma_is_brought_to_srgb(self):
        def srgb(light):
            return 12.92 * light if light <= 0.0031308 else 1.055 * light ** (1 / 2.4) - 0.055
        steps = lambda x, y: 4096 * x + 255 * y
        for value in (1.0, 0.55, 1 / 1.8):
            linear = self.file("l.png", 16, 16, steps, depth=16, extra=gamma(value))
            exponent = 1 / (round(100000 * value) / 100000)
            want = self.file("w.png", 16, 16, lambda x, y: round(65535 * srgb((steps(x, y) / 65535) ** exponent)),
                             depth=16)
            self.assertLessEqual(self.compared(linear, want)["largest"], 1 / 257 + 1e-12)
            plain = self.file("n.png", 16, 16, steps, depth=16)
            self.assertGreater(self.compared(linear, plain, codes=(5,))["largest"], 10)
            # An sRGB chunk counts before gAMA.
            tagged = self.file("t.png", 16, 16, steps, depth=16, extra=SRGB + gamma(value))
            self.assertEqual(0, self.compared(tagged, plain)["differing_pixels"])
        for value in (0.45455, 0.51):  # sRGB's, and what FFmpeg writes for BT.709
            usual = self.file("u.png", 16, 16, steps, depth=16, extra=gamma(value))
            self.assertEqual(0, self.compared(usual, plain)["differing_pixels"])
        # In 8 bits, and with alpha: 188 is the sRGB value of half the light.
        eight = self.file("e.png", 2, 2, lambda x, y: (128, 255, 0, 128), colour=RGBA, extra=gamma(1))
        want = self.file("f.png", 2, 2, lambda x, y: (188, 255, 0, 128), colour=RGBA)
        self.assertEqual(0, self.compared(eight, want)["differing_pixels"])


class First(MeasuresTest):
    def test_the_first_frame_that_differs_and_the_first_that_is_not_identical(self):
        for name in "AB":
            (self.folder / name).mkdir()
            for k in range(8):
                off = {2: 1, 5: 40, 6: 90}.get(k, 0) if name == "B" else 0
                self.file(f"{name}/f{k}.png", 20, 20, lambda x, y: 50 + (off if (x, y) == (7, 7) else 0), GREY)
        found = self.compared(self.folder / "A", self.folder / "B")
        self.assertEqual(("f5.png", "f2.png", "f6.png"),
                         tuple(found[k] for k in ("first_differing", "first_not_identical", "worst")))
        self.assertEqual([0, 0, 1, 0, 0, 40, 90, 0], [p["largest"] for p in found["pairs"]])
        self.assertEqual([True] * 5 + [False] * 2 + [True], [p["same"] for p in found["pairs"]])
        self.assertEqual({"tolerance": 2, "max_differing": 0.01}, found["limits"])
        lines = run("compare", self.folder / "A", self.folder / "B").stdout.splitlines()
        self.assertIn("1 of 400 pixels (0.2500 %) differ, PSNR", lines[1])
        self.assertTrue(lines[1].startswith("first f5.png"), lines)
        passed = run("compare", self.folder / "A", self.folder / "B", "--tolerance", 90).stdout
        self.assertIn("first not identical f2.png", passed)

    def test_films(self):
        # Two films without loss that part at frame 3.
        def film(name, change):
            path = self.folder / name
            subprocess.run(["ffmpeg", "-v", "error", "-y", "-f", "lavfi", "-i",
                            f"color=c=gray:s=64x64:r=10:d=1,format=gray,geq=lum='100+if(gte(N,{change}),60,0)'",
                            "-c:v", "ffv1", str(path)], check=True)
            return path
        found = self.compared(film("a.mkv", 99), film("b.mkv", 3))
        self.assertEqual(("frame 3", "frame 3", 10), tuple(
            found[k] for k in ("first_differing", "first_not_identical", "compared")))
        self.assertEqual([3], [k for k, p in enumerate(found["pairs"][:4]) if not p["same"]])


if __name__ == "__main__":
    unittest.main()
