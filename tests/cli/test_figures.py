"""carom figures makes the paper again, and docs/paper.md shows what it makes."""

import csv
import math
import os
import re
import subprocess
import unittest

from program import CAROM, SOURCE, ProgramTest, run

PAPER = SOURCE / "docs" / "paper.md"
PICTURES = SOURCE / "docs" / "paper"


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class Figures(ProgramTest):
    def make(self, only):
        folder = self.folder / "paper"
        self.assert_exit(0, run("figures", "-o", folder, "-y", "-q", "--only", only))
        return folder

    def block(self, name):
        """What stands between two markers of docs/paper.md."""
        found = re.search(rf"<!-- {name}:begin -->\n(.*?)<!-- {name}:end -->", PAPER.read_text(), re.S)
        self.assertIsNotNone(found, name)
        self.assertNotEqual("", found[1], name)
        return found[1]

    def test_the_document_shows_what_the_command_makes(self):
        made = self.make("plots,tables,pictures")
        drawings = sorted(PICTURES.glob("*.svg"))
        self.assertEqual(6, len(drawings))
        for drawing in drawings:
            self.assertEqual((made / drawing.name).read_text(), drawing.read_text(), drawing.name)
        for picture in ("figure8.png", "figure9-montage.png"):
            self.assert_exit(0, run("compare", PICTURES / picture, made / picture))
        for table in ("table1", "table2", "errata", "figure8-rebounds"):
            self.assertEqual((made / f"{table}.md").read_text(), self.block(table), table)
        for shown in re.findall(r"\]\(paper/(\S+)\)", PAPER.read_text()):
            self.assertTrue((PICTURES / shown).is_file(), shown)

    def test_the_verdicts_of_the_official_tests_are_shown(self):
        lines = []
        for scene in sorted((SOURCE / "scenes" / "official").glob("*.yaml")):
            result = run("simulate", scene, "-o", "/dev/null")
            self.assert_exit(0, result)
            lines.append(result.stderr.replace("carom: ", "- "))
        self.assertEqual(5, len(lines))
        self.assertEqual("".join(lines), self.block("verdicts"))
        self.assertEqual(3, sum(" passes " in line for line in lines))
        drawn = self.folder / "fiba.png"
        scene = SOURCE / "scenes" / "official" / "fiba_basketball.yaml"
        self.assert_exit(0, run("still", scene, "--time", "2.5", "--size", "960x540", "-o", drawn))
        self.assert_exit(0, run("compare", PICTURES / "fiba_basketball.png", drawn))

    def test_tables_as_csv_hold_to_full_precision(self):
        made = self.make("tables")
        corrected = {r["ball"]: r for r in rows(made / "table2.csv")}
        self.assertEqual(5, len(corrected))
        for ball, distance, velocity in (("Basketball", 0.42, 5), ("Volleyball", 0.72, 6), ("Football", 0.3, 3),
                                         ("Table tennis", 0.05, 1), ("Tennis (derived)", 0.736, 5)):
            row = corrected[ball]
            self.assertAlmostEqual(math.exp(-4 * distance / (2 * velocity)), float(row["restitution"]), delta=1e-15)
            self.assertLess(abs(float(row["deviation"])), 0.009)
        for row in rows(made / "figure8-rebounds.csv"):
            expected = math.exp(-4 * 0.042) ** (2 * int(row["rebound"])) * 1.8
            self.assertLess(abs(float(row["height_m"]) / expected - 1), 1e-12)

    def test_any_folder_and_the_scenes_inside_will_do(self):
        result = subprocess.run([CAROM, "figures", "-o", "new/folder", "--only", "figure8-height"], cwd=self.folder,
                                capture_output=True, text=True)
        self.assert_exit(0, result)
        self.assertEqual({f"figure8-height.{e}" for e in ("svg", "png", "pdf", "csv")},
                         {p.name for p in (self.folder / "new" / "folder").iterdir()})

    def test_the_film_of_figure_8_is_whole(self):
        film = self.make("figure8") / "figure8.mp4"
        found = subprocess.run(["ffprobe", "-v", "error", "-count_packets", "-show_entries",
                                "stream=width,height,nb_read_packets", "-of", "csv=p=0", film],
                               capture_output=True, text=True, check=True).stdout
        self.assertEqual("1280,720,360", found.strip())

    def test_files_that_exist_are_kept_without_overwrite(self):
        folder = self.make("table1")
        (folder / "table1.csv").write_text("mine")
        result = run("figures", "-o", folder, "--only", "table1")
        self.assert_exit(4, result)
        self.assertIn("table1.csv", result.stderr)
        self.assertEqual("mine", (folder / "table1.csv").read_text())

    def test_mistakes(self):
        result = run("figures", "-o", self.folder / "x", "--only", "figure10")
        self.assert_exit(2, result)
        self.assertIn("figure10", result.stderr)
        self.assertIn("figure7", result.stderr)
        self.assert_exit(2, run("figures"))
        (self.folder / "file").write_text("")
        self.assert_exit(4, run("figures", "-o", self.folder / "file", "--only", "tables"))

    def test_without_gnuplot_it_says_what_to_install(self):
        result = subprocess.run([CAROM, "figures", "-o", self.folder / "x", "--only", "figure4"], capture_output=True,
                                text=True, env={**os.environ, "PATH": str(self.folder)})
        self.assert_exit(1, result)
        self.assertIn("gnuplot-nox", result.stderr)


if __name__ == "__main__":
    unittest.main()
