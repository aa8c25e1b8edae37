"""Every kind of film, decoded again: frames, time stamps, transparency, colours, texts."""

import fractions
import resource
import signal
import subprocess
import unittest

import film_reading as reading
from program import CAROM, SMALL_SCENE, ProgramTest, run

WIDTH, HEIGHT, FRAMES = 160, 96, 8

# Colours of all kinds before a sky; without it they stand on nothing, with shadows.
SCENE = SMALL_SCENE.replace("size: [160, 90], fps: 20", f"size: [{WIDTH}, {HEIGHT}], fps: 20") + """\
title: Küche & <Ball>
looks:
  red: {color: "#c8102e", style: striped}
  blue: {color: "#1040ff"}
  green: {color: "#10c020"}
camera: {from: [0, -2.4, 0.6], to: [0, 0, 0.35]}
"""
BALLS = """\
  - {name: b, radius: 0.2, look: red, position: [0.5, 0, 0.5]}
  - {name: c, radius: 0.2, look: blue, position: [-0.5, 0, 0.4], velocity: [0, 0, 1]}
  - {name: d, radius: 0.15, look: green, position: [-0.9, 0.3, 0.6]}
"""
SCENE = SCENE.replace("film: {", BALLS + "film: {")

CODECS = {  # of each: extension, --codec (None: the first), name by ffprobe, lossless
    "mp4": ("mp4", None, "h264", False),
    "mp4 h265": ("mp4", "h265", "hevc", False),
    "mp4 av1": ("mp4", "av1", "av1", False),
    "mkv": ("mkv", None, "h264", False),
    "mkv ffv1": ("mkv", "ffv1", "ffv1", True),
    "mkv vp9": ("mkv", "vp9", "vp9", False),
    "mov": ("mov", None, "prores", False),
    "mov h264": ("mov", "h264", "h264", False),
    "webm": ("webm", None, "vp9", False),
    "webm av1": ("webm", "av1", "av1", False),
    "gif": ("gif", None, "gif", False),
    "apng": ("apng", None, "apng", True),
    "webp": ("webp", None, "webp", True),
    "y4m": ("y4m", None, "rawvideo", False),
    "raw": ("raw", None, "rawvideo", True),
}
WITH_ALPHA = ("mkv ffv1", "mkv vp9", "mov", "webm", "gif", "apng", "webp", "raw")


class FormatTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene.write_text(SCENE)

    def film(self, kind, *words, stem="film"):
        """The film and, by a pattern, the PNGs of the same drawing."""
        extension, codec, _, _ = CODECS[kind]
        path = self.folder / f"{stem}.{extension}"
        words = list(words) + (["--codec", codec] if codec else [])
        result = run("render", self.scene, "-o", path, "-o", self.folder / "png", "-y", "--frames", f"0-{FRAMES - 1}",
                     *words)
        self.assert_exit(0, result)
        self.assertEqual("", "".join(line for line in result.stderr.splitlines(True) if not line.startswith("carom:")))
        return path, self.folder / "png" / "frame_%05d.png"

    def samples(self, kind, path, alpha=False):
        extension, _, name, _ = CODECS[kind]
        if extension == "webp":
            return b"".join(reading.AnimatedWebp(path).rgba())
        if extension == "raw":
            pixels = "rgba" if alpha else "rgb24"
            return reading.rgba(path, ["-f", "rawvideo", "-video_size", f"{WIDTH}x{HEIGHT}", "-pixel_format", pixels])
        if extension == "y4m":  # it cannot name its matrix
            return reading.rgba(path, (), "scale=in_color_matrix=bt709")
        return reading.rgba(path, ["-c:v", "libvpx-vp9"] if name == "vp9" else [])


class DecodedAgain(FormatTest):
    def test_opaque(self):
        for kind, (extension, _, name, lossless) in CODECS.items():
            with self.subTest(kind=kind):
                path, pictures = self.film(kind)
                drawn, film = reading.rgba(pictures), self.samples(kind, path)
                self.assertEqual(FRAMES * WIDTH * HEIGHT * 4, len(film), "frames")
                d = reading.Difference(drawn, film, WIDTH, HEIGHT)
                self.assertGreater(d.blocks, 100)
                print(f"{kind}: mean {d.mean:.2f}, flat {d.flat:.2f}, largest {d.largest} of 255, "
                      f"{path.stat().st_size} bytes")
                self.assertEqual(0, d.alpha)
                self.assertLessEqual(d.mean, 0 if lossless else 4)
                self.assertLessEqual(d.flat, 0 if lossless else 4)
                if extension not in ("webp", "raw"):
                    (stream,) = reading.probe(path)["streams"]
                    self.assertEqual(name, stream["codec_name"])

    def test_transparent(self):
        for kind in WITH_ALPHA:
            lossless = CODECS[kind][3]
            with self.subTest(kind=kind):
                path, pictures = self.film(kind, "--set", "background=transparent")
                drawn, film = reading.rgba(pictures), self.samples(kind, path, alpha=True)
                self.assertEqual({0, 255}, {min(drawn[3::4]), max(drawn[3::4])})
                if kind == "gif":  # one bit: what is seen by half or more
                    self.assertEqual([255 if a >= 128 else 0 for a in drawn[3::4]], list(film[3::4]))
                    drawn = bytearray(drawn)
                    drawn[3::4] = film[3::4]
                    drawn = bytes(drawn)
                d = reading.Difference(drawn, film, WIDTH, HEIGHT)
                print(f"{kind}: alpha {d.alpha}, mean {d.mean:.2f}, flat {d.flat:.2f}, largest {d.largest} of 255")
                self.assertLessEqual(d.alpha, 0 if lossless else 1)
                self.assertLessEqual(d.mean, 0 if lossless else 4)
                self.assertLessEqual(d.flat, 0 if lossless else 4)

    def test_a_transparent_film_is_read_back_by_compare(self):
        for kind in ("mkv ffv1", "mkv vp9", "webm", "apng"):
            one, _ = self.film(kind, "--set", "background=transparent")
            two, _ = self.film("mkv ffv1", "--set", "background=transparent", stem="other")
            result = run("compare", one, two, "--json")
            self.assertIn(result.returncode, (0, 5), result.stderr)
            if CODECS[kind][3]:
                self.assert_exit(0, run("compare", one, two, "--tolerance", 0, "--max-differing", 0))

    def test_every_time_stamp(self):
        for kind, (extension, *_) in CODECS.items():
            if extension == "raw":
                continue
            rates = ("20", "25", "50") if extension == "gif" else ("20", "60", "30000/1001", "24")
            for rate in rates:
                with self.subTest(kind=kind, rate=rate):
                    path, _ = self.film(kind, "--fps", rate, "--set", "simulation.duration=1")
                    webp = reading.AnimatedWebp(path) if extension == "webp" else None
                    times = (webp.stamps() if webp else reading.apng_stamps(path) if extension == "apng"
                             else reading.stamps(path))
                    exact = [k / fractions.Fraction(rate) for k in range(FRAMES)]
                    if extension in ("mkv", "webm", "webp"):  # whole milliseconds, rounded once
                        exact = [fractions.Fraction(int(1000 * t + fractions.Fraction(1, 2)), 1000) for t in exact]
                    self.assertEqual(exact, times)

    def test_one_frame_and_two_are_films(self):
        for kind, (extension, codec, *_) in CODECS.items():
            for frames in (1, 2):
                with self.subTest(kind=kind, frames=frames):
                    path = self.folder / f"short.{extension}"
                    self.assert_exit(0, run("render", self.scene, "-o", path, "-y", "--frames", f"0-{frames - 1}",
                                            *(["--codec", codec] if codec else [])))
                    self.assertEqual(frames * WIDTH * HEIGHT * 4, len(self.samples(kind, path)))

    def test_two_runs_give_the_same_bytes(self):
        for kind in CODECS:
            with self.subTest(kind=kind):
                one, _ = self.film(kind)
                self.assertEqual(one.read_bytes(), self.film(kind, stem="again")[0].read_bytes())

    def test_a_gif_rounds_its_times_once(self):
        path, _ = self.film("gif", "--fps", "30")
        self.assertEqual([fractions.Fraction(int(100 * k / 30 + 0.5), 100) for k in range(FRAMES)], reading.stamps(path))

    def test_tags(self):
        for kind, (extension, _, name, _) in CODECS.items():
            if extension in ("webp", "raw", "y4m", "gif", "apng") or name == "ffv1":
                continue
            path, _ = self.film(kind)
            (stream,) = reading.probe(path)["streams"]
            tags = {key: stream.get(key) for key in ("color_space", "color_primaries", "color_transfer")}
            self.assertEqual({key: "bt709" for key in tags}, tags, kind)
            self.assertEqual("tv", stream.get("color_range", "tv"), kind)
            self.assertEqual("20/1", stream["r_frame_rate"], kind)

    def test_pixel_formats(self):
        for kind, pixels in (("mp4", "yuv444p"), ("mp4", "yuv420p10le"), ("mkv", "yuv444p10le"),
                             ("mp4 h265", "yuv420p10le"), ("mp4 av1", "yuv420p10le"), ("webm", "yuv444p"),
                             ("webm", "yuv420p10le"), ("mov", "yuva444p10le"), ("y4m", "yuv444p"),
                             ("y4m", "yuv420p10le")):
            with self.subTest(kind=kind, pixels=pixels):
                path, pictures = self.film(kind, "--pix-fmt", pixels)
                # FFmpeg's ProRes decoder gives the 12 bits that the format has, and alpha where it is.
                shown = reading.probe(path)["streams"][0]["pix_fmt"]
                self.assertEqual(pixels.replace("10le", ""), shown.replace("10le", "").replace("12le", ""))
                d = reading.Difference(reading.rgba(pictures), self.samples(kind, path), WIDTH, HEIGHT)
                print(f"{kind} {pixels}: mean {d.mean:.2f}, flat {d.flat:.2f}, largest {d.largest} of 255")
                self.assertLessEqual(max(d.mean, d.flat), 4)

    def test_qualities(self):
        for kind in CODECS:
            sizes = []
            for quality in ("draft", "medium", "high"):
                extension, codec, *_ = CODECS[kind]
                path = self.folder / f"q.{extension}"
                result = run("render", self.scene, "-o", path, "-y", "--quality", quality,
                             *(["--codec", codec] if codec else []))
                if extension in ("gif", "raw", "y4m") or codec == "ffv1":
                    self.assert_exit(2, result)
                    self.assertIn("--quality means nothing to", result.stderr)
                    continue
                self.assert_exit(0, result)
                sizes.append(path.stat().st_size)
            print(kind, sizes)
            if extension in ("apng", "webp"):  # the same pixels in fewer bytes
                self.assertGreater(sizes[0], sizes[2])
            elif sizes:
                self.assertLess(sizes[0], sizes[2])

    def test_title_and_fingerprint(self):
        prints = set()
        for kind, (extension, *_) in CODECS.items():
            if extension in ("raw", "y4m"):
                continue
            path, _ = self.film(kind)
            data = path.read_bytes()
            if extension in ("gif", "apng", "webp"):
                text = data.decode("latin-1").encode("latin-1").decode("utf-8", "ignore")
            else:
                tags = {key.lower(): value for key, value in reading.probe(path)["format"]["tags"].items()}
                self.assertEqual("Küche & <Ball>", tags["title"], kind)
                text = tags["comment"]
            self.assertRegex(text, r"carom \d+\.\d+\.\d+, scene [0-9a-f]{16}", kind)
            prints.add(text[text.index(", scene ") + 8:][:16])
        self.assertEqual(1, len(prints))
        self.scene.write_text("# the same scene\n" + SCENE.replace("fps: 20", "fps:  20"))
        self.assertIn(next(iter(prints)).encode(), self.film("apng")[0].read_bytes())
        self.assertNotIn(next(iter(prints)).encode(), self.film("apng", "--set", "balls.a.mass=2")[0].read_bytes())


class Refused(FormatTest):
    def refused(self, name, *words, code=2):
        result = run("render", self.scene, "-o", self.folder / name, *words)
        self.assert_exit(code, result)
        self.assertEqual([], self.names())
        return result.stderr

    def test_options_that_mean_nothing(self):
        for name, words, text in (
                ("a.gif", ["--crf", "20"], "--crf means nothing to GIF"),
                ("a.gif", ["--preset", "fast"], "--preset means nothing to GIF"),
                ("a.gif", ["--threads", "2"], "--threads means nothing to GIF"),
                ("a.mov", ["--crf", "20"], "--crf means nothing to ProRes 4444"),
                ("a.webp", ["--crf", "20"], "--crf means nothing to WebP"),
                ("a.mkv", ["--codec", "ffv1", "--preset", "fast"], "--preset means nothing to FFV1"),
                ("frames/", ["--crf", "20"], "--crf means nothing to PNG frames"),
                ("frames/", ["--codec", "h264"], "--codec means nothing to PNG frames"),
                ("a.mp4", ["--dpi", "300"], "--dpi is for PNG frames")):
            self.assertIn(text, self.refused(name, *words))

    def test_codecs_pixels_presets_and_numbers(self):
        for name, words, text in (
                ("a.mp4", ["--codec", "vp9"], "MP4 is not written with the codec 'vp9'; it has h264, h265, av1"),
                ("a.webm", ["--codec", "h264"], "it has vp9, av1"),
                ("a.mp4", ["--pix-fmt", "rgba"], "H.264 has no pixel format 'rgba'; it has yuv420p"),
                ("a.webm", ["--preset", "veryfast"], "VP9 has 8, 7"),
                ("a.mp4", ["--preset", "veryfats"], "did you mean 'veryfast'?"),
                ("a.webm", ["--crf", "64"], "crf 64 is not one of VP9's 1 (best) ... 63"),
                ("a.mp4", ["--crf", "52"], "crf 52 is not one of H.264's 1 (best) ... 51"),
                ("a.mp4", ["--codec", "av1", "--size", "62x64"], "AV1 has at least 64 pixels"),
                ("a.mp4", ["--crf", "0"], "ffv1")):
            self.assertIn(text, self.refused(name, *words))

    def test_transparency(self):
        clear = ["--set", "background=transparent"]
        text = self.refused("a.mp4", *clear)
        self.assertIn("H.264 has no transparency", text)
        for name in (".mov", ".webm", ".gif", ".apng", ".webp", ".mkv", "PNGs"):
            self.assertIn(name, text)
        self.assertIn("AV1 has no transparency", self.refused("a.webm", *clear, "--codec", "av1"))
        self.assertIn("yuv420p has no transparency", self.refused("a.webm", *clear, "--pix-fmt", "yuv420p"))

    def test_rates_that_a_container_cannot_hold(self):
        self.assertIn("--fps 50", self.refused("a.gif", "--fps", "60"))
        self.assertIn("--fps 90", self.refused("a.webp", "--fps", "100"))
        self.assertIn("--fps 1000", self.refused("a.webm", "--fps", "2000"))
        self.assertIn("65535", self.refused("a.apng", "--fps", "1000000/16667"))

    def test_names(self):
        text = self.refused("a.avi")
        for name in (".mp4", ".mkv", ".mov", ".webm", ".gif", ".apng", ".webp", ".y4m"):
            self.assertIn(name, text)


class Streams(FormatTest):
    def test_each_stream_is_the_film(self):
        for kind in ("mp4", "mkv", "mov", "webm", "gif", "apng", "webp", "y4m", "raw"):
            with self.subTest(kind=kind):
                extension = CODECS[kind][0]
                whole, _ = self.film(kind)
                stream = self.folder / f"stream.{extension}"
                with stream.open("wb") as out:
                    subprocess.run([CAROM, "render", str(self.scene), "-o", "-", "--format", extension, "--frames",
                                    f"0-{FRAMES - 1}", "-q"], stdout=out, check=True)
                self.assertEqual(self.samples(kind, whole), self.samples(kind, stream))
                if extension not in ("webp", "raw"):
                    self.assertEqual(reading.stamps(whole), reading.stamps(stream))
                if extension in ("y4m", "raw", "gif", "apng", "webp"):
                    self.assertEqual(whole.read_bytes(), stream.read_bytes())

    def test_an_mp4_comes_in_fragments(self):
        stream = subprocess.run([CAROM, "render", str(self.scene), "-o", "-", "--format", "mp4", "-q", "--set",
                                 "simulation.duration=3"], capture_output=True, check=True).stdout
        self.assertGreaterEqual(stream.count(b"moof"), 3)
        self.assertLess(stream.index(b"moov"), stream.index(b"moof"))

    def test_what_streams_goes_out_as_it_is_made_and_a_closed_pipe_ends_quietly(self):
        for extension in ("mp4", "mkv", "mov", "webm", "y4m", "raw", "png"):
            with self.subTest(extension=extension):
                process = subprocess.Popen(
                    [CAROM, "render", str(self.scene), "-o", "-", "--format", extension, "--fps", "1000", "--set",
                     "simulation.duration=100", "--size", "64x64", "--progress", "none"],
                    stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                self.assertEqual(20_000, len(process.stdout.read(20_000)))
                self.assertIsNone(process.poll())  # of 100,000 frames it has drawn some
                process.stdout.close()
                self.assertEqual(0, process.wait(timeout=60))
                self.assertEqual(b"", process.stderr.read())
                process.stderr.close()


class Limits(FormatTest):
    def test_a_disk_that_fills_leaves_nothing(self):
        def little_room():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (3000, 3000))
        for kind, (extension, codec, *_) in CODECS.items():
            with self.subTest(kind=kind):
                path = self.folder / f"film.{extension}"
                result = run("render", self.scene, "-o", path, *(["--codec", codec] if codec else []), "--size",
                             "640x360", preexec_fn=little_room)
                self.assert_exit(4, result)
                self.assertIn("File too large", result.stderr)
                self.assertEqual([], self.names())

    def test_what_nobody_can_mean(self):
        for words, text in ((["--fps", "1e12"], "film.fps"),
                            (["--set", "simulation.duration=1e7"], "--chunk"),
                            (["--set", "simulation.duration=2e6", "--size", "7680x4320"], "days")):
            result = run("render", self.scene, "-o", self.folder / "a.mp4", *words)
            self.assertIn(result.returncode, (2, 3), result.stderr)
            self.assertIn(text, result.stderr)
            self.assertEqual([], self.names())

    def test_more_than_the_disk_has(self):
        result = run("render", self.scene, "-o", self.folder / "a.y4m", "--size", "7680x4320", "--set",
                     "simulation.duration=5e4")
        self.assert_exit(4, result)
        self.assertRegex(result.stderr, r"1000000 frames of 7680x4320 take at least 50 TB, and the disk of .* has .*B free")

    def test_more_than_the_memory_has(self):
        def little_memory():
            resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))
        result = run("render", self.scene, "-o", self.folder / "png", "--size", "9998x9998", "--threads", "8",
                     preexec_fn=little_memory)
        self.assert_exit(2, result)
        self.assertRegex(result.stderr, r"about 11 GB of memory here, and 1\.1 GB are free")

    def test_the_plan_says_what_it_takes(self):
        result = run("render", self.scene, "-o", self.folder / "a.y4m", "--size", "1920x1080", "--dry-run")
        self.assert_exit(0, result)
        self.assertRegex(result.stdout, r"about 31 MB on disk, 58 MB of memory for pictures, 1 s on two cores")


if __name__ == "__main__":
    unittest.main()
