"""Every scene of the repository against its golden pictures (tests/golden, 320 x 180).

After a wanted change of the picture, look at what differs and run scripts/update_goldens.sh.
"""

import os
import pathlib
import unittest

from program import SOURCE, run

GOLDEN = SOURCE / "tests" / "golden"


class Goldens(unittest.TestCase):
    def test_every_scene(self):
        # scenes/hard is for numbers: bench/hard_cases holds those against closed forms.
        scenes = sorted(p for p in (SOURCE / "scenes").rglob("*.yaml") if p.parent.name != "hard")
        self.assertGreaterEqual(len(scenes), 8)
        differences = pathlib.Path(os.environ["CAROM"]).parent / "golden-differences"
        result = run("golden", "check", *scenes, "--dir", GOLDEN, "--size", "320x180", "--diffs", differences)
        self.assertEqual(0, result.returncode, result.stdout + result.stderr)

    def test_no_golden_without_a_scene(self):
        stems = {p.stem for p in (SOURCE / "scenes").rglob("*.yaml")}
        for golden in GOLDEN.glob("*.png"):
            self.assertIn(golden.stem.rsplit("-t", 1)[0], stems)


if __name__ == "__main__":
    unittest.main()
