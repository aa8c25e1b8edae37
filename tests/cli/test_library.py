"""The headers of include/carom: each compiles alone, and they bring nothing but the standard library."""

import re
import shutil
import subprocess
import unittest

from program import SOURCE, ProgramTest, run

HEADERS = sorted((SOURCE / "include" / "carom").glob("*.h"))


class Headers(ProgramTest):
    def test_each_compiles_alone_under_warnings(self):
        compiler = shutil.which("g++")
        self.assertIsNotNone(compiler)
        self.assertGreater(len(HEADERS), 8)
        for header in HEADERS:
            result = subprocess.run(
                [compiler, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion",
                 "-Werror", f"-I{SOURCE / 'include'}", "-x", "c++", "-"],
                input=f"#include <carom/{header.name}>\n", text=True, capture_output=True)
            self.assertEqual((0, ""), (result.returncode, result.stderr), header.name)

    def test_they_include_the_standard_library_and_each_other(self):
        for header in HEADERS:
            for name in re.findall(r"#include [<\"]([^>\"]+)", header.read_text()):
                self.assertTrue(name in {f"carom/{h.name}" for h in HEADERS} or re.fullmatch(r"[a-z_]+", name),
                                f"{header.name}: {name}")
        umbrella = (SOURCE / "include" / "carom" / "carom.h").read_text()
        for header in HEADERS:
            if header.name not in ("carom.h", "export.h"):
                self.assertIn(f"<carom/{header.name}>", umbrella)

    def test_versions_agree(self):
        text = (SOURCE / "include" / "carom" / "version.h").read_text()
        macros = ".".join(re.search(rf"CAROM_VERSION_{part} (\d+)", text)[1] for part in ("MAJOR", "MINOR", "PATCH"))
        self.assertEqual(f"carom {macros}\n", run("--version").stdout)
        project = re.search(r"project\(carom VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]
        self.assertEqual(project, macros)
        self.assertIn(f"## {macros} ", (SOURCE / "CHANGELOG.md").read_text())
        self.assertIn(f"version: {macros}\n", (SOURCE / "CITATION.cff").read_text())

    def test_both_ways_of_packaging_say_the_same(self):
        control = (SOURCE / "debian" / "control").read_text()
        changelog = (SOURCE / "debian" / "changelog").read_text()
        cpack = (SOURCE / "cmake" / "packages.cmake").read_text()
        maintainer = re.search(r"^Maintainer: (.*)$", control, re.M)[1]
        self.assertNotIn(".invalid", maintainer)
        self.assertIn(f"\n -- {maintainer}  ", changelog)
        self.assertIn(f'CPACK_PACKAGE_CONTACT "{maintainer}"', cpack)
        self.assertIn(f"  - name: {maintainer.split(' <')[0]}\n", (SOURCE / "CITATION.cff").read_text())
        program = control.split("Package: carom\n")[1].split("\n\n")[0]
        for field in ("Recommends", "Suggests"):
            names = re.search(rf"^{field}: (.*)$", program, re.M)[1].replace("${carom:Layers}", "${layer_packages}")
            self.assertIn(f'PROGRAM_PACKAGE_{field.upper()} "{names}"', cpack)

    def test_the_example_is_the_one_of_the_documents(self):
        example = (SOURCE / "examples" / "consumer" / "consumer.cpp").read_text()
        document = (SOURCE / "docs" / "library.md").read_text()
        self.assertIn("```cpp\n" + example[example.index("#include <carom"):] + "```", document)
        self.assertLessEqual(len([l for l in example.splitlines() if l.strip()]), 20)


if __name__ == "__main__":
    unittest.main()
