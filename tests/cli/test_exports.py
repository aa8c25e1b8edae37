"""carom simulate -o .json, .npz and .glb: read by others, with the numbers of the CSV files."""

import csv
import io
import json
import struct
import subprocess
import unittest

import numpy

from program import CAROM, SOURCE, ProgramTest, run

SPINNING = """\
carom: 1
title: "</script> \\u202e & 'quotes'"
simulation: {duration: 1.3}
materials:
  rubber: {restitution: 0.8, friction: 0.5}
surfaces:
  - {name: floor, plane: {normal: [0, 0, 1], offset: 0}, material: rubber}
balls:
  - {name: a, preset: tennis, drop_height: 1, at: [0, 0], velocity: [1, 0, 0], spin: [0, -30, 0]}
  - {name: b, radius: 0.05, material: rubber, position: [0.3, 0.4, 0.7]}
film: {size: [160, 90], fps: 30}
"""


class Exports(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("scene.yaml", SPINNING)

    def export(self, extension, *more):
        path = self.folder / f"motion.{extension}"
        self.assert_exit(0, run("simulate", self.scene, "-o", path, "-q", *more))
        return path

    def rows(self, name="motion.csv"):
        with (self.folder / name).open() as file:
            return list(csv.DictReader(file))

    def with_rows(self, *rate):
        self.export("csv", "--events", self.folder / "events.csv", *rate)
        return self.rows(), self.rows("events.csv")

    def test_arrays_have_the_bits_of_the_rows(self):
        rows, events = self.with_rows("--rate", "77")
        arrays = numpy.load(self.export("npz", "--rate", "77"), allow_pickle=False)
        self.assertEqual(["a", "b"], list(arrays["balls"]))
        self.assertEqual(["floor"], list(arrays["surfaces"]))
        self.assertEqual(len(rows), arrays["time"].size * 2)
        columns = [("position", "x y z"), ("orientation", "qw qx qy qz"), ("velocity", "vx vy vz"),
                   ("spin", "wx wy wz")]
        for name, keys in columns:
            expected = numpy.array([[float(row[key]) for key in keys.split()] for row in rows])
            self.assertEqual(expected.tobytes(), arrays[name].tobytes(), name)
        self.assertEqual([float(row["time"]) for row in rows[::2]], list(arrays["time"]))
        self.assertGreater(len(events), 3)
        self.assertEqual([float(row["time"]) for row in events], list(arrays["event_time"]))
        self.assertEqual([row["kind"] for row in events], list(arrays["event_kind"]))
        self.assertEqual([row["ball"] for row in events],
                         [arrays["balls"][i] for i in arrays["event_ball"]])
        for i, row in enumerate(events):
            point = [float(row[key]) for key in "xyz"]
            self.assertEqual(point, list(arrays["event_point"][i]))
            for key in ("approach_speed", "separation_speed", "restitution", "impulse",
                        "tangential_impulse"):
                value = arrays["event_" + key][i]
                self.assertTrue(numpy.isnan(value) if row[key] == "" else value == float(row[key]))

    def test_pieces_give_the_places_of_the_rows(self):
        rows, events = self.with_rows()
        motion = json.loads(self.export("json").read_text())
        self.assertEqual(("carom motion", 1), (motion["format"], motion["version"]))
        self.assertEqual([len(events), 1.3], [len(motion["events"]), motion["duration"]])
        balls = {ball["name"]: ball for ball in motion["balls"]}
        for row in rows:
            t = float(row["time"])
            piece = [p for p in balls[row["ball"]]["pieces"] if p["t"] <= t][-1]
            s = t - piece["t"]
            zero = [0, 0, 0]
            for i, key in enumerate("xyz"):
                v, a = piece.get("v", zero)[i], piece.get("a", zero)[i]
                self.assertNotIn("curve", piece)
                # The expression of docs/exports.md, in its order: the same bits.
                self.assertEqual(float(row[key]), piece["p"][i] + s * (v + (0.5 * s) * a))
        for row, event in zip(events, motion["events"]):
            named = dict(zip(motion["event_columns"], event))
            for key, value in named.items():
                self.assertEqual(row[key], value if isinstance(value, str) else
                                 next(t for t in [row[key]] if float(t) == value))

    def test_a_title_of_any_kind_is_json(self):
        motion = json.loads(self.export("json").read_text())
        self.assertEqual("</script> \u202e & 'quotes'", motion["title"])

    def test_a_camera_of_glb_moves_until_the_end(self):
        self.scene.write_text(SPINNING + "camera: {from: [0, -4, 1], to: [0, 0, 0.5], orbit_deg_per_s: 30}\n")
        data = self.export("glb").read_bytes()
        document = json.loads(data[20:20 + struct.unpack("<I", data[12:16])[0]])
        camera = [node["name"] for node in document["nodes"]].index("camera")
        motion = document["animations"][0]
        inputs = [motion["samplers"][channel["sampler"]]["input"] for channel in motion["channels"]
                  if channel["target"]["node"] == camera]
        self.assertEqual(2, len(inputs))
        for accessor in inputs:
            self.assertEqual([numpy.float32(1.3)], document["accessors"][accessor]["max"])
            self.assertEqual(79, document["accessors"][accessor]["count"])

    def test_glb_is_whole(self):
        data = self.export("glb").read_bytes()
        magic, version, size = struct.unpack("<4sII", data[:12])
        self.assertEqual((b"glTF", 2, len(data)), (magic, version, size))
        length, kind = struct.unpack("<I4s", data[12:20])
        self.assertEqual(b"JSON", kind)
        document = json.loads(data[20:20 + length])
        names = [node["name"] for node in document["nodes"]]
        self.assertEqual(["z_up", "camera", "floor", "a", "b"], names)
        self.assertEqual(1, len(document["images"]))  # the tennis ball's felt; b is plain
        image = document["bufferViews"][document["images"][0]["bufferView"]]
        start = 28 + length + image["byteOffset"]
        self.assertEqual(b"\x89PNG", data[start:start + 4])

    def test_figure_9_is_small(self):
        """At most 150 bytes a ball and event and 20 KB, aside from textures."""
        path, events = self.folder / "f.glb", self.folder / "e.csv"
        self.assert_exit(0, run("simulate", SOURCE / "scenes" / "figure9.yaml", "-o", path,
                                "--events", events, "-q"))
        data = path.read_bytes()
        document = json.loads(data[20:20 + struct.unpack("<I", data[12:16])[0]])
        textures = sum(document["bufferViews"][image["bufferView"]]["byteLength"]
                       for image in document["images"])
        rows = self.rows("e.csv")
        self.assertLessEqual(len(data) - textures, 150 * (10 + len(rows)) + 20_480)

    def test_the_same_bytes_again_and_on_standard_output(self):
        for extension in ("json", "npz", "glb", "csv"):
            with self.subTest(extension=extension):
                first = self.export(extension).read_bytes()
                again = run("simulate", self.scene, "-o", "-", "--format", extension, "-q",
                            text=False)
                self.assert_exit(0, again)
                self.assertEqual(first, again.stdout)
        self.assertEqual(2, numpy.load(io.BytesIO(run(
            "simulate", self.scene, "-o", "-", "--format", "npz", "-q",
            text=False).stdout))["balls"].size)

    def test_what_has_no_meaning_is_refused(self):
        for extension in ("json", "glb"):
            result = run("simulate", self.scene, "-o", self.folder / f"m.{extension}",
                         "--rate", "100")
            self.assert_exit(2, result)
            self.assertIn("take a rate", result.stderr)
        result = run("simulate", self.scene, "-o", self.folder / "m.csv", "--format", "npz")
        self.assert_exit(2, result)
        self.assertIn("--format npz", result.stderr)
        self.assertEqual([], self.names())

    def test_what_cannot_be_written_leaves_nothing(self):
        for extension in ("json", "npz", "glb"):
            with self.subTest(extension=extension):
                command = (f"ulimit -f 8; trap '' XFSZ; exec '{CAROM}' simulate '{self.scene}' "
                           f"-o '{self.folder}/m.{extension}' -q")
                rate = " --rate 10000" if extension == "npz" else ""
                many = " --set simulation.duration=6" if extension == "json" else ""
                result = subprocess.run(["bash", "-c", command + rate + many],
                                        capture_output=True, text=True)
                self.assertEqual(4, result.returncode, result.stderr)
                self.assertIn("cannot write", result.stderr)
                self.assertEqual([], self.names())
                self.export(extension)
                self.assert_exit(4, run("simulate", self.scene, "-o",
                                        self.folder / f"motion.{extension}"))
                (self.folder / f"motion.{extension}").unlink()


if __name__ == "__main__":
    unittest.main()
