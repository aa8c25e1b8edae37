"""--layers against rays, states and projections that are computed here, from the motion's CSV alone."""

import csv
import json
import math
import signal
import subprocess
import time
import unittest
import zlib

from exr_reading import read_exr
from faults import FaultyTest
from program import CAROM, SOURCE, run

ALL = "depth,distance,segmentation,normals,flow,backflow,coordinates"
RATE = 20

SCENE = """\
carom: 1
simulation: {duration: 0.5}
materials: {rubber: {restitution: 0.8, friction: 0.5}}
surfaces:
  - {name: floor, plane: {normal: [0, 0, 1], offset: 0}, material: rubber}
  - {name: block, box: {position: [0.5, 0.3, 0.2], size: [0.4, 0.4, 0.4]}, material: rubber}
  - {name: dome, sphere: {position: [-0.6, 0.4, 0.1], radius: 0.3}, material: rubber}
balls:
  - {name: a, radius: 0.2, material: rubber, position: [-0.2, 0, 0.45], velocity: [1.5, 0, 0], spin: [3, 9, -5]}
  - {name: b, radius: 0.12, material: rubber, position: [0.1, 0.8, 0.5], spin: [0, 0, 12]}
  - {name: c, radius: 0.15, material: rubber, position: [0.2, -0.7, 0.3], velocity: [-1, 0.3, 1]}
  - {name: away, radius: 0.1, material: rubber, position: [9, 3, 0.3]}
film: {size: [96, 54], fps: 20}
camera: {from: [0.3, -2.6, 1.1], to: [0, 0, 0.3], fov_deg: 38}
"""
RADII = {"a": 0.2, "b": 0.12, "c": 0.15, "away": 0.1}
BALLS = list(RADII)
SURFACES = ["floor", "block", "dome"]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def add(a, b, s=1.0):
    return [x + s * y for x, y in zip(a, b)]


def turned(q, v):
    """By the quaternion w, x, y, z."""
    w, u = q[0], q[1:]
    cross = lambda a, b: [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    t = [2 * x for x in cross(u, v)]
    return add(add(v, t, w), cross(u, t))


def turned_back(q, v):
    return turned([q[0], -q[1], -q[2], -q[3]], v)


def meets_sphere(origin, direction, center, radius):
    from_center = add(origin, center, -1)
    b = dot(from_center, direction)
    reach = b * b - dot(from_center, from_center) + radius * radius
    return -b - math.sqrt(reach) if reach > 0 and -b > math.sqrt(reach) else math.inf


def meets_floor(origin, direction):
    return -origin[2] / direction[2] if direction[2] < 0 < origin[2] else math.inf


def meets_block(origin, direction):
    low, high = -math.inf, math.inf
    for o, d, middle in zip(origin, direction, (0.5, 0.3, 0.2)):
        if d == 0:
            continue
        one, two = sorted(((middle - 0.2 - o) / d, (middle + 0.2 - o) / d))
        low, high = max(low, one), min(high, two)
    return low if 0 < low < high else math.inf


class Camera:
    """As layers.json says it: x right, y down, z forward."""

    def __init__(self, said):
        self.said = said
        self.rows = said["world_from_camera"]
        self.eye = [row[3] for row in self.rows[:3]]

    def axis(self, i):
        return [row[i] for row in self.rows[:3]]

    def ray(self, x, y):
        c = self.said
        if c["projection"] == "orthographic":
            aside = [(x - c["cx"]) / c["pixels_per_m"], (y - c["cy"]) / c["pixels_per_m"]]
            return add(add(self.eye, self.axis(0), aside[0]), self.axis(1), aside[1]), self.axis(2)
        d = [(x - c["cx"]) / c["fx"], (y - c["cy"]) / c["fy"], 1]
        length = math.sqrt(dot(d, d))
        return self.eye, [dot(row[:3], d) / length for row in self.rows[:3]]

    def seen(self, point):
        p = add(point, self.eye, -1)
        x, y, z = (dot(self.axis(i), p) for i in range(3))
        c = self.said
        if c["projection"] == "orthographic":
            return [c["cx"] + c["pixels_per_m"] * x, c["cy"] + c["pixels_per_m"] * y, z]
        return [c["cx"] + c["fx"] * x / z, c["cy"] + c["fy"] * y / z, z]


def read_grey16(path):
    """The samples of a PNG of 16 bits, by its own description: filters none and Up."""
    data, at, pixels = path.read_bytes(), 8, b""
    while at < len(data):
        size, kind = int.from_bytes(data[at:at + 4], "big"), data[at + 4:at + 8]
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colours = *(int.from_bytes(body[i:i + 4], "big") for i in (0, 4)), body[8], body[9]
            assert (depth, colours) == (16, 0)
        pixels += body if kind == b"IDAT" else b""
        at += 12 + size
    rows, before, values = zlib.decompress(pixels), bytes(2 * width), []
    for y in range(height):
        kind, *row = rows[y * (2 * width + 1):(y + 1) * (2 * width + 1)]
        assert kind in (0, 2), "a filter that is not read here"
        before = bytes((a + b) & 255 for a, b in zip(row, before)) if kind == 2 else bytes(row)
        values += [before[i] << 8 | before[i + 1] for i in range(0, 2 * width, 2)]
    return width, height, values


class Layers(FaultyTest):
    def states(self, scene, *options):
        """Frame -> ball -> position and orientation, of the simulation."""
        path = self.folder / "motion.csv"
        self.assert_exit(0, run("simulate", scene, "-o", path, "--rate", RATE, "-y", *options))
        states = {}
        with open(path, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                frame = round(float(row["time"]) * RATE)
                states.setdefault(frame, {}).setdefault(
                    row["ball"], [[float(row[k]) for k in keys] for keys in (("x", "y", "z"), ("qw", "qx", "qy", "qz"))])
        return states

    def render(self, scene, name, *options, layers=ALL):
        folder = self.folder / name
        self.assert_exit(0, run("render", scene, "-o", f"{folder}/", "--layers", layers, "-q", *options))
        return folder, json.loads((folder / "layers.json").read_text())

    def nearest(self, origin, direction, balls):
        """(distance, id) of the first body, ids as promised: balls, then surfaces, from 1."""
        found = [(meets_sphere(origin, direction, balls[name][0], RADII[name]), i + 1) for i, name in enumerate(BALLS)]
        found += [(meets_floor(origin, direction), 5), (meets_block(origin, direction), 6),
                  (meets_sphere(origin, direction, [-0.6, 0.4, 0.1], 0.3), 7)]
        distance, body = min(found)
        return distance, body if distance < math.inf else 0

    def moved(self, body, point, here, there):
        if not 1 <= body <= 4:
            return point
        (c0, q0), (c1, q1) = here[BALLS[body - 1]], there[BALLS[body - 1]]
        return add(c1, turned(q1, turned_back(q0, add(point, c0, -1))))

    def is_hidden(self, camera, point, there, size):
        x, y, _ = camera.seen(point)
        if not (0 <= x < size[0] and 0 <= y < size[1]):
            return True
        origin, direction = camera.ray(x, y)
        return self.nearest(origin, direction, there)[0] < dot(add(point, origin, -1), direction) * (1 - 2e-6)

    def check_frames(self, scene, name, *options):
        states = self.states(scene, *options)
        folder, index = self.render(scene, name, *options)
        width, height = index["size"]
        self.assertEqual([*BALLS, *SURFACES], [body["name"] for body in index["bodies"]])
        self.assertEqual(list(range(1, 8)), [body["id"] for body in index["bodies"]])
        frames = index["frames"]
        self.assertEqual(list(range(10)), [frame["frame"] for frame in frames])
        cameras = [Camera(frame["camera"]) for frame in frames]
        worst = dict.fromkeys(("depth", "flow", "coordinates", "normals"), 0.0)
        hidden, seen_ids = 0, set()
        for k in (0, 4, 9):
            layers = {kind: read_exr(folder / file)[2] for kind, file in frames[k]["files"].items() if file.endswith(".exr")}
            ids = read_grey16(folder / frames[k]["files"]["segmentation"])
            self.assertEqual((width, height), ids[:2])
            ids = ids[2]
            seen_ids |= set(ids)
            self.check_shares(frames[k]["balls"], ids, cameras[k], states[k], width, height)
            for i in range(width * height):
                x, y = i % width + 0.5, i // width + 0.5
                origin, direction = cameras[k].ray(x, y)
                distance, body = self.nearest(origin, direction, states[k])
                self.assertEqual(body, ids[i], f"{name} {k} {x} {y}")
                self.check_point(worst, layers, i, (distance, body), (origin, direction), cameras[k], states[k])
                point = add(origin, direction, distance) if body else None
                for kind, other in (("flow", k + 1), ("backflow", k - 1)):
                    flow = [layers[kind][c][i] for c in "RGB"]
                    if not 0 <= other < 10:
                        self.assertTrue(math.isnan(flow[0]) and math.isnan(flow[1]) and flow[2] == 1)
                    elif body:
                        there = self.moved(body, point, states[k], states[other])
                        u, v, _ = cameras[other].seen(there)
                        worst["flow"] = max(worst["flow"], abs(u - x - flow[0]), abs(v - y - flow[1]))
                        is_hidden = self.is_hidden(cameras[other], there, states[other], (width, height))
                        self.assertEqual(is_hidden, flow[2] == 1, f"{name} {k} {kind} {x} {y} {body}")
                        hidden += is_hidden
        print(f"    {name}: worst", {key: f"{value:.1e}" for key, value in worst.items()}, f"{hidden} hidden")
        self.assertLess(worst["depth"], 1e-6)  # relative; float32 alone has 6e-8
        self.assertLess(worst["normals"], 1e-6)
        self.assertLess(worst["coordinates"], 1e-6)
        self.assertLess(worst["flow"], 1e-3)
        self.assertGreater(hidden, 50)
        return seen_ids

    def check_point(self, worst, layers, i, met, ray, camera, states):
        (distance, body), (origin, direction) = met, ray
        values = {kind: [layers[kind][c][i] for c in "RGB"] for kind in ("normals", "coordinates")}
        depth, said = layers["depth"]["Z"][i], layers["distance"]["Y"][i]
        if body == 0:
            self.assertEqual((math.inf, math.inf, [0, 0, 0]), (depth, said, values["normals"]))
            self.assertTrue(all(map(math.isnan, values["coordinates"])))
            return
        right = distance * dot(direction, camera.axis(2))
        worst["depth"] = max(worst["depth"], abs(depth / right - 1), abs(said / distance - 1))
        normal = values["normals"]
        worst["normals"] = max(worst["normals"], abs(math.sqrt(dot(normal, normal)) - 1))
        self.assertLess(dot(normal, direction), 1e-6)
        point = add(origin, direction, distance)
        if body <= 4:
            center, turn = states[BALLS[body - 1]]
            radius = RADII[BALLS[body - 1]]
            outward = [x / radius for x in add(point, center, -1)]
            point = turned_back(turn, add(point, center, -1))
            worst["normals"] = max(worst["normals"], *(abs(a - b) for a, b in zip(normal, outward)))
        worst["coordinates"] = max(worst["coordinates"],
                                   *(abs(a - b) / max(1, abs(b)) for a, b in zip(values["coordinates"], point)))

    def check_shares(self, balls, ids, camera, states, width, height):
        for ball in balls:
            name = ball["name"]
            self.assertEqual(sum(i == ball["id"] for i in ids), ball["visible_px"])
            whole = {(x, y) for x in range(width) for y in range(height)
                     if meets_sphere(*camera.ray(x + 0.5, y + 0.5), states[name][0], RADII[name]) < math.inf}
            said = {(ball["whole"]["left"] + i, y) for i, (top, bottom) in enumerate(ball["whole"]["columns"])
                    for y in range(top, bottom)}
            self.assertEqual(whole, said, name)
            self.assertEqual(len(whole), ball["whole_px"])
            self.assertEqual(ball["visible_px"] / len(whole) if whole else None, ball["visible_share"])

    def test_a_camera_that_stands(self):
        scene = self.write("layers.yaml", SCENE)
        self.assertEqual({0, 1, 2, 3, 5, 6, 7}, self.check_frames(scene, "stands"))

    def test_a_camera_that_moves(self):
        scene = self.write("layers.yaml", SCENE)
        self.check_frames(scene, "moves", "--set", "camera.orbit_deg_per_s=90")

    def test_parallel_rays(self):
        scene = self.write("layers.yaml", SCENE)
        self.check_frames(scene, "parallel", "--set", "camera={from: [0.3, -2.6, 1.1], to: [0, 0, 0.3], orthographic: 1.6}")

    def files(self, folder, names):
        return {name: (folder / name).read_bytes() for name in names}

    def test_a_frame_does_not_depend_on_those_before(self):
        scene = self.write("layers.yaml", SCENE)
        whole, index = self.render(scene, "whole")
        alone, _ = self.render(scene, "alone", "--frames", "6")
        names = index["frames"][6]["files"].values()
        self.assertEqual(self.files(whole, names), self.files(alone, names))
        self.assert_exit(0, run("render", scene, "-o", f"{self.folder}/parts/", "--chunk", "2/2", "--layers", ALL))
        self.assertEqual(self.files(whole, names), self.files(self.folder / "parts", names))
        part = json.loads((self.folder / "parts" / "layers.00005-00009.json").read_text())
        self.assertEqual(index["frames"][5:], part["frames"])
        still = self.folder / "still" / "p.png"
        still.parent.mkdir()
        self.assert_exit(0, run("still", scene, "--time", 0.3, "-o", still, "--layers", "depth,segmentation"))
        self.assertEqual((whole / "frame_00006.depth.exr").read_bytes(), (still.parent / "p.depth.exr").read_bytes())
        self.assertEqual({"p.png", "p.depth.exr", "p.segmentation.png", "layers.json"},
                         {p.name for p in still.parent.iterdir()})

    def test_what_is_written_over_or_mixed_into_a_picture_is_in_no_layer(self):
        scene = self.write("layers.yaml", SCENE)
        names = [f"frame_00004.{kind}" for kind in ("depth.exr", "segmentation.png", "flow.exr")]
        plain, _ = self.render(scene, "plain", "--frames", "4")
        changed, _ = self.render(scene, "changed", "--frames", "4", "--set", "overlay={ruler: true, clock: true, "
                                 "trail: true, labels: true}", "--set", "film.shutter_deg=180", "--against-set",
                                 "balls.a.velocity[0]=1")
        self.assertEqual(self.files(plain, names), self.files(changed, names))
        self.assertNotEqual(*((f / "frame_00004.png").read_bytes() for f in (plain, changed)))
        clear, _ = self.render(scene, "clear", "--frames", "4", "--set", "background=transparent")
        ids = [set(read_grey16(f / names[1])[2]) for f in (plain, clear)]
        self.assertEqual({5}, ids[0] - ids[1])  # the plane

    def test_wrong_usage_and_files_that_exist(self):
        scene = self.write("layers.yaml", SCENE)
        for words in (["render", scene, "-o", self.folder / "a.mp4", "--layers", "depth"],
                      ["render", scene, "-o", self.folder / "a/", "--layers", "depht"],
                      ["render", scene, "-o", self.folder / "a/", "--layers", "depth,depth"],
                      ["render", scene, "-o", self.folder / "a/", "--layers", "depth", "--against-set",
                       "balls.a.mass=2", "--against-view", "side"],
                      ["still", scene, "--time", 0, "-o", "-", "--layers", "depth"],
                      ["still", scene, "--time", 0.2, "--strobe", 0.1, "-o", self.folder / "a.png", "--layers", "depth"]):
            result = run(*words)
            self.assert_exit(2, result)
            self.assertIn("--layers", result.stderr)
        folder, _ = self.render(scene, "f", "--frames", "0-1", layers="depth")
        for path in folder.glob("*.png"):
            path.unlink()
        again = ["render", scene, "-o", f"{folder}/", "--layers", "depth", "--frames", "1"]
        result = run(*again)
        self.assert_exit(4, result)
        self.assertIn("layers.json", result.stderr)
        (folder / "layers.json").unlink()
        result = run(*again)
        self.assert_exit(4, result)
        self.assertIn("frame_00001.depth.exr", result.stderr)
        self.assertEqual({"frame_00000.depth.exr", "frame_00001.depth.exr"}, {p.name for p in folder.iterdir()})
        self.assert_exit(0, run(*again, "-y"))

    def test_without_openexr_only_ids_can_be_had(self):
        still = ["still", self.write("layers.yaml", SCENE), "--time", "0", "-o", self.folder / "a.png", "--layers"]
        for library, package in (("OpenEXR", b"libopenexr"), ("deflate", b"libdeflate0")):
            result = self.short_of([*still, "depth"], FAIL_LIBRARY=library)
            self.assertEqual(1, result.returncode)
            self.assertRegex(result.stderr, b"EXR files need .*package " + package)
            self.assertFalse((self.folder / "a.png").exists())
        self.assertEqual(0, self.short_of([*still, "segmentation"], FAIL_LIBRARY="OpenEXR").returncode)

    def test_an_interrupt_keeps_the_frames_that_are_whole(self):
        folder = self.folder / "long"
        process = subprocess.Popen([CAROM, "render", SOURCE / "scenes" / "gallery" / "follow.yaml", "-o", f"{folder}/",
                                    "--layers", ALL, "--size", "1920x1080"], stderr=subprocess.PIPE)
        while not (folder / "frame_00002.depth.exr").exists() and process.poll() is None:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=60)[1]
        self.assertEqual(130, process.returncode, said)
        frames = json.loads((folder / "layers.json").read_text())["frames"]
        self.assertGreaterEqual(len(frames), 2)
        self.assertIn(f"after {len(frames)} of 240 frames".encode(), said)
        for frame in frames:
            for name in (frame["picture"], *frame["files"].values()):
                self.assertTrue((folder / name).is_file(), name)
        self.assertFalse([p.name for p in folder.iterdir() if ".tmp" in p.name])

    def test_every_shape_of_the_gallery(self):
        # What is at the depth, and in which direction, is what the segmentation says.
        for scene in sorted((SOURCE / "scenes" / "gallery").glob("*.yaml")):
            name = scene.stem
            options = ["--against-view", "ghost"] if "against" in name else []
            picture = self.folder / f"{name}.png"
            result = run("still", scene, "--time", 0.2, "-o", picture, "--size", "64x36", "-y", "--layers",
                         "depth,segmentation,normals", *options)
            self.assert_exit(0, result)
            index = json.loads((self.folder / "layers.json").read_text())
            ids = read_grey16(self.folder / f"{name}.segmentation.png")[2]
            depth = read_exr(self.folder / f"{name}.depth.exr")[2]["Z"]
            normals = read_exr(self.folder / f"{name}.normals.exr")[2]
            known = {0, *(body["id"] for body in index["bodies"])}
            for i, body in enumerate(ids):
                self.assertIn(body, known)
                self.assertEqual(body == 0, depth[i] == math.inf, name)
                length = math.sqrt(sum(normals[c][i]**2 for c in "RGB"))
                self.assertAlmostEqual(0 if body == 0 else 1, length, delta=1e-6)


if __name__ == "__main__":
    unittest.main()
