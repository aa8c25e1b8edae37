"""The includes follow the flow: scene -> sim -> motion -> render -> media, core below, cli on top;
and inside a folder that has rooms, the arrows between these."""

import graphlib
import os
import pathlib
import re
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["CAROM_SOURCE_DIR"]) / "src"

# Folder -> our folders that it may include, besides itself.
MAY_INCLUDE = {
    "core": set(),
    "geometry": {"core"},
    "scene": {"core", "geometry"},
    "motion": {"core"},
    "sim": {"core", "geometry", "scene", "motion"},
    "render": {"core", "geometry", "scene", "motion"},
    "media": {"core"},
    "golden": {"core", "scene", "media"},
    "report": {"core", "geometry", "scene", "motion", "sim", "render", "media"},
    "export": {"core", "geometry", "scene", "motion", "render", "media"},
    "page": {"core", "geometry", "scene", "motion", "sim", "render", "media", "report", "export",
             "sweep"},
    "sweep": {"core", "geometry", "scene", "motion", "sim", "render", "media", "report"},
    "api": {"core", "geometry", "scene", "motion", "sim", "render", "media", "report"},
    "cli": {"core", "geometry", "scene", "motion", "sim", "render", "media", "golden", "report",
            "export", "page", "sweep"},
}

# Folder -> its rooms -> the rooms that each may include, besides itself. What lies beside the rooms
# is the folder's door: it may include all of them, and none of them includes it.
ROOMS = {
    "sim": {
        "math": set(),
        "contact": set(),
        "solve": {"contact"},
        "collide": {"contact", "math"},
        "law": {"contact"},
        "record": {"contact", "math"},
        "integrate": {"law", "math"},
        "fixed": {"contact", "law", "record", "solve"},
        "world": {"collide", "contact", "law", "record"},
        "group": {"contact", "record", "solve", "world"},
        "phase": {"contact", "group", "integrate", "law", "math", "record", "solve", "world"},
        "exact": {"collide", "group", "math", "phase", "record", "world"},
    },
    "render": {
        "gl": set(),
        "draw2d": set(),
        "runs": {"draw2d"},
        "view": {"runs"},
        "tile": {"view"},
        "blend": {"gl", "tile"},
        "element": {"draw2d", "runs", "view"},
        "texture": {"blend", "gl"},
        "marks": {"draw2d", "element", "runs", "view"},
        "plates": {"draw2d", "element", "runs", "view"},
        "overlay": {"draw2d", "element", "marks", "plates", "tile"},
        "background": {"blend", "gl", "tile", "view"},
        "balls": {"background", "blend", "gl", "runs", "tile", "view"},
        "layers": {"balls", "runs", "view"},
        "picture": {"background", "balls", "blend", "draw2d", "element", "gl", "overlay", "runs",
                    "tile", "view"},
    },
    "sweep": {
        "file": set(),
        "runs": {"file"},
    },
}

MOST_FILES_OF_A_ROOM = 22

# Header of a third-party library -> the folders that may name it.
LIBRARY_HOME = {
    r"yaml-cpp/": {"scene"},
    r"ode/": {"sim"},
    r"boost/numeric/odeint/": {"sim"},
    r"boost/math/": {"sweep"},
    r"muParser": {"sweep"},
    r"(GL|EGL)/": {"render"},
    r"cairo|freetype/": {"render"},
    r"png\.h": {"media"},
    r"lib(av|sw)\w+/": {"media"},
    r"(?i)openexr": {"media"},
    r"libdeflate\.h": {"media"},
    r"CLI/": {"cli"},
    r"minizip/": {"export"},
    r"event2/": {"cli"},
    r"zlib\.h": {"media", "page"},
    r"xxhash\.h": {"core"},
}


def sources(root):
    return [f for f in sorted(root.rglob("*")) if f.suffix in (".h", ".cpp")]


def includes(root=SOURCE):
    """(file below root, kind, path) of every #include line; kind is '"' or '<'."""
    for file in sources(root):
        for match in re.finditer(r'^\s*#include ([<"])([^>"]+)[>"]', file.read_text(), re.M):
            yield file.relative_to(root), match[1], match[2]


def room_of(path, rooms):
    """The room of a file below src; '' beside the rooms or in a folder without any."""
    parts = pathlib.PurePath(path).parts
    return parts[1] if parts[0] in rooms and len(parts) > 2 else ""


def faults_of_rooms(root, rooms, most_files):
    """Sentences on what breaks the rules of rooms in the tree below root."""
    faults = []
    for folder in sorted(p.name for p in root.iterdir() if p.is_dir()):
        found = {p.name for p in (root / folder).iterdir() if p.is_dir() and sources(p)}
        wanted = set(rooms.get(folder, {}))
        faults += [f"{folder}/{name} is not in the table" for name in sorted(found - wanted)]
        faults += [f"{folder}/{name} is in the table only" for name in sorted(wanted - found)]
        for name in sorted(found & wanted):
            files = sources(root / folder / name)
            if len(files) > most_files:
                faults.append(f"{folder}/{name} has {len(files)} files, at most {most_files}")
            faults += [f"{file} lies deeper than a room" for file in files
                       if file.parent != root / folder / name]
    for folder, arrows in rooms.items():
        try:
            list(graphlib.TopologicalSorter(arrows).static_order())
        except graphlib.CycleError as circle:
            faults.append(f"{folder}: a circle of rooms: {' - '.join(circle.args[1])}")
    of_file = {}
    for file, kind, path in includes(root):
        if kind != '"':
            continue
        of_file.setdefault(str(file), set()).add(path)
        folder = file.parts[0]
        if folder not in rooms or not path.startswith(folder + "/"):
            continue
        here, there = room_of(file, rooms), room_of(path, rooms)
        if here and here != there and there not in rooms[folder].get(here, set()):
            faults.append(f"{file} must not include {path}")
    try:
        list(graphlib.TopologicalSorter(of_file).static_order())
    except graphlib.CycleError as circle:
        faults.append(f"a circle of files: {' - '.join(circle.args[1])}")
    return faults


class Includes(unittest.TestCase):
    def test_every_folder_is_in_the_table(self):
        folders = {p.name for p in SOURCE.iterdir() if p.is_dir()}
        self.assertEqual(folders, set(MAY_INCLUDE))

    def test_own_includes_follow_the_flow(self):
        found = 0
        for file, kind, path in includes():
            if kind != '"':
                continue
            found += 1
            folder, target = file.parts[0], path.split("/")[0]
            self.assertIn(target, MAY_INCLUDE[folder] | {folder}, f"{file}: {path}")
            self.assertTrue((SOURCE / path).is_file(), f"{file}: {path}")
        self.assertGreater(found, 50)

    def test_rooms_follow_their_arrows(self):
        self.assertEqual([], faults_of_rooms(SOURCE, ROOMS, MOST_FILES_OF_A_ROOM))

    def test_every_arrow_between_rooms_is_used(self):
        used = {(file.parts[0], room_of(file, ROOMS), room_of(path, ROOMS))
                for file, kind, path in includes() if kind == '"'}
        for folder, arrows in ROOMS.items():
            for here, others in arrows.items():
                for there in others:
                    self.assertIn((folder, here, there), used)

    def test_libraries_are_named_at_home(self):
        found = set()
        for file, kind, path in includes():
            for pattern, home in LIBRARY_HOME.items():
                if kind == "<" and re.match(pattern, path):
                    found.add(pattern)
                    self.assertIn(file.parts[0], home, f"{file}: {path}")
        self.assertEqual(found, set(LIBRARY_HOME))


class FaultsAreFound(unittest.TestCase):
    """The rules of rooms, on trees that break one of them each."""

    ROOMS = {"house": {"low": set(), "high": {"low"}}}

    def faults(self, files, rooms=None, most=2):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, included in {"house/low/a.h": "", "house/high/b.h": "house/low/a.h",
                                   "house/door.h": "house/high/b.h", **files}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(f'#include "{included}"\n' if included else "")
            return faults_of_rooms(root, rooms or self.ROOMS, most)

    def test_a_sound_tree_has_none(self):
        self.assertEqual([], self.faults({"house/data/c.txt": ""}))

    def test_an_include_against_the_arrow(self):
        self.assertEqual(["house/low/c.cpp must not include house/high/b.h"],
                         self.faults({"house/low/c.cpp": "house/high/b.h"}))

    def test_an_include_of_the_door(self):
        self.assertEqual(["house/low/c.cpp must not include house/door.h"],
                         self.faults({"house/low/c.cpp": "house/door.h"}))

    def test_circles(self):
        rooms = {"house": {"low": {"high"}, "high": {"low"}}}
        self.assertIn("a circle of rooms", self.faults({}, rooms)[0])
        self.assertIn("a circle of files", self.faults(
            {"house/low/c.h": "house/low/a.h", "house/low/a.h": "house/low/c.h"})[0])

    def test_a_crowded_room(self):
        self.assertEqual(["house/low has 3 files, at most 2"],
                         self.faults({"house/low/c.h": "", "house/low/d.h": ""}))

    def test_rooms_and_table_differ(self):
        self.assertEqual(["house/new is not in the table"], self.faults({"house/new/c.h": ""}))
        self.assertEqual(["house/old is in the table only"],
                         self.faults({}, {"house": {**self.ROOMS["house"], "old": set()}}))
        self.assertIn("lies deeper", self.faults({"house/low/deep/c.h": ""})[0])


if __name__ == "__main__":
    unittest.main()
