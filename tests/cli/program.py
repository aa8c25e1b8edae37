"""Runs the program as its users do."""

import os
import pathlib
import subprocess
import tempfile
import unittest

CAROM = os.environ["CAROM"]
SOURCE = pathlib.Path(os.environ["CAROM_SOURCE_DIR"])

# A ball above a floor: half a second, small pictures.
SMALL_SCENE = """\
carom: 1
simulation: {duration: 0.5}
materials:
  rubber: {restitution: 0.8}
surfaces:
  - {name: floor, plane: {normal: [0, 0, 1], offset: 0}}
balls:
  - {name: a, radius: 0.1, material: rubber, position: [0, 0, 0.6]}
film: {size: [160, 90], fps: 20}
"""


def scenes_with_goldens():
    """All but those that are for numbers: bench/hard_cases holds scenes/hard against closed forms, bench/measured.py
    scenes/measured against measurements; and sweeps, which are no scenes."""
    return sorted(p for p in (SOURCE / "scenes").rglob("*.yaml") if p.parent.name not in ("hard", "measured", "sweeps"))


def run(*arguments, **keywords):
    """The finished process, with its output as text."""
    keywords.setdefault("text", True)
    keywords.setdefault("timeout", 300)
    return subprocess.run([CAROM, *map(str, arguments)], capture_output=True, **keywords)


class ProgramTest(unittest.TestCase):
    """A folder that goes with the test, and a small scene in it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.scene = self.write("scene.yaml", SMALL_SCENE)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def names(self):
        """What stands in the folder, without the scene."""
        return sorted(p.name for p in self.folder.iterdir() if p != self.scene)

    def assert_environment_changes_nothing(self, still, settings):
        """The picture that the command writes is the same under each setting; softpipe is refused."""
        right = run(*still, text=False)
        self.assert_exit(0, right)
        for setting in settings:
            with self.subTest(setting=setting):
                result = run(*still, text=False, env={**os.environ, **dict([setting.split("=", 1)])})
                self.assertEqual(0, result.returncode, result.stderr)
                self.assertEqual(right.stdout, result.stdout)
        result = run(*still, text=False, env={**os.environ, "GALLIUM_DRIVER": "softpipe"})
        self.assertEqual(1, result.returncode)
        self.assertIn(b"softpipe: its pixels differ", result.stderr)

    def assert_exit(self, code, result):
        self.assertEqual(code, result.returncode, f"{result.args}\n{result.stdout}\n{result.stderr}")
