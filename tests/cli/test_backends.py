"""OSMesa and EGL: the same pixels from both, and what is said where one or both are missing."""

import json
import unittest

from faults import FaultyTest
from program import SOURCE, ProgramTest, run, scenes_with_goldens

DRIVERS = {"osmesa": "OSMesa", "egl": "EGL"}


class SamePixels(ProgramTest):
    def assert_no_pixel_differs(self, one, other):
        result = run("compare", one, other, "--tolerance", "0", "--max-differing", "0", "--json")
        self.assertEqual(0, result.returncode, result.stdout + result.stderr)

    def test_every_golden(self):
        scenes = scenes_with_goldens()
        for backend in DRIVERS:
            self.assert_exit(0, run("golden", "update", *scenes, "--dir", self.folder / backend, "--size", "320x180",
                                    "--backend", backend))
        self.assertGreater(len(list((self.folder / "egl").iterdir())), 80)
        self.assert_no_pixel_differs(self.folder / "osmesa", self.folder / "egl")

    def test_frames_one_after_the_other(self):
        for scene in ("gallery/follow", "gallery/motion_blur", "gallery/against_side"):
            for backend in DRIVERS:
                self.assert_exit(0, run("render", SOURCE / "scenes" / f"{scene}.yaml", "-o", self.folder / backend,
                                        "--frames", "20-50:15", "--size", "320x180", "--backend", backend, "-y"))
            self.assert_no_pixel_differs(self.folder / "osmesa", self.folder / "egl")


class Choice(FaultyTest):
    def renderer(self, *options, **environment):
        """What --stats says that drew a still, or its words on standard error."""
        stats = self.folder / "stats.json"
        result = self.short_of(["still", self.scene, "--time", "0", "-o", self.folder / "a.png", "-y",
                                "--stats", stats, *options], **environment)
        if result.returncode != 0:
            return result.returncode, result.stderr.decode()
        return 0, json.loads(stats.read_text())["renderer"]

    def test_stats_say_which_one_drew(self):
        for backend, name in DRIVERS.items():
            self.assertRegex(self.renderer("--backend", backend)[1], rf"^llvmpipe .*Mesa.*, {name}$")
            self.assertRegex(self.renderer(CAROM_BACKEND=backend)[1], rf", {name}$")
        self.assertRegex(self.renderer("--backend", "egl", CAROM_BACKEND="osmesa")[1], ", EGL$")

    def test_auto_is_osmesa_where_it_is_there(self):
        self.assertRegex(self.renderer()[1], ", OSMesa$")
        self.assertRegex(self.renderer("--backend", "auto")[1], ", OSMesa$")
        self.assertRegex(self.renderer(FAIL_LIBRARY="OSMesa")[1], ", EGL$")

    def test_one_that_is_missing_is_named_with_its_package(self):
        for options, lost, packages in (
                (["--backend", "osmesa"], "OSMesa", ["libosmesa6"]),
                (["--backend", "egl"], "libEGL", ["libegl1"]),
                (["--backend", "egl"], "EGL_mesa", ["libegl-mesa0", "libgl1-mesa-dri", "libosmesa6"]),
                (["--backend", "egl"], "_dri.so", ["libegl-mesa0", "libgl1-mesa-dri"]),
                ([], "OSMesa,libEGL", ["libosmesa6", "libegl1", "libgl1-mesa-dri"])):
            if lost == "_dri.so" and not self.has_plug_ins():
                continue
            (self.folder / "a.png").unlink(missing_ok=True)
            code, said = self.renderer(*options, FAIL_LIBRARY=lost)
            self.assertEqual(1, code, f"{lost}: {said}")
            for package in packages:
                self.assertIn(package, said, lost)
            self.assertEqual(1, len(said.splitlines()), said)
            self.assertFalse((self.folder / "a.png").exists())

    def has_plug_ins(self):
        """Whether Mesa loads its driver by name (until 24.1)."""
        version = self.renderer("--backend", "osmesa")[1].split("Mesa ")[1]
        return tuple(map(int, version.split(",")[0].split(".")[:2])) < (24, 2)

    def test_another_name_is_wrong_usage(self):
        code, said = self.renderer("--backend", "glx")
        self.assertEqual(2, code)
        self.assertIn("egl", said)
        code, said = self.renderer(CAROM_BACKEND="glx")
        self.assertEqual(2, code)
        self.assertIn("CAROM_BACKEND: glx: expected auto, osmesa or egl", said)
        self.assertEqual(0, self.short_of(["check", self.scene], CAROM_BACKEND="glx").returncode)

    def test_the_environment_does_not_choose_another_driver_for_egl(self):
        still = ["still", self.scene, "--time", "0.2", "-o", "-", "--backend", "egl"]
        self.assert_environment_changes_nothing(still, (
            "GALLIUM_DRIVER=zink", "MESA_LOADER_DRIVER_OVERRIDE=zink", "MESA_GL_VERSION_OVERRIDE=2.1",
            "EGL_PLATFORM=x11", "DISPLAY=:7", "LP_NUM_THREADS=0"))


if __name__ == "__main__":
    unittest.main()
