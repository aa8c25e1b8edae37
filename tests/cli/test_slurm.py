"""`carom sweep --slurm`, with a stand-in for sbatch that runs the jobs of an array one after the other."""

import os
import subprocess
import unittest

from program import ProgramTest, run
from test_sweep import MANY, tree

# Writes down how it was called. Runs each task of an array, the second one only after it was killed
# and put back once; a job that depends on others comes after them anyway.
SBATCH = """\
#!/usr/bin/env python3
import os, pathlib, subprocess, sys
folder = pathlib.Path(os.environ["FAKE_SLURM"])
log = folder / "calls"
number = 100 + (len(log.read_text().splitlines()) if log.exists() else 0)
with log.open("a") as file:
    file.write(" ".join(sys.argv[1:]) + "\\n")
full_after = folder / "full-after"
if (folder / "full").exists() or full_after.exists() and number - 100 >= int(full_after.read_text()):
    sys.exit("sbatch: error: no such partition")
options = [a for a in sys.argv[1:] if a.startswith("--")]
script, *rest = [a for a in sys.argv[1:] if not a.startswith("--")]
tasks = [None]
for option in options:
    if option.startswith("--array="):
        first, last = option.split("=")[1].split("-")
        tasks = range(int(first), int(last) + 1)
for task in tasks:
    environment = dict(os.environ)
    if task is not None:
        environment["SLURM_ARRAY_TASK_ID"] = str(task)
    if task == 1:
        process = subprocess.Popen(["bash", script, *rest], env=environment)
        try:
            process.wait(0.05)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
    subprocess.run(["bash", script, *rest], env=environment)
print(number)
"""


class Slurm(ProgramTest):
    def setUp(self):
        super().setUp()
        self.sweep = self.write("my sweep.yaml", MANY)
        tools = self.folder / "bin"
        tools.mkdir()
        (tools / "sbatch").write_text(SBATCH)
        (tools / "sbatch").chmod(0o755)
        (tools / "scontrol").write_text("#!/bin/sh\necho 'MaxArraySize            = 4'\n")
        (tools / "scontrol").chmod(0o755)
        self.environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "FAKE_SLURM": str(self.folder)}

    def carom(self, *options, out="out", environment=None):
        return run("sweep", self.sweep, "-o", self.folder / out, *options, env=environment or self.environment)

    def calls(self):
        return (self.folder / "calls").read_text().splitlines()

    def test_arrays_make_what_one_process_makes(self):
        self.assert_exit(0, self.carom(out="right"))
        result = self.carom("--slurm", "--tasks", "10")
        self.assert_exit(0, result)
        self.assertIn("400 runs in 10 tasks of jobs 100, 101, 102; job 103 writes the index", result.stderr)
        calls = self.calls()
        self.assertEqual(["0-3", "0-3", "0-1"], [c.split("--array=")[1].split()[0] for c in calls[:3]])
        self.assertEqual(["0", "4", "8"], [c.split()[-1] for c in calls[:3]])
        self.assertIn("--dependency=afterany:100:101:102", calls[3])
        made = tree(self.folder / "out")
        scripts = {name for name in made if name.startswith("slurm")}
        self.assertEqual({"slurm", "slurm/array.sh", "slurm/index.sh"}, scripts)
        self.assertEqual(tree(self.folder / "right"), {k: v for k, v in made.items() if k not in scripts})

    def test_print_shows_scripts_that_bash_can_read_and_submits_nothing(self):
        result = self.carom("--slurm", "--print", "--tasks", "7", "--max-array", "5", "--partition", "long", "--time",
                            "1:00:00", "--account", "me", "--jobs", "3", "--set", "title=a 'b'")
        self.assert_exit(0, result)
        self.assertFalse((self.folder / "out").exists())
        for line in ("#SBATCH --partition=long", "#SBATCH --time=1:00:00", "#SBATCH --account=me",
                     "#SBATCH --cpus-per-task=3", "#SBATCH --requeue"):
            self.assertIn(line, result.stdout)
        self.assertIn("--slice \"$(($1 + SLURM_ARRAY_TASK_ID + 1))/7\"", result.stdout)
        self.assertIn("job2=$(sbatch --parsable --array=0-1 ", result.stdout)
        self.assertIn("--dependency=afterany:$job1:$job2 ", result.stdout)
        checked = subprocess.run(["bash", "-n"], input=result.stdout, text=True, capture_output=True)
        self.assertEqual(0, checked.returncode, checked.stderr)
        self.assertFalse((self.folder / "calls").exists())

    def test_slurm_that_is_missing_or_refuses(self):
        result = self.carom("--slurm", environment={**self.environment, "PATH": "/nowhere"})
        self.assert_exit(1, result)
        self.assertIn("sbatch is not here", result.stderr)
        (self.folder / "full").touch()
        result = self.carom("--slurm", "--tasks", "2")
        self.assert_exit(1, result)
        self.assertIn("Slurm has not taken the job", result.stderr)
        self.assertIn("no such partition", result.stderr)

    def test_jobs_that_were_taken_before_one_was_refused_are_named(self):
        (self.folder / "full-after").write_text("2")
        result = self.carom("--slurm", "--tasks", "10")
        self.assert_exit(1, result)
        self.assertIn("submitted before it, and not taken back: 100, 101", result.stderr)

    def test_slices_are_slurms_own(self):
        for more in (["--slice", "1/2"], ["--index"], ["--dry-run"]):
            for slurm in ("--slurm", "--print"):
                self.assert_exit(2, self.carom(slurm, *more))
        self.assert_exit(2, self.carom("--index", "--dry-run"))
        self.assertFalse((self.folder / "calls").exists())

    def test_options_of_slurm_are_refused_without_it(self):
        for option, value in (("--tasks", "5"), ("--max-array", "5"), ("--partition", "p"), ("--time", "1:00"),
                              ("--account", "a")):
            result = self.carom(option, value)
            self.assert_exit(2, result)
            self.assertIn(f"{option} is for --slurm", result.stderr)
            self.assertFalse((self.folder / "out").exists())

    def test_no_name_begins_a_line_of_a_script(self):
        word = "x\ntouch pwned #"
        for options in (["--partition", word], ["--account", word], ["--time", word]):
            self.assert_exit(2, self.carom("--print", *options))
        self.assert_exit(2, self.carom("--print", out=f"{word}/out"))
        self.sweep = self.write("a\nb.yaml", MANY)
        self.assert_exit(2, self.carom("--print"))

    def test_a_folder_with_a_percent_sign_is_no_pattern_of_logs(self):
        result = self.carom("--print", out="at 90%j")
        self.assert_exit(0, result)
        self.assertIn("/at 90%%j/slurm/array-%A_%a.log'", result.stdout)
        self.assertIn(f"-o '{self.folder}/at 90%j' ", result.stdout)

    def test_a_task_of_an_array_knows_its_slice(self):
        task = {**self.environment, "SLURM_ARRAY_TASK_ID": "5", "SLURM_ARRAY_TASK_MIN": "4", "SLURM_ARRAY_TASK_MAX": "7",
                "SLURM_ARRAY_TASK_COUNT": "4"}
        self.assert_exit(0, self.carom("--slice", "auto", environment=task))
        made = [p.name for p in (self.folder / "out" / "runs" / "000").iterdir()]
        self.assertEqual([f"{i:06}" for i in range(100, 200)], sorted(made))
        result = self.carom("--slice", "auto")
        self.assert_exit(2, result)
        self.assertIn("give --slice I/N", result.stderr)


if __name__ == "__main__":
    unittest.main()
