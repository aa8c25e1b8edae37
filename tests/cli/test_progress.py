"""Progress for programs that watch: a line of JSON at a time on standard error."""

import json
import re
import subprocess
import unittest

from long_work import GAS
from program import CAROM, ProgramTest, run

KEYS = ["stage", "done", "total", "unit", "rate", "elapsed_s", "left_s"]


class JsonLines(ProgramTest):
    def lines(self, *words, kill_after=None):
        """The objects; other lines are messages of the program."""
        process = subprocess.Popen([CAROM, *map(str, words), "--progress", "json"], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        found = []
        for line in process.stderr:
            if not line.startswith("{"):
                self.assertRegex(line, r"^carom: ")
                continue
            self.assertEqual("\n", line[-1])
            found.append(json.loads(line))
            if len(found) == kill_after:
                process.terminate()
                kill_after = None
        process.stderr.close()
        self.assertIn(process.wait(), (0, 143))
        return found

    def check(self, lines, film=False):
        for line in lines:
            extra = ["film_s", "film_total_s"] if line["unit"] == "frames" and film else []
            self.assertEqual(KEYS + extra, list(line))
            self.assertGreaterEqual(line["rate"], 0)
            self.assertGreater(line["elapsed_s"], 0)
            if line["total"] is None:
                self.assertIsNone(line["left_s"])
            else:
                self.assertLessEqual(line["done"], line["total"])
                if line["rate"] > 0:
                    self.assertAlmostEqual((line["total"] - line["done"]) / line["rate"], line["left_s"])
        for a, b in zip(lines, lines[1:]):
            if a["stage"] == b["stage"]:
                self.assertLessEqual(a["done"], b["done"])
                self.assertLess(a["elapsed_s"], b["elapsed_s"])

    def test_each_stage_of_a_film_ends_with_all_that_there_is(self):
        lines = self.lines("render", self.scene, "-o", self.folder / "film.mp4")
        self.check(lines, film=True)
        last = {line["stage"]: line for line in lines}
        self.assertEqual(["simulate", "film"], list(last))
        self.assertEqual((0.5, 0.5, "s"), tuple(last["simulate"][k] for k in ("done", "total", "unit")))
        self.assertEqual((10, 10, "frames", 0.5, 0.5),
                         tuple(last["film"][k] for k in ("done", "total", "unit", "film_s", "film_total_s")))

    def test_a_simulation_goes_on_and_says_when_it_will_end(self):
        gas = self.write("gas.yaml", GAS)
        lines = self.lines("simulate", gas, "-o", self.folder / "m.csv", kill_after=4)
        self.check(lines)
        self.assertEqual({"simulate"}, {line["stage"] for line in lines})
        self.assertEqual({1e6}, {line["total"] for line in lines})
        self.assertGreater(lines[3]["done"], lines[0]["done"])
        self.assertGreater(lines[3]["left_s"], 0)
        until_rest = self.write("rest.yaml", GAS.replace("duration: 1e6", "duration: rest, max_duration: 1e5"))
        lines = self.lines("simulate", until_rest, "-o", self.folder / "m.csv", kill_after=2)
        self.check(lines)
        self.assertEqual({None}, {line["total"] for line in lines})

    def test_rows_joins_and_second_runs(self):
        stages = [line["stage"] for line in self.lines("simulate", self.scene, "-o", self.folder / "m.csv")]
        self.assertEqual(["simulate", "write"], stages)
        stages = [line["stage"] for line in self.lines("render", self.scene, "-o", self.folder / "a.mp4", "--against-set",
                                                       "balls.a.mass=2")]
        self.assertEqual(["simulate", "simulate_other", "film"], stages)
        for i in (1, 2):
            self.assert_exit(0, run("render", self.scene, "-o", self.folder / f"{i}.mp4", "--chunk", f"{i}/2"))
        (line,) = self.lines("join", self.folder / "1.mp4", self.folder / "2.mp4", "-o", self.folder / "j.mp4")
        self.check([line])
        self.assertEqual(("join", 10, 10), tuple(line[k] for k in ("stage", "done", "total")))

    def test_quiet_is_quiet(self):
        result = run("simulate", self.scene, "-o", "-", "--progress", "json", "-q")
        self.assert_exit(0, result)
        self.assertEqual("", result.stderr)


class PlainLines(ProgramTest):
    def test_a_film_says_its_time_its_rate_and_what_remains(self):
        never_rests = self.write("bounces.yaml", """carom: 1
simulation: {duration: 500}
surfaces: [{name: floor, plane: {}}]
balls: [{name: a, radius: 0.1, position: [0, 0, 1]}]
""")
        process = subprocess.Popen(
            [CAROM, "render", str(never_rests), "-o", str(self.folder / "f.mp4"), "--progress", "plain",
             "--fps", "100", "--size", "640x360"], stderr=subprocess.PIPE, text=True)
        line = process.stderr.readline()
        process.kill()
        process.wait()
        process.stderr.close()
        found = re.fullmatch(r"(\d+)/50000 frames \(([\d.]+)/500.0 s\), [\d.]+/s, [\d:]+ left\n", line)
        self.assertTrue(found, line)
        self.assertAlmostEqual(int(found[1]) / 100, float(found[2]), delta=0.051)


if __name__ == "__main__":
    unittest.main()
