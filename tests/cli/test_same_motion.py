"""The same scene gives the same motion: in two runs, at other film rates, and in another build of the program.

The other build is named by CAROM_OTHER (scripts/test_long.sh compares Debug and Release); without it that part is skipped.
"""

import json
import os
import subprocess
import unittest

from program import SOURCE, ProgramTest, run

HARD = SOURCE / "scenes" / "hard"
# One of each kind of motion: bounces, chains, stepped stacks, curved contacts, balls that act on each other, many balls.
SCENES = ["h01_peaks", "h07_cradle", "h09_rack", "h11_groove", "h13_friction", "h17_stack", "h20_wall", "h28_slip_across", "h31_off_a_ball"]

POURED = """\
carom: 1
simulation: {duration: 0.8}
materials:
  clay: {restitution: 0.7, friction: 0.5}
surfaces:
  - {name: floor, box: {position: [0, 0, -0.05], size: [1, 1, 0.1]}, material: clay}
  - {name: left, plane: {normal: [1, 0, 0], offset: -0.25}, material: clay}
  - {name: right, plane: {normal: [-1, 0, 0], offset: -0.25}, material: clay}
  - {name: front, plane: {normal: [0, 1, 0], offset: -0.25}, material: clay}
  - {name: back, plane: {normal: [0, -1, 0], offset: -0.25}, material: clay}
balls:
  - {name: c, radius: 0.05, material: clay, position: [-0.18, -0.18, 0.1],
     repeat: {count: [4, 4, 4], spacing: 0.115, jitter: 0.002, seed: 1}}
"""


class SameMotionTest(ProgramTest):
    def stats(self, scene, program=None, *options):
        path = self.folder / "stats.json"
        arguments = ["simulate", str(scene), "-o", str(self.folder / "motion.csv"), "-y", "--stats", str(path), *options]
        if program is None:
            self.assert_exit(0, run(*arguments))
        else:
            subprocess.run([program, *arguments], capture_output=True, check=True, timeout=600)
        return json.loads(path.read_text())

    def scenes(self):
        return [HARD / f"{name}.yaml" for name in SCENES] + [SOURCE / "scenes" / "gallery" / "ball_on_ball.yaml"] + [self.write("poured.yaml", POURED)]

    def test_twice_and_at_another_rate(self):
        for scene in self.scenes():
            with self.subTest(scene=scene.name):
                first = self.stats(scene)
                self.assertRegex(first["motion_hash"], r"^[0-9a-f]{16}$")
                self.assertEqual(first["motion_hash"], self.stats(scene)["motion_hash"])
                self.assertEqual(first["motion_hash"], self.stats(scene, None, "--rate", "17")["motion_hash"])

    def test_another_motion_has_another_hash(self):
        scene = self.write("poured.yaml", POURED)
        hashes = {self.stats(scene, None, "--set", f"balls.c.position={p}")["motion_hash"]
                  for p in ("[-0.18, -0.18, 0.1]", "[-0.18, -0.18, 0.1000001]")}
        self.assertEqual(2, len(hashes))

    @unittest.skipUnless("CAROM_OTHER" in os.environ, "CAROM_OTHER names no other build")
    def test_another_build(self):
        for scene in self.scenes():
            with self.subTest(scene=scene.name):
                ours, theirs = self.stats(scene), self.stats(scene, os.environ["CAROM_OTHER"])
                self.assertEqual(ours["motion_hash"], theirs["motion_hash"])
                self.assertEqual(ours["impacts"], theirs["impacts"])


if __name__ == "__main__":
    unittest.main()
