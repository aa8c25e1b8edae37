"""No output eats another one, the scene, or what stood there before; names that cannot be meant."""

import json
import os
import shutil
import signal
import stat
import subprocess
import unittest

from program import CAROM, ProgramTest, run


class Distinct(ProgramTest):
    def refused(self, *arguments):
        before = {p: p.read_bytes() for p in self.folder.rglob("*") if p.is_file()}
        result = run(*arguments)
        self.assert_exit(2, result)
        after = {p: p.read_bytes() for p in self.folder.rglob("*") if p.is_file()}
        self.assertEqual(before, after)
        return result.stderr

    def test_two_outputs_of_one_name(self):
        m, film, png = (self.folder / name for name in ("m.csv", "x.mp4", "p.png"))
        link, hard = self.folder / "link", self.folder / "hard"
        link.symlink_to(self.folder)
        for overwrite in ([], ["-y"]):
            text = self.refused("simulate", self.scene, "-o", m, "--events", m, *overwrite)
            self.assertIn("--events", text)
            self.refused("simulate", self.scene, "-o", m, "--stats", m, *overwrite)
            self.refused("simulate", self.scene, "-o", m, "--events", link / "m.csv", *overwrite)
            self.refused("simulate", self.scene, "-o", "-", "--events", "-", *overwrite)
            self.refused("render", self.scene, "-o", film, "--stats", film, *overwrite)
            self.refused("render", self.scene, "-o", film, "-o", self.folder / "." / "x.mp4", *overwrite)
            self.refused("render", self.scene, "-o", self.folder / "f", "-o", f"{self.folder}/f/", *overwrite)
            self.refused("render", self.scene, "-o", self.folder / "f", "-o", self.folder / "f/frame_%05d.png",
                         *overwrite)
            self.refused("render", self.scene, "-o", "-", "-o", "-", *overwrite)
            self.refused("still", self.scene, "--time", 0, "-o", png, "--stats", png, *overwrite)
        m.write_text("old")
        os.link(m, hard)
        self.refused("simulate", self.scene, "-o", m, "--events", hard, "-y")

    def test_an_output_over_what_is_read(self):
        other = self.write("other.yaml", self.scene.read_text().replace("0.6]}", "0.7]}"))
        png = shutil.copy(self.scene, self.folder / "scene.png")
        self.refused("simulate", self.scene, "-o", self.scene, "-y")
        self.refused("simulate", self.scene, "-o", "-", "--stats", self.scene, "-y")
        self.refused("render", self.scene, "-o", self.folder / "f", "--against", other, "--stats", other, "-y")
        self.refused("still", png, "--time", 0, "-o", png, "-y")
        csv = self.write("drops.svg", "drop [m],rebound [m]\n1,0.5\n")
        self.refused("fit", "--csv", csv, "-o", csv, "-y")

    def test_a_difference_over_what_is_compared(self):
        a, b = self.folder / "a.png", self.folder / "b.png"
        for path, t in ((a, 0), (b, 0.3)):
            self.assert_exit(0, run("still", self.scene, "--time", t, "-o", path))
        for path in (a, b):
            self.refused("compare", a, b, "--diff", path, "-y")

    def test_the_null_device_takes_everything(self):
        self.assert_exit(0, run("simulate", self.scene, "-o", "/dev/null", "--events", "/dev/null", "--stats",
                                "/dev/null"))

    def test_statistics_on_standard_output(self):
        result = run("simulate", self.scene, "-o", self.folder / "m.csv", "--stats", "-")
        self.assert_exit(0, result)
        self.assertEqual(1, json.loads(result.stdout)["impacts"])


class Kept(ProgramTest):
    def test_of_two_runs_at_once_the_later_fails(self):
        for name in ("m.csv", "x.mkv"):
            path = self.folder / name
            command = [CAROM, "simulate" if name == "m.csv" else "render", str(self.scene), "-o", str(path)]
            runs = [subprocess.Popen(command, stderr=subprocess.PIPE, text=True) for _ in range(3)]
            errors = [r.communicate(timeout=60)[1] for r in runs]
            self.assertEqual([0, 4, 4], sorted(r.returncode for r in runs), errors)
            self.assertEqual([name], [n for n in self.names() if n != "m.csv" or name == "m.csv"])

    def test_an_older_partial_film_is_kept(self):
        film = self.folder / "a.mkv"
        old = self.write("a.partial.mkv", "old")
        for arguments, kept in (([], "a.partial-2.mkv"), (["-y"], "a.partial.mkv")):
            process = subprocess.Popen(
                [CAROM, "render", str(self.scene), "-o", str(film), "--fps", "1000", "--set",
                 "simulation.duration=20000", "--progress", "json", *arguments], stderr=subprocess.PIPE, text=True)
            sign = {"stage": ""}
            while sign["stage"] != "film" or sign["done"] < 20:
                sign = json.loads(process.stderr.readline())
            process.send_signal(signal.SIGINT)
            _, errors = process.communicate(timeout=60)
            self.assertEqual(130, process.returncode, errors)
            self.assertIn(f"kept {self.folder / kept}", errors)
            self.assertTrue((self.folder / kept).read_bytes().startswith(b"\x1a\x45\xdf\xa3"))
            if not arguments:
                self.assertEqual("old", old.read_text())

    def test_the_mode_of_a_replaced_file_stays(self):
        for name, command in (("m.csv", ["simulate"]), ("s.png", ["still", "--time", "0"])):
            path = self.write(name, "old")
            for mode in (0o640, 0o600, 0o444):
                path.chmod(mode)
                self.assert_exit(0, run(command[0], self.scene, *command[1:], "-o", path, "-y"))
                self.assertEqual(mode, stat.S_IMODE(path.stat().st_mode))

    def test_names_as_long_as_the_disk_takes(self):
        for extension in (".mkv", ".csv"):
            path = self.folder / ("n" * (255 - len(extension)) + extension)
            self.assert_exit(0, run("simulate" if extension == ".csv" else "render", self.scene, "-o", path))
            self.assertTrue(path.exists())
        path = self.folder / ("m" * 251 + ".mp4")
        process = subprocess.Popen([CAROM, "render", str(self.scene), "-o", str(path), "--fps", "20000",
                                    "--size", "640x360", "--progress", "plain"], stderr=subprocess.PIPE, text=True)
        process.stderr.readline()
        process.send_signal(signal.SIGINT)
        self.assertEqual(130, process.wait(timeout=60), process.stderr.read())
        process.stderr.close()
        kept = [n for n in self.names() if n.endswith(".partial.mp4")]
        self.assertEqual(["m" * (255 - len(".partial.mp4")) + ".partial.mp4"], kept)


class Patterns(ProgramTest):
    def test_a_pattern_is_a_png_with_one_number(self):
        for pattern, right in (("f_%05d", "frame_%05d.png"), ("50%done", "%%"), ("f_%05d.jpg", ".png"),
                               ("f_%d_%d.png", "twice"), ("f_%5d.png", "%05d"), ("f_%s.png", "%05d"),
                               ("v1.2", "v1.2/"), ("%d/f.png", "folder")):
            result = run("render", self.scene, "-o", self.folder / pattern)
            self.assert_exit(2, result)
            self.assertIn(right, result.stderr)
        self.assertEqual([], self.names())

    def test_folders_with_dots_and_percent_signs(self):
        for name, folder in (("v1.2/", "v1.2"), ("50%%", "50%"), ("a%%b_%d.png", None)):
            self.assert_exit(0, run("render", self.scene, "-o", f"{self.folder}/{name}", "--frames", "0"))
            path = self.folder / folder / "frame_00000.png" if folder else self.folder / "a%b_0.png"
            self.assertTrue(path.exists(), path)


class Chunks(ProgramTest):
    def test_an_empty_chunk_says_so_and_writes_nothing(self):
        # 10 frames in 50 chunks: floor(10 * 5 / 50) = 1 is the first that is not empty.
        for duration in ("0.5", "rest"):
            arguments = ["render", self.scene, "-o", self.folder / "c.mp4", "--chunk", "1/50", "--set",
                         f"simulation.duration={duration}", "--set", "simulation.max_duration=0.5"]
            result = run(*arguments)
            self.assert_exit(0, result)
            self.assertIn("chunk 1/50 has no frames", result.stderr)
            dry = run(*arguments, "--dry-run")
            self.assert_exit(0, dry)
            self.assertIn("0 frames", dry.stdout)
            self.assertNotIn("-1", dry.stdout)
            self.assertEqual([], self.names())
        self.assert_exit(0, run("render", self.scene, "-o", self.folder / "c.mp4", "--chunk", "5/50"))
        self.assertEqual(["c.mp4"], self.names())


class Limits(ProgramTest):
    def test_what_cannot_be_meant_is_refused_at_once_with_numbers(self):
        long = ["--set", "simulation.duration=1e7", "--fps", "60"]
        for output in (self.folder / "f.mp4", self.folder / "frames"):
            result = run("render", self.scene, "-o", output, *long, "--dry-run", timeout=5)
            self.assert_exit(2, result)
            self.assertIn("6e+08 frames", result.stderr)
            self.assertIn("115.7 days", result.stderr)
            self.assertIn("--frames", result.stderr)
        result = run("simulate", self.scene, "-o", "-", *long[:2], "--rate", 100000, timeout=5)
        self.assert_exit(2, result)
        self.assertIn("1e+12 rows", result.stderr)

    def test_a_part_of_a_very_long_film_is_no_trouble(self):
        long = ["--set", "simulation.duration=1e6", "--set", "materials.rubber.restitution=0", "--fps", "60"]
        for part, count in ((["--frames", "0-2,59999999"], 4), (["--chunk", "7/10000000"], 6)):
            result = run("render", self.scene, "-o", self.folder / "frames", *long, *part, "--dry-run", timeout=5)
            self.assert_exit(0, result)
            self.assertIn(f"{count} frames", result.stdout)


if __name__ == "__main__":
    unittest.main()
