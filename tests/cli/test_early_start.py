"""Films that begin while their motion is still being computed: the same frames and numbers."""

import json
import pathlib
import re
import resource
import signal
import subprocess
import time
import unittest

from long_work import GAS, LongWork
from program import CAROM, ProgramTest, run

CAMERA = "camera: {from: [0, -5, 2], to: [0, 0, 1]}\n"


class EarlyStart(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene.write_text(GAS + CAMERA + "overlay: {clock: true, labels: true}\n")

    def stats(self, *words):
        path = self.folder / "stats.json"
        self.assert_exit(0, run(*words, "--stats", path, "-y"))
        return json.loads(path.read_text())

    def test_frames_and_numbers_are_those_of_the_whole_motion(self):
        words = ["--set", "simulation.duration=40", "--set", "film.fps=5"]
        filmed = self.stats("render", self.scene, "-o", self.folder / "f_%03d.png", *words)
        self.assertTrue(filmed["effects"]["early_start"]["on"])
        self.assertEqual(200, filmed["frames"])
        self.assertGreater(filmed["cpu_s"]["sim"], 0)
        whole = self.stats("simulate", self.scene, "-o", "/dev/null", *words)
        for key in ("motion_hash", "impacts", "steps", "balls"):
            self.assertEqual(whole[key], filmed[key])
        for k in (0, 1, 77, 199):
            still = self.folder / "still.png"
            self.assert_exit(0, run("still", self.scene, "--time", k / 5, "-o", still, "-y", *words))
            self.assert_exit(0, run("compare", still, self.folder / f"f_{k:03}.png", "--tolerance", 0, "--max-differing", 0))

    def test_what_is_let_go_changes_nothing(self):
        for words in (["--rate", 7], ["--rate", "30000/1001"]):
            rows = ["simulate", self.scene, "--set", "simulation.duration=60", "-y", *words]
            self.assert_exit(0, run(*rows, "-o", self.folder / "let_go.csv"))
            self.assert_exit(0, run(*rows, "-o", self.folder / "kept.csv", "--stats", self.folder / "s.json"))
            self.assertEqual((self.folder / "kept.csv").read_bytes(), (self.folder / "let_go.csv").read_bytes())
        frames = ["render", self.scene, "--set", "simulation.duration=60", "--set", "film.fps=2", "-y"]
        self.assert_exit(0, run(*frames, "-o", self.folder / "let_go"))
        self.assert_exit(0, run(*frames, "-o", self.folder / "kept", "--stats", self.folder / "s.json"))
        names = sorted(path.name for path in (self.folder / "kept").iterdir())
        self.assertEqual(120, len(names))
        for name in names:
            self.assertEqual((self.folder / "kept" / name).read_bytes(), (self.folder / "let_go" / name).read_bytes())

    def test_memory_does_not_grow_with_the_length(self):
        def peak(duration, *words, pauses=0):
            """kB; while the reader pauses, the queue between simulation and writing or drawing fills up."""
            process = subprocess.Popen(
                [CAROM, words[0], str(self.scene), "--set", f"simulation.duration={duration}", "-y", "-q", *words[1:]],
                stdout=subprocess.PIPE)
            status = pathlib.Path(f"/proc/{process.pid}/status")
            greatest = 0
            while process.stdout.read(1 << 16):
                if pauses > 0:
                    pauses -= 1
                    time.sleep(0.3)
                high_water = re.search(r"VmHWM:\s+(\d+)", status.read_text())  # none once it has ended
                greatest = max(greatest, int(high_water[1]) if high_water else 0)
            process.stdout.close()
            self.assertEqual(0, process.wait())
            return greatest
        for words in (["simulate", "--rate", "1", "-o", "-"],
                      ["render", "--set", "film.fps=1/2", "--size", "64x64", "--format", "y4m", "-o", "-"]):
            short, long = peak(500, *words, pauses=6), peak(1500, *words, pauses=6)
            print(f"{words[0]}: {short} kB for 500 s, {long} kB for 1500 s")
            self.assertLess(long, 1.05 * short + 2000)
        # What is kept otherwise grows with it.
        short, long = (peak(duration, "simulate", "--rate", "1", "-o", "-", "--stats", str(self.folder / "s.json"))
                       for duration in (300, 1500))
        print(f"kept: {short} kB, {long} kB")
        self.assertGreater(long, 1.5 * short)

    def test_frames_come_long_before_the_motion_ends(self):
        process = subprocess.Popen([CAROM, "render", str(self.scene), "-o", "-", "--format", "y4m", "--size", "64x64", "-q"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        frame = 64 * 64 * 3 // 2
        self.assertEqual(50 * frame, len(process.stdout.read(50 * frame)))  # of two million frames
        process.stdout.close()
        self.assertEqual(0, process.wait(timeout=20), process.stderr.read())
        self.assertEqual(b"", process.stderr.read())
        process.stderr.close()

    def test_what_needs_the_end_is_said(self):
        for scene, text in ((GAS, "camera"), (GAS + CAMERA + "overlay: {trail: true}\n", "trails")):
            self.scene.write_text(scene)
            effect = self.stats("render", self.scene, "-o", self.folder / "f_%d.png", "--frames", "0-1", "--set",
                                "simulation.duration=1")["effects"]["early_start"]
            self.assertFalse(effect["on"])
            self.assertIn(text, effect["why"])

    def test_an_interrupt_keeps_the_playable_part(self):
        work = LongWork("render", self.scene, "-o", self.folder / "f.mp4", "--progress", "json", "--size", "64x64")
        while json.loads(work.process.stderr.readline())["done"] < 20:
            pass
        code, _, errors = work.end(signal.SIGINT)
        self.assertEqual(130, code, errors)
        self.assertRegex(errors, r"interrupted after \d+ of 20000000 frames")
        self.assertEqual(["f.partial.mp4"], self.names())

    def test_a_failure_of_the_encoder_stops_the_simulation_and_is_said_once(self):
        def little_room():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))
        result = run("render", self.scene, "-o", self.folder / "f.mkv", "-q", preexec_fn=little_room, timeout=100)
        self.assert_exit(4, result)
        self.assertEqual(1, len(re.findall("carom: ", result.stderr)), result.stderr)
        self.assertEqual([], self.names())


if __name__ == "__main__":
    unittest.main()
