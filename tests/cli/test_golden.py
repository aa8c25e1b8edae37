"""Every scene of the repository against its golden pictures (tests/golden, 320 x 180).

After a wanted change of the picture, look at what differs and run scripts/update_goldens.sh.
"""

import os
import pathlib
import tempfile
import unittest

from program import SOURCE, run, scenes_with_goldens

GOLDEN = SOURCE / "tests" / "golden"


class Goldens(unittest.TestCase):
    def test_every_scene(self):
        scenes = scenes_with_goldens()
        self.assertGreaterEqual(len(scenes), 8)
        differences = pathlib.Path(os.environ["CAROM"]).parent / "golden-differences"
        result = run("golden", "check", *scenes, "--dir", GOLDEN, "--size", "320x180", "--diffs", differences)
        self.assertEqual(0, result.returncode, result.stdout + result.stderr)

    def test_the_maker_of_the_processor_does_not_show(self):
        # Approximate reciprocal roots differ between makers of processors; without SSE the driver
        # has none. With its own encoding of sRGB 4.5 % of these pixels were off by one.
        with tempfile.TemporaryDirectory() as folder:
            pictures = [pathlib.Path(folder) / "with.png", pathlib.Path(folder) / "without.png"]
            for picture, caps in zip(pictures, ({}, {"GALLIUM_OVERRIDE_CPU_CAPS": "nosse"})):
                scene = SOURCE / "scenes" / "figure8.yaml"
                result = run("still", scene, "--time", "1", "--size", "320x180", "-o", picture,
                             env=dict(os.environ, **caps))
                self.assertEqual(0, result.returncode, result.stderr)
            result = run("compare", *pictures, "--max-differing", "0.005", "--tolerance", "1")
            self.assertEqual(0, result.returncode, result.stdout + result.stderr)

    def test_no_golden_without_a_scene(self):
        stems = {p.stem for p in (SOURCE / "scenes").rglob("*.yaml")}
        for golden in GOLDEN.glob("*.png"):
            self.assertIn(golden.stem.rsplit("-t", 1)[0], stems)


if __name__ == "__main__":
    unittest.main()
