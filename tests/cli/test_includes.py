"""The includes follow the flow: scene -> sim -> motion -> render -> media, core below, cli on top."""

import os
import pathlib
import re
import unittest

SOURCE = pathlib.Path(os.environ["CAROM_SOURCE_DIR"]) / "src"

# Folder -> our folders that it may include, besides itself.
MAY_INCLUDE = {
    "core": set(),
    "scene": {"core"},
    "motion": {"core"},
    "sim": {"core", "scene", "motion"},
    "render": {"core", "scene", "motion"},
    "media": {"core"},
    "report": {"core", "scene", "motion", "sim", "render", "media"},
    "cli": {"core", "scene", "motion", "sim", "render", "media", "report"},
}

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
