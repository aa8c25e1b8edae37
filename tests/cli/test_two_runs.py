"""Two runs in one film, motion blur and transparent pictures, as users call them."""

import json
import pathlib
import subprocess
import unittest

from program import CAROM, ProgramTest, SMALL_SCENE, run

FIXED = ("--against-set", "simulation.method=fixed", "--against-set", "simulation.step=0.01")


def color_type(png):
    """PNG's colour type: 2 is RGB, 6 is RGB with alpha."""
    return pathlib.Path(png).read_bytes()[25]


class TwoRuns(ProgramTest):
    def frames(self, name, *options):
        folder = self.folder / name
        self.assert_exit(0, run("render", self.scene, "-o", folder, *options))
        return {p.name: p.read_bytes() for p in sorted(folder.iterdir())}

    def test_frames_are_those_of_the_first_scene_and_chunks_agree(self):
        whole = self.frames("whole", *FIXED)
        self.assertEqual(10, len(whole))
        longer = self.frames("longer", *FIXED, "--against-set", "simulation.duration=2")
        self.assertEqual(sorted(whole), sorted(longer))
        chunks = {}
        for i in (1, 2, 3):
            chunks.update(self.frames(f"chunk{i}", *FIXED, "--chunk", f"{i}/3"))
        self.assertEqual(whole, chunks)
        self.assertNotEqual(whole, self.frames("alone"))
        side = self.frames("side", *FIXED, "--against-view", "side")
        self.assertEqual(sorted(whole), sorted(side))
        self.assertNotEqual(whole, side)

    def test_stats_has_both_motions(self):
        stats = self.folder / "stats.json"
        self.assert_exit(0, run("still", self.scene, "--time", 0.4, "-o", self.folder / "a.png", "--stats", stats, *FIXED))
        both = json.loads(stats.read_text())
        hashes = {}
        for method in ("exact", "fixed"):
            alone = self.folder / f"{method}.json"
            options = ["--set", f"simulation.method={method}"]
            if method == "fixed":
                options += ["--set", "simulation.step=0.01"]
            self.assert_exit(0, run("simulate", self.scene, "-o", self.folder / f"{method}.csv", "--stats", alone, *options))
            hashes[method] = json.loads(alone.read_text())["motion_hash"]
        self.assertEqual(hashes["exact"], both["motion_hash"])
        self.assertEqual(hashes["fixed"], both["against"]["motion_hash"])
        self.assertEqual("ghost", both["against"]["view"])
        self.assertEqual({"simulation.method": ["exact", "fixed"], "simulation.step": ["\u2013", "0.01"]},
                         both["against"]["differences"])
        self.assertTrue(both["effects"]["against"]["on"])
        self.assertFalse(both["effects"]["motion_blur"]["on"])

    def test_another_file_from_the_command_line_and_from_the_scene(self):
        other = SMALL_SCENE.replace("restitution: 0.8", "restitution: 0.3")
        self.write("other.yaml", other)
        keyed = self.write("keyed.yaml", SMALL_SCENE + "against: {scene: other.yaml}\n")
        a, b = self.folder / "a.png", self.folder / "b.png"
        self.assert_exit(0, run("still", self.scene, "--time", 0.45, "-o", a, "--against", self.folder / "other.yaml"))
        self.assert_exit(0, run("still", keyed, "--time", 0.45, "-o", b))
        # The files tell the scenes apart, the pixels do not.
        self.assert_exit(0, run("compare", a, b, "--tolerance", 0, "--max-differing", 0))

    def test_a_scene_on_standard_input(self):
        result = subprocess.run([CAROM, "still", "-", "--time", "0.4", "-o", "-", *FIXED],
                                input=SMALL_SCENE.encode(), capture_output=True, timeout=60)
        self.assertEqual(0, result.returncode, result.stderr)
        self.assertTrue(result.stdout.startswith(b"\x89PNG"))

    def test_check_reads_the_other_run(self):
        wrong = self.write("wrong.yaml", SMALL_SCENE + "against: {set: [simulation.method=euler]}\n")
        result = run("check", wrong)
        self.assert_exit(3, result)
        self.assertIn("--set simulation.method", result.stderr)
        self.assert_exit(0, run("check", self.write("right.yaml", wrong.read_text().replace("euler", "fixed"))))

    def test_mistakes(self):
        strange = self.write("strange.yaml", SMALL_SCENE.replace("name: a", "name: b"))
        picture = self.folder / "a.png"
        still = ("still", self.scene, "--time", 0.1, "-o", picture)

        result = run(*still, "--against", strange)
        self.assert_exit(2, result)
        self.assertIn("a against b", result.stderr)
        result = run(*still, "--against-view", "side")
        self.assert_exit(2, result)
        self.assertIn("--against-set", result.stderr)
        result = run(*still, "--against-set", "simulation.method=euler")
        self.assert_exit(3, result)
        self.assertIn("euler", result.stderr)
        result = run(*still, "--against-set", "surfaces.floor.plane.offset=-1")
        self.assert_exit(2, result)
        self.assertIn("side", result.stderr)
        result = run(*still, "--against-set", "surfaces.floor.plane.offset=-1", "--against-view", "side")
        self.assert_exit(0, result)
        result = run(*still, "--against-set", "film.fps=30", "-y")
        self.assert_exit(0, result)
        self.assertIn("both runs are the same", result.stderr)
        self.assert_exit(2, run(*still, "--against", self.folder / "missing.yaml", "-y"))


class Transparent(ProgramTest):
    def test_pngs_have_alpha_and_films_are_refused(self):
        clear = ("--set", "background=transparent")
        picture, opaque = self.folder / "a.png", self.folder / "b.png"
        self.assert_exit(0, run("still", self.scene, "--time", 0.1, "-o", picture, *clear))
        self.assert_exit(0, run("still", self.scene, "--time", 0.1, "-o", opaque))
        self.assertEqual((6, 2), (color_type(picture), color_type(opaque)))
        result = run("render", self.scene, "-o", self.folder / "film.mp4", *clear)
        self.assert_exit(2, result)
        self.assertIn("transparen", result.stderr)
        self.assertFalse((self.folder / "film.mp4").exists())
        self.assert_exit(0, run("render", self.scene, "-o", self.folder / "frames", "--frames", "0-1", *clear))
        self.assertEqual(6, color_type(self.folder / "frames" / "frame_00001.png"))

    def test_goldens_and_compare_see_alpha(self):
        scene = self.write("clear.yaml", SMALL_SCENE.replace("film: {", "film: {stills: [0.1], ") + "background: transparent\n")
        golden = self.folder / "golden"
        self.assert_exit(0, run("golden", "update", scene, "--dir", golden))
        self.assert_exit(0, run("golden", "check", scene, "--dir", golden))
        self.assert_exit(5, run("golden", "check", scene, "--dir", golden, "--set", "background=sky"))
        # Without a ball near, transparent black against opaque black: only alpha differs.
        kept = golden / "clear-t0.100000.png"
        other = self.folder / "other.png"
        self.assert_exit(0, run("still", scene, "--time", 0.3, "-o", other))
        self.assert_exit(5, run("compare", kept, other, "--diff", self.folder / "diff.png"))
        self.assertTrue((self.folder / "diff.png").exists())


class MotionBlur(ProgramTest):
    def test_a_still_is_the_films_picture_and_stats_say_so(self):
        blur = ("--set", "film.shutter_deg=360")
        stats = self.folder / "stats.json"
        self.assert_exit(0, run("render", self.scene, "-o", self.folder / "frames", "--stats", stats, *blur))
        effect = json.loads(stats.read_text())["effects"]["motion_blur"]
        self.assertTrue(effect["on"])
        still = self.folder / "still.png"
        self.assert_exit(0, run("still", self.scene, "--time", 0.25, "-o", still, *blur))
        frame = self.folder / "frames" / "frame_00005.png"
        self.assert_exit(0, run("compare", still, frame, "--tolerance", 0, "--max-differing", 0))
        sharp = self.folder / "sharp.png"
        self.assert_exit(0, run("still", self.scene, "--time", 0.25, "-o", sharp))
        self.assert_exit(5, run("compare", still, sharp))


if __name__ == "__main__":
    unittest.main()
