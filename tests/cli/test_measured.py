"""The tables of docs/real-balls.md are what their commands make."""

import importlib.util
import os
import sys
import unittest

from program import SOURCE, ProgramTest, run


def load(name):
    spec = importlib.util.spec_from_file_location(name, SOURCE / "bench" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


class Measured(ProgramTest):
    def page_between(self, module):
        return module.PAGE.read_text(encoding="utf-8").split(module.BEGIN)[1].split(module.END)[0]

    def test_the_measured_table_is_what_the_command_makes(self):
        module = load("measured")
        self.assertGreaterEqual(len(module.ROWS), 10)
        self.assertEqual(module.table(os.environ["CAROM"]), self.page_between(module))

    def test_the_tables_of_the_official_tests_are_what_the_command_makes(self):
        module = load("official")
        self.assertEqual(module.tables(os.environ["CAROM"]), self.page_between(module))
        self.assertEqual({"air.svg", "rolling.svg", "speed.svg"}, {p.name for p in module.PLOTS.glob("*")})

    def test_every_scene_is_valid_and_in_the_table(self):
        module = load("measured")
        scenes = sorted((SOURCE / "scenes" / "measured").glob("*.yaml"))
        self.assertEqual(sorted({row[0] for row in module.ROWS}), [scene.stem for scene in scenes])
        checked = run("check", *scenes)
        self.assert_exit(0, checked)
        self.assertNotIn("warning", checked.stderr)


if __name__ == "__main__":
    unittest.main()
