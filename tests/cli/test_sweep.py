"""`carom sweep`: what it makes, what it makes again, and that nothing but the file decides it."""

import csv
import hashlib
import json
import os
import pathlib
import signal
import subprocess
import time
import unittest

import jsonschema
import yaml

from program import CAROM, SOURCE, ProgramTest, run

NUMBERS = """\
base: scene.yaml
axes:
  balls.a.position[2]: {from: 0.6, to: 1.6, steps: 3}
  materials.rubber.restitution: [0.5, 0.9]
results:
  fall: impact_time("a", 1)
  top: peak("a", 1)
outputs: {motion: true, events: true, stats: true, scene: true}
"""
PICTURES = """\
base: scene.yaml
axes:
  balls.a.radius: [0.05, 0.1, 0.15, 0.2, 0.25, 0.3]
  film.size: {choice: [[64, 64]]}
outputs: {film: mp4, frames: true, stills: [0.1, 0.2], layers: [depth, segmentation]}
"""
MANY = """\
base: scene.yaml
mode: random
count: 400
seed: 3
axes:
  balls.a.mass: {uniform: [1, 2]}
random:
  balls:
    - {count: {integer: [0, 4]}, region: {from: [-1, -1, 0], to: [1, 1, 3]}, each: {radius: {uniform: [0.05, 0.2]}}}
results: {n: balls, hits: impacts("*")}
outputs: {events: true}
"""


def tree(folder):
    """Each file's bytes, by its path; folders that are empty too."""
    return {str(p.relative_to(folder)): hashlib.sha256(p.read_bytes()).hexdigest() if p.is_file() else "folder"
            for p in sorted(folder.rglob("*"))}


def stamps(folder):
    """What changes when a run is made again."""
    return {str(p.relative_to(folder)): (p.stat().st_ino, p.stat().st_mtime_ns)
            for p in folder.rglob("*") if p.is_file()}


class SweepTest(ProgramTest):
    def sweep(self, text, *options, name="sweep.yaml", out="out", code=0):
        result = run("sweep", self.write(name, text), "-o", self.folder / out, *options)
        self.assert_exit(code, result)
        return result

    def index(self, out="out"):
        with open(self.folder / out / "index.csv", newline="") as file:
            return list(csv.DictReader(file))


class WhatItMakes(SweepTest):
    def test_a_grid_has_a_row_and_a_folder_for_each_run(self):
        self.sweep(NUMBERS)
        rows = self.index()
        self.assertEqual([str(i) for i in range(6)], [row["run"] for row in rows])
        self.assertEqual({"done"}, {row["status"] for row in rows})
        for row in rows:
            drop = float(row["balls.a.position[2]"]) - 0.1
            if drop < 1.2:  # it falls within the half second
                self.assertAlmostEqual((2 * drop / 9.81) ** 0.5, float(row["fall"]), places=12)
            else:
                self.assertEqual("", row["fall"])
            folder = self.folder / "out" / "runs" / "000" / f"{int(row['run']):06}"
            self.assertEqual(["events.csv", "motion.csv", "run.json", "scene.yaml", "stats.json"],
                             sorted(p.name for p in folder.iterdir()))
            record = json.loads((folder / "run.json").read_text())
            self.assertEqual(row["motion_hash"], record["motion_hash"])
            self.assertEqual(row["motion_hash"], json.loads((folder / "stats.json").read_text())["motion_hash"])
            for name, file in record["files"].items():
                self.assertEqual((folder / name).stat().st_size, file["bytes"])
        dataset = json.loads((self.folder / "out" / "dataset.json").read_text())
        self.assertEqual((6, 6, 0, 0), tuple(dataset[k] for k in ("runs", "done", "failed", "seed")))
        self.assertIn("ode", json.dumps(dataset["versions"]).lower())

    def test_runs_are_what_simulate_and_render_make(self):
        self.sweep(NUMBERS)
        self.sweep(PICTURES, name="pictures.yaml", out="pictures")
        one = self.folder / "out" / "runs" / "000" / "000003"
        values = ["--set", "balls.a.position[2]=1.1", "--set", "materials.rubber.restitution=0.9"]
        motion, events = self.folder / "m.csv", self.folder / "e.csv"
        self.assert_exit(0, run("simulate", self.scene, *values, "-o", motion, "--events", events))
        self.assertEqual(motion.read_bytes(), (one / "motion.csv").read_bytes())
        self.assertEqual(events.read_bytes(), (one / "events.csv").read_bytes())
        self.assert_exit(0, run("simulate", one / "scene.yaml", "-o", motion, "-y"))
        self.assertEqual(motion.read_bytes(), (one / "motion.csv").read_bytes())

        one = self.folder / "pictures" / "runs" / "000" / "000003"
        values = ["--set", "balls.a.radius=0.2", "--size", "64x64"]
        film, frames = self.folder / "f.mp4", self.folder / "frames"
        self.assert_exit(0, run("render", self.scene, *values, "-o", film, "-o", frames, "--threads", "1",
                                "--layers", "depth,segmentation"))
        self.assertEqual(film.read_bytes(), (one / "film.mp4").read_bytes())
        names = sorted(p.name for p in frames.iterdir())
        self.assertEqual(names, sorted(p.name for p in (one / "frames").iterdir()))
        self.assertEqual(31, len(names))
        for name in filter(lambda n: n != "layers.json", names):
            self.assertEqual((frames / name).read_bytes(), (one / "frames" / name).read_bytes(), name)
        still = self.folder / "s.png"
        self.assert_exit(0, run("still", self.scene, *values, "--time", "0.2", "-o", still))
        self.assert_exit(0, run("compare", still, one / "still_001.png", "--tolerance", "0"))

    def test_neither_jobs_nor_slices_nor_order_change_a_byte(self):
        self.sweep(MANY, "--jobs", 1)
        self.sweep(MANY, "--jobs", 5, out="five")
        for part in (3, 1, 2):
            self.sweep(MANY, "--slice", f"{part}/3", out="parts")
        self.assertFalse((self.folder / "parts" / "index.csv").exists())
        self.sweep(MANY, "--index", out="parts")
        self.assertEqual(tree(self.folder / "out"), tree(self.folder / "five"))
        self.assertEqual(tree(self.folder / "out"), tree(self.folder / "parts"))
        self.assertGreater(len(set(row["motion_hash"] for row in self.index())), 390)

    def test_set_changes_the_base(self):
        self.sweep(NUMBERS, "--set", "simulation.duration=2")
        self.assertTrue(all(row["fall"] for row in self.index()))

    def test_a_pattern_of_gnu_parallel_makes_the_whole(self):
        self.sweep(MANY)
        line = f"seq 4 | parallel {CAROM} sweep {self.folder}/sweep.yaml -o {self.folder}/p -q --jobs 1 --slice {{}}/4"
        done = subprocess.run(line, shell=True, capture_output=True, text=True)
        self.assertEqual(0, done.returncode, done.stderr)
        self.sweep(MANY, "--index", out="p")
        self.assertEqual(tree(self.folder / "out"), tree(self.folder / "p"))


class MadeAgain(SweepTest):
    def test_what_is_there_stays_and_what_is_missing_or_changed_is_made(self):
        self.sweep(NUMBERS)
        before, whole = stamps(self.folder / "out"), tree(self.folder / "out")
        self.assertIn("0 runs made, 6 were there", self.sweep(NUMBERS).stderr)
        self.assertEqual(before, stamps(self.folder / "out"))

        runs = self.folder / "out" / "runs" / "000"
        (runs / "000002" / "events.csv").unlink()
        (runs / "000004" / "run.json").write_text("{}")
        self.assertIn("2 runs made, 4 were there", self.sweep(NUMBERS).stderr)
        self.assertEqual(whole, tree(self.folder / "out"))
        after = stamps(self.folder / "out")
        same = {name for name in before if before[name] == after[name]}
        self.assertEqual({"000002", "000004"}, {name.split("/")[2] for name in set(before) - same})

        # One value of an axis: half of the runs.
        changed = self.sweep(NUMBERS.replace("[0.5, 0.9]", "[0.5, 0.8]"))
        self.assertIn("3 runs made, 3 were there", changed.stderr)
        self.assertIn("6 runs made", self.sweep(NUMBERS.replace("stats: true, ", "")).stderr)
        self.assertIn("0 runs made", self.sweep("# said otherwise\n" + NUMBERS.replace("stats: true, ", "")).stderr)

    def test_more_draws_leave_the_first_ones(self):
        self.sweep(MANY.replace("400", "20"))
        before = stamps(self.folder / "out" / "runs")
        self.assertIn("10 runs made, 20 were there", self.sweep(MANY.replace("400", "30")).stderr)
        after = stamps(self.folder / "out" / "runs")
        self.assertEqual(before, {name: after[name] for name in before})

    def kill_at(self, text, seconds, out, sweeps=()):
        process = subprocess.Popen([CAROM, "sweep", self.write("sweep.yaml", text), "-o", self.folder / out, "--progress",
                                    "none", *sweeps], stderr=subprocess.DEVNULL, start_new_session=True)
        time.sleep(seconds)
        killed = process.poll() is None
        process.kill()
        process.wait()
        return killed

    def killed_again_and_again(self, text, steps):
        self.sweep(text, out="right")
        right = tree(self.folder / "right")
        seconds, killed, finished_before = 0.02, 0, {}
        for _ in range(60):
            was_killed = self.kill_at(text, seconds, "out")
            # A worker dies with its process, but not in the same moment.
            time.sleep(0.05)
            killed += was_killed
            runs = self.folder / "out" / "runs"
            now = {str(p): p.stat().st_ino for p in runs.rglob("run.json") if ".tmp-" not in str(p)}
            for name, inode in finished_before.items():
                self.assertEqual(inode, now.get(name), f"{name} was made again")
            finished_before = now
            if not was_killed:
                break
            seconds *= steps
        self.assertGreaterEqual(killed, 3)
        self.sweep(text)
        self.assertEqual(right, tree(self.folder / "out"))

    def test_kills_change_nothing_of_numbers(self):
        self.killed_again_and_again(MANY.replace("400", "3000"), 1.3)

    def test_kills_change_nothing_of_pictures(self):
        self.killed_again_and_again(PICTURES, 1.5)

    def test_an_interrupt_leaves_whole_runs_only(self):
        text = MANY.replace("400", "100000")
        process = subprocess.Popen([CAROM, "sweep", self.write("sweep.yaml", text), "-o", self.folder / "out"],
                                   stderr=subprocess.PIPE, text=True)
        while not any((self.folder / "out").rglob("run.json")):
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=60)
        self.assertEqual(130, process.returncode, said)
        self.assertRegex(said, r"interrupted after \d+ of 100000 runs")
        self.assertEqual([], [p for p in (self.folder / "out").rglob(".*")])

    def test_a_worker_that_dies_takes_its_run_alone(self):
        text = PICTURES.replace("[0.05, 0.1, 0.15, 0.2, 0.25, 0.3]", "{from: 0.05, to: 0.3, steps: 30}")
        process = subprocess.Popen([CAROM, "sweep", self.write("sweep.yaml", text), "-o", self.folder / "out", "--jobs",
                                    "2"], stderr=subprocess.PIPE, text=True)
        while not any((self.folder / "out").rglob("run.json")):
            time.sleep(0.01)
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
        os.kill(int(children[0]), signal.SIGKILL)
        _, said = process.communicate(timeout=300)
        self.assertEqual(1, process.returncode, said)
        failed = [row for row in self.index() if row["status"] == "failed"]
        self.assertEqual(1, len(failed), said)
        self.assertIn("signal 9", failed[0]["reason"])
        self.assertIn("1 runs made, 29 were there", self.sweep(text).stderr)
        self.assertEqual({"done"}, {row["status"] for row in self.index()})


class WhatGoesWrong(SweepTest):
    OVERLAP = """\
base: scene.yaml
axes: {"balls.a.position[2]": [0.5, 0.05, 0.6, -1, 0.7]}
"""

    def test_failed_runs_are_listed_and_do_not_stop_the_rest(self):
        result = self.sweep(self.OVERLAP, code=1)
        rows = self.index()
        self.assertEqual(["done", "invalid", "done", "invalid", "done"], [row["status"] for row in rows])
        self.assertIn("overlap", rows[1]["reason"])
        self.assertIn("run 1 invalid: ", result.stderr)
        again = self.sweep(self.OVERLAP, code=1)
        self.assertIn("0 runs made, 5 were there", again.stderr)

    def test_a_slice_names_those_of_its_own_that_failed_again_too(self):
        for _ in range(2):
            result = self.sweep(self.OVERLAP, "--slice", "1/2", code=1)
            self.assertIn("run 1 invalid: ", result.stderr)
            self.assertNotIn("run 3", result.stderr)
        self.sweep(self.OVERLAP.replace("-1", "0.9"), "--slice", "5/5", out="right")

    def test_fail_fast_begins_no_more(self):
        self.sweep(self.OVERLAP, "--fail-fast", "--jobs", 1, code=1)
        self.assertEqual(["done", "invalid", "missing", "missing", "missing"], [row["status"] for row in self.index()])

    def test_a_run_that_cannot_be_made_is_failed_with_its_reason(self):
        result = self.sweep("base: scene.yaml\noutputs: {stills: [0.6]}\naxes: {simulation.duration: [0.5, 1], "
                            "film.size: {choice: [[32, 32]]}}\n", code=1)
        self.assertIn("run 0 failed: no still at 0.6 s", result.stderr)
        self.assertEqual(["failed", "done"], [row["status"] for row in self.index()])

    def test_mistakes_of_the_file_and_of_names(self):
        result = self.sweep("base: scene.yaml\naxes: {balls.a.mas: [1]}\n", code=3)
        self.assertRegex(result.stderr, r"sweep.yaml:2:8: error: unknown key 'mas'; did you mean 'mass'\?")
        self.sweep("base: none.yaml\n", code=2)
        self.write("sweep.yaml", "base: '-'\n")
        self.assert_exit(2, run("sweep", "sweep.yaml", "-o", "out", input=self.scene.read_text(), cwd=self.folder))
        self.assert_exit(2, run("sweep", self.folder / "none.yaml", "-o", self.folder / "out"))
        self.assert_exit(2, run("sweep", "-", "-o", self.folder / "out", input=NUMBERS))
        self.assert_exit(2, run("sweep", self.scene))
        (self.folder / "mine").mkdir()
        (self.folder / "mine" / "index.csv").write_text("my own\n")
        self.sweep(NUMBERS, out="mine", code=4)
        self.assertEqual("my own\n", (self.folder / "mine" / "index.csv").read_text())
        self.sweep(NUMBERS, "--slice", "4/3", out="not made", code=2)
        self.assertFalse((self.folder / "not made").exists())
        self.sweep(NUMBERS, out="scene.yaml", code=4)

    def test_against_is_refused_where_pictures_are_made(self):
        self.scene.write_text(self.scene.read_text() + "against: {set: ['simulation.method=fixed']}\n")
        self.assertIn("take 'against' out", self.sweep(PICTURES, code=3).stderr)


class DryRun(SweepTest):
    def test_lists_the_runs_and_says_what_they_take(self):
        result = self.sweep(NUMBERS, "--dry-run")
        lines = result.stdout.splitlines()
        self.assertEqual(7, len(lines))
        self.assertEqual("runs/000/000001 balls.a.position[2]=0.6 materials.rubber.restitution=0.9", lines[1])
        self.assertRegex(lines[6], r"^6 runs, about .* at once, about .*B on disk; of 5 runs each took .* ms of a processor")
        self.assertFalse((self.folder / "out").exists())

    def test_of_a_hundred_thousand_runs(self):
        result = self.sweep(MANY.replace("400", "100000"), "--dry-run", "--jobs", 2)
        self.assertEqual(100001, len(result.stdout.splitlines()))
        self.assertTrue(result.stdout.splitlines()[-1].startswith("100000 runs, about "))


class WithTheProgram(ProgramTest):
    def test_the_schema_takes_the_sweeps_that_come_with_carom(self):
        schema = json.loads(run("schema", "sweep").stdout)
        validator = jsonschema.Draft202012Validator(schema)
        files = sorted((SOURCE / "scenes" / "sweeps").glob("*.yaml"))
        self.assertGreaterEqual(len(files), 2)
        for path in files:
            validator.validate(yaml.safe_load(path.read_text()))
            result = run("sweep", path, "-o", self.folder / path.stem, "--dry-run", "--slice", "1/20")
            self.assert_exit(0, result)
        self.assertFalse(validator.is_valid({"base": "a.yaml", "axis": {}}))
        self.assertFalse(validator.is_valid({"base": "a.yaml", "axes": {"a": {"uniform": [1, 2, 3]}}}))
        self.assertFalse(validator.is_valid({"axes": {}}))

    def test_the_reference_stands_in_the_docs(self):
        text = (SOURCE / "docs" / "sweeps.md").read_text()
        part = text.split("<!-- reference:begin -->\n")[1].split("<!-- reference:end -->")[0]
        self.assertEqual(part, run("schema", "sweep", "--reference").stdout)


if __name__ == "__main__":
    unittest.main()
