"""Time stamps that containers can hold, plots that are whole, inputs without end, scenes of many parts."""

import fractions
import json
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


if __name__ == "__main__":
    unittest.main()
