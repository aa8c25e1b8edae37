"""carom compare: by what files are, not by their names; every option counts; a summary, not a list."""

import json
import subprocess
import unittest

from png_making import png
from program import ProgramTest, run


class CompareTest(ProgramTest):
    def picture(self, name, grey=100, pixels_off=0, off=1):
        """100 x 10 pixels of `grey`, the first `pixels_off` of them brighter by `off`."""
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(png(100, 10, lambda x, y: grey + (off if 100 * y + x < pixels_off else 0)))
        return path

    def film(self, name, rate=10, frames=6, grey=128):
        path = self.folder / name
        subprocess.run(["ffmpeg", "-v", "error", "-y", "-f", "lavfi", "-i",
                        f"color=c=0x{grey:02x}{grey:02x}{grey:02x}:s=64x64:r={rate}", "-frames:v", str(frames),
                        "-c:v", "libx264", "-preset", "ultrafast", str(path)], check=True)
        return path

    def compared(self, code, *arguments):
        result = run("compare", *arguments, "--json")
        self.assert_exit(code, result)
        return json.loads(result.stdout)


class Options(CompareTest):
    def test_the_share_of_differing_pixels_counts_for_each_kind(self):
        # 20 of 1000 pixels are off by 1: 2 %.
        a, b = self.picture("a.png"), self.picture("b.png", pixels_off=20)
        folder_a, folder_b = self.picture("A/f.png").parent, self.picture("B/f.png", pixels_off=20).parent
        for one, other in ((a, b), (folder_a, folder_b)):
            self.compared(5, one, other)
            self.compared(0, one, other, "--max-differing", 0.02)
            self.compared(5, one, other, "--max-differing", 0.0199)

    def test_the_share_of_differing_pixels_counts_for_films(self):
        a, b = self.film("a.mp4", grey=128), self.film("b.mp4", grey=130)
        found = self.compared(0, a, b)  # the films' own default has no limit on the number
        self.assertEqual(1, found["differing_fraction"])
        self.assertLessEqual(found["largest"], 4)
        self.compared(5, a, b, "--max-differing", 0)
        self.compared(5, a, b, "--max-differing", 0.99)
        self.compared(5, a, b, "--tolerance", 0)
        self.compared(0, a, a, "--max-differing", 0, "--tolerance", 0)


class Signatures(CompareTest):
    def test_a_png_is_one_under_any_name(self):
        for name in ("b.PNG", "b", "b.mp4"):
            b = self.picture(name, pixels_off=20)
            self.assertEqual(1, self.compared(5, self.picture("a.png"), b)["largest"])

    def test_folders_of_pngs_in_capitals(self):
        a, b = self.picture("A/f.PNG").parent, self.picture("B/f.PNG", pixels_off=500).parent
        self.assertEqual(1, self.compared(5, a, b)["compared"])

    def test_other_pictures_are_refused_by_name(self):
        a = self.picture("a.png")
        for start, name in ((b"\xff\xd8\xff\xe0\0\x10JFIF", "JPEG"), (b"BM\x46\0\0\0\0\0\0\0\x36\0", "BMP"),
                            (b"RIFF\x24\0\0\0WEBPVP8 ", "WebP"), (b"II*\0\x08\0\0\0", "TIFF")):
            for file in ("b.jpg", "b.png"):
                other = self.folder / file
                other.write_bytes(start + bytes(100))
                result = run("compare", a, other)
                self.assert_exit(2, result)
                self.assertIn(f"{name} picture", result.stderr)
            (self.folder / "P").mkdir(exist_ok=True)
            (self.folder / "P" / "f.jpg").write_bytes(start + bytes(100))
            result = run("compare", self.folder / "P", self.folder / "P")
            self.assert_exit(2, result)
            self.assertIn(f"{name} picture", result.stderr)

    def test_pointers_and_empty_files_are_named(self):
        a = self.picture("a.png")
        pointer = self.write("p.png", "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n")
        for other, words in ((pointer, "Git LFS"), (self.write("e.png", ""), "empty")):
            result = run("compare", a, other)
            self.assert_exit(2, result)
            self.assertIn(words, result.stderr)


class Summary(CompareTest):
    def test_folders_that_differ_much_are_summed_up(self):
        for k in range(40):
            self.picture(f"A/f{k:02}.png")
            self.picture(f"B/f{k:02}.png", pixels_off=0 if k < 3 else 200, off=90 if k == 17 else 5)
        self.picture("B/g.png")
        result = run("compare", self.folder / "A", self.folder / "B")
        self.assert_exit(5, result)
        lines = result.stdout.splitlines()
        self.assertEqual(3, len(lines), result.stdout)
        self.assertIn("38 of 41 pictures differ, 1 only in one", lines[0])
        self.assertTrue(lines[1].startswith("first f03.png: largest difference 5 of 255"), lines[1])
        self.assertTrue(lines[2].startswith("worst f17.png: largest difference 90 of 255"), lines[2])

    def test_empty_is_an_error(self):
        full = self.picture("A/f.png").parent
        empty = self.folder / "E"
        empty.mkdir()
        for one, other in ((full, empty), (empty, full), (empty, empty)):
            result = run("compare", one, other)
            self.assert_exit(2, result)
            self.assertIn("nothing to compare", result.stderr)

    def test_names_that_never_meet_give_no_worst_pair(self):
        result = run("compare", self.picture("A/f.png").parent, self.picture("B/g.png").parent)
        self.assert_exit(5, result)
        self.assertNotIn("worst", result.stdout)
        self.assertIn("2 of 2 pictures differ, 2 only in one", result.stdout)

    def test_time_stamps_count(self):
        a = self.film("a.mp4", rate=10)
        for rate in (20, "10000/1001"):
            found = self.compared(5, a, self.film("b.mp4", rate=rate))
            self.assertEqual(5, found["at_other_times"])  # the first frame is at 0 in both
            self.assertEqual(0, found["largest"])
        # Containers that round their stamps differently show the same film.
        self.compared(0, self.film("c.mp4", rate=30), self.film("c.mkv", rate=30))


if __name__ == "__main__":
    unittest.main()
