"""Whatever a scene asks, `check` and the start of a run answer soon and in bounded memory.

The promise is 2 s and 1 GB. CPU seconds are taken twice, for machines that share their cores with others; what is not
bounded takes ten times as long.
"""

import os
import resource
import unittest

from program import CAROM, ProgramTest

MOST_S, MOST_MB = 4, 1000


def listed(row, count, start="[", end="]"):
    return start + ", ".join(row(i) for i in range(count)) + end


def rows(row, count):
    return "\n".join(row(i) for i in range(count)) + "\n"


def table(count, value):
    return "{speed: " + listed(lambda i: str(i + 1), count) + ", value: " + listed(value, count) + "}"


BALL = "balls: [{name: a, radius: 0.1, position: [0, 0, 1]}]\n"

# Name -> the text behind `carom: 1`. Written when they are needed: they are large.
SCENES = {
    "ten million balls": lambda: "balls: [{name: a, radius: 0.1, position: [0, 0, 1], "
                                 "repeat: {count: [1000, 100, 100], spacing: 0.3}}]\n",
    "balls in one place": lambda: "balls: [{name: a, radius: 0.1, position: [0, 0, 1], "
                                  "repeat: {count: [100, 100, 20], spacing: 0}}]\n",
    "balls over planes": lambda: "surfaces:\n" + rows(lambda i: f"- {{name: s{i}, plane: {{offset: -{i}}}}}", 50_000)
    + "balls: [{name: a, radius: 0.1, position: [0, 0, 1], repeat: {count: [100, 100, 10], spacing: 0.3}}]\n",
    "a table of a restitution": lambda: "materials: {m: {restitution: "
    + table(200_000, lambda i: f"{0.9 - i * 1e-7:.7f}") + "}}\n" + BALL,
    "tables of restitution": lambda: "materials:\n" + rows(
        lambda k: f"  m{k}: {{restitution: {table(10_000, lambda i: f'{0.9 - i * 1e-7:.7f}')}}}", 10)
    + "balls:\n" + rows(lambda k: f"- {{name: b{k}, radius: 0.1, position: [{k}, 0, 1], material: m{k}}}", 10),
    "mistakes in one line": lambda: "balls: " + listed(lambda i: "{nam: a, radios: x}", 100_000) + "\n",
    "unknown keys": lambda: rows(lambda i: f"k{i}: 1", 300_000),
    "unknown materials": lambda: "materials:\n" + rows(lambda i: f"  m{i}: {{restitution: 0.5}}", 60_000)
    + "balls:\n" + rows(lambda i: f"- {{name: b{i}, radius: 0.1, position: [{i}, 0, 1], material: n{i}}}", 60_000),
    "a second run of very many changes": lambda: BALL + "against: {set: "
    + listed(lambda i: '"simulation.duration=1"', 100_000) + "}\n",
    "a key of megabytes": lambda: "x" * 8_000_000 + ": 1\n",
    "a title of megabytes": lambda: 'title: "' + "x" * 8_000_000 + '"\n',
    "nested": lambda: "x: " + "[" * 8_000_000 + "\n",
    "aliases": lambda: "a: &a [1, 1]\n" + rows(lambda i: f"a{i}: &a{i} [*a, *a]", 1000),
    "colons": lambda: "x: " + ":" * 4_000_000 + "\n",
    "blank": lambda: "\n" * 8_000_000,
}


class HostileScenes(ProgramTest):
    def answer(self, *words):
        """Exit code, CPU seconds and megabytes of the program alone."""
        report = self.folder / "usage"
        # A fork of this process would count its memory.
        words = ["/bin/sh", "-c", 'exec "$0" "$@"', CAROM, *map(str, words)]
        pid = os.posix_spawn(words[0], words, os.environ, file_actions=[
            (os.POSIX_SPAWN_OPEN, 1, str(report), os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600),
            (os.POSIX_SPAWN_OPEN, 2, str(report), os.O_WRONLY | os.O_APPEND, 0o600)])
        _, status, usage = os.wait4(pid, 0)
        return os.waitstatus_to_exitcode(status), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024

    def test_check_and_the_start_of_a_run_answer(self):
        resource.setrlimit(resource.RLIMIT_CPU, (600, 600))
        for name, text in SCENES.items():
            scene = self.write("hostile.yaml", "carom: 1\n" + text())
            with self.subTest(name=name):
                code, seconds, megabytes = self.answer("check", scene)
                print(f"    {name}: {seconds:.1f} s of at most {MOST_S}, {megabytes:.0f} MB of at most {MOST_MB}")
                self.assertIn(code, (0, 3))
                self.assertLess(seconds, MOST_S)
                self.assertLess(megabytes, MOST_MB)
                if code == 3:
                    still = self.answer("still", scene, "--time", 0, "-o", self.folder / "s.png")
                    self.assertEqual(3, still[0])
                    self.assertLess(still[1], MOST_S)
            scene.unlink()


if __name__ == "__main__":
    unittest.main()
