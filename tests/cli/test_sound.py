"""carom render -o sound.wav: a click at each impact, read by Python's own reader of WAV files."""

import array
import csv
import json
import math
import unittest
import wave

from program import ProgramTest, run


class Sound(ProgramTest):
    def read(self, path):
        with wave.open(str(path)) as sound:
            self.assertEqual((1, 2, 48000),
                             (sound.getnchannels(), sound.getsampwidth(), sound.getframerate()))
            return array.array("h", sound.readframes(sound.getnframes()))

    def impacts(self):
        events = self.folder / "events.csv"
        self.assert_exit(0, run("simulate", self.scene, "-o", self.folder / "motion.csv",
                                "--events", events, "-q"))
        with events.open() as file:
            return [float(row["time"]) for row in csv.DictReader(file) if row["kind"] == "impact"]

    def test_the_first_sample_of_a_click_is_the_first_after_its_impact(self):
        sound = self.folder / "sound.wav"
        self.assert_exit(0, run("render", self.scene, "-o", sound, "-q"))
        samples = self.read(sound)
        first = next(i for i, sample in enumerate(samples) if sample)
        self.assertEqual(math.ceil(self.impacts()[0] * 48000), first)
        self.assertAlmostEqual(0.8 * 32768, max(abs(s) for s in samples), delta=2)
        self.assertEqual(["events.csv", "motion.csv", "sound.wav"], self.names())

    def test_beside_a_film_and_in_a_dry_run(self):
        sound, film = self.folder / "sound.wav", self.folder / "film.mkv"
        said = run("render", self.scene, "-o", film, "-o", sound, "--dry-run")
        self.assert_exit(0, said)
        self.assertIn("sound.wav", said.stdout)
        self.assertEqual([], self.names())
        stats = self.folder / "stats.json"
        self.assert_exit(0, run("render", self.scene, "-o", film, "-o", sound, "--stats", stats, "-q"))
        self.assertEqual(["film.mkv", "sound.wav", "stats.json"], self.names())
        self.assertEqual(10, json.loads(stats.read_text())["frames"])
        self.assertGreater(len(self.read(sound)), 0.5 * 48000)

    def test_what_fit_hears(self):
        sound = self.folder / "sound.wav"
        self.assert_exit(0, run("render", self.scene, "-o", sound, "-q", "--set",
                                "simulation.duration=4"))
        heard = run("fit", "--wav", sound, "--json")
        self.assert_exit(0, heard)
        self.assertAlmostEqual(0.8, json.loads(heard.stdout)["restitution"], delta=1e-5)
        none = run("fit", "--wav", self.scene)
        self.assert_exit(2, none)
        self.assertIn("this is no WAV file", none.stderr)

    def test_what_cannot_be_is_refused(self):
        sound = self.folder / "sound.wav"
        for words in (("--frames", "0-2"), ("--chunk", "1/2"), ("--resume",)):
            refused = run("render", self.scene, "-o", sound, *words)
            self.assert_exit(2, refused)
        self.assert_exit(2, run("render", self.scene, "-o", sound, "-o", sound))
        sound.write_text("kept")
        self.assert_exit(4, run("render", self.scene, "-o", sound))
        self.assertEqual("kept", sound.read_text())
        self.assert_exit(0, run("render", self.scene, "-o", sound, "-y", "-q"))


if __name__ == "__main__":
    unittest.main()
