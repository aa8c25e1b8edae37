"""carom fit --air and --wav as commands: against closed forms of a fall with drag, and a recording made here."""

import json
import math
import struct
import unittest
import wave

from program import ProgramTest, run


def restitution(drop, rebound, radius, mass, drag, density):
    """A fall from h ends with V sqrt(1 - exp(-h/q)); what leaves with u rises to q ln(1 + (u/V)^2); q = V^2 / 2g."""
    gravity = 9.81 * (1 - density * 4 / 3 * math.pi * radius ** 3 / mass)
    q = mass / (density * math.pi * radius ** 2 * drag)
    assert gravity > 0
    return math.sqrt(math.expm1(rebound / q) / -math.expm1(-drop / q))


class FitInAir(ProgramTest):
    def fit(self, *arguments):
        result = run("fit", *arguments, "--json")
        self.assert_exit(0, result)
        return json.loads(result.stdout)["restitution"]

    def test_drops_in_air(self):
        drop = ["--drop", 2.5, "--rebound", 1.4]
        for density in (1.225, 0.3):
            ball = ["--radius", "20mm", "--mass", 0.0027, "--drag", 0.45]
            found = self.fit(*drop, "--air", *ball, "--density", density)
            self.assertAlmostEqual(restitution(2.5, 1.4, 0.02, 0.0027, 0.45, density), found, places=12)
        self.assertAlmostEqual(math.sqrt(1.4 / 2.5), self.fit(*drop), places=12)
        # Nearly no air is nearly a vacuum.
        thin = self.fit(*drop, "--air", *ball, "--density", 1e-9)
        self.assertAlmostEqual(math.sqrt(1.4 / 2.5), thin, places=8)

    def test_a_preset_gives_what_is_left_out(self):
        drop = ["--drop", 2, "--rebound", 1]
        own = ["--radius", 0.03, "--mass", 0.05, "--drag", 0.5]
        self.assertEqual(self.fit(*drop, "--air", *own), self.fit(*drop, "--air", "--ball", "tennis", *own))
        self.assertNotEqual(self.fit(*drop, "--air", *own), self.fit(*drop, "--air", "--ball", "tennis"))
        wrong = run("fit", *drop, "--air", "--ball", "tenis")
        self.assert_exit(2, wrong)
        self.assertIn("did you mean 'tennis'?", wrong.stderr)
        self.assert_exit(2, run("fit", *drop, "--air"))
        self.assert_exit(2, run("fit", *drop, "--ball", "tennis"))

    def test_a_recording(self):
        rate, ratio, at, gap = 48000, 0.8, 0.3, 0.62
        instants = []
        for _ in range(8):
            instants.append(at)
            at, gap = at + gap, gap * ratio
        samples = [0.0] * int(rate * (at + 0.2))
        for k, instant in enumerate(instants):
            for i in range(int(0.02 * rate)):
                t = (math.ceil(instant * rate) + i) / rate - instant
                samples[math.ceil(instant * rate) + i] += 0.7 * ratio ** k * math.exp(-t / 0.003) * math.cos(
                    2 * math.pi * 1800 * t)
        path = self.folder / "bounces.wav"
        with wave.open(str(path), "wb") as file:
            file.setnchannels(1)
            file.setsampwidth(2)
            file.setframerate(rate)
            file.writeframes(b"".join(struct.pack("<h", round(32767 * s)) for s in samples))
        self.assertAlmostEqual(ratio, self.fit("--wav", path), delta=2e-4)
        result = run("fit", "--wav", self.write("no.wav", "no sound"))
        self.assert_exit(2, result)
        self.assertIn("no.wav", result.stderr)


if __name__ == "__main__":
    unittest.main()
