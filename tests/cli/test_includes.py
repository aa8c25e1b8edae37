"""The includes follow the flow: scene -> sim -> motion -> render -> media, core below, cli on top."""

import os
import pathlib
import re
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
    "report": {"core", "geometry", "scene", "motion", "sim", "render", "media"},
    "cli": {"core", "geometry", "scene", "motion", "sim", "render", "media", "report"},
}

# Of a folder that has rooms: room -> rooms of the same folder that it may include. Files outside of
# rooms are what the folder offers: they may include all of them, and no room includes them.
ROOMS = {
    "sim": {
        "math": set(),
        "contact": set(),
        "solve": {"contact"},
        "collide": {"contact", "math"},
        "law": {"contact"},
        "record": {"contact", "math"},
        "integrate": {"law", "math"},
        "fixed": {"contact", "record", "solve"},
        "world": {"collide", "contact", "law"},
        "group": {"solve", "world"},
        "exact": {"collide", "group", "integrate", "law", "math", "record", "solve",
                  "world"},
    },
}
MOST_FILES = 22  # of a room

# Header of a third-party library -> the folders that may name it.
LIBRARY_HOME = {
    r"yaml-cpp/": {"scene"},
    r"ode/": {"sim"},
    r"boost/numeric/odeint/": {"sim"},
    r"(GL|EGL)/": {"render"},
    r"cairo|freetype/": {"render"},
    r"png\.h": {"media"},
    r"lib(av|sw)\w+/": {"media"},
    r"CLI/": {"cli"},
    r"xxhash\.h": {"motion"},
}


def includes():
    """(folder, file, kind, path) of every #include line; kind is '"' or '<'."""
    for file in sorted(SOURCE.rglob("*")):
        if file.suffix not in (".h", ".cpp"):
            continue
        for match in re.finditer(r'^\s*#include ([<"])([^>"]+)[>"]', file.read_text(), re.M):
            yield file.relative_to(SOURCE).parts[0], file, match[1], match[2]


def room_includes(folder):
    """(file, path) of every include of a room's file that names a file of the same folder."""
    for of, file, kind, path in includes():
        in_room = len(file.relative_to(SOURCE / folder).parts) > 1 if of == folder else False
        if in_room and kind == '"' and path.startswith(f"{folder}/"):
            yield file, path


class Includes(unittest.TestCase):
    def test_every_folder_is_in_the_table(self):
        folders = {p.name for p in SOURCE.iterdir() if p.is_dir()}
        self.assertEqual(folders, set(MAY_INCLUDE))

    def test_own_includes_follow_the_flow(self):
        found = 0
        for folder, file, kind, path in includes():
            if kind != '"':
                continue
            found += 1
            target = path.split("/")[0]
            self.assertIn(target, MAY_INCLUDE[folder] | {folder}, f"{file}: {path}")
            self.assertTrue((SOURCE / path).is_file(), f"{file}: {path}")
        self.assertGreater(found, 50)

    def test_rooms_include_what_they_may(self):
        for folder, table in ROOMS.items():
            rooms = {p.name for p in (SOURCE / folder).iterdir() if p.is_dir()}
            self.assertEqual(rooms - {"shaders", "fonts"}, set(table), folder)
            used = set()
            for file, path in room_includes(folder):
                room = file.relative_to(SOURCE / folder).parts[0]
                inner = path.split("/")
                self.assertEqual(len(inner), 3, f"{file}: {path} is in no room")
                used.add((room, inner[1]))
                self.assertIn(inner[1], table[room] | {room}, f"{file}: {path}")
            allowed = {(room, other) for room, others in table.items() for other in others}
            self.assertEqual(allowed - used, set(), f"{folder}: nobody uses these arrows")

    def test_rooms_have_no_circle(self):
        for folder, table in ROOMS.items():
            left = {room: set(others) for room, others in table.items()}
            while free := [room for room, others in left.items() if not others & set(left)]:
                for room in free:
                    del left[room]
            self.assertEqual(left, {}, f"{folder}: rooms that include each other in a circle")

    def test_rooms_are_small(self):
        for folder, table in ROOMS.items():
            for room in table:
                files = [p for p in (SOURCE / folder / room).iterdir() if p.is_file()]
                self.assertLessEqual(len(files), MOST_FILES, f"{folder}/{room}")

    def test_libraries_are_named_at_home(self):
        found = set()
        for folder, file, kind, path in includes():
            for pattern, home in LIBRARY_HOME.items():
                if kind == "<" and re.match(pattern, path):
                    found.add(pattern)
                    self.assertIn(folder, home, f"{file}: {path}")
        self.assertEqual(found, set(LIBRARY_HOME))


if __name__ == "__main__":
    unittest.main()
