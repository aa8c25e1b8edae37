#!/usr/bin/env python3
"""Writes the dictionaries of the fuzz targets that read scenes and sweeps: every key and word of the program's own
schemas, and what YAML is made of.

usage: scripts/fuzz_dictionaries.py [PROGRAM]      (default build/release/carom)
"""

import json
import pathlib
import subprocess
import sys

CORPUS = pathlib.Path(__file__).resolve().parent.parent / "tests/fuzz/corpus"

YAML = ["- ", ": ", "{", "}", "[", "]", ", ", "\n", "\n  ", "\n    ", "# ", "'", '"', "|\n", ">\n", "? ", "&a ", "*a",
        "!!int ", "---\n", "...\n", "~", "null", "true", "false", "\t", "\u00a0", "\ufeff", "\u202e"]
NUMBERS = ["0", "-1", "1e-9", "1e-300", "1e9", "1e300", "-1e9", "0x7fffffff", "2147483648", "9007199254740993", ".inf",
           ".nan", "1e999", "0.1", "0.5", "2", "1/3", "[0, 0, 1]", "[1, 1, 1]", "[0, 0]", "[16384, 16384]"]
PATHS = ["balls.a.", "balls[0].", "surfaces.floor.", "materials.rubber.", "film.size[0]=", "=", ".", "[", "]", "[-1]"]


def words_of(schema, found):
    """All keys and choices of a JSON Schema, depth first."""
    if isinstance(schema, dict):
        found.update(schema.get("properties", {}))
        for choice in schema.get("enum", []) + ([schema["const"]] if "const" in schema else []):
            found.add(str(choice))
        for value in schema.values():
            words_of(value, found)
    elif isinstance(schema, list):
        for value in schema:
            words_of(value, found)
    return found


def quoted(word):
    return '"' + "".join(chr(b) if 32 <= b < 127 and b not in b'"\\' else f"\\x{b:02x}" for b in word.encode()) + '"'


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else "build/release/carom"
    for name, kind, more in (("scene", "scene", []), ("set", "scene", PATHS), ("sweep", "sweep", PATHS)):
        text = subprocess.run([program, "schema", kind], capture_output=True, check=True, text=True).stdout
        words = sorted(words_of(json.loads(text), set()))
        lines = [quoted(w) for w in words + [w + ": " for w in words if w.isidentifier()] + YAML + NUMBERS + more]
        (CORPUS / f"{name}.dict").write_text("# scripts/fuzz_dictionaries.py\n" + "\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
