"""carom fit: from measurements to a coefficient, a line and a material."""

import json
import math
import unittest

from program import SOURCE, ProgramTest, run


class Fit(ProgramTest):
    def fit(self, *arguments):
        result = run("fit", *arguments, "--json")
        self.assert_exit(0, result)
        return json.loads(result.stdout)

    def test_a_drop_that_carom_simulated_gives_its_coefficient_back(self):
        stats = self.folder / "stats.json"
        events = self.folder / "events.csv"
        scene = SOURCE / "scenes" / "figure8.yaml"
        self.assert_exit(0, run("simulate", scene, "-o", "/dev/null", "--events", events, "--stats", stats))
        peak = json.loads(stats.read_text())["balls"]["basketball"]["peaks"][0]["height"]
        expected = math.exp(-4 * 0.42 / (2 * 5))
        fitted = self.fit("--drop", 1.8, "--rebound", repr(peak))["restitution"]
        print(f"from the heights {fitted:.12f}, from the virtual body {expected:.12f}")
        self.assertAlmostEqual(expected, fitted, delta=1e-9)

        lines = [line.split(",") for line in events.read_text().splitlines()[1:]]
        impacts = [float(line[0]) for line in lines if line[3] == "impact"][:8]
        intervals = ",".join(repr(b - a) for a, b in zip(impacts, impacts[1:]))
        self.assertAlmostEqual(expected, self.fit("--intervals", intervals)["restitution"], delta=1e-9)

    def test_what_it_prints_is_a_scene_s_material(self):
        result = run("fit", "--drop", "180cm", "--rebound", "1.3", "--constant", "3", "--name", "mine")
        self.assert_exit(0, result)
        scene = self.write("pasted.yaml", "carom: 1\n" + result.stdout +
                           "surfaces: [{name: floor, plane: {}}]\n"
                           "balls: [{name: a, radius: 0.1, material: mine, drop_height: 1.8}]\n")
        stats = self.folder / "stats.json"
        self.assert_exit(0, run("simulate", scene, "-o", "/dev/null", "--stats", stats, "--set",
                                "simulation.duration=2"))
        peak = json.loads(stats.read_text())["balls"]["a"]["peaks"][0]["height"]
        self.assertAlmostEqual(1.3, peak, delta=1e-9)

    def test_files_of_repeated_drops(self):
        table = self.write("drops.csv", "drop [cm],rebound [cm]\n100,64\n100,49\n100,81\n")
        fitted = self.fit("--csv", table)
        self.assertAlmostEqual(0.8, fitted["restitution"], delta=1e-15)
        self.assertAlmostEqual(0.1 / math.sqrt(3), fitted["uncertainty"], delta=1e-15)
        self.assertEqual(3, len(fitted["single"]))

    def test_top_and_bottom(self):
        fitted = self.fit("--drop", 1.8, "--rebound", 1.2, "--rebound-to", "top", "--diameter", "243mm")
        self.assertAlmostEqual(math.sqrt(0.957 / 1.8), fitted["restitution"], delta=1e-12)

    def test_plots(self):
        for ending, magic in (("svg", b"<?xml"), ("png", b"\x89PNG"), ("pdf", b"%PDF")):
            plot = self.folder / f"line.{ending}"
            self.assert_exit(0, run("fit", "--drop", 1, "--rebound", 0.5, "--reading-error", "1mm", "-o", plot))
            self.assertTrue(plot.read_bytes().startswith(magic))
            self.assert_exit(4, run("fit", "--drop", 1, "--rebound", 0.5, "-o", plot))
            self.assert_exit(0, run("fit", "--drop", 1, "--rebound", 0.5, "-o", plot, "-y"))

    def test_mistakes(self):
        drop = ("--drop", 1)
        for arguments, says in (
            ((), "nothing measured"),
            (drop, "--rebound"),
            (("--rebound", 1), "--drop"),
            ((*drop, "--rebound", 1.5), "higher than the drop"),
            ((*drop, "--rebound", 0), "above 0"),
            ((*drop, "--rebound", -0.5), "above 0"),
            ((*drop, "--rebound", "0.5kg"), "'kg' is no unit of a length"),
            ((*drop, "--rebound", "high"), "'high' is no number"),
            ((*drop, *drop, "--rebound", 0.5), "one rebound for each drop"),
            ((*drop, "--rebound", 0.5, "--intervals", "1,2"), "only one of"),
            ((*drop, "--rebound", 0.5, "--rebound-to", "top"), "--diameter"),
            ((*drop, "--rebound", 0.5, "--diameter", 0.1), "only needed with"),
            ((*drop, "--rebound", 0.5, "--reading-error", 0), "above 0"),
            ((*drop, "--rebound", 0.5, "--name", "my ball"), "a name is"),
            ((*drop, "--rebound", 0.5, "-o", self.folder / "p.jpg"), ".svg, .png or .pdf"),
            ((*drop, "--rebound", 0.5, "--constant", 0), "--constant"),
            (("--intervals", "0.5"), "not enough"),
            (("--intervals", "0.5,0.6"), "grow"),
            (("--intervals", "0.5,0.4", "--rebound-to", "top", "--diameter", "1"), "intervals"),
            (("--csv", self.folder / "none.csv"), "none.csv"),
            (("--csv", self.write("bad.csv", "drop,rebound\n1,2\n")), "bad.csv:1: the column 'drop' has no unit"),
        ):
            result = run("fit", *arguments)
            self.assert_exit(2, result)
            self.assertIn(says, result.stderr)
            self.assertEqual("", result.stdout)


if __name__ == "__main__":
    unittest.main()
