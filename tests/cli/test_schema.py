"""The JSON Schema that `carom schema` prints, held by an existing validator against the scenes that
come with carom, and against broken ones that `carom check` refuses too."""

import copy
import json
import re
import unittest

import jsonschema
import yaml

from program import SOURCE, ProgramTest, run


class CoreLoader(yaml.SafeLoader):
    """YAML 1.2's core types, where PyYAML knows 1.1's: 1e-3 is a number, yes is text."""


CoreLoader.yaml_implicit_resolvers = {}
for tag, pattern, first in (
    ("bool", r"true|True|TRUE|false|False|FALSE", "tTfF"),
    ("int", r"[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+", "-+0123456789"),
    ("float", r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?", "-+.0123456789"),
    ("null", r"~|null|Null|NULL|", ["~", "n", "N", ""]),
):
    CoreLoader.add_implicit_resolver(
        f"tag:yaml.org,2002:{tag}", re.compile(f"^(?:{pattern})$"), list(first)
    )

RIGHT = """\
carom: 1
title: all kinds of things
simulation: {duration: rest, max_duration: 20, gravity: [0, 0, -1.62], step: 1e-3, solver: quick}
materials:
  steel: {restitution: 1.0, friction: 0.5}
  rubber: {virtual_body: {distance: 0.42, velocity: 5.0}, friction: 0.6}
  still: {virtual_body: {distance: 0, velocity: 0}, friction: 0.1}
pairs: [{between: [rubber, steel], restitution: 0.8}]
looks: {red: {color: "#c8102e", style: striped, second_color: "#fff"}}
surfaces:
  - {name: floor, plane: {}, material: steel, look: red}
  - {name: plate, box: {position: [9, 0, 0.5], size: [1, 1, 0.1], rotation_deg: [0, 30, 0]}}
  - {name: turned, box: {position: [9, 3, 0.5], size: [1, 1, 0.1], quaternion: [1, 0, 0, 1]}}
  - {name: bump, sphere: {position: [-9, 0, 0], radius: 0.5}}
  - {name: rail, capsule: {from: [-9, 3, 0], to: [-8, 3, 0], radius: 0.05}}
  - {name: drum, cylinder: {from: [-9, 6, 0], to: [-9, 6, 1], radius: 0.25}}
  - {name: hoop, ring: {position: [-9, 9, 3], axis: [0, 0, 1], radius: 0.25, tube_radius: 0.01}}
  - {name: dish, bowl: {position: [-9, 12, 3], radius: 0.25, opening: [0, 0, 1], depth: 0.1}}
  - {name: pipe, pipe: {from: [-9, 15, 3], to: [-8, 15, 3], radius: 0.25, angle_deg: 200}}
defaults: {ball: {inertia: 0.5, material: rubber}}
balls:
  - {name: a, radius: 0.1, position: [0, 0, 1], spin: [0, 1, 0], look: red}
  - {name: b, preset: basketball, material: still, drop_height: 1.8, at: [1, 0]}
  - {name: c, radius: 0.05, position: [0, 3, 3], repeat: {count: [2, 2, 2], spacing: [1, 1, 1]}}
camera: {from: [0, -6, 1.5], to: [0, 0, 1], fov_deg: 30}
film: {size: [640, 360], fps: "30000/1001", speed: 0.5, stills: [0.5]}
overlay: {ruler: true, clock: {corner: top_right}, trail: false, labels: {size_px: 12},
  title: true, caption: words, peaks: {size_px: 11}, velocity: {scale: 0.1}, plot: {ball: [a, b], size: [0.3, 0.4]},
  theme: dark}
"""

# Where, and what to put there. DELETE takes the key away.
DELETE = object()
WRONG = [
    (["carom"], 2),
    (["carom"], DELETE),
    (["carom"], "1"),
    (["titel"], "x"),
    (["title"], 7),
    (["simulation", "duration"], -1),
    (["simulation", "duration"], "until_rest"),
    (["simulation", "gravity"], [0, 0]),
    (["simulation", "gravity"], [0, 0, "down"]),
    (["simulation", "restitution_constant"], 0),
    (["simulation", "method"], "euler"),
    (["simulation", "step"], 0),
    (["simulation", "solver"], "slow"),
    (["simulation", "iterations"], 0),
    (["simulation", "iterations"], 1.5),
    (["materials", "steel", "restitution"], 1.5),
    (["materials", "steel", "restitution"], -0.5),
    (["materials", "steel", "friction"], -1),
    (["materials", "steel", "color"], "#fff"),
    (["materials", "steel", "virtual_body"], {"distance": 1, "velocity": 1}),
    (["materials", "rubber", "virtual_body", "velocity"], 0),
    (["materials", "rubber", "virtual_body", "velocity"], DELETE),
    (["materials", "rubber", "virtual_body", "distance"], -1),
    (["materials", "2nd"], {}),
    (["materials", "n" * 65], {}),
    (["pairs", 0, "restitution"], DELETE),
    (["pairs", 0, "between"], ["rubber"]),
    (["looks", "red", "color"], "red"),
    (["looks", "red", "style"], "dotted"),
    (["looks", "red", "tile"], 0),
    (["surfaces", 0, "name"], DELETE),
    (["surfaces", 0, "plane"], DELETE),
    (["surfaces", 0, "sphere"], {"radius": 1}),
    (["surfaces", 0, "velocity"], [0, 0, 1]),
    (["surfaces", 1, "box", "size"], [1, 0, 1]),
    (["surfaces", 1, "box", "quaternion"], [1, 0, 0, 0]),
    (["surfaces", 3, "sphere", "radius"], DELETE),
    (["surfaces", 4, "capsule", "to"], DELETE),
    (["surfaces", 5, "cylinder", "from"], DELETE),
    (["surfaces", 5, "cylinder", "radius"], 0),
    (["surfaces", 5, "cylinder", "length"], 1),
    (["surfaces", 6, "ring", "tube_radius"], DELETE),
    (["surfaces", 6, "ring", "radius"], -1),
    (["surfaces", 6, "ring", "axis"], [0, 1]),
    (["surfaces", 7, "bowl", "radius"], DELETE),
    (["surfaces", 7, "bowl", "depth"], 0),
    (["surfaces", 8, "pipe", "to"], DELETE),
    (["surfaces", 8, "pipe", "angle_deg"], 361),
    (["defaults", "ball", "name"], "x"),
    (["defaults", "ball", "inertia"], 0.7),
    (["balls", 0, "name"], "no spaces"),
    (["balls", 0, "name"], DELETE),
    (["balls", 0, "radius"], 0),
    (["balls", 0, "mass"], -1),
    (["balls", 0, "inertia"], "hollow"),
    (["balls", 0, "drop_height"], 1),
    (["balls", 0, "at"], [1, 1]),
    (["balls", 0, "radius"], True),
    (["balls", 1, "preset"], "cricket"),
    (["balls", 2, "repeat", "count"], [2, 2]),
    (["balls", 2, "repeat", "count"], [2, 2, 0]),
    (["balls", 2, "repeat", "spacing"], DELETE),
    (["balls", 2, "repeat", "jitter"], -1),
    (["camera", "from"], DELETE),
    (["camera", "fov_deg"], 180),
    (["film", "size"], [641, 360]),
    (["film", "size"], [8, 8]),
    (["film", "size"], [640.5, 360]),
    (["film", "fps"], 0),
    (["film", "fps"], "30000:1001"),
    (["film", "speed"], 0),
    (["film", "start"], -1),
    (["film", "stills"], [-1]),
    (["overlay", "ruler"], 1),
    (["overlay", "clock", "corner"], "middle"),
    (["overlay", "clock", "digits"], -1),
    (["overlay", "labels", "size_px"], 0),
    (["overlay"], None),
    (["balls"], {}),
]


def changed(scene, path, value):
    scene = copy.deepcopy(scene)
    place = scene
    for step in path[:-1]:
        place = place[step]
    if value is DELETE:
        del place[path[-1]]
    else:
        place[path[-1]] = value
    return scene


class Schema(ProgramTest):
    @classmethod
    def setUpClass(cls):
        result = run("schema")
        assert result.returncode == 0, result.stderr
        cls.schema = json.loads(result.stdout)
        cls.validator = jsonschema.Draft202012Validator(cls.schema)

    def test_is_a_schema(self):
        jsonschema.Draft202012Validator.check_schema(self.schema)

    def test_accepts_the_scenes_that_come_with_carom(self):
        scenes = sorted(p for p in (SOURCE / "scenes").glob("**/*.yaml") if p.parent.name != "sweeps")
        self.assertGreaterEqual(len(scenes), 2)
        for path in scenes:
            with self.subTest(scene=str(path)):
                self.validator.validate(yaml.load(path.read_text(), CoreLoader))
                self.assert_exit(0, run("check", path))

    def test_accepts_a_scene_with_a_bit_of_everything(self):
        self.validator.validate(yaml.load(RIGHT, CoreLoader))
        self.assert_exit(0, run("check", self.write("right.yaml", RIGHT)))

    def test_refuses_what_the_reader_refuses(self):
        right = yaml.load(RIGHT, CoreLoader)
        for number, (path, value) in enumerate(WRONG):
            wrong = changed(right, path, value)
            with self.subTest(path=path, value="deleted" if value is DELETE else value):
                self.assertFalse(self.validator.is_valid(wrong), "the schema accepts it")
                # JSON is YAML, and its numbers and quotes leave no doubt about types.
                result = run("check", self.write(f"wrong{number}.yaml", json.dumps(wrong)))
                self.assert_exit(3, result)
                self.assertRegex(result.stdout + result.stderr, r"wrong\d+\.yaml:\d+:\d+: error: ")

    def test_examples_and_defaults_fit_their_own_keys(self):
        sections = [self.schema, *self.schema["$defs"].values()]
        seen = 0
        for section in sections:
            for key, schema in section["properties"].items():
                with self.subTest(key=key):
                    self.assertIn("description", schema)
                    defaults = [schema["default"]] if "default" in schema else []
                    for value in schema["examples"] + defaults:
                        part = {**schema, "$defs": self.schema["$defs"]}
                        jsonschema.Draft202012Validator(part).validate(value)
                        seen += 1
        self.assertGreater(seen, 100)


if __name__ == "__main__":
    unittest.main()
