"""carom still --strobe: several instants in one picture."""

import unittest

from program import SOURCE, ProgramTest, run


class Strobe(ProgramTest):
    def still(self, *arguments):
        picture = self.folder / "still.png"
        return picture, run("still", *arguments, "-o", picture, "-y")

    def bytes_of(self, *arguments):
        picture, result = self.still(*arguments)
        self.assert_exit(0, result)
        return picture.read_bytes()

    def test_instants_before_time_are_laid_over_one_another(self):
        plain = self.bytes_of(self.scene, "--time", 0.3)
        strobe = self.bytes_of(self.scene, "--time", 0.3, "--strobe", 0.1)
        self.assertNotEqual(plain, strobe)
        # No instant before: the picture itself.
        self.assertEqual(plain, self.bytes_of(self.scene, "--time", 0.3, "--strobe", 0.31))
        # 0.3 / 0.1 is a little less than 3; the start belongs to the picture all the same.
        self.assertEqual(strobe, self.bytes_of(self.scene, "--time", 0.3, "--strobe", 0.3 / 3))
        self.assertNotEqual(strobe, self.bytes_of(self.scene, "--time", 0.3, "--strobe", 0.11))

    def test_mistakes(self):
        for strobe, says in (("0", "above 0"), ("-1", "above 0"), ("inf", "above 0"), ("1e-9", "at most"), ("x", "--strobe")):
            _, result = self.still(self.scene, "--time", 0.3, "--strobe", strobe)
            self.assert_exit(2, result)
            self.assertIn(says, result.stderr)

    def test_the_official_test_is_judged(self):
        scene = SOURCE / "scenes" / "official" / "itf_tennis.yaml"
        picture, result = self.still(scene, "--time", 2.9, "--size", "320x180")
        self.assert_exit(0, result)
        self.assertIn("tennis passes (ITF type 2): rebound to its bottom 1.4", result.stderr)
        _, result = self.still(scene, "--time", 2.9, "--size", "320x180", "-q")
        self.assertEqual("", result.stderr)


if __name__ == "__main__":
    unittest.main()
