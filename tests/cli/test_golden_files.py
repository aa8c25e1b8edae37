"""carom golden: two stills never share a name, and a golden that cannot be read is one of many."""

import unittest

from program import SMALL_SCENE, ProgramTest, run


class GoldenFiles(ProgramTest):
    def setUp(self):
        super().setUp()
        self.goldens = self.folder / "G"
        self.times = ["--time", "0", "--time", "0.1", "--time", "0.2", "--time", "0.3"]
        self.base = [self.scene, "--dir", self.goldens, "--size", "32x18"]

    def golden(self, time):
        return self.goldens / f"scene-t{time:.6f}.png"

    def test_scenes_of_one_name_are_refused_with_both_paths(self):
        for name in ("a", "b"):
            (self.folder / name).mkdir()
            (self.folder / name / "x.yaml").write_text(SMALL_SCENE)
        paths = [self.folder / name / "x.yaml" for name in ("a", "b")]
        for action in ("update", "check"):
            result = run("golden", action, *paths, "--dir", self.goldens, "--time", 0)
            self.assert_exit(2, result)
            for path in paths:
                self.assertIn(str(path), result.stderr)
        self.assertFalse(self.goldens.exists())
        # One file under two names is no two scenes.
        self.assert_exit(0, run("golden", "update", paths[0], self.folder / "a" / ".." / "a" / "x.yaml",
                                "--dir", self.goldens, "--time", 0, "--size", "32x18"))

    def test_times_of_one_name_are_refused(self):
        result = run("golden", "update", *self.base, "--time", 0.1, "--time", 0.10000001)
        self.assert_exit(2, result)
        self.assertIn("0.10000001", result.stderr)
        stills = self.write("stills.yaml", SMALL_SCENE.replace("fps: 20", "fps: 20, stills: [0.1, 0.10000001]"))
        self.assert_exit(2, run("golden", "update", stills, "--dir", self.goldens))

    def test_unreadable_goldens_are_counted_and_made_anew(self):
        self.assert_exit(0, run("golden", "update", *self.base, *self.times))
        whole = self.golden(0.2).read_bytes()
        self.golden(0).write_text("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n")
        self.golden(0.1).write_bytes(b"")
        self.golden(0.2).write_bytes(whole[:len(whole) // 2])
        result = run("golden", "check", *self.base, *self.times)
        self.assert_exit(5, result)
        for time, words in ((0, "Git LFS"), (0.1, "unreadable"), (0.2, "unreadable")):
            line = next(l for l in result.stdout.splitlines() if str(self.golden(time)) in l)
            self.assertIn(words, line)
        self.assertIn(f"same: {self.golden(0.3)}", result.stdout)
        self.assertIn("1 same, 0 different, 0 missing, 3 unreadable", result.stdout)
        self.assert_exit(0, run("golden", "update", *self.base, *self.times))
        self.assertEqual(whole, self.golden(0.2).read_bytes())
        self.assert_exit(0, run("golden", "check", *self.base, *self.times))

    def test_a_file_in_place_of_a_folder_is_found_before_work(self):
        file = self.write("file", "mine")
        result = run("golden", "check", *self.base, *self.times, "--diffs", file)
        self.assert_exit(4, result)
        self.assertEqual("mine", file.read_text())
        self.assert_exit(4, run("golden", "update", self.scene, "--dir", file, "--time", 0))


if __name__ == "__main__":
    unittest.main()
