"""Cameras that move and films that change their speed, from the command line."""

import unittest

from program import SOURCE, ProgramTest, run

GALLERY = SOURCE / "scenes" / "gallery"
SMALL = ("--size", "160x90", "-q")


class CameraAndTimeTest(ProgramTest):
    def assert_frame_is_still(self, scene, frame, time):
        frames, still = self.folder / "frame_%05d.png", self.folder / "still.png"
        self.assert_exit(0, run("render", scene, "--frames", frame, "-o", frames, "-y", *SMALL))
        self.assert_exit(0, run("still", scene, "--time", time, "-o", still, "-y", *SMALL))
        drawn = self.folder / f"frame_{frame:05d}.png"
        self.assertEqual(drawn.read_bytes(), still.read_bytes())

    def test_a_frame_of_a_moving_camera_is_the_still_of_its_instant(self):
        for scene in ("follow", "camera_path"):
            self.assert_frame_is_still(GALLERY / f"{scene}.yaml", 90, 1.5)

    def test_a_ramp_stretches_the_film(self):
        # 0.4 s as in life, two ramps of ln(20) / 0.95 s per second of motion, and 0.13 s at 1/20:
        # 0.4 + 0.32 ln(20) / 0.95 + 2.6 + 0.75 = 4.7591 s, 286 frames.
        result = run("render", GALLERY / "slow_motion.yaml", "-o", self.folder / "f.mp4", "--dry-run")
        self.assert_exit(0, result)
        self.assertIn("286 frames", result.stdout)

    def test_a_frame_of_a_ramp_shows_the_instant_of_the_closed_form(self):
        # Speed 1 + 2 t from 0 on: t = (exp(2 s) - 1) / 2, which is 0.25 at s = ln(1.5) / 2.
        scene = self.write("ramp.yaml", self.scene.read_text().replace(
            "fps: 20", "fps: 4.932606924, speed: [{time: 0, speed: 1}, {time: 0.5, speed: 2}]"))
        self.assert_frame_is_still(scene, 1, 0.25)


if __name__ == "__main__":
    unittest.main()
