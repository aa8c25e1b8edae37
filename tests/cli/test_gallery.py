"""docs/gallery.md shows every scene of the gallery, as it is now."""

import os
import re
import unittest
from pathlib import Path

SOURCE = Path(os.environ["CAROM_SOURCE_DIR"])
SCENES = sorted((SOURCE / "scenes" / "gallery").glob("*.yaml"))


class Gallery(unittest.TestCase):
    def setUp(self):
        self.page = (SOURCE / "docs" / "gallery.md").read_text()

    def test_every_scene_has_its_section_and_picture(self):
        self.assertGreater(len(SCENES), 10)
        for scene in SCENES:
            with self.subTest(scene=scene.name):
                text = scene.read_text()
                title = re.search(r'^title: *"?(.*?)"?$', text, re.MULTILINE)
                heading = title.group(1) if title else scene.stem
                self.assertIn(f"## {heading}\n", self.page)
                self.assertIn(f"gallery/{scene.stem}.png", self.page)
                comment = re.match(r"(?:#.*\n)+", text).group(0)
                for line in comment.splitlines():
                    self.assertIn(line.lstrip("# "), self.page)

    def test_no_picture_is_missing_or_left_over(self):
        shown = set(re.findall(r"\]\(gallery/(.*?)\)", self.page))
        there = {p.name for p in (SOURCE / "docs" / "gallery").iterdir()}
        self.assertEqual(shown, there)
        self.assertEqual(there, {f"{s.stem}.png" for s in SCENES})

    def test_every_scene_has_golden_pictures(self):
        golden = {p.name.rsplit("-t", 1)[0] for p in (SOURCE / "tests" / "golden").glob("*.png")}
        self.assertLessEqual({s.stem for s in SCENES}, golden)


if __name__ == "__main__":
    unittest.main()
