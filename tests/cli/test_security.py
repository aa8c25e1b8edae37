"""Names and working folders that want something else than to be names and working folders."""

import os
import pathlib
import re
import shutil
import subprocess
import unittest

from program import CAROM, SMALL_SCENE, ProgramTest, run

# Each would make a file `pwned` in the working folder, were it run, or move the cursor, were it printed raw.
HOSTILE = ["$(touch pwned)", "`touch pwned`", "; touch pwned;", "| touch pwned", "'; touch pwned; '", '"; touch pwned; "',
           "a\ntouch pwned\n", '"; system("touch pwned"); "', "@'touch pwned'", "{touch,pwned}", "%s%n%n%n%999999999d",
           "{0} {} {:999999999}", "\x1b[31m\x1b]0;pwned\x07", "\u202epwned", "<script>pwned<!--", "-o pwned", "--help",
           "..", "a\\b", "~", "*", "\xff".encode("latin-1").decode("utf-8", "surrogateescape")]

SOURCE_OF_A_LIBRARY = """\
#include <fcntl.h>
__attribute__((constructor)) static void pwn(void) { open("%s", O_CREAT, 0600); }
"""


class Names(ProgramTest):
    def setUp(self):
        super().setUp()
        self.cwd = self.folder / "cwd"
        self.cwd.mkdir()

    def run_here(self, *words):
        result = run(*words, cwd=self.cwd, text=False)
        said = result.stderr.decode(errors="replace")
        self.assertIn(result.returncode, (0, 1, 2, 3, 4, 5), said)
        self.assertFalse(list(self.folder.rglob("pwned")), words)
        self.assertIsNone(re.search("[\x00-\x08\x0b-\x1f\x7f\u202a-\u202e]", said.replace("\r\n", "\n")), repr(said))
        return result

    def test_files_with_hostile_names_are_files(self):
        """As scenes, outputs and folders, in every command that takes names."""
        done = 0
        for name in HOSTILE:
            scene = self.cwd / f"{name}.yaml"
            scene.write_text(SMALL_SCENE)
            with self.subTest(name=name):
                path = f"./{name}"
                for words in (["check", f"{path}.yaml"], ["check", f"{path}.nothing"],
                              ["simulate", f"{path}.yaml", "-o", f"{path}.csv", "--stats", f"{path}.json"],
                              ["simulate", f"{path}.yaml", "-o", f"{path}.csv"],  # it exists
                              ["simulate", f"{path}.yaml", "-o", f"{path}/m.csv"],  # no such folder
                              ["still", f"{path}.yaml", "--time", "0.1", "-o", f"{path}.png", "--size", "16x16"],
                              ["golden", "check", f"{path}.yaml", "--dir", path, "--time", "0.1", "--size", "16x16"],
                              ["compare", f"{path}.png", f"{path}.nothing"],
                              ["fit", "--csv", f"{path}.yaml"],
                              ["check", f"{path}.yaml", "--set", f"{name}=1"],
                              ["check", f"{path}.yaml", "--set", f"balls.a.mass={name}"],
                              ["check", f"{path}.yaml", "--set", f"title={name}"],
                              ["new", f"{path}.new.yaml"],
                              ["new", "x", "--like", name],
                              [name]):
                    self.run_here(*words)
                    done += 1
            scene.unlink()
        print(f"    {done} runs")
        self.assertGreater(done, 300)

    def test_plots_run_nothing(self):
        text = SMALL_SCENE.replace("carom: 1", 'carom: 1\ntitle: %s').replace("duration: 0.5", "duration: 0.2")
        (self.cwd / ".gnuplot").write_text('system("touch pwned")\n')
        for name in ("'\"; system(\"touch pwned\"); \"'", "'`touch pwned`'", "'@x ; !touch pwned'",
                     "'{/*99999 x} ^_{&{x}}%n\\n\\'' system(\"touch pwned\")'"):
            scene = self.cwd / f"{name.replace('/', '_')}.yaml"
            scene.write_text(text % name if name.count("'") == 2 else text % "x")
            self.run_here("accuracy", f"./{scene.name}", "-o", "out", "-y", "--steps", "0.01", "--repeats", "1")
            self.run_here("fit", "--drop", "1.8", "--rebound", "1.3", "--name", name, "-o", "p.svg", "-y")

    def test_a_script_of_slurm_runs_nothing_of_a_name(self):
        tools = self.folder / "tools"
        tools.mkdir()
        for tool in ("sbatch", "scontrol", "carom"):
            (tools / tool).write_text("#!/bin/sh\necho 1\n")
            (tools / tool).chmod(0o755)
        tried = 0
        for name in HOSTILE:
            if "\n" in name or "\udcff" in name:
                continue
            (self.cwd / "base.yaml").write_text(SMALL_SCENE)
            sweep = self.cwd / f"{name}.yaml"
            sweep.write_text("base: base.yaml\naxes: {balls.a.mass: [1, 2]}\n")
            out = f"./out{name}"
            result = self.run_here("sweep", f"./{name}.yaml", "-o", out, "--slurm", "--print")
            if result.returncode != 0:
                continue
            script = self.cwd / "script.sh"
            script.write_bytes(result.stdout)
            # bash reads all of it and runs what it would run, with tools that do nothing.
            subprocess.run(["bash", script], cwd=self.cwd, capture_output=True, timeout=60,
                           env={"PATH": f"{tools}:/usr/bin:/bin", "SLURM_ARRAY_TASK_ID": "0"})
            self.assertFalse(list(self.folder.rglob("pwned")), name)
            tried += 1
        print(f"    {tried} scripts")
        self.assertGreater(tried, 5)


class WorkingFolder(ProgramTest):
    def test_no_library_and_no_program_comes_from_it(self):
        """Libraries that are loaded late, and gnuplot, have the names of files in the working folder."""
        cwd = self.folder / "cwd"
        cwd.mkdir()
        mark = self.folder / "loaded"
        source = self.folder / "l.c"
        source.write_text(SOURCE_OF_A_LIBRARY % mark)
        library = self.folder / "l.so"
        compiler = next(c for c in ("cc", "gcc", "clang") if shutil.which(c))
        subprocess.run([compiler, "-shared", "-fPIC", "-o", library, source], check=True)
        names = [f"lib{n}.so.{v}" for n in ("OSMesa", "EGL", "avcodec", "avformat", "avutil", "swscale", "OpenEXR-3_1",
                                            "deflate", "gallium", "Imath-3_1") for v in ("0", "1", "6", "7", "8", "29", "57",
                                                                                        "58", "59", "60")]
        for name in names + [n.split(".so")[0] + ".so" for n in names] + ["libOpenEXR-3_1.so.30", "libdeflate.so.0"]:
            shutil.copy(library, cwd / name)
        (cwd / "gnuplot").write_text(f"#!/bin/sh\ntouch {mark}\n")
        (cwd / "gnuplot").chmod(0o755)
        for words in (["render", self.scene, "-o", "f.mp4"], ["still", self.scene, "--time", 0.1, "-o", "s.png"],
                      ["still", self.scene, "--time", 0.1, "-o", "l.png", "--layers", "depth"],
                      ["render", self.scene, "-o", "frames/"], ["fit", "--drop", 1.8, "--rebound", 1.3, "-o", "p.svg"],
                      ["render", self.scene, "-o", "g.mp4", "--backend", "egl"], ["info"]):
            result = run(*words, cwd=cwd)
            self.assertIn(result.returncode, (0, 1), result.stderr)
            self.assertFalse(mark.exists(), words)

    def test_temporaries_are_nobody_elses(self):
        """A link that stands under the name of a temporary file is not followed, a folder for work is the user's."""
        target = self.folder / "precious"
        target.write_text("mine")
        process = subprocess.Popen(["/bin/sh", "-c", 'echo $$; read line; exec "$0" "$@"', CAROM, "simulate",
                                    str(self.scene), "-o", str(self.folder / "m.csv")], stdin=subprocess.PIPE,
                                   stdout=subprocess.PIPE, text=True)
        number = int(process.stdout.readline())
        link = self.folder / f".m.tmp{number}.csv"
        link.symlink_to(target)
        process.communicate("\n")
        self.assertEqual(0, process.returncode)
        self.assertEqual("mine", target.read_text())
        self.assertTrue(link.is_symlink())
        self.assertTrue((self.folder / "m.csv").stat().st_size > 100)


class Hardening(ProgramTest):
    def test_the_program_is_built_to_be_hard_to_break(self):
        def read(*options):
            return subprocess.run(["readelf", "-W", *options, CAROM], capture_output=True, text=True, check=True).stdout
        self.assertRegex(read("-h"), r"Type: +DYN")
        self.assertIn("GNU_RELRO", read("-l"))
        self.assertRegex(read("-l"), r"GNU_STACK.*RW ")
        self.assertRegex(read("-d"), "BIND_NOW|FLAGS.*NOW")
        self.assertNotRegex(read("-d"), "RPATH|RUNPATH")


if __name__ == "__main__":
    unittest.main()
