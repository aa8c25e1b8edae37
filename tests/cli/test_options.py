"""Every option that --help names is used by some test: driven from the parser's own table.

An option counts as used where one test, with the helpers that it calls, has both the command's words
and the option among its texts.
"""

import ast
import json
import re
import unittest

from program import SOURCE, run

# An option that means the same in every command, and is tested in one.
ONCE_FOR_ALL = {"-h, --help", "--version"}


def table():
    """(command, names of the option) of all that the parser takes."""
    for command in json.loads(run("help", "--json").stdout):
        for option in command["options"]:
            if option["names"]:
                yield command["command"], tuple(option["names"])


class Texts(ast.NodeVisitor):
    """All texts below a node, and the names of what it calls or mentions."""

    def __init__(self, node):
        self.texts, self.names = set(), set()
        self.visit(node)

    def visit_Constant(self, node):
        if isinstance(node.value, str):
            self.texts.update(re.split(r"[\s=]", node.value))

    def visit_Name(self, node):
        self.names.add(node.id)

    def visit_Attribute(self, node):
        self.names.add(node.attr)
        self.generic_visit(node)


def used_together():
    """Sets of texts, one for each test with all that it uses of its own file and program.py."""
    common = ast.parse((SOURCE / "tests" / "cli" / "program.py").read_text())
    for path in sorted((SOURCE / "tests" / "cli").glob("test_*.py")):
        if path.name == "test_options.py":
            continue
        tree = ast.parse(path.read_text())
        parts = {}
        for node in [*ast.walk(common), *ast.walk(tree)]:
            if isinstance(node, ast.FunctionDef):
                parts.setdefault(node.name, []).append(Texts(node))
            elif isinstance(node, ast.Assign):
                for target in node.targets:
                    name = getattr(target, "id", getattr(target, "attr", None))
                    parts.setdefault(name, []).append(Texts(node.value))
        for name in [n for n in parts if n and n.startswith("test_")]:
            texts, todo, seen = set(), ["setUp", name], set()
            while todo:
                part = todo.pop()
                if part in seen:
                    continue
                seen.add(part)
                for found in parts.get(part, []):
                    texts |= found.texts
                    todo += found.names
            yield texts


class Options(unittest.TestCase):
    def test_each_is_used_by_a_test(self):
        tests = list(used_together())
        self.assertGreater(len(tests), 100)
        options = list(table())
        self.assertGreater(len(options), 80)
        unused = [f"{command} {', '.join(names)}" for command, names in options
                  if ", ".join(names) not in ONCE_FOR_ALL and not any(
                      set(command.split()) <= texts and texts & set(names) for texts in tests)]
        self.assertEqual([], unused)

    def test_an_option_that_no_test_uses_would_be_found(self):
        self.assertFalse(any("--an-option-of-no-command" in texts for texts in used_together()))
        self.assertTrue(any({"golden", "accept", "--only"} <= texts for texts in used_together()))
        self.assertFalse(any({"schema", "--only"} <= texts and "figures" not in texts and "golden" not in texts
                             for texts in used_together()))


if __name__ == "__main__":
    unittest.main()
