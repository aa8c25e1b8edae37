"""Time stamps that containers can hold, plots that are whole, inputs without end, scenes of many parts."""

import fractions
import json
import random
import resource
import signal
import subprocess
import time
import unittest

from program import CAROM, SMALL_SCENE, ProgramTest, run


def stamps(path):
    """The packets' times in seconds, as fractions, in order."""
    found = json.loads(subprocess.run(
        ["ffprobe", "-v", "error", "-show_entries", "packet=pts:stream=time_base", "-of", "json", str(path)],
        capture_output=True, check=True).stdout)
    tick = fractions.Fraction(found["streams"][0]["time_base"])
    return sorted(packet["pts"] * tick for packet in found["packets"])


class TimeStamps(ProgramTest):
    def film(self, name, fps):
        path = self.folder / name
        result = run("render", self.scene, "-o", path, "--fps", fps, "--frames", "0-59", "--size", "32x32", "--quality",
                     "draft")
        return path, result

    def test_mp4_holds_each_rate_exactly(self):
        for rate in ("2000", "90000", "2997/125", "30000/1001", "240"):
            path, result = self.film(f"{rate.replace('/', '_')}.mp4", rate)
            if fractions.Fraction(rate) < 120:  # half a second has fewer frames
                self.assert_exit(2, result)
                result = run("render", self.scene, "-o", path, "--fps", rate, "--size", "32x32", "--quality", "draft")
            self.assert_exit(0, result)
            times = stamps(path)
            self.assertEqual([k / fractions.Fraction(rate) for k in range(len(times))], times)

    def test_matroska_has_one_frame_a_time_or_is_refused_before_work(self):
        path, result = self.film("a.mkv", 1000)
        self.assert_exit(0, result)
        self.assertEqual(60, len(set(stamps(path))))
        for rate in (1001, 2000):
            path, result = self.film("b.mkv", rate)
            self.assert_exit(2, result)
            self.assertIn(".mp4", result.stderr)
            self.assertFalse(path.exists())
        self.assert_exit(2, run("render", self.scene, "-o", "-", "--format", "mkv", "--fps", 2000))

    def test_matroska_goes_out_as_it_is_made(self):
        process = subprocess.Popen(
            [CAROM, "render", str(self.scene), "-o", "-", "--format", "mkv", "--fps", "1000", "--set",
             "simulation.duration=1000", "--size", "64x64", "--progress", "none"],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual(b"\x1a\x45\xdf\xa3", process.stdout.read(4))
        self.assertEqual(100_000, len(process.stdout.read(100_000)))
        self.assertIsNone(process.poll())  # of a million frames it has drawn some
        process.stdout.close()
        self.assertEqual(0, process.wait(timeout=20), process.stderr.read())
        process.stderr.close()

    def test_matroska_through_a_pipe_is_the_film(self):
        path = self.folder / "p.mkv"
        with path.open("wb") as file:
            subprocess.run([CAROM, "render", str(self.scene), "-o", "-", "--format", "mkv", "-q"], stdout=file,
                           check=True)
        other = self.folder / "f.mkv"
        self.assert_exit(0, run("render", self.scene, "-o", other))
        self.assert_exit(0, run("compare", path, other, "--tolerance", 0, "--max-differing", 0))


class Plots(ProgramTest):
    def test_a_plot_that_is_not_whole_is_noticed(self):
        def little_room():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
        for extension in ("svg", "png", "pdf"):
            path = self.folder / f"line.{extension}"
            result = run("fit", "--drop", 1.8, "--rebound", 1.2, "--rebound", 1.3, "-o", path, preexec_fn=little_room)
            self.assert_exit(4, result)
            self.assertFalse(path.exists())
            self.assert_exit(0, run("fit", "--drop", 1.8, "--rebound", 1.2, "--rebound", 1.3, "-o", path))
            self.assertGreater(path.stat().st_size, 4096)


class WithoutEnd(ProgramTest):
    def test_measurements_without_end_are_refused_in_little_memory(self):
        def little_memory():
            resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))
        for text in ("tr '\\0' x < /dev/zero", "echo 'interval [s]'; yes 1"):
            feeder = subprocess.Popen(["sh", "-c", text], stdout=subprocess.PIPE)
            result = run("fit", "--csv", "/dev/stdin", stdin=feeder.stdout, timeout=30, preexec_fn=little_memory)
            feeder.stdout.close()
            feeder.wait(timeout=10)
            self.assert_exit(2, result)
            self.assertIn("more than", result.stderr)

    def test_many_materials_and_pairs_are_checked_in_a_moment(self):
        count = 2000
        materials = "\n".join(f"  m{i}: {{restitution: 0.5{', friction: 0.3' if i % 2 else ''}}}" for i in range(count))
        pairs = "\n".join(f"  - {{between: [m{i}, m{j}], restitution: 0.3}}"
                          for i in range(count) for j in range(i + 1, min(count, i + 11)))
        balls = "\n".join(f"  - {{name: b{i}, material: m{i}, radius: 0.1, position: [{i}, 0, 1]}}" for i in range(count))
        scene = self.write("many.yaml", f"carom: 1\nmaterials:\n{materials}\npairs:\n{pairs}\nballs:\n{balls}\n")
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        result = run("check", scene, timeout=30)
        spent = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        self.assert_exit(0, result)
        self.assertIn("and more", result.stderr)
        print(f"{spent:.2f} CPU s for {count} materials and {len(pairs.splitlines())} pairs (at most 2)")
        self.assertLess(spent, 2)


EVERYTHING = """\
title: a ball and another one
overlay: {ruler: true, clock: true, trail: true, labels: true, title: true, caption: with everything, peaks: true,
          velocity: true, plot: true}
"""


class SmallPictures(ProgramTest):
    def test_what_has_no_room_is_left_out(self):
        scene = self.write("full.yaml", SMALL_SCENE + EVERYTHING)
        stats = self.folder / "stats.json"
        other = ["--against-set", "balls.a.radius=0.11"]
        for size in ("16x16", "16x64", "64x16", "18x30", "48x48", "200x16"):
            for words in ([], other, other + ["--against-view", "side"]):
                picture = self.folder / f"{size}{len(words)}.png"
                result = run("still", scene, "--time", 0.4, "-o", picture, "--size", size, "--stats", stats, "-y",
                             *words)
                self.assert_exit(0, result)
                self.assertTrue(picture.exists())
                effects = json.loads(stats.read_text())["effects"]
                for name in ("plot",) if size == "48x48" else ("plot", "title"):
                    self.assertEqual({"on": False, "why": "the picture has no room for it"}, effects[name],
                                     (size, words))
        self.assert_exit(0, run("still", scene, "--time", 0.4, "-o", self.folder / "large.png", "--stats", stats,
                                "-y", "--size", "1280x720"))
        effects = json.loads(stats.read_text())["effects"]
        for name in ("title", "plot", "clock", "ruler", "caption"):
            self.assertTrue(effects[name]["on"], name)


class ManyThings(ProgramTest):
    """Generous times: what is linear takes a small part of them, what is not takes many times as long."""

    def still(self, text, seconds, *words, time=0):
        scene = self.write("many.yaml", "carom: 1\n" + text)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assert_exit(0, run("still", scene, "--time", time, "-o", self.folder / "many.png", "-y", *words))
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        print(f"{self.id().split('.')[-1]}: {spent:.2f} CPU s (at most {seconds})")
        self.assertLess(spent, seconds)

    def test_labels_of_thousands_of_balls(self):
        self.still("simulation: {duration: 0.1, gravity: [0, 0, 0]}\n"
                   "balls: [{name: a, radius: 0.1, position: [0, 0, 1], repeat: {count: [40, 20, 20], spacing: 0.3}}]\n"
                   "overlay: {labels: true}\n", 15)

    def test_thousands_of_planes(self):
        numbers = random.Random(1)
        planes = []
        for i in range(4000):
            normal = [numbers.gauss(0, 1) for _ in range(3)]
            offset = -(1 + 0.3 * numbers.random()) * sum(x * x for x in normal) ** 0.5
            planes.append(f"  - {{name: p{i}, plane: {{normal: {normal}, offset: {offset}}}}}")
        self.still("simulation: {duration: 0.1}\nsurfaces:\n" + "\n".join(planes)
                   + "\nballs: [{name: a, radius: 0.1, position: [0, 0, 0]}]\n", 20, "--size", "320x180")

    def test_a_ruler_beside_a_ball_far_up(self):
        for speed in ("0", "1e3", "1e9"):
            self.still("simulation: {duration: 1e7, gravity: [0, 0, 0]}\n"
                       f"balls: [{{name: a, radius: 0.1, position: [0, 0, 1e9], velocity: [0, 0, {speed}]}}]\n"
                       "camera: {from: [0, -6, 1e9], to: [0, 0, 1e9], follow: a}\noverlay: {ruler: true}\n", 5, "--size", "320x180", time=1e7)

    def test_a_plot_and_a_trail_of_very_many_hops(self):
        self.still("simulation: {duration: 2e5}\nsurfaces: [{name: floor, plane: {}}]\n"
                   "balls: [{name: a, radius: 0.1, position: [0, 0, 1.1]}]\n"
                   "overlay: {plot: true, trail: true, peaks: true}\n", 15, "--size", "320x180", time=2e5)


if __name__ == "__main__":
    unittest.main()
