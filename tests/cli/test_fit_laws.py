"""carom fit --over-speed and --fit-drag as commands."""

import json
import math
import unittest

from program import ProgramTest, run

BALL = """\
carom: 1
simulation: {duration: 5}
air: {}
materials: {m: {restitution: 0.9}}
surfaces: [{name: f, plane: {}}]
balls: [{name: a, preset: table_tennis, material: m, drop_height: 1.5, drag: 0.5}]
"""


class FitLaws(ProgramTest):
    def heights(self, value=0.9, exponent=0.1):
        lines = ["drop_cm,rebound_cm"]
        for height in (20, 60, 150, 300):
            v = math.sqrt(2 * 9.81 * height / 100)
            lines.append(f"{height},{height * (value * v ** -exponent) ** 2!r}")
        return self.write("heights.csv", "\n".join(lines) + "\n")

    def test_a_law_over_the_speed_is_a_material(self):
        heights = self.heights()
        found = run("fit", "--csv", heights, "--over-speed", "--json")
        self.assert_exit(0, found)
        law = json.loads(found.stdout)
        self.assertAlmostEqual(0.1, law["exponent"]["value"], places=9)
        self.assertAlmostEqual(0.9 * law["at_speed_m_s"] ** -0.1, law["restitution"]["value"], places=9)
        text = run("fit", "--csv", heights, "--over-speed", "--name", "felt").stdout
        scene = BALL.replace("materials: {m: {restitution: 0.9}}\n", text).replace("material: m", "material: felt")
        self.assert_exit(0, run("check", self.write("law.yaml", scene)))
        plot = self.folder / "law.svg"
        self.assert_exit(0, run("fit", "--csv", heights, "--over-speed", "-o", plot))
        self.assertIn("power law", plot.read_text())

    def test_drag_from_what_the_simulation_sounds_like(self):
        sound = self.folder / "sound.wav"
        self.assert_exit(0, run("render", self.write("ball.yaml", BALL), "-o", sound, "-q"))
        ball = ["--air", "--ball", "table_tennis"]
        found = run("fit", "--wav", sound, *ball, "--fit-drag", "--json")
        self.assert_exit(0, found)
        fit = json.loads(found.stdout)
        self.assertAlmostEqual(0.9, fit["restitution"]["value"], delta=1e-3)
        self.assertAlmostEqual(0.5, fit["drag"]["value"], delta=0.02)
        self.assertIn("drag C_D = 0.", run("fit", "--wav", sound, *ball, "--fit-drag").stdout)

    def test_what_they_cannot_be_asked_for(self):
        drop = ["--drop", 1, "--rebound", 0.7]
        times = ["--intervals", "0.5,0.45,0.4,0.36,0.32"]
        ball = ["--air", "--ball", "table_tennis"]
        for words, why in (((*drop, *ball, "--fit-drag"), "times between many bounces"),
                           ((*times, "--fit-drag"), "give --air"),
                           ((*times, *ball, "--drag", 0.5, "--fit-drag"), "leave out --drag"),
                           ((*times, "--air", "--radius", "2cm", "--fit-drag"), "needs the ball"),
                           ((*times, *ball, "--fit-drag", "-o", self.folder / "a.svg"), "no plot"),
                           ((*times, *ball, "--fit-drag", "--rebound-to", "top", "--diameter", "4cm"),
                            "--rebound-to"),
                           ((*times, *ball, "--fit-drag", "--diameter", "4cm"), "--diameter"),
                           ((*times, "--over-speed"), "drops from several heights"),
                           ((*drop, "--over-speed"), "drop from heights that differ"),
                           ((*drop, "--over-speed", "--velocity", 3), "--velocity"),
                           ((*times, *ball, "--fit-drag", "--constant", 4), "--constant"),
                           ((*times, *ball, "--fit-drag", "--over-speed"), "--over-speed"),
                           (("--intervals", "1,0.8,0.64,0.512,0.4096,0.32768", "--reading-error", "1ms", *ball,
                             "--fit-drag"), "do not tell the drag")):
            refused = run("fit", *words)
            self.assert_exit(2, refused)
            self.assertIn(why, refused.stderr)
            self.assertEqual("", refused.stdout)


if __name__ == "__main__":
    unittest.main()
