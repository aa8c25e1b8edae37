"""carom report: one page that holds all it shows, whatever the scene says."""

import base64
import gzip
import hashlib
import html.parser
import json
import re
import statistics
import unittest

from program import SMALL_SCENE, ProgramTest, SOURCE, run

HOSTILE = """\
carom: 1
# </pre><script>alert('comment')</script>
title: "</title><script>alert(1)</script> <img src=x onerror=alert(2)> \\u202eevil & \\"quotes\\""
simulation: {duration: 0.8}
materials:
  rubber: {restitution: 0.8}
surfaces:
  - {name: floor, plane: {normal: [0, 0, 1], offset: 0}}
balls:
  - {name: a, radius: 0.1, material: rubber, position: [0, 0, 0.6]}
film: {size: [160, 90], fps: 10}
overlay: {caption: "</script><script>alert(4)</script>"}
"""


SWEEP = """\
base: scene.yaml
axes:
  balls.a.position[2]: {from: 0.6, to: 1.6, steps: 3}
  balls.a.radius: [0.05, 0.1, 0.15, 0.2]
  simulation.duration: [2]
  film.size: {choice: [[64, 64]]}
results: {top: 'peak("a", 1)'}
outputs: {stills: [0.2]}
"""


class Page(html.parser.HTMLParser):
    """Elements with their attributes, and the texts within them."""

    def __init__(self, text):
        super().__init__()
        self.elements, self.texts, self.inside = [], {}, None
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        self.inside = f"{tag}#{dict(attributes).get('id', '')}"

    def handle_data(self, data):
        self.texts[self.inside] = self.texts.get(self.inside, "") + data

    def named(self, tag):
        return [attributes for name, attributes in self.elements if name == tag]


class Report(ProgramTest):
    def report(self, scene, *more):
        path = self.folder / "report.html"
        self.assert_exit(0, run("report", scene, "-o", path, "-q", "-y", *more))
        return path.read_text()

    def test_it_holds_the_film_the_motion_and_every_impact(self):
        text = self.report(SOURCE / "scenes" / "figure8.yaml", "--size", "160x90")
        page = Page(text)
        film = page.named("video")[0]["src"].removeprefix("data:video/mp4;base64,")
        self.assertEqual(b"ftyp", base64.b64decode(film)[4:8])
        motion = json.loads(gzip.decompress(base64.b64decode(page.texts["script#motion"])))
        impacts = [event for event in motion["events"] if event[3] == "impact"]
        self.assertGreater(len(impacts), 5)
        rows = re.findall(r'<tr><td><button type="button">([\d.]+)</button>', text)
        self.assertEqual([f"{event[0]:.6f}" for event in impacts], rows)
        off = re.search(r"impacts are off by at most (\S+) s, heights by (\S+) of", text)
        self.assertLess(float(off[1]), 1e-12)
        self.assertLess(float(off[2]), 1e-12)
        self.assertTrue("product: " in text)
        self.assertTrue("(x 0.42 m, v 5 m/s)" in text)
        self.assertIn("drop_height", page.texts["pre#"])
        self.assertIn("three.js authors", page.texts["pre#"])

    def test_the_same_bytes_again_and_on_standard_output(self):
        first = self.report(self.scene)
        self.assertEqual(first, self.report(self.scene, "--backend", "osmesa", "--progress", "none"))
        self.assertEqual(first, run("report", self.scene, "-o", "-", "-q").stdout)

    def test_the_policy_names_the_scripts_that_are_there(self):
        text = self.report(self.scene)
        page = Page(text)
        policy = page.named("meta")[1]["content"]
        self.assertIn("default-src 'none'", policy)
        self.assertNotIn("unsafe", policy)

        def hashed(source):
            digest = hashlib.sha256(source.encode()).digest()
            return f"'sha256-{base64.b64encode(digest).decode()}'"

        allowed = re.search("script-src ([^;]*);", policy)[1].split()
        three = gzip.decompress(base64.b64decode(page.texts["script#three"])).decode()
        running = re.findall(r"<script>(.*?)</script>", text, re.S)
        self.assertEqual([hashed(running[0]), hashed(three)], allowed)
        self.assertEqual(1, len(running))
        style = re.search(r"<style>(.*?)</style>", text, re.S)[1]
        self.assertIn(hashed(style), policy)

    def test_a_scene_of_any_words_stays_text(self):
        text = self.report(self.write("hostile.yaml", HOSTILE))
        page = Page(text)
        kinds = [attributes.get("type", "") for attributes in page.named("script")]
        self.assertEqual(["text/plain", "text/plain", "application/json", ""], kinds)
        self.assertTrue(all("onerror" not in attributes for _, attributes in page.elements))
        self.assertFalse("<script>alert" in text)
        self.assertFalse("\u202e" in text)
        self.assertEqual(1, len(page.named("title")))
        self.assertIn("alert('comment')", page.texts["pre#"])
        for uri in (value for _, attributes in page.elements for key, value in attributes.items()
                    if key in ("src", "href")):
            self.assertRegex(uri, "^(data:|#)")

    def test_a_drop_test_says_its_verdict(self):
        text = self.report(SOURCE / "scenes" / "official" / "fiba_basketball.yaml",
                           "--size", "160x90", "--set", "film.fps=5")
        self.assertRegex(text, '<p class="(good|bad)">[^<]*FIBA')

    def test_speed_beside_error(self):
        text = self.report(self.scene, "--accuracy")
        self.assertTrue('<table id="errors">' in text)
        # The method exact, and two solvers of fixed with seven steps each.
        self.assertEqual([1, 14], [text.count(f'<tr><th scope="row">{method}')
                                   for method in ("exact", "fixed")])
        self.assertFalse('<table id="errors">' in self.report(self.scene))

    def test_several_scenes_in_one_table(self):
        other = self.write("other.yaml", HOSTILE)
        page = self.folder / "overview.html"
        self.assert_exit(0, run("report", self.scene, other, "-o", page, "-q"))
        text = page.read_text()
        parsed = Page(text)
        self.assertEqual(2, len(parsed.named("img")))
        self.assertEqual(["scene.yaml", "other.yaml"],
                         re.findall(r'</th><td>(\w+\.yaml)</td>', text))
        self.assertEqual([""], [a.get("type", "") for a in parsed.named("script")])
        self.assertFalse("<script>alert" in text)
        self.assert_exit(2, run("report", self.scene, other, "-o", page, "-y", "--accuracy"))
        bad = self.write("bad.yaml", "carom: 1\nbals: []\n")
        self.assert_exit(3, run("report", self.scene, bad, "-o", self.folder / "none.html"))
        self.assertNotIn("none.html", self.names())

    def test_a_second_run_is_there_as_ghosts(self):
        """Its own motion, where it touches the same surfaces; no script where there is none."""
        other = "against: {{set: [{}], view: side}}\n"
        lower = self.write("lower.yaml", SMALL_SCENE + other.format("'balls.a.position[2]=0.4'"))
        page = Page(self.report(lower))
        first, second = (json.loads(gzip.decompress(base64.b64decode(page.texts[f"script#{name}"])))
                         for name in ("motion", "second"))
        self.assertEqual(0.4, second["balls"][0]["pieces"][0]["p"][2])
        self.assertNotEqual(0.4, first["balls"][0]["pieces"][0]["p"][2])
        self.assertIn("v-second", [a.get("id") for a in page.named("input")])
        moved = self.write("moved.yaml", SMALL_SCENE + other.format("'surfaces.floor.plane.offset=-1'"))
        for scene in (moved, self.scene):
            page = Page(self.report(scene))
            self.assertNotIn("script#second", page.texts)
            self.assertNotIn("v-second", [a.get("id") for a in page.named("input")])

    def sweep(self, text):
        sweep, folder = self.write("sweep.yaml", text), self.folder / "runs of <b>"
        self.assert_exit(0, run("sweep", sweep, "-o", folder, "-q"))
        return folder

    def test_the_folder_of_a_sweep(self):
        """Plots of each result over each axis, with a series for each value of the other one."""
        folder = self.sweep(SWEEP)
        text = self.report(folder)
        page = Page(text)
        self.assertEqual("runs of <b>: 12 runs", page.texts["title#"].strip())
        # e^2 = 0.64 of the gap that it falls through.
        tops = [0.64 * (z - r) for z in (0.6, 1.1, 1.6) for r in (0.05, 0.1, 0.15, 0.2)]
        self.assertEqual([f"top over {axis}: 12 points, {min(tops):.4g} to {max(tops):.4g}"
                          for axis in ("balls.a.position[2]", "balls.a.radius")],
                         [a["aria-label"] for a in page.named("svg") if "aria-label" in a])
        self.assertIn(f'<td class="n">{statistics.median(tops):.6g}</td><td class="n">'
                      f'{statistics.mean(tops):.6g}</td>', text)
        self.assertEqual(12, text.count('<tr><th scope="row">') - 1)
        self.assertEqual([4, 3], [plot.split("<ul")[0].count('class="points')
                                  for plot in text.split("</figure>")[:2]])
        self.assertEqual(12, len(page.named("img")))
        self.assertEqual({("64", "64")}, {(a["width"], a["height"]) for a in page.named("img")})
        self.assertIn("Run 5: balls.a.position[2] 1.1, balls.a.radius 0.1",
                      [a["alt"] for a in page.named("img")])
        self.assertEqual(text, self.report(folder))

    def test_a_thousand_runs_are_a_small_page(self):
        folder = self.sweep(SWEEP.split("axes:")[0] + "mode: random\ncount: 1000\naxes: {\"balls.a.position[2]\": "
                            "{uniform: [0.6, 2]}, balls.a.mass: {log_uniform: [0.01, 10]}}\nresults: "
                            "{top: 'peak(\"a\", 1)', left: 'energy(\"a\", duration)'}\n")
        text = self.report(folder)
        self.assertLess(len(text.encode()), 2_000_000)
        self.assertEqual(1000 + 2, text.count('<tr><th scope="row">'))
        self.assertIn("log₁₀ balls.a.mass", text)

    def test_folders_without_a_table_are_refused(self):
        folder = self.sweep(SWEEP)
        for words in ([folder, self.scene], [folder, "--accuracy"], [folder, "--size", "64x64"],
                      [self.folder]):
            self.assert_exit(2, run("report", *words, "-o", self.folder / "none.html"))
        index = folder / "index.csv"
        index.write_text(index.read_text() + "12,1\n")
        wrong = run("report", folder, "-o", self.folder / "none.html")
        self.assert_exit(2, wrong)
        self.assertIn("index.csv:14: 2 cells in a table of 9 columns", wrong.stderr)
        self.assertNotIn("none.html", self.names())

    def test_figure_9_is_small(self):
        """At most 4/3 of film and pictures, and 900 KB."""
        text = self.report(SOURCE / "scenes" / "figure9.yaml", "--set", "film.fps=5")
        embedded = sum(len(uri) for uri in re.findall(r"data:(?:video|image)/[^\"]*", text))
        self.assertLess(len(text.encode()) - embedded, 900_000)

    def test_what_is_no_page_is_refused(self):
        self.assert_exit(2, run("report", self.scene, "-o", self.folder / "report.pdf"))
        self.write("old.html", "kept")
        self.assert_exit(4, run("report", self.scene, "-o", self.folder / "old.html"))
        self.assert_exit(3, run("report", self.write("bad.yaml", "carom: 1\nbals: []\n"),
                                "-o", self.folder / "new.html"))
        self.assertEqual(["bad.yaml", "old.html"], self.names())


if __name__ == "__main__":
    unittest.main()
