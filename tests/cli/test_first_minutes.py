"""What somebody meets first: carom alone, new, words that were meant, the line that is wrong, completions, the manual."""

import json
import math
import re
import shutil
import subprocess
import unittest

import yaml

from program import SMALL_SCENE, SOURCE, ProgramTest, run


def commands():
    return {c["command"]: c for c in json.loads(run("help", "--json").stdout)}


class Alone(ProgramTest):
    def test_carom_alone_names_three_commands_that_work(self):
        alone = run()
        self.assert_exit(2, alone)
        self.assertEqual("", alone.stdout)
        lines = [l for l in alone.stderr.splitlines() if l.startswith("  carom ")]
        self.assertEqual(3, len(lines))
        for line in lines:
            words = re.split(r"  +", line.strip())[0].split()[1:]
            if words[0] == "render":
                words += ["--size", "64x36", "--fps", "5"]
            self.assert_exit(0, run(*words, cwd=self.folder))
        self.assertTrue((self.folder / "ball.mp4").stat().st_size > 500)


class New(ProgramTest):
    def test_every_example_is_valid_commented_and_draws(self):
        listed = run("new", "--list")
        self.assert_exit(0, listed)
        names = [line.split()[0] for line in listed.stdout.splitlines()]
        self.assertLess({"drop", "pile", "figure8", "court"}, set(names))
        for name in names:
            self.assert_exit(0, run("new", f"my_{name}", "--like", name, cwd=self.folder))
            text = (self.folder / f"my_{name}.yaml").read_text()
            source = next(p for p in (SOURCE / "scenes").rglob(f"{name}.yaml"))
            self.assertEqual(source.read_text(), text)
            self.assertTrue(text.startswith("# "), name)
            checked = run("check", self.folder / f"my_{name}.yaml")
            self.assert_exit(0, checked)
            self.assertEqual("", checked.stderr)
            title = yaml.safe_load(text)["title"]
            self.assertRegex(listed.stdout, rf"(?m)^{name} +{re.escape(title)}$")
        self.assertGreater((SOURCE / "scenes/examples/drop.yaml").read_text().count("#"), 15)
        self.assertEqual(run("new", "-", "--like", "drop").stdout, run("new", "-").stdout)

    def test_nothing_is_overwritten_unasked(self):
        self.assert_exit(0, run("new", "a", cwd=self.folder))
        mine = self.write("a.yaml", "mine")
        self.assert_exit(4, run("new", "a", cwd=self.folder))
        self.assert_exit(4, run("new", mine))
        self.assertEqual("mine", mine.read_text())
        self.assert_exit(0, run("new", "a.yaml", "-y", "-q", cwd=self.folder))
        self.assertTrue(mine.read_text().startswith("#"))
        self.assertFalse((self.folder / "a.yaml.yaml").exists())
        self.assert_exit(4, run("new", self.folder / "nowhere" / "a"))

    def test_what_is_missing_or_misspelt_is_said(self):
        self.assertIn("--list", run("new").stderr)
        wrong = run("new", "a", "--like", "figur8", cwd=self.folder)
        self.assert_exit(2, wrong)
        self.assertIn("did you mean 'figure8'?", wrong.stderr)
        self.assertFalse((self.folder / "a.yaml").exists())


class Choices(ProgramTest):
    def test_every_misspelt_choice_is_answered_with_the_choices(self):
        found = 0
        for path, command in commands().items():
            for option in command["options"]:
                if not option["choices"] or option["argument"]:
                    continue
                found += 1
                right = max(option["choices"], key=len)
                wrong = right[:-1] + ("x" if right[-1] != "x" else "y")
                result = run(*path.split(), option["names"][-1], wrong)
                self.assert_exit(2, result)
                self.assertIn(f"'{wrong}' is none of", result.stderr, (path, option["names"]))
                if len(right) > 3:
                    self.assertIn("did you mean", result.stderr, (path, option["names"]))
        self.assertGreater(found, 8)
        self.assertIn("did you mean 'bash'?", run("completion", "bsh").stderr)


class Carets(ProgramTest):
    def shown(self, text, *options, name="s.yaml"):
        result = run("check", self.write(name, text), *options)
        self.assertIn(result.returncode, (0, 3))
        return result.stderr.replace(str(self.folder) + "/", "")

    def test_the_line_and_a_mark_under_the_place(self):
        self.assertEqual("s.yaml:2:1: error: unknown key 'bals'; did you mean 'balls'?\n"
                         "    2 | bals: []\n"
                         "      | ^~~~\n", self.shown("carom: 1\nbals: []\n"))
        self.assertIn("   12 |   - {name: b, radius: -0.1, position: [0, 0, 9]}\n"
                      "      |                       ^~~~\n",
                      self.shown("carom: 1\n" + "#\n" * 9 + "balls:\n"
                                 "  - {name: b, radius: -0.1, position: [0, 0, 9]}\n"))

    def test_each_mistake_has_its_own(self):
        text = SMALL_SCENE.replace("duration: 0.5", "duration: long").replace("radius: 0.1", "radius: 0.1, mas: 3")
        lines = self.shown(text).splitlines()
        self.assertEqual(6, len(lines), lines)
        for first in (lines[0:3], lines[3:6]):
            place = re.match(r"s\.yaml:(\d+):(\d+): error: ", first[0])
            number, column = int(place[1]), int(place[2])
            self.assertEqual(text.splitlines()[number - 1], first[1].split(" | ", 1)[1])
            self.assertEqual(column - 1, first[2].split(" | ", 1)[1].index("^"))

    def test_characters_of_several_bytes_line_ends_and_marks_of_bytes(self):
        for begin, end in (("", "\n"), ("\ufeff", "\n"), ("", "\r\n")):
            path = self.folder / "s.yaml"
            path.write_bytes((begin + f"carom: 1{end}title: x{end}looks: {{a: {{color: 'äöü', colr: 1}}}}{end}").encode())
            result = run("check", path)
            mark = next(l for l in result.stderr.splitlines() if "^~~~" in l)
            line = next(l for l in result.stderr.splitlines() if "looks" in l and " | " in l)
            column = int(re.search(r"s\.yaml:3:(\d+): error: unknown", result.stderr)[1])
            self.assertEqual(column - 1, mark.split(" | ", 1)[1].index("^"), result.stderr)
            self.assertTrue(line.endswith("{a: {color: 'äöü', colr: 1}}"), repr(line))

    def test_hostile_lines_are_harmless_and_long_ones_cut(self):
        shown = self.shown("carom: 1\nbals: [] # \u202e \u200f " + "x" * 5000 + "\n")
        self.assertNotRegex(shown, "[\u202e\u200f\x1b]")
        self.assertLess(max(map(len, shown.splitlines())), 120)
        far = self.shown("carom: 1\nlooks: {" + "a" * 60 + ": {color: red}, " + "b" * 300 + ": 1}\n")
        for line in far.splitlines():
            if " | " in line:
                self.assertLess(len(line), 120)
        self.assertEqual(0, run("check", self.scene, "--set", "balls.a.mass=2").returncode)
        # What the command line changed stands in no line.
        self.assertNotIn("|", run("check", self.scene, "--set", "balls.a.mas=2").stderr)

    def test_warnings_and_the_second_run_have_them_too(self):
        half = SMALL_SCENE.replace("restitution: 0.8", "restitution: 0.8, friction: 1")
        self.assertRegex(self.shown(half), r"(?s)warning: .*\n +4 \|   rubber: .*\n +\| +\^")
        self.assertEqual("", run("check", self.write("h.yaml", half), "-q").stderr)


@unittest.skipUnless(shutil.which("bash"), "bash is not installed")
class Completion(ProgramTest):
    def complete(self, *words, command="carom"):
        """COMPREPLY of bash with the script sourced, the last word under the cursor."""
        script = self.folder / "carom.bash"
        if not script.exists():
            script.write_text(run("completion", "bash").stdout)
        # As readline gives them: the sign of equality is a word.
        split = [part for word in words for part in re.split(r"(=)", word) if part or word == ""]
        if words[-1].endswith("="):
            split = split[:-1] if split[-1] == "" else split
        quoted = " ".join("'" + w.replace("'", "'\\''") + "'" for w in [command, *split])
        result = subprocess.run(
            ["bash", "--norc", "-c", f"source '{script}'; COMP_WORDS=({quoted}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); "
             "_carom; printf '%s\\n' \"${COMPREPLY[@]}\""],
            cwd=self.folder, text=True, capture_output=True, timeout=60)
        self.assertEqual("", result.stderr)
        return [line for line in result.stdout.splitlines() if line]

    def test_commands_options_choices_and_files(self):
        self.write("b.yaml", "")
        self.write("c.txt", "")
        (self.folder / "d e").mkdir()
        self.assertEqual(["render"], self.complete("rend"))
        self.assertEqual({"check", "update", "accept"}, set(self.complete("golden", "")))
        self.assertEqual(["--progress", "--preset"], sorted(self.complete("render", "x.yaml", "--pr"), reverse=True))
        self.assertEqual(["plain"], self.complete("render", "--progress", "pl"))
        self.assertEqual(["plain"], self.complete("render", "--progress=pl"))
        self.assertEqual({"auto", "bar", "plain", "none", "json"}, set(self.complete("render", "--progress=")))
        self.assertEqual({"b.yaml", "scene.yaml", "d e"}, set(self.complete("still", "")))
        self.assertEqual(["scene.yaml"], self.complete("golden", "check", "sc"))
        self.assertIn("c.txt", self.complete("still", "b.yaml", "-o", ""))
        self.assertEqual(["d e"], self.complete("golden", "check", "--dir", ""))
        self.assertEqual([], self.complete("still", "--time", ""))
        self.assertEqual({"bash", "zsh", "fish"}, set(self.complete("completion", "")))
        self.assertIn("court", self.complete("new", "--like", "co"))

    def test_every_option_of_every_command_is_offered(self):
        for path, command in commands().items():
            wanted = {name for option in command["options"] for name in option["names"]}
            self.assertEqual(wanted, set(self.complete(*path.split(), "-")), path)

    def test_other_shells_take_their_scripts(self):
        for shell in ("zsh", "fish"):
            text = run("completion", shell).stdout
            script = self.write(f"c.{shell}", text)
            for path, command in commands().items():
                for option in command["options"]:
                    for name in option["names"]:
                        spelt = name.lstrip("-") if shell == "fish" else name
                        self.assertIn(spelt, text, f"{shell}: {path} {name}")
            if not shutil.which(shell):
                continue
            self.assertEqual("", subprocess.run([shell, "-n", script], capture_output=True, text=True).stderr)
        if shutil.which("fish"):
            offered = subprocess.run(
                ["fish", "--no-config", "-c", f"function carom; end; source '{self.folder}/c.fish'; "
                 "complete -C 'carom render --progress '; complete -C 'carom golden '"],
                capture_output=True, text=True, env={"HOME": str(self.folder), "PATH": "/usr/bin:/bin"})
            words = {line.split("\t")[0] for line in offered.stdout.splitlines()}
            self.assertLessEqual({"auto", "bar", "plain", "none", "check", "update", "accept"}, words)
        if shutil.which("zsh"):
            loaded = subprocess.run(["zsh", "-f", "-c", f"autoload -U compinit; compinit -D -u; source '{self.folder}/c.zsh'; "
                                     "print $_comps[carom]"], capture_output=True, text=True)
            self.assertEqual(("_carom\n", ""), (loaded.stdout, loaded.stderr))


class Manual(ProgramTest):
    def test_it_has_every_command_and_option_and_no_mistake(self):
        text = run("help", "--man").stdout
        page = self.write("carom.1", text)
        read = text.replace("\\-", "-")
        for path, command in commands().items():
            self.assertIn(f".SS carom {path}" if path else ".SH NAME", read)
            for option in command["options"]:
                for name in option["names"]:
                    self.assertIn(f"\\fB{name}\\fR", read)
        self.assertNotRegex(text, r"(?m)^[.'](?!TH|SH|SS|TP|PP|EX|EE|B|I|BR)\b")
        if shutil.which("mandoc"):
            lint = subprocess.run(["mandoc", "-T", "lint", "-W", "warning", page], capture_output=True, text=True)
            self.assertEqual("", lint.stdout + lint.stderr)
        if shutil.which("man"):
            shown = subprocess.run(["man", "-l", "--warnings=all", page], capture_output=True, text=True,
                                   env={"PATH": "/usr/bin:/bin", "LC_ALL": "C.UTF-8", "MANWIDTH": "80"})
            self.assertEqual("", shown.stderr)
            self.assertIn("EXIT STATUS", shown.stdout)

    def test_help_and_listing_say_the_same(self):
        for path, command in commands().items():
            text = run(*path.split(), "--help", env={"COLUMNS": "400"}).stdout
            for option in command["options"]:
                for name in option["names"]:
                    self.assertIn(name, text)
                self.assertIn(" ".join(option["text"].split()), text)
        self.assert_exit(2, run("help", "--man", "--json"))


class Rest(ProgramTest):
    """Options that no other test uses."""

    def test_dpi_of_a_still(self):
        picture = self.folder / "p.png"
        self.assert_exit(0, run("still", self.scene, "--time", 0, "--size", "32x18", "--dpi", 300, "-o", picture))
        data = picture.read_bytes()
        at = data.index(b"pHYs") + 4
        # 300 / 0.0254 = 11811.02 pixels a metre.
        self.assertEqual([11811, 11811, 1], [int.from_bytes(data[at:at + 4], "big"),
                                             int.from_bytes(data[at + 4:at + 8], "big"), data[at + 8]])

    def test_the_velocity_of_a_fitted_virtual_body(self):
        for velocity in (2.5, 10):
            found = run("fit", "--drop", 1, "--rebound", 0.25, "--velocity", velocity, "--json")
            self.assert_exit(0, found)
            body = json.loads(found.stdout)["point"]
            # e = 1/2, so x = -2 v ln(1/2) / K.
            self.assertAlmostEqual(velocity, body["velocity_m_s"])
            self.assertAlmostEqual(2 * velocity * math.log(2) / 4, body["distance_m"], places=9)

    def test_the_budget_of_a_measurement(self):
        options = ["--steps", "0.01,0.005", "--repeats", 1, "-q"]
        self.assert_exit(0, run("accuracy", self.scene, "-o", self.folder / "all", "--budget", 100, *options))
        self.assert_exit(0, run("accuracy", self.scene, "-o", self.folder / "few", "--budget", 1e-9, *options))
        rows = [(self.folder / name / "accuracy.csv").read_text() for name in ("all", "few")]
        # The first step tells what the next one would cost; with World and with QuickStep.
        self.assertEqual([0, 2], [text.count("left out: it would take") for text in rows])

    def test_the_back_end_of_goldens_and_figures(self):
        options = [self.scene, "--dir", self.folder / "G", "--time", 0, "--size", "64x36"]
        self.assert_exit(0, run("golden", "update", *options))
        self.assert_exit(0, run("golden", "check", *options, "--backend", "osmesa", "--tolerance", 0))
        for name, backend in (("A", ["--backend", "osmesa"]), ("B", [])):
            self.assert_exit(0, run("figures", "-o", self.folder / name, "--only", "figure9-montage", *backend))
        a, b = (self.folder / name / "figure9-montage.png" for name in "AB")
        self.assert_exit(0, run("compare", a, b))
        self.assert_exit(2, run("figures", "-o", self.folder / "C", "--backend", "osmessa"))

    def test_the_reference_is_the_one_of_the_documents(self):
        document = (SOURCE / "docs" / "scene.md").read_text()
        kept = document.split("<!-- reference:begin -->")[1].split("<!-- reference:end -->")[0]
        self.assertEqual(kept.strip(), run("schema", "--reference").stdout.strip())


if __name__ == "__main__":
    unittest.main()
