"""carom accuracy: its files, its sentence, and what it refuses."""

import csv
import json
import unittest

from program import SOURCE, ProgramTest, run

SCENE = """carom: 1
simulation: {duration: 2}
materials: {rubber: {restitution: 0.8}}
surfaces: [{name: floor, plane: {}}]
balls: [{name: a, radius: 0.1, position: [0, 0, 1.1], material: rubber}]
"""


class Accuracy(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene = self.folder / "drop.yaml"
        self.scene.write_text(SCENE)

    def measure(self, *options):
        return run("accuracy", self.scene, "-o", self.folder / "result", "--steps", "0.001,0.01", "--repeats", "1", *options)

    def test_the_files_agree_with_the_sentence(self):
        result = self.measure("-q")
        self.assert_exit(0, result)
        folder = self.folder / "result"
        names = {"accuracy.csv", "accuracy.json", "accuracy.svg", "accuracy.png", "accuracy-peaks.svg", "accuracy-peaks.png"}
        self.assertEqual(names, {f.name for f in folder.iterdir()})
        rows = list(csv.DictReader((folder / "accuracy.csv").read_text().splitlines()))
        self.assertEqual(["exact", "fixed", "fixed", "fixed", "fixed"], [r["method"] for r in rows])
        self.assertEqual(["", "0.01", "0.001", "0.01", "0.001"], [r["step_s"] for r in rows])
        self.assertLess(float(rows[0]["position_error_m"]), 1e-12)
        self.assertGreater(float(rows[1]["position_error_m"]), 1e-3)
        data = json.loads((folder / "accuracy.json").read_text())
        self.assertEqual(data["summary"] + "\n", result.stdout)
        self.assertIn("and 1e-6 exact", result.stdout)
        self.assertIn("exact", (folder / "accuracy.svg").read_text())

    def test_it_replaces_nothing_unasked(self):
        self.assert_exit(0, self.measure("-q"))
        before = (self.folder / "result" / "accuracy.csv").read_bytes()
        self.assert_exit(4, self.measure("-q"))
        self.assertEqual(before, (self.folder / "result" / "accuracy.csv").read_bytes())
        self.assert_exit(0, self.measure("-q", "-y"))

    def test_what_cannot_be_measured_is_refused(self):
        self.scene.write_text("carom: 1\n")
        result = self.measure()
        self.assert_exit(2, result)
        self.assertIn("no balls", result.stderr)
        self.assert_exit(3, run("accuracy", self.scene, "-o", self.folder / "r", "--set", "titel=x"))
        self.assert_exit(2, run("accuracy", self.scene, "-o", self.folder / "r", "--steps", "0"))


if __name__ == "__main__":
    unittest.main()
