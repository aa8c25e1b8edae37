"""--time-limit: every command that simulates or draws ends, with exit code 1, and leaves nothing that is not whole."""

import json
import subprocess
import unittest

from long_work import GAS, RESTING
from program import CAROM, ProgramTest, run

LIMIT_S = 0.5


class TimeLimit(ProgramTest):
    def assert_ends(self, words, where, limit=LIMIT_S):
        """`where` says how far it got, if it has begun; the temporaries go. That it ends at all is the test: none of these would."""
        before = sorted(p for p in self.folder.rglob("*"))
        result = run(*words, "--time-limit", limit, timeout=60)
        self.assert_exit(1, result)
        self.assertRegex(result.stderr, rf"(?m)carom: ended by --time-limit {limit}({where})?")
        self.assertNotIn("interrupted", result.stderr)
        left = [p for p in self.folder.rglob("*") if p.is_file() and p not in before]
        return left

    def test_each_command_ends_and_leaves_nothing(self):
        gas = self.write("gas.yaml", GAS)
        resting = self.write("resting.yaml", RESTING)
        sweep = self.write("sweep.yaml", "base: gas.yaml\naxes: {balls.a.mass: [1, 2]}\n")
        out = self.folder / "out"
        out.mkdir()
        simulating = r" after \d+ of 1000000 s simulated"
        for words, where in (
                (["simulate", gas, "-o", out / "m.csv", "--stats", out / "s.json"], simulating),
                (["simulate", gas, "-o", out / "m.npz", "--set", "simulation.method=fixed"], simulating),
                (["simulate", resting, "-o", out / "r.csv"], r" after \d+ of 1000000 s written"),
                (["render", gas, "-o", out / "f.mp4", "--set", "film.speed=1e6"], simulating),
                (["still", gas, "--time", 1, "-o", out / "s.png"], simulating),
                (["report", gas, "-o", out / "r.html"], ""),
                (["sweep", sweep, "-o", out / "runs"], r" after \d+ of 2 runs"),
                (["golden", "update", gas, "--dir", out, "--time", 0.1], ""),
                (["golden", "check", gas, "--dir", out, "--time", 0.1], ""),
                (["accuracy", gas, "-o", out / "a"], " while measuring")):
            with self.subTest(words=words):
                self.assertEqual([], self.assert_ends(words, where))
        self.assertEqual([], self.assert_ends(["view", gas], ""))
        self.assertEqual([], self.assert_ends(["figures", "-o", out / "figures", "--only", "films"], "", 0.05))

    def test_of_a_film_nothing_is_kept_and_of_frames_those_that_are_whole(self):
        # Frames of a motion that is soon known.
        scene = self.write("slow.yaml", self.scene.read_text().replace("fps: 20", "fps: 1000, shutter_deg: 360"))
        drawing = ["--size", "1600x1600"]
        where = r" after [\d.]+ of [\d.]+ (frames|s simulated)"
        self.assertEqual([], self.assert_ends(["render", scene, "-o", self.folder / "f.mkv", *drawing], where, 2))
        frames = self.folder / "frames"
        left = self.assert_ends(["render", scene, "-o", frames, *drawing], where, 2)
        self.assertFalse([p for p in left if not p.name.startswith("frame_")], left)
        for path in left:
            self.assertTrue(path.read_bytes().endswith(b"IEND\xaeB`\x82"), path)

    def test_one_driver_call_or_one_write_is_left_where_it_is(self):
        still = ["still", self.scene, "--time", 0.5, "-o", self.folder / "s.png", "--strobe", 0.0005, "--size", "4000x4000"]
        self.assertEqual([], self.assert_ends(still, " while drawing"))
        process = subprocess.Popen([CAROM, "simulate", self.write("r.yaml", RESTING), "-o", "-", "--time-limit", "0.3"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual(1, process.wait(timeout=60))  # nobody reads
        self.assertIn(b"ended by --time-limit", process.communicate()[1])

    def test_a_limit_that_is_not_reached_changes_nothing(self):
        words = ["simulate", self.scene, "-o", "-", "--time-limit"]
        right = run(*words[:-1])
        for limit in ("60", "1e300"):
            result = run(*words, limit)
            self.assert_exit(0, result)
            self.assertEqual(right.stdout, result.stdout)
        # The last one counts, as of every option.
        self.assert_exit(0, run(*words, "0.000001", "--time-limit", "60"))

    def test_what_is_no_time_is_refused(self):
        for wrong in ("0", "-1", "soon", "nan"):
            self.assert_exit(2, run("simulate", self.scene, "-o", "-", "--time-limit", wrong))

    def test_every_command_that_simulates_or_draws_has_it(self):
        with_limit = {c["command"] for c in json.loads(run("help", "--json").stdout)
                      if any("--time-limit" in o["names"] for o in c["options"])}
        self.assertEqual({"render", "still", "simulate", "report", "view", "sweep", "golden check", "golden update",
                          "accuracy", "figures"}, with_limit)


if __name__ == "__main__":
    unittest.main()
