"""The Python module: numbers against closed forms, errors, threads, Ctrl-C, and the examples of docs/python.md.

PYTHONPATH names the folder that has the module; CAROM the program, CAROM_SOURCE_DIR the sources.
"""

import ast
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import carom

SOURCE = pathlib.Path(os.environ["CAROM_SOURCE_DIR"])
os.environ["PYTHONPATH"] = str(pathlib.Path(carom.__file__).resolve().parents[1])  # for other processes
TEXT = """\
carom: 1
simulation: {duration: 1}
materials: {rubber: {restitution: 0.8}}
surfaces: [{name: floor, plane: {normal: [0, 0, 1], offset: 0}}]
balls: [{name: a, radius: 0.1, material: rubber, position: [0, 0, 0.6], spin: [0, 0, 2]}]
film: {size: [64, 36], fps: 10}
"""
LONG = TEXT.replace("duration: 1", "duration: 600").replace("rubber: {restitution: 0.8}", "rubber: {restitution: 1}")


class Module(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.scene = carom.load(TEXT)
        self.motion = carom.simulate(self.scene)

    def test_states_of_any_shape(self):
        times = np.array([[0, 0.1, 0.2], [0.3, 0.05, 0.25]])
        states = self.motion.states(times)
        self.assertEqual((2, 3, 1, 3), states.position.shape)
        np.testing.assert_allclose(states.position[..., 0, 2], 0.6 - 4.905 * times ** 2, atol=1e-14)
        np.testing.assert_allclose(states.velocity[..., 0, 2], -9.81 * times, atol=1e-14)
        np.testing.assert_allclose(states.orientation[..., 0, 0], np.cos(times), atol=1e-14)
        np.testing.assert_allclose(states.orientation[..., 0, 3], np.sin(times), atol=1e-14)
        self.assertEqual((1, 3), self.motion.states(0.3).position.shape)
        self.assertEqual((0, 1, 3), self.motion.states([]).position.shape)
        for wrong in (-1, 1.01, float("nan")):
            with self.assertRaisesRegex(carom.Error, "no instant"):
                self.motion.states(wrong)

    def test_numpy_is_loaded_with_the_first_array(self):
        script = ("import sys, carom\n"
                  "motion = carom.simulate(carom.load(sys.argv[1], set={'balls.a.position': '[0, 0, 0.7]'}))\n"
                  "print('numpy' in sys.modules)\nmotion.states(0.1)\nprint('numpy' in sys.modules)\n"
                  "from carom import *\nprint(EVENT_DTYPE.names[0], 'EVENT_DTYPE' in dir(carom))\n")
        self.assertEqual("False\nTrue\ntime True\n", subprocess.run(
            [sys.executable, "-c", script, TEXT], check=True, capture_output=True, text=True).stdout)
        with self.assertRaisesRegex(AttributeError, "no attribute 'stil'"):
            carom.stil

    def test_fits_of_numbers_and_of_lists(self):
        for drops, rebounds in ((1.8, 1.3), ([1.8], [1.3]), (np.array(1.8), np.array([1.3])), ((1.8,), iter([1.3]))):
            self.assertAlmostEqual((1.3 / 1.8) ** 0.5, carom.fit(drops, rebounds).restitution, places=3)

    def test_arrays_outlive_the_motion(self):
        states = carom.simulate(self.scene).states([0, 0.1]).position
        np.testing.assert_allclose(states[:, 0, 2], [0.6, 0.6 - 0.04905])

    def test_events_are_a_structured_array(self):
        events = self.motion.events
        self.assertEqual(carom.EVENT_DTYPE, events.dtype)
        impacts = events[events["kind"] == "impact"]
        self.assertAlmostEqual(np.sqrt(1 / 9.81), impacts["time"][0], places=14)
        np.testing.assert_allclose(impacts["normal"], [[0, 0, 1]] * len(impacts))
        np.testing.assert_allclose(impacts["restitution"], 0.8)
        empty = carom.simulate(carom.load(TEXT, set={"simulation.duration": 0.1})).events
        self.assertEqual((0,), empty.shape)

    def test_the_same_as_the_program(self):
        path = self.folder / "s.yaml"
        path.write_text(TEXT)
        scene = carom.load(path, set={"balls.a.position": "[0, 0, 0.7]"})
        motion = carom.simulate(scene)
        values = carom.load(path, set={"balls.a.position": np.array([0, 0, 0.7])})
        self.assertEqual(motion.hash, carom.simulate(values).hash)
        setting = ["--set", "balls.a.position=[0, 0, 0.7]"]
        program = os.environ["CAROM"]
        stats = subprocess.run([program, "simulate", path, "-o", "/dev/null", "--stats", "-", *setting], check=True,
                               capture_output=True, text=True).stdout
        self.assertIn(f"{motion.hash:016x}", stats)
        self.assertEqual(10, carom.film(scene, motion, self.folder / "a.mp4"))
        subprocess.run([program, "render", path, "-o", self.folder / "b.mp4", "-q", *setting], check=True)
        self.assertEqual((self.folder / "b.mp4").read_bytes(), (self.folder / "a.mp4").read_bytes())
        carom.film(scene, motion, self.folder / "A")
        subprocess.run([program, "render", path, "-o", self.folder / "B", "-q", *setting], check=True)
        for name in sorted(p.name for p in (self.folder / "B").iterdir()):
            self.assertEqual((self.folder / "B" / name).read_bytes(), (self.folder / "A" / name).read_bytes())
        picture = carom.read_png(self.folder / "B" / "frame_00003.png")
        self.assertTrue(np.array_equal(picture, carom.still(scene, motion, 0.3)))

    def test_two_runs_are_those_of_the_program(self):
        program, path = os.environ["CAROM"], self.folder / "s.yaml"
        change = {"balls.a.position": [0, 0, 0.7]}
        for view in ("ghost", "side"):
            key = f"against: {{set: ['balls.a.position=[0, 0, 0.7]'], view: {view}}}\n"
            path.write_text(TEXT + key)
            subprocess.run([program, "still", path, "--time", "0.3", "-o", self.folder / "p.png", "-y"], check=True)
            wanted = carom.read_png(self.folder / "p.png")
            named = carom.load(path)
            self.assertTrue(np.array_equal(wanted, carom.still(named, self.motion, 0.3)))
            run = carom.second_run(named)
            self.assertEqual(view, run.view)
            path.write_text(TEXT)  # the same file, as its second run is named by it
            plain, other = carom.load(path), carom.load(path, set=change)
            given = carom.Against(other, carom.simulate(other), view)
            self.assertEqual(run.motion.hash, given.motion.hash)
            self.assertTrue(np.array_equal(wanted, carom.still(plain, self.motion, 0.3, against=given)))
            path.write_text(TEXT + key)
            subprocess.run([program, "render", path, "-o", self.folder / f"P{view}", "-q"], check=True)
            self.assertEqual(10, carom.film(named, self.motion, self.folder / f"F{view}", against=run))
            for name in sorted(p.name for p in (self.folder / f"P{view}").iterdir()):
                self.assertEqual((self.folder / f"P{view}" / name).read_bytes(),
                                 (self.folder / f"F{view}" / name).read_bytes())
        self.assertIsNone(carom.second_run(self.scene))
        with self.assertRaises(ValueError):
            carom.still(self.scene, self.motion, 0, against=(self.scene, self.motion, "beside"))
        strange = carom.load(TEXT.replace("name: a,", "name: b,"))
        for wrong in ((strange, self.motion), (strange, carom.simulate(strange))):
            with self.assertRaises(carom.Error):
                carom.still(self.scene, self.motion, 0, against=wrong)

    def test_layers_are_those_of_the_program(self):
        program, path = os.environ["CAROM"], self.folder / "s.yaml"
        path.write_text(TEXT)
        names = ["depth", "distance", "segmentation", "normals", "flow", "backflow", "coordinates"]
        found = carom.layers(self.scene, self.motion, 0.3, names)
        self.assertEqual(names, list(found))
        for name, layer in found.items():
            channels = () if name in ("depth", "distance", "segmentation") else (3,)
            self.assertEqual((36, 64, *channels), layer.shape, name)
            self.assertEqual(np.uint16 if name == "segmentation" else np.float32, layer.dtype)
        self.assertEqual({0, 1, 2}, set(np.unique(found["segmentation"])))
        ball = found["segmentation"] == 1
        np.testing.assert_allclose(np.linalg.norm(found["normals"][ball], axis=-1), 1, atol=1e-6)
        np.testing.assert_allclose(np.linalg.norm(found["coordinates"][ball], axis=-1), 0.1, atol=1e-6)
        # The files of film() are those of the program, byte for byte.
        subprocess.run([program, "render", path, "-o", self.folder / "P", "-q", "--layers", ",".join(names)],
                       check=True)
        carom.film(self.scene, self.motion, self.folder / "F", layers=names)
        files = sorted(p.name for p in (self.folder / "P").iterdir())
        self.assertEqual(10 * (1 + len(names)) + 1, len(files))
        for name in files:
            self.assertEqual((self.folder / "P" / name).read_bytes(), (self.folder / "F" / name).read_bytes(), name)
        for wrong in (["deep"], ["depth", "depth"]):
            with self.assertRaises(carom.Error):
                carom.layers(self.scene, self.motion, 0.3, wrong)
        with self.assertRaises(carom.Error):
            carom.layers(self.scene, self.motion, 0.3, "depth", against=(self.scene, self.motion, "side"))
        with self.assertRaises(carom.Error):
            carom.film(self.scene, self.motion, self.folder / "f.mp4", layers="depth")

    def test_pictures_of_every_shape(self):
        grey = np.arange(12, dtype=np.uint8).reshape(3, 4)
        for picture in (grey, np.dstack([grey] * 3), np.dstack([grey] * 3 + [np.full_like(grey, 255)])):
            carom.write_png(self.folder / "p.png", picture)
            self.assertTrue(np.array_equal(np.dstack([grey] * 3), carom.read_png(self.folder / "p.png")[..., :3]))
            self.assertTrue(carom.compare(picture, grey).same(0, 0))
        turned = np.dstack([grey] * 3).transpose(1, 0, 2)  # rows are not one after the other
        self.assertTrue(carom.compare(turned, np.ascontiguousarray(turned)).same(0, 0))
        self.assertFalse(carom.compare(grey, grey[:2]).same_size)
        for wrong in (np.zeros((2, 2)), np.zeros(3, np.uint8), np.zeros((2, 2, 2), np.uint8)):
            with self.assertRaises((TypeError, ValueError)):
                carom.compare(wrong, wrong)

    def test_errors_have_their_diagnostics(self):
        with self.assertRaises(carom.SceneError) as caught:
            carom.load("carom: 1\nbals: []\nsimulation: {duration: x}\n")
        self.assertEqual([(2, 1), (3, 24)], [(d.line, d.column) for d in caught.exception.diagnostics])
        self.assertIn("    2 | bals: []\n      | ^~~~", str(caught.exception))
        self.assertIsInstance(caught.exception, carom.Error)
        with self.assertRaises(carom.Error):
            carom.load(self.folder / "nowhere.yaml")
        (self.folder / "f.mkv").write_text("mine")
        with self.assertRaisesRegex(carom.Error, "exists"):
            carom.film(self.scene, self.motion, self.folder / "f.mkv")
        self.assertEqual("mine", (self.folder / "f.mkv").read_text())

    def test_what_progress_raises_comes_through(self):
        def stop(done):
            raise LookupError(f"enough at {done}")
        with self.assertRaisesRegex(LookupError, "enough at"):
            carom.film(self.scene, self.motion, self.folder / "f.mkv", progress=stop)
        self.assertEqual([], list(self.folder.iterdir()))

    def test_other_threads_run_meanwhile(self):
        counted = 0
        done = threading.Event()

        def count():
            nonlocal counted
            while not done.is_set():
                counted += 1
                time.sleep(0.001)
        thread = threading.Thread(target=count)
        thread.start()
        carom.film(self.scene, self.motion, self.folder / "f.mkv", quality="draft")
        done.set()
        thread.join()
        self.assertGreater(counted, 10)

    def test_ctrl_c_ends_long_work_and_leaves_nothing(self):
        script = (f"import carom\nscene = carom.load({LONG!r})\nprint('begins', flush=True)\n"
                  "motion = carom.simulate(scene)\n"
                  "try:\n    carom.film(scene, motion, 'f.mkv', progress=lambda n: print(n, flush=True))\n"
                  "except KeyboardInterrupt:\n    print('interrupted')\n")
        process = subprocess.Popen([sys.executable, "-c", script], cwd=self.folder, stdout=subprocess.PIPE, text=True)
        self.assertEqual("begins\n", process.stdout.readline())
        process.stdout.readline()  # a frame is written
        process.send_signal(signal.SIGINT)
        rest, _ = process.communicate(timeout=60)
        self.assertEqual("interrupted", rest.splitlines()[-1])
        self.assertEqual([], list(self.folder.iterdir()))

    def test_the_stubs_have_every_name(self):
        stubs = ast.parse((pathlib.Path(carom.__file__).parent / "__init__.pyi").read_text())
        names = {n.name for n in stubs.body if isinstance(n, (ast.ClassDef, ast.FunctionDef))}
        names |= {n.target.id for n in stubs.body if isinstance(n, ast.AnnAssign)}
        self.assertEqual(set(), set(carom.__all__) - names)
        classes = {n.name: {m.name for m in n.body if isinstance(m, ast.FunctionDef)}
                   for n in stubs.body if isinstance(n, ast.ClassDef)}
        for kind in (carom.Scene, carom.Motion, carom.Diagnostic):
            public = {n for n in dir(kind) if not n.startswith("_")}
            self.assertEqual(public, classes[kind.__name__], kind)

    def test_the_examples_of_the_documents_run(self):
        text = (SOURCE / "docs" / "python.md").read_text()
        blocks = re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)
        self.assertGreaterEqual(len(blocks), 6)
        result = subprocess.run([sys.executable, "-c", "\n".join(blocks)], cwd=self.folder, text=True,
                                capture_output=True, timeout=300)
        self.assertEqual("", result.stderr)
        self.assertEqual({"still.png", "film.mp4", "two.mp4", "frames"}, {p.name for p in self.folder.iterdir()})


if __name__ == "__main__":
    unittest.main()
