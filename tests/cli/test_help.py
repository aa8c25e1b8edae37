"""Help that fits, words that were probably meant, and what stands in messages from outside."""

import os
import re
import subprocess
import unittest

from program import CAROM, SMALL_SCENE, ProgramTest, run

COMMANDS = ["render", "still", "simulate", "check", "compare", "golden", "golden check", "golden update", "accuracy",
            "figures", "fit", "schema", "info", "golden accept", "new", "completion", "help", "sweep"]


class Help(ProgramTest):
    def help(self, command, columns):
        result = run(*command.split(), "--help", env={**os.environ, "COLUMNS": str(columns)})
        self.assert_exit(0, result)
        return result.stdout

    def test_every_command_wraps_between_words_at_the_width(self):
        for command in ["", *COMMANDS]:
            words = self.help(command, 400).split()
            for columns in (60, 80, 200):
                text = self.help(command, columns)
                self.assertEqual(words, text.split(), f"{command} at {columns}: words are cut")
                body = text.split("Usage:")[1]
                self.assertLessEqual(max(map(len, body.splitlines())), columns, f"{command} at {columns}")

    def test_every_option_says_its_default_and_examples_come_first(self):
        for command in COMMANDS:
            text = self.help(command, 400)
            if command not in ("schema", "info"):
                self.assertLess(text.index("Examples:"), text.index("Usage:"))
            self.assertNotRegex(text, r"INT|TEXT|FLOAT|\bin \[")
            options = text.split("Options:")[1].splitlines()
            for line in filter(lambda l: re.match(r" {2,6}-", l), options):
                takes_value = re.match(r" +(-\w, )?--[\w-]+ [^ ]", line) is not None
                if takes_value and "against" not in line and "--set" not in line:
                    following = options[options.index(line) + 1] if len(line) < 60 else ""
                    said = line + following
                    self.assertRegex(said, r"default|required|repeatable|for --rebound-to|Columns|Times",
                                     f"{command}: {said}")

    def test_help_and_version_are_words_too(self):
        self.assertEqual(run("render", "--help").stdout, run("help", "render").stdout)
        self.assertEqual(run("--help").stdout, run("help").stdout)
        self.assertEqual(run("--version").stdout, run("version").stdout)
        alone = run()
        self.assert_exit(2, alone)
        self.assertIn("carom help", alone.stderr)  # test_first_minutes.py


class Meant(ProgramTest):
    def test_misspelt_options_are_named_before_what_is_missing(self):
        for words, right in ((["render", "--hlep"], "--help"), (["render", "--ouput", "x.mp4"], "--output"),
                             (["simulate", "--evnts=e.csv"], "--events"), (["golden", "chekc"], "check"),
                             (["stil"], "still")):
            result = run(*words)
            self.assert_exit(2, result)
            self.assertIn(f"did you mean '{right}'", result.stderr)

    def test_a_key_of_another_section_is_found(self):
        for path, right in (("fps=30", "film.fps"), ("duration=1", "simulation.duration"),
                            ("size=[64, 64]", "film.size"), ("gravity=[0, 0, 0]", "simulation.gravity")):
            result = run("check", self.scene, "--set", path)
            self.assert_exit(3, result)
            self.assertIn(f"did you mean '{right}'", result.stderr)

    def test_sizes_and_repeated_options(self):
        picture = self.folder / "p.png"
        self.assert_exit(0, run("still", self.scene, "--time", 0.3, "--time", 0.1, "--size", "64x64", "--size", "32X18",
                                "-o", picture))
        self.assertEqual((32, 18), tuple(int.from_bytes(picture.read_bytes()[k:k + 4], "big") for k in (16, 20)))
        dry = run("render", self.scene, "-o", self.folder / "x.mp4", "--fps", 10, "--fps", 40, "--dry-run")
        self.assertIn("20 frames", dry.stdout)

    def test_blanks_that_are_no_spaces_are_named_in_their_line(self):
        for lines, place, name in ((["balls:", "\t- name: a"], "3:1", "a tab"),
                                   (["balls:", "  - name: a", "  \tradius: 1"], "4:3", "a tab"),
                                   (["balls:", "  - name: a", "    radius:\u00a01", "    mass: 1"], "4:12", "U+00A0"),
                                   (["balls:", "  - name: a", "\u00a0   radius: 1", "    mass: 1"], "4:1", "U+00A0"),
                                   (["balls: [{name: a, radius: \u202f1, position: [0, 0, 2]}]"], "2:27", "U+202F")):
            path = self.write("s.yaml", "carom: 1\n" + "\n".join(lines) + "\n")
            result = run("check", path)
            self.assert_exit(3, result)
            self.assertRegex(result.stderr, rf"s\.yaml:{place}: error: .*{re.escape(name)}")
        # In a text they may stand.
        self.assert_exit(0, run("check", self.write("t.yaml", "title: 'a\u00a0b' # \u00a0\n" + SMALL_SCENE)))

    def test_rows_have_a_rate_of_their_own(self):
        result = run("simulate", self.scene, "-o", "-", "--rate", "1e6", "--set", "simulation.duration=1e-4")
        self.assert_exit(0, result)
        self.assertEqual(102, len(result.stdout.splitlines()))
        for rate in ("2e7", "0", "-1", "1/0", "fast", "nan"):
            result = run("simulate", self.scene, "-o", "-", f"--rate={rate}")
            self.assert_exit(2, result)
            self.assertIn("--rate", result.stderr)
            self.assertNotIn("fps", result.stderr.replace("film.fps", ""))

    def test_fixed_says_when_a_ball_may_pass_through_others(self):
        # 8 m/s and a radius of 0.1 m: steps above 0.0125 s are too long.
        fixed = ["--set", "simulation.method=fixed", "--set", "simulation.gravity=[0, 0, 0]", "--set",
                 "balls.a.velocity=[8, 0, 0]"]
        for step, warned in ((0.0126, True), (0.0124, False)):
            result = run("simulate", self.scene, "-o", "-", *fixed, "--set", f"simulation.step={step}")
            self.assert_exit(0, result)
            self.assertEqual(warned, "the ball 'a'" in result.stderr and "below 0.0125 s" in result.stderr,
                             result.stderr)


class FromOutside(ProgramTest):
    HOSTILE = "a\x1b[31m\nb\u202e"

    def assert_harmless(self, result):
        for text in (result.stdout, result.stderr):
            self.assertNotRegex(text, r"[\x00-\x09\x0b-\x1f\x7f-\x9f\u202e]", result.args)
        self.assertNotRegex(result.stderr, r"(?m)^b", result.args)

    def test_names_in_messages_are_escaped(self):
        scene = self.folder / f"{self.HOSTILE}.yaml"
        scene.write_text(SMALL_SCENE)
        broken = self.write(f"{self.HOSTILE}2.yaml", "carom: 1\nbals: []\n")
        odd = self.folder / self.HOSTILE
        csv = self.write(f"{self.HOSTILE}.csv", f"{self.HOSTILE} [m],x\n1,2\n")
        for command in (["check", scene], ["check", broken], ["check", odd], ["compare", odd, odd],
                        ["render", scene, "-o", f"{odd}.mp4", "--dry-run"], ["render", scene, "-o", f"{odd}.xyz"],
                        ["check", scene, "--set", f"{self.HOSTILE}=1"], ["check", scene, "--set", self.HOSTILE],
                        ["check", self.scene, "--set", f"balls.a.material={self.HOSTILE}"],
                        ["simulate", scene, "-o", odd / "x.csv"], ["fit", "--csv", csv], ["fit", "--drop", self.HOSTILE],
                        ["golden", "check", scene, "--dir", odd, "--time", 0, "--size", "16x16"],
                        ["figures", "-o", self.folder / "F", "--only", self.HOSTILE], [self.HOSTILE],
                        ["render", f"--{self.HOSTILE}"], ["still", scene, "--time", 0, "-o", self.HOSTILE]):
            self.assert_harmless(run(*command))

    def test_names_that_are_no_utf8(self):
        name = os.fsencode(self.folder) + b"/\xff.yaml"
        with open(name, "w", encoding="utf-8") as file:
            file.write("carom: 1\nbals: []\n")
        for extra in ([], ["--json"]):
            result = subprocess.run([CAROM, "check", *extra, name], capture_output=True, timeout=60)
            self.assertEqual(3, result.returncode, result.stderr)
            (result.stdout + result.stderr).decode("utf-8")  # throws where it is none

    def test_long_names_are_cut(self):
        result = run("check", "x" * 4000)
        self.assert_exit(2, result)
        self.assertLess(len(result.stderr), 1200)
        self.assertTrue(result.stderr.rstrip().endswith("File name too long"), result.stderr[-80:])


if __name__ == "__main__":
    unittest.main()
