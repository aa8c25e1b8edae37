"""film.sound: the impacts in the film's own track, decoded again and held against the WAV file."""

import array
import subprocess
import unittest
import wave

from film_reading import probe
from program import SMALL_SCENE, ProgramTest, run

RATE = 48000
# Impacts at 0.319, 0.83, 1.238, 1.565, 1.827 s.
SCENE = SMALL_SCENE.replace("duration: 0.5", "duration: 2").replace("fps: 20", "fps: 25, sound: true")
CODECS = {"mp4": "aac", "mov": "aac", "mkv": "opus", "webm": "opus"}


def decoded(path, start=0.0):
    """The film's sound on the clock of its pictures: by the time stamps, from where the pictures begin."""
    words = ["ffmpeg", "-v", "error", "-copyts", "-i", str(path), "-map", "0:a", "-af",
             f"aresample=async=1:first_pts={round(start * RATE)}", "-f", "s16le", "-ac", "1", "-ar", str(RATE), "-"]
    samples = array.array("h")
    samples.frombytes(subprocess.run(words, stdout=subprocess.PIPE, check=True).stdout)
    return samples


def lag(wanted, found, at, most=200, length=1500):
    """By how many samples `found` is later than `wanted` around the sample `at`: the lag of the largest
    cross-correlation, and this correlation over the root of both energies."""
    a = wanted[at - 100:at + length]

    def product(shift):
        b = found[at - 100 + shift:at + length + shift]
        return sum(x * y for x, y in zip(a, b))

    best = max(range(-most, most + 1), key=product)
    b = found[at - 100 + best:at + length + best]
    energy = sum(x * x for x in a) * sum(y * y for y in b)
    return best, product(best) / max(energy, 1) ** 0.5


class FilmSound(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene.write_text(SCENE)

    def wav(self, *words):
        path = self.folder / "wanted.wav"
        self.assert_exit(0, run("render", self.scene, "-o", path, "-q", "-y", *words))
        with wave.open(str(path)) as sound:
            return array.array("h", sound.readframes(sound.getnframes()))

    def film(self, name, *words):
        path = self.folder / name
        self.assert_exit(0, run("render", self.scene, "-o", path, "-q", "-y", *words))
        return path

    def assert_in_place(self, wanted, found, impacts, first=0):
        """Within 1 ms of each impact [samples of the WAV], of a film that begins at the sample `first`."""
        self.assertGreater(len(impacts), 0)
        for at in impacts:
            late, alike = lag(wanted[first:], found, at - first)
            self.assertLessEqual(abs(late), RATE // 1000, f"the impact at sample {at}")
            self.assertGreater(alike, 0.9, f"the impact at sample {at}")

    def impacts(self, wanted, least=3000):
        """Where the clicks of the WAV begin."""
        found, quiet = [], RATE
        for i, sample in enumerate(wanted):
            if abs(sample) > least and quiet > RATE // 10:
                found.append(i)
            quiet = 0 if abs(sample) > least else quiet + 1
        return found

    def test_each_container_has_the_impacts_in_place(self):
        wanted = self.wav()
        impacts = self.impacts(wanted)[:4]
        self.assertEqual(4, len(impacts))
        for extension, codec in CODECS.items():
            with self.subTest(extension):
                film = self.film(f"film.{extension}")
                streams = probe(film)["streams"]
                self.assertEqual(["video", "audio"], [s["codec_type"] for s in streams])
                self.assertEqual(codec, streams[1]["codec_name"])
                self.assertEqual((1, str(RATE)), (streams[1]["channels"], streams[1]["sample_rate"]))
                self.assertEqual(0, float(streams[0]["start_time"]))
                self.assert_in_place(wanted, decoded(film), impacts)

    def test_exact_containers_are_as_long_as_the_film(self):
        for stream in probe(self.film("film.mp4"))["streams"]:
            self.assertAlmostEqual(2.0, float(stream["duration"]), delta=1e-4)
            self.assertAlmostEqual(0.0, float(stream["start_time"]), delta=1e-9)

    def test_a_packet_of_sound_beyond_many_short_frames_ends_with_them(self):
        words = ["--fps", "1000", "--frames", "0-499"]
        for stream in probe(self.film("film.mp4", *words))["streams"]:
            self.assertAlmostEqual(0.5, float(stream["duration"]), delta=1e-4)

    def test_slow_motion_that_starts_later(self):
        words = ["--set", "film.speed=0.5", "--set", "film.start=0.4"]
        wanted = self.wav(*words)
        impacts = self.impacts(wanted)
        self.assertAlmostEqual(2 * (0.8293 - 0.4), impacts[0] / RATE, delta=0.01)
        self.assert_in_place(wanted, decoded(self.film("film.mp4", *words)), impacts[:2])

    def test_streams(self):
        wanted = self.wav()
        for form in ("mkv", "mp4"):
            with self.subTest(form):
                result = run("render", self.scene, "-o", "-", "--format", form, "-q", text=False)
                self.assert_exit(0, result)
                path = self.folder / f"stream.{form}"
                path.write_bytes(result.stdout)
                self.assert_in_place(wanted, decoded(path), self.impacts(wanted)[:2])

    def test_chunks_and_frames_have_their_part(self):
        wanted = self.wav()
        for extension in CODECS:
            film = self.film(f"part.{extension}", "--frames", "17-40")
            first = round(17 / 25 * RATE)
            with self.subTest(extension):
                inside = [i for i in self.impacts(wanted) if 17 / 25 * RATE < i < 40 / 25 * RATE - 2000]
                self.assert_in_place(wanted, decoded(film), inside, first)

    def test_joined_parts_have_the_sound_of_the_whole(self):
        wanted = self.wav()
        for extension in CODECS:
            with self.subTest(extension):
                whole = self.film(f"whole.{extension}")
                parts = [self.film(f"part{i}.{extension}", "--chunk", f"{i}/3") for i in (1, 2, 3)]
                joined = self.folder / f"joined.{extension}"
                self.assert_exit(0, run("join", *parts, "-o", joined, "-q"))
                self.assertEqual(decoded(whole), decoded(joined))
                self.assert_in_place(wanted, decoded(joined), self.impacts(wanted)[:4])

    def test_a_part_with_sound_and_one_without_are_not_joined(self):
        one = self.film("one.mp4", "--chunk", "1/2")
        two = self.film("two.mp4", "--chunk", "2/2", "--set", "film.sound=false")
        refused = run("join", one, two, "-o", self.folder / "joined.mp4")
        self.assert_exit(2, refused)
        self.assertIn("different scenes", refused.stderr)
        mute = self.folder / "mute.mp4"
        subprocess.run(["ffmpeg", "-v", "error", "-i", one, "-an", "-c", "copy", mute], check=True)
        other = self.film("other.mp4", "--chunk", "2/2")
        refused = run("join", mute, other, "-o", self.folder / "joined.mp4")
        self.assert_exit(2, refused)
        self.assertIn("its sound is missing", refused.stderr)

    def test_frames_with_gaps_bring_their_own_sound(self):
        wanted = self.wav()
        film = self.film("film.mkv", "--frames", "0-9,20-24")
        found = decoded(film)
        self.assertAlmostEqual(15 / 25 * RATE, len(found), delta=2100)
        # Frame 20 is shown at frame 10's time.
        shifted = wanted[:round(0.4 * RATE)] + wanted[round(0.8 * RATE):]
        self.assert_in_place(shifted, found, [i for i in self.impacts(shifted) if i < 0.55 * RATE])

    def test_without_the_key_nothing_is_heard_and_nothing_changes(self):
        silent = self.film("silent.mp4", "--set", "film.sound=false")
        self.assertEqual(["video"], [s["codec_type"] for s in probe(silent)["streams"]])

    def test_silent_outputs_are_named_or_refused(self):
        folder = self.folder / "frames"
        words = ["-o", folder, "-o", self.folder / "film.gif", "-o", self.folder / "film.mp4", "--frames", "0-3"]
        said = run("render", self.scene, *words)
        self.assert_exit(0, said)
        self.assertEqual(2, said.stderr.count("holds no sound"))
        quiet = run("render", self.scene, *words, "-y", "-q")
        self.assertEqual("", quiet.stderr)
        for name in ("film2.gif", "film2.apng", "film2.webp", "film2.y4m", "frames2/"):
            refused = run("render", self.scene, "-o", self.folder / name, "--sound")
            self.assert_exit(2, refused)
            self.assertIn("--sound", refused.stderr)
            self.assertFalse((self.folder / name).exists())

    def test_the_option_does_what_the_key_does(self):
        self.scene.write_text(SCENE.replace(", sound: true", ""))
        film = self.film("film.mp4", "--sound", "--frames", "0-3")
        self.assertEqual(["video", "audio"], [s["codec_type"] for s in probe(film)["streams"]])

    def test_another_type_is_an_error(self):
        refused = run("check", self.write("bad.yaml", SCENE.replace("sound: true", "sound: 3")))
        self.assert_exit(3, refused)
        self.assertIn("bad.yaml", refused.stderr)


if __name__ == "__main__":
    unittest.main()
