"""carom info: what the machine has, and what is missing."""

import json
import re
import subprocess
import unittest

from faults import FaultyTest
from program import run


class Info(FaultyTest):
    def facts(self, **faults):
        result = self.short_of(["info", "--json"], **faults)
        self.assertEqual((0, b""), (result.returncode, result.stderr))
        return json.loads(result.stdout)

    def test_versions_are_those_of_the_machine(self):
        facts = self.facts()
        self.assertEqual(run("--version").stdout, f"carom {facts['carom']}\n")
        self.assertRegex(facts["ode"], r"^\d+\.\d+")
        said = subprocess.run(["ffmpeg", "-version"], capture_output=True, text=True).stdout
        self.assertEqual(said.split()[2], facts["ffmpeg"])
        said = subprocess.run(["gnuplot", "--version"], capture_output=True, text=True).stdout
        self.assertEqual(re.sub(r"gnuplot ([\d.]+) patchlevel (\w+).*\n", r"\1.\2", said), facts["gnuplot"]["version"])
        self.assertEqual("Inter Medium", facts["font"])

    def test_the_renderer_is_the_one_that_draws(self):
        facts = self.facts()
        stats = self.folder / "stats.json"
        for backend in ("osmesa", "egl", "auto"):
            self.assert_exit(0, run("still", self.scene, "--time", 0, "-o", self.folder / "a.png", "-y", "--stats", stats,
                                    "--backend", backend))
            drawn = json.loads(stats.read_text())["renderer"]
            said = facts["renderer"] if backend == "auto" else facts["backends"][backend]["renderer"]
            self.assertEqual(drawn, said)

    def test_codecs_are_those_that_render_knows_and_ffmpeg_has(self):
        codecs = self.facts()["codecs"]
        words = run("render", "--help").stdout.split("--codec NAME")[1].split("--pix-fmt")[0]
        for name in re.findall(r" ([a-z]\w*)[,;]", words.split("(default")[0]):
            self.assertIn(name, codecs)
        encoders = subprocess.run(["ffmpeg", "-hide_banner", "-encoders"], capture_output=True, text=True).stdout
        encoders = {line.split()[1] for line in encoders.split("------")[1].splitlines() if line.split()}
        for name, codec in codecs.items():
            encoder = re.search(r"[\w-]+(?=\)$)|[\w-]+$", codec.get("encoder") or codec["missing"])[0]
            self.assertEqual(encoder in encoders, codec["found"], name)
        self.assertTrue(codecs["h264"]["found"])

    def test_defaults_are_those_of_the_schema(self):
        rules = json.loads(run("schema").stdout)["$defs"]["simulation"]["properties"]
        defaults = self.facts()["defaults"]
        self.assertIn("method", defaults)
        for key, value in defaults.items():
            self.assertEqual(rules[key]["default"], value, key)

    def test_a_back_end_that_is_missing_is_named_with_its_packages(self):
        for backend, lost, packages in (("osmesa", "OSMesa", "libosmesa6"), ("egl", "libEGL", "libegl1 libgl1-mesa-dri")):
            facts = self.facts(FAIL_LIBRARY=lost)
            other = {"osmesa": "egl", "egl": "osmesa"}[backend]
            self.assertEqual([False, True], [facts["backends"][b]["found"] for b in (backend, other)])
            self.assertEqual(packages, facts["backends"][backend]["packages"])
            self.assertEqual(facts["backends"][other]["renderer"], facts["renderer"])
            said = self.short_of(["info"], FAIL_LIBRARY=lost).stdout.decode()
            self.assertRegex(said, rf"{backend} +missing: .*\(packages: {packages}\)")
        facts = self.facts(FAIL_LIBRARY="OSMesa,libEGL")
        self.assertRegex(facts["renderer"], "none: .*OSMesa.*EGL")

    def test_missing_libraries_and_programs_are_named(self):
        result = self.short_of(["info"], FAIL_LIBRARY="avcodec", PATH="/nowhere")
        self.assertEqual(0, result.returncode, result.stderr)
        self.assertRegex(result.stdout, rb"libavcodec +none: films need FFmpeg.*libavcodec")
        self.assertRegex(result.stdout, rb"libpng +\d")
        self.assertRegex(result.stdout, rb"gnuplot +missing: .*gnuplot-nox")
        self.assertEqual({}, self.facts(FAIL_LIBRARY="avcodec")["codecs"])
        self.assertRegex(self.facts()["openexr"], r"^\d+\.\d+\.\d+$")
        self.assertRegex(self.facts(FAIL_LIBRARY="OpenEXR")["openexr"], "none: EXR files need OpenEXR .package libopenexr")


if __name__ == "__main__":
    unittest.main()
