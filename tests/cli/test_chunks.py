"""Parts of a film: a batch system's chunks, frames that are drawn when they are missing, films that are joined."""

import json
import os
import random
import signal
import struct
import subprocess
import time
import unittest
import zlib

import film_reading as reading
from program import CAROM, ProgramTest, run

# Balls in every part of the picture, at a rate that no decimal holds.
SCENE = """\
carom: 1
title: Kugeln – zwei
simulation: {duration: 1.2}
materials: {rubber: {restitution: 0.9, friction: 0.4}}
looks: {red: {color: "#c8102e", style: striped}}
surfaces: [{name: floor, plane: {normal: [0, 0, 1], offset: 0}, material: rubber}]
balls:
  - {name: a, radius: 0.1, material: rubber, look: red, position: [-0.4, 0, 0.6], velocity: [0.7, 0, 0], spin: [0, 9, 0]}
  - {name: b, radius: 0.15, material: rubber, position: [0.4, 0.1, 0.3], velocity: [-0.4, 0, 1]}
film: {size: [160, 90], fps: "30000/1001"}
"""
FRAMES = 36  # ceil(1.2 * 30000 / 1001)


class PartsTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene.write_text(SCENE)

    def render(self, name, *words, code=0, env=None):
        result = run("render", self.scene, "-o", self.folder / name, *words, env=env and {**os.environ, **env})
        self.assert_exit(code, result)
        return result


class Chunks(PartsTest):
    def frames(self, code=0, **variables):
        """The frames of `--chunk auto` under these variables, or the message."""
        clean = {k: v for k, v in os.environ.items() if not k.startswith(("SLURM_", "SGE_", "AWS_", "PBS_"))}
        result = run("render", self.scene, "-o", self.folder / "auto" / "%d.png", "--chunk", "auto", "--dry-run",
                     env={**clean, **variables})
        self.assert_exit(code, result)
        if code:
            return result.stderr
        line = result.stdout.splitlines()[1]
        return tuple(int(word) for word in line[line.index("frame ", 20) + 6:].split(" to "))

    def test_auto_is_the_formula(self):
        for n in (1, 4, 7):
            ends = [(i * FRAMES // n, (i + 1) * FRAMES // n - 1) for i in range(n)]
            for first in (0, 1, 3):
                self.assertEqual(ends, [self.frames(
                    SLURM_ARRAY_TASK_ID=str(first + i), SLURM_ARRAY_TASK_MIN=str(first),
                    SLURM_ARRAY_TASK_MAX=str(first + n - 1), SLURM_ARRAY_TASK_COUNT=str(n)) for i in range(n)])
            # Steps, as in --array=1-19:3: tasks 1, 4, 7 ...
            self.assertEqual(ends, [self.frames(
                SGE_TASK_ID=str(1 + 3 * i), SGE_TASK_FIRST="1", SGE_TASK_LAST=str(3 * n),
                SGE_TASK_STEPSIZE="3") for i in range(n)])
            self.assertEqual(ends, [self.frames(AWS_BATCH_JOB_ARRAY_INDEX=str(i), AWS_BATCH_JOB_ARRAY_SIZE=str(n))
                                    for i in range(n)])

    def test_auto_says_what_is_not_right(self):
        self.assertIn("--chunk 1/4", self.frames(2))
        self.assertIn("no task of an array", self.frames(2, SGE_TASK_ID="undefined"))
        self.assertIn("SLURM_ARRAY_TASK_MIN is not set", self.frames(2, SLURM_ARRAY_TASK_ID="1"))
        slurm = {"SLURM_ARRAY_TASK_ID": "5", "SLURM_ARRAY_TASK_MIN": "1", "SLURM_ARRAY_TASK_MAX": "9"}
        self.assertIn("'five' is no whole number", self.frames(2, **{**slurm, "SLURM_ARRAY_TASK_ID": "five"}))
        # --array=1,5,9: nobody says that 5 is the second of three.
        self.assertIn("gaps", self.frames(2, **slurm, SLURM_ARRAY_TASK_COUNT="3"))
        self.assertIn("not one of the array's 3 tasks",
                      self.frames(2, **{**slurm, "SLURM_ARRAY_TASK_ID": "6"}, SLURM_ARRAY_TASK_STEP="4",
                                  SLURM_ARRAY_TASK_COUNT="3"))
        self.assertIn("--chunk $PBS_ARRAY_INDEX/N", self.frames(2, PBS_ARRAY_INDEX="3"))

    def test_usage_errors_say_what_is_right(self):
        for words, text in ((["--chunk", "0/3"], "1/3 to 3/3"), (["--chunk", "4/3"], "1/3 to 3/3"),
                            (["--chunk", "2"], "expected I/N, e.g. 1/4"), (["--chunk", "1/0"], "1/1"),
                            (["--chunk", "a/3"], "--chunk 1/4"), (["--frames", "x"], "0-9,20-40:2,100-"),
                            (["--frames", "9-3"], "3-9 is right"), (["--frames", "30-99"], "frames 0 to 35")):
            self.assertIn(text, self.render("%d.png", *words, code=2).stderr)


def with_text(data, keyword, text):
    """A PNG with another text under a keyword, its checksum right."""
    at = 8
    while at < len(data):
        size, name = struct.unpack_from(">I4s", data, at)
        if name == b"tEXt" and data[at + 8:].startswith(keyword + b"\0"):
            body = name + keyword + b"\0" + text
            chunk = struct.pack(">I", len(body) - 4) + body + struct.pack(">I", zlib.crc32(body))
            return data[:at] + chunk + data[at + 12 + size:]
        at += 12 + size
    raise AssertionError(keyword)


class Resume(PartsTest):
    def bytes(self, name):
        return {path.name: path.read_bytes() for path in (self.folder / name).iterdir()}

    def resumed(self, name, *words, drawn):
        """Resumes; so many frames were drawn, and afterwards all are as they would be in one go."""
        before = {path.name: path.stat().st_mtime_ns for path in (self.folder / name).iterdir()}
        stats = self.folder / "stats.json"
        self.render(name, "--resume", "--stats", stats, "-y", *words)
        numbers = json.loads(stats.read_text())
        self.assertEqual((drawn, FRAMES - drawn), (numbers["frames"], numbers.get("frames_kept", 0)))
        after = {path.name: path.stat().st_mtime_ns for path in (self.folder / name).iterdir()}
        self.assertEqual(drawn, sum(before.get(k) != after[k] for k in after))
        self.render("fresh", *words, "-y")
        self.assertEqual(self.bytes("fresh"), self.bytes(name))

    def test_only_what_is_missing_or_not_whole_is_drawn(self):
        self.render("out")
        self.resumed("out", drawn=0)
        self.assertIn("all 36 frames are there", self.render("out", "--resume").stderr)
        frame = [self.folder / "out" / f"frame_{k:05}.png" for k in range(FRAMES)]
        whole = [path.read_bytes() for path in frame]
        frame[0].unlink()
        frame[3].write_bytes(whole[3][:-1])
        frame[4].write_bytes(whole[4][:len(whole[4]) // 2])
        frame[5].write_bytes(b"")
        frame[6].write_bytes(whole[6] + b"x")
        middle = len(whole[7]) // 2
        frame[7].write_bytes(whole[7][:middle] + bytes([whole[7][middle] ^ 1]) + whole[7][middle + 1:])
        frame[8].write_bytes(whole[9])  # another instant
        frame[10].write_text("no PNG")
        frame[11].write_bytes(with_text(whole[11], b"Software", b"carom 0.0.9"))
        frame[12].write_bytes(with_text(whole[12], b"Scene", b"0123456789abcdef"))
        self.resumed("out", drawn=10)

    def test_what_changes_the_picture_draws_all(self):
        self.render("out")
        self.resumed("out", "--set", "balls.a.spin=[0, 1, 0]", drawn=FRAMES)
        self.resumed("out", "--size", "80x46", drawn=FRAMES)
        self.resumed("out", "--dpi", 150, drawn=FRAMES)
        self.resumed("out", "--against-set", "materials.rubber.friction=0", drawn=FRAMES)
        self.resumed("out", "--against-set", "materials.rubber.friction=0.1", drawn=FRAMES)
        self.resumed("out", "--against-set", "materials.rubber.friction=0.1", "--against-view", "side", drawn=FRAMES)
        self.resumed("out", "--against-set", "materials.rubber.friction=0.1", "--against-view", "side", drawn=0)
        # Comments and blanks are not the scene.
        self.render("out", "-y")
        self.scene.write_text("# the same\n" + SCENE.replace("fps:", "fps:  "))
        self.resumed("out", drawn=0)

    def test_chunks_of_one_folder(self):
        self.render("out", "--chunk", "2/3")
        leftover = self.folder / "out" / ".frame_00003.tmp1.png"
        other = self.folder / "out" / ".frame_00030.tmp1.png"  # another chunk's: it may be at work
        leftover.touch(), other.touch()
        self.assertIn("12 frames in", self.render("out", "--chunk", "1/3", "--resume").stderr)
        self.assertFalse(leftover.exists())
        self.assertTrue(other.exists())
        self.resumed("out", drawn=12)

    def test_several_folders_get_what_one_of_them_lacks(self):
        self.render("a", "-o", self.folder / "b")
        (self.folder / "a" / "frame_00004.png").unlink()
        (self.folder / "b" / "frame_00005.png").unlink()
        result = self.render("a", "-o", self.folder / "b", "--resume")
        self.assertIn("2 frames in", result.stderr)
        self.assertIn("34 were there", result.stderr)
        self.assertEqual(self.bytes("a"), self.bytes("b"))

    def test_a_film_with_it_is_wrong_usage(self):
        for words in (["film.mp4"], ["out", "-o", self.folder / "film.mkv"]):
            result = self.render(*words, "--resume", code=2)
            self.assertIn("carom join", result.stderr)
        self.assert_exit(2, run("render", self.scene, "-o", "-", "--format", "png", "--resume"))
        result = self.render("out", "--layers", "depth", "--resume", code=2)
        self.assertIn("layers", result.stderr)
        self.assertEqual([], self.names())

    def test_killed_and_resumed_is_unbroken(self):
        kills = int(os.environ.get("CAROM_KILLS", "6"))
        words = ["--size", "320x180", "--fps", "120"]
        start = time.monotonic()
        self.render("whole", *words)
        took = time.monotonic() - start
        instants = random.Random(17)
        killed, counts = 0, [0]
        (self.folder / "out").mkdir()
        while killed < kills:
            # Not to the end: then there would be nothing left to kill.
            process = subprocess.Popen([CAROM, "render", str(self.scene), "-o", str(self.folder / "out"), "--resume", "-q",
                                        *words], stderr=subprocess.DEVNULL)
            try:
                process.wait(instants.uniform(0.3, 1.0) * took)
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGKILL)
                process.wait()
                killed += 1
                counts.append(len(list((self.folder / "out").glob("frame_*.png"))))
            else:
                # It came to the end: some frames go, so that there is work again.
                self.assertEqual(0, process.returncode)
                for path in sorted((self.folder / "out").iterdir())[10:]:
                    path.unlink()
        print(f"killed {killed} times, with {counts} frames")
        self.assertGreater(max(counts), 0)
        self.render("out", *words, "--resume")
        whole = self.bytes("whole")
        self.assertEqual(144, len(whole))
        self.assertEqual(whole, self.bytes("out"))


# Extension, codec, further options; whether its frames are the same whatever stood before them.
FILMS = [
    ("mp4", "h264", [], False), ("mp4", "h265", [], False), ("mp4", "av1", [], False),
    ("mkv", "h264", ["--pix-fmt", "yuv444p10le"], False), ("mkv", "ffv1", [], True), ("mkv", "vp9", [], False),
    ("mov", "prores", ["--set", "background=transparent"], True), ("mov", "h265", [], False),
    ("webm", "vp9", ["--set", "background=transparent"], False), ("webm", "av1", [], False),
]


class Join(PartsTest):
    def part(self, name, chunk, *words):
        self.render(name, "--chunk", chunk, "-q", *words)
        return self.folder / name

    def joined(self, name, parts, *words, code=0):
        result = run("join", *parts, "-o", self.folder / name, *words)
        self.assert_exit(code, result)
        return result.stderr if code else self.folder / name

    def errors(self, path, before):
        """The decoded samples, and of each frame the mean difference from the one that was drawn, which no
        neighbour comes near."""
        samples = reading.rgba(path, before)
        drawn, film = (reading.over_black(data) for data in
                       (reading.rgba(self.folder / "png" / "frame_%05d.png", ["-framerate", "30"]), samples))
        self.assertEqual(len(drawn), len(film))
        size = len(drawn) // FRAMES

        def mean(j, k):
            a, b = drawn[j * size:(j + 1) * size:5], film[k * size:(k + 1) * size:5]
            return sum(abs(x - y) for x, y in zip(a, b)) / len(a)
        errors = [mean(k, k) for k in range(FRAMES)]
        for k in range(1, FRAMES):
            self.assertLess(errors[k], mean(k - 1, k))
            self.assertLess(errors[k - 1], mean(k, k - 1))
        return samples, errors

    def test_each_container_has_the_frames_of_one_go(self):
        for extension, codec, words, same in FILMS:
            with self.subTest(f"{extension} {codec}"):
                options = ["--codec", codec, *words]
                background = words if "--set" in words else []
                self.render("png", *background, "-y")
                whole = self.folder / f"{codec}.{extension}"
                self.render(whole.name, "-y", "-q", *options)
                parts = [self.part(f"{codec}_{i}.{extension}", f"{i}/3", "-y", *options) for i in (1, 2, 3)]
                film = self.joined(f"{codec}_joined.{extension}", [parts[2], parts[0], parts[1]], "-y")
                self.assertEqual(FRAMES, len(reading.stamps(film)))
                self.assertEqual(reading.stamps(whole), reading.stamps(film))
                # Everything else that the container says.
                said = []
                for path in (whole, film):
                    streams = reading.probe(path)
                    for part in (streams["streams"][0], streams["format"]):
                        for key in ("bit_rate", "size", "filename", "max_bit_rate"):
                            part.pop(key, None)
                    said.append(streams)
                self.assertEqual(*said)
                before = ["-c:v", "libvpx-vp9"] if codec == "vp9" else []
                pixels, errors = self.errors(film, before)
                whole_pixels, whole_errors = self.errors(whole, before)
                print(f"{extension} {codec}: mean error {sum(errors) / FRAMES:.2f}, worst frame {max(errors):.2f}; "
                      f"in one go {sum(whole_errors) / FRAMES:.2f}, {max(whole_errors):.2f}")
                # A frame twice, or one for another, would be off by several times that.
                self.assertLess(max(errors), 1.3 * max(whole_errors) + 0.2)
                if same:
                    self.assertEqual(whole_pixels, pixels)

    def test_parts_of_one_frame_and_of_other_lengths(self):
        self.render("png")
        parts = [self.part(f"{k:02}.mp4", f"{k + 1}/{FRAMES}") for k in range(FRAMES)]
        film = self.joined("ones.mp4", parts)
        _, errors = self.errors(film, [])
        self.assertLess(max(errors), 4)
        self.assertEqual(FRAMES, len(reading.stamps(film)))
        self.render("a.mkv", "--frames", "0-4", "-q")
        self.render("b.mkv", "--frames", "5-", "-q")
        film = self.joined("two.mkv", [self.folder / "a.mkv", self.folder / "b.mkv"])
        self.render("c.mkv", "-q")
        self.assertEqual(reading.stamps(self.folder / "c.mkv"), reading.stamps(film))

    def test_the_decoder_has_nothing_to_complain_about(self):
        parts = [self.part(f"{i}.mp4", f"{i}/4") for i in (1, 2, 3, 4)]
        film = self.joined("film.mp4", parts)
        result = subprocess.run(["ffmpeg", "-v", "warning", "-xerror", "-err_detect", "explode", "-i", str(film), "-f", "null",
                                 "-"], capture_output=True, text=True)
        self.assertEqual((0, ""), (result.returncode, result.stderr))
        data = film.read_bytes()
        self.assertLess(data.index(b"moov"), data.index(b"mdat"))
        # A jump to a seam, and into a part, shows the frame of that time.
        self.render("png", "-q")
        for k in (9, 18, 20, 35):
            shown = reading.ffmpeg("-ss", f"{k * 1001 / 30000 - 0.001:.6f}", "-i", film, "-frames:v", "1", "-f", "rawvideo",
                                   "-pix_fmt", "rgba", "-sws_flags", reading.EXACT, "-")
            near = []
            for j in range(FRAMES):
                drawn = reading.rgba(self.folder / "png" / f"frame_{j:05}.png")
                near.append(sum(abs(x - y) for x, y in zip(drawn[::7], shown[::7])))
            self.assertEqual(k, near.index(min(near)))

    def test_what_does_not_belong_together(self):
        one, two, three = (self.part(f"{i}.mp4", f"{i}/3") for i in (1, 2, 3))
        other = {
            "scene": self.part("scene.mp4", "2/3", "--set", "balls.a.mass=2"),
            "size": self.part("size.mp4", "2/3", "--size", "80x46"),
            "settings": self.part("settings.mp4", "2/3", "--crf", "30"),
            "against": self.part("against.mp4", "2/3", "--against-set", "balls.a.spin=[0, 1, 0]"),
            "chunks": self.part("chunks.mp4", "2/4"),
            "container": self.part("container.mkv", "2/3"),
        }
        self.render("all.mp4", "-q")
        self.render("some.mp4", "-q", "--frames", "0-9:3")
        for parts, text in (
                ([one, three], "frames 12 to 23 of the film's 36 are in none"),
                ([one, two], "frames 24 to 35"), ([two, three], "frames 0 to 11"), ([one], "frames 12 to 35"),
                ([one, two, two, three], "hold the same frames"), ([one, other["chunks"], three], "hold the same frames"),
                ([one, other["scene"], three], "different scenes"), ([one, other["size"], three], "160x90 and 80x46"),
                ([one, other["settings"], three], "h264 18 veryfast yuv420p and h264 30"),
                ([one, other["against"], three], "against"),
                ([one, other["container"], three], "container that they have"),
                ([self.folder / "all.mp4"], "no part"), ([one, self.folder / "some.mp4"], "4 frames of 36"),
                ([self.scene], "Invalid data"), ([one, self.folder / "none.mp4"], "none.mp4")):
            text_of = self.joined("film.mp4", parts, code=2)
            self.assertIn(text, text_of)
        self.assertIn(".mp4, .mkv, .mov, .webm", self.joined("film.gif", [one, two, three], code=2))
        self.joined("1.mp4", [one, two, three], "-y", code=2)
        self.joined("all.mp4", [one, two, three], code=4)
        self.assertFalse((self.folder / "film.mp4").exists())

    def test_a_part_that_is_not_whole(self):
        one, two = (self.part(f"{i}.mkv", f"{i}/2") for i in (1, 2))
        whole = two.read_bytes()
        two.write_bytes(whole[:len(whole) * 2 // 3])
        self.assertIn("of these 18 frames", self.joined("film.mkv", [one, two], code=2))
        self.assertEqual(["1.mkv", "2.mkv"], self.names())


if __name__ == "__main__":
    unittest.main()
