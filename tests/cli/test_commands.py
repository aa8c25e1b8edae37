"""The commands, their exit codes, and that output appears whole or not at all."""

import csv
import json
import signal
import subprocess
import unittest

from program import CAROM, SMALL_SCENE, ProgramTest, run


class ExitCodes(ProgramTest):
    def test_help_and_version(self):
        for option in ("--help", "--version"):
            result = run(option)
            self.assert_exit(0, result)
            self.assertIn("carom", result.stdout)

    def test_usage(self):
        self.assert_exit(2, run())
        self.assert_exit(2, run("render", self.scene))
        self.assert_exit(2, run("render", self.scene, "-o", self.folder / "a.mp4", "--no-such-option"))
        self.assert_exit(2, run("render", self.scene, "-o", self.folder / "a.xyz"))
        self.assert_exit(2, run("render", self.scene, "-o", self.folder / "a.png"))
        self.assert_exit(2, run("still", self.scene, "--time", 9, "-o", self.folder / "a.png"))
        self.assertEqual([], self.names())

    def test_a_misspelt_command_is_suggested(self):
        result = run("rendr", self.scene)
        self.assert_exit(2, result)
        self.assertIn("did you mean 'render'", result.stderr)

    def test_missing_scene(self):
        result = run("check", self.folder / "none.yaml")
        self.assert_exit(2, result)
        self.assertIn("none.yaml", result.stderr)

    def test_invalid_scene_names_every_mistake_and_its_place(self):
        bad = self.write("bad.yaml", "carom: 1\nballs:\n  - {name: a, radius: -1, positon: [0, 0, 1]}\n")
        for command in (["check", bad], ["still", bad, "--time", 0, "-o", self.folder / "a.png"],
                        ["simulate", bad, "-o", self.folder / "a.csv"],
                        ["render", bad, "-o", self.folder / "a.mp4"]):
            result = run(*command)
            self.assert_exit(3, result)
            self.assertRegex(result.stderr, r"bad\.yaml:3:\d+: error: ")
            self.assertIn("position", result.stderr)
            self.assertIn("radius", result.stderr)

    def test_output_that_exists_is_kept(self):
        kept = self.write("kept.csv", "mine\n")
        result = run("simulate", self.scene, "-o", kept)
        self.assert_exit(4, result)
        self.assertIn("-y", result.stderr)
        self.assertEqual("mine\n", kept.read_text())
        self.assert_exit(0, run("simulate", self.scene, "-o", kept, "-y"))
        self.assertTrue(kept.read_text().startswith("time,ball,"))

    def test_output_folder_that_does_not_exist(self):
        self.assert_exit(4, run("render", self.scene, "-o", self.folder / "none" / "a.mp4"))

    def test_a_reader_that_goes_is_no_error(self):
        process = subprocess.Popen([CAROM, "simulate", self.scene, "-o", "-", "--rate", "100000"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        process.stdout.read(10)
        process.stdout.close()
        self.assertEqual(0, process.wait(timeout=60), process.stderr.read())
        process.stderr.close()


class Libraries(ProgramTest):
    def test_drivers_and_codecs_are_loaded_only_when_needed(self):
        # The loader's own list: what is loaded before any command begins.
        result = run(env={"LD_TRACE_LOADED_OBJECTS": "1"})
        self.assertIn("libode", result.stdout)
        for library in ("libOSMesa", "libEGL", "libLLVM", "libavcodec", "libswscale", "libOpenEXR"):
            self.assertNotIn(library, result.stdout)


class Check(ProgramTest):
    def test_json(self):
        bad = self.write("bad.yaml", "carom: 1\nbals: []\n")
        result = run("check", "--json", self.scene, bad)
        self.assert_exit(3, result)
        good_result, bad_result = json.loads(result.stdout)
        self.assertTrue(good_result["valid"])
        self.assertFalse(bad_result["valid"])
        self.assertEqual(2, bad_result["diagnostics"][0]["line"])

    def test_standard_input(self):
        self.assert_exit(0, run("check", "-", input=SMALL_SCENE))


class Simulate(ProgramTest):
    def test_rows_and_events(self):
        motion, events = self.folder / "m.csv", self.folder / "e.csv"
        self.assert_exit(0, run("simulate", self.scene, "-o", motion, "--events", events, "--rate", 8))
        rows = list(csv.DictReader(motion.open()))
        self.assertEqual([0, 0.125, 0.25, 0.375, 0.5], [float(r["time"]) for r in rows])
        self.assertAlmostEqual(0.6 - 9.81 / 2 * 0.125**2, float(rows[1]["z"]), delta=2e-4)
        impacts = [r for r in csv.DictReader(events.open()) if r["kind"] == "impact"]
        self.assertEqual(1, len(impacts))
        self.assertAlmostEqual((2 * 0.5 / 9.81) ** 0.5, float(impacts[0]["time"]), delta=5e-4)
        self.assertAlmostEqual(0.8, float(impacts[0]["restitution"]), delta=1e-12)

    def test_two_runs_are_identical(self):
        for name in ("a", "b"):
            self.assert_exit(0, run("simulate", self.scene, "-o", self.folder / f"{name}.csv",
                                    "--events", self.folder / f"{name}_events.csv"))
        for suffix in ("", "_events"):
            a, b = (self.folder / f"{name}{suffix}.csv" for name in "ab")
            self.assertEqual(a.read_bytes(), b.read_bytes())

    def test_set_changes_the_scene(self):
        result = run("simulate", self.scene, "-o", "-", "--rate", 1, "--set", "balls.a.position=[0, 0, 5]")
        self.assert_exit(0, result)
        self.assertEqual("5", result.stdout.splitlines()[1].split(",")[4])
        result = run("check", self.scene, "--set", "balls.b.mass=1")
        self.assert_exit(3, result)
        self.assertIn("--set", result.stderr)

    def test_film_rate_changes_nothing_in_the_motion(self):
        hashes = set()
        for rate in ("20", "30000/1001"):
            stats = self.folder / "stats.json"
            self.assert_exit(0, run("simulate", self.scene, "-o", "-", "--rate", rate, "--stats", stats, "-y"))
            hashes.add(json.loads(stats.read_text())["motion_hash"])
        self.assertEqual(1, len(hashes))


class Render(ProgramTest):
    def test_several_outputs_from_one_run(self):
        film, stats = self.folder / "a.mp4", self.folder / "s.json"
        result = run("render", self.scene, "-o", film, "-o", self.folder / "f_%03d.png", "--stats", stats)
        self.assert_exit(0, result)
        self.assertEqual(["a.mp4"] + [f"f_{k:03}.png" for k in range(10)] + ["s.json"], self.names())
        numbers = json.loads(stats.read_text())
        self.assertEqual(10, numbers["frames"])
        self.assertEqual({"scene", "sim", "draw", "read", "convert", "encode", "write"}, set(numbers["cpu_s"]))
        self.assertFalse(numbers["effects"]["friction"]["on"])
        self.assertIn("llvmpipe", numbers["renderer"])

    def test_frame_numbers_are_absolute(self):
        self.assert_exit(0, run("render", self.scene, "-o", self.folder / "f_%02d.png", "--frames", "1,4-8:2"))
        self.assertEqual(["f_01.png", "f_04.png", "f_06.png", "f_08.png"], self.names())

    def test_chunks_are_the_whole(self):
        for i in (1, 2, 3):
            self.assert_exit(0, run("render", self.scene, "-o", self.folder / "f_%02d.png", "--chunk", f"{i}/3"))
        self.assertEqual([f"f_{k:02}.png" for k in range(10)], self.names())
        self.assert_exit(2, run("render", self.scene, "-o", self.folder / "g_%d.png", "--chunk", "0/3"))
        self.assert_exit(2, run("render", self.scene, "-o", self.folder / "g_%d.png", "--frames", "3-20"))

    def test_two_runs_give_identical_frames(self):
        for name in ("a", "b"):
            self.assert_exit(0, run("render", self.scene, "-o", self.folder / f"{name}_%d.png", "--frames", "0,5,9"))
        for k in (0, 5, 9):
            self.assertEqual((self.folder / f"a_{k}.png").read_bytes(), (self.folder / f"b_{k}.png").read_bytes())

    def test_dry_run_writes_nothing(self):
        result = run("render", self.scene, "-o", self.folder / "a.mp4", "--dry-run")
        self.assert_exit(0, result)
        self.assertIn("10 frames", result.stdout)
        self.assertEqual([], self.names())

    def test_standard_output(self):
        png = run("still", self.scene, "--time", 0.2, "-o", "-", text=False)
        self.assert_exit(0, png)
        self.assertTrue(png.stdout.startswith(b"\x89PNG"))
        film = run("render", self.scene, "-o", "-", "--format", "mkv", text=False)
        self.assert_exit(0, film)
        self.assertTrue(film.stdout.startswith(b"\x1a\x45\xdf\xa3"))

    def test_an_interrupt_keeps_the_playable_part(self):
        film = self.folder / "a.mp4"
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            process = subprocess.Popen(
                [CAROM, "render", str(self.scene), "-o", str(film), "--fps", "20000", "--progress", "plain",
                 "--size", "640x360"], stderr=subprocess.PIPE, text=True)
            process.stderr.readline()  # the first line of progress: frames are being drawn
            process.send_signal(number)
            _, errors = process.communicate(timeout=60)
            self.assertEqual(code, process.returncode, errors)
            self.assertRegex(errors, r"interrupted after \d+ of 10000 frames")
            # The second one does not take the first one's name.
            kept = "a.partial.mp4" if number == signal.SIGINT else "a.partial-2.mp4"
            self.assertIn(kept, self.names())
            self.assertNotIn("a.mp4", self.names())
            frames = subprocess.run(
                ["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames",
                 "-of", "csv=p=0", str(self.folder / kept)], capture_output=True, text=True)
            self.assertGreater(int(frames.stdout), 10)


class Compare(ProgramTest):
    def test_pictures(self):
        paths = [self.folder / f"{k}.png" for k in range(3)]
        for path, t in zip(paths, (0.1, 0.1, 0.4)):
            self.assert_exit(0, run("still", self.scene, "--time", t, "-o", path))
        self.assert_exit(0, run("compare", paths[0], paths[1]))
        difference = self.folder / "d.png"
        result = run("compare", paths[0], paths[2], "--json", "--diff", difference)
        self.assert_exit(5, result)
        self.assertGreater(json.loads(result.stdout)["largest"], 50)
        self.assertTrue(difference.exists())
        self.assert_exit(0, run("compare", paths[0], paths[2], "--tolerance", 255, "--max-differing", 1))

    def test_golden(self):
        goldens = self.folder / "goldens"
        base = [self.scene, "--dir", goldens, "--time", 0.1, "--time", 0.3]
        self.assert_exit(5, run("golden", "check", *base))
        self.assert_exit(0, run("golden", "update", *base))
        self.assertEqual(["scene-t0.100000.png", "scene-t0.300000.png"], sorted(p.name for p in goldens.iterdir()))
        self.assert_exit(0, run("golden", "check", *base))
        result = run("golden", "check", *base, "--set", "balls.a.radius=0.12")
        self.assert_exit(5, result)
        self.assertIn("llvmpipe", result.stdout)


if __name__ == "__main__":
    unittest.main()
