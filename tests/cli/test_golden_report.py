"""carom golden as a product: limits, ignored parts, orphans, reports that other programs read, and accept."""

import base64
import hashlib
import html.parser
import json
import re
import shutil
import struct
import subprocess
import unittest
import xml.etree.ElementTree as xml
import zlib

import yaml

from png_making import RGB, RGBA, chunk, png
from program import CAROM, SMALL_SCENE, SOURCE, ProgramTest, run


def pixels(data):
    """Rows of an 8-bit RGB or RGBA PNG as lists of tuples, read without carom."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, idat = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
        idat += body if kind == b"IDAT" else b""
        at += 12 + length
    n = {RGB: 3, RGBA: 4}[colour]
    assert depth == 8
    raw, rows, before = zlib.decompress(idat), [], bytearray(width * n)
    for y in range(height):
        kind, line = raw[y * (width * n + 1)], bytearray(raw[y * (width * n + 1) + 1:(y + 1) * (width * n + 1)])
        for i in range(width * n):
            left, up, corner = (line[i - n] if i >= n else 0), before[i], (before[i - n] if i >= n else 0)
            guess = left + up - corner
            paeth = min((left, up, corner), key=lambda v: abs(guess - v))
            line[i] = line[i] + (0, left, up, (left + up) // 2, paeth)[kind] & 255
        rows.append([tuple(line[i:i + n]) for i in range(0, width * n, n)])
        before = line
    return rows


class Page(html.parser.HTMLParser):
    """What of a page matters here: texts, tags, and the pictures by the names of their rules."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.texts, self.open = [], [], []
        self.feed(text)
        self.close()
        assert not self.open, f"left open: {self.open}"
        self.pictures = {name: base64.b64decode(data, validate=True) for name, data in re.findall(
            r"\.(\w+)\{background-image:url\(data:image/png;base64,([^)]*)\)\}", text)}

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))
        if tag not in ("meta", "input", "link"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.texts.append(data)


class GoldenTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.goldens = self.folder / "G"
        self.reports = {k: self.folder / f"r.{k}" for k in ("html", "xml", "json")}
        self.base = [self.scene, "--dir", self.goldens, "--size", "96x54", "--time", 0, "--time", 0.2]

    def update(self, *options):
        result = run("golden", "update", *(options or self.base))
        self.assert_exit(0, result)
        return result

    def check(self, code, *options, reports=True):
        names = ["--html", self.reports["html"], "--junit", self.reports["xml"], "--json", self.reports["json"], "-y"]
        result = run("golden", "check", *self.base, *options, *(names if reports else []))
        self.assert_exit(code, result)
        return result

    def golden(self, time):
        return self.goldens / f"scene-t{time:.6f}.png"

    def report(self):
        return json.loads(self.reports["json"].read_text())

    moved = ["--set", "balls.a.position[0]=0.03"]


class Limits(GoldenTest):
    def test_both_limits_hold_together_and_say_by_how_much(self):
        self.update()
        found = self.check(5, *self.moved, reports=False).stdout
        largest = int(re.search(r"largest difference (\d+) of 255", found)[1])
        count, total = map(int, re.search(r"(\d+) of (\d+) pixels", found).groups())
        self.assertIn(f"off by {largest}, {largest - 2} more than the 2 of 255 allowed", found)
        share = count / total
        self.assertGreater(share, 0.005)
        only_first = self.check(5, *self.moved, "--max-differing", 1, reports=False).stdout
        self.assertIn("more than the 2 of 255", only_first)
        self.assertNotIn("pixels differ,", only_first)
        only_second = self.check(5, *self.moved, "--tolerance", 255, "--max-differing", 0.001, reports=False).stdout
        allowed = int(0.001 * total)
        self.assertIn(f"{count} pixels differ, {count - allowed} more than the {allowed} (0.1 %) allowed", only_second)
        self.check(0, *self.moved, "--tolerance", 255, "--max-differing", 1, reports=False)

    def test_the_same_renderer_can_be_held_to_more(self):
        self.update()
        golden = self.golden(0)
        data, rows = golden.read_bytes(), pixels(golden.read_bytes())
        self.check(0)
        renderer = next(s["renderer"] for s in self.report()["stills"])
        said = chunk(b"tEXt", b"Renderer\0" + renderer.encode())
        self.assertIn(said, data)

        def changed(off, text):
            # One channel of one pixel in the sky.
            r, g, b = rows[3][50][:3]
            made = png(96, 54, lambda x, y: (r - off, g, b) if (x, y) == (50, 3) else rows[y][x][:3], colour=RGB,
                       extra=text)
            golden.write_bytes(made)

        other = chunk(b"tEXt", b"Renderer\0another one")
        for off, text, code in ((0, said, 0), (1, said, 0), (2, said, 5), (2, b"", 0), (2, other, 0), (3, other, 5)):
            changed(off, text)
            self.check(code, "--same-renderer", 1)
        changed(2, said)
        found = self.check(5, "--same-renderer", 1).stdout
        self.assertIn("off by 2, 1 more than the 1 of 255 allowed to the renderer that drew the golden", found)
        self.assertEqual({"tolerance": 2, "max_differing": 0.01}, self.report()["limits"])
        self.check(0)
        self.update(*self.base, "--same-renderer", 1)
        self.assertEqual(data, golden.read_bytes())

    def test_update_says_what_it_would_write(self):
        dry = self.update(*self.base, "--dry-run").stdout
        self.assertIn(f"would write: {self.golden(0)}: there is no golden", dry)
        self.assertIn("2 of 2 would be written", dry)
        self.assertFalse(self.goldens.exists())
        self.update()
        before = {p: p.read_bytes() for p in self.goldens.iterdir()}
        changed = self.update(*self.base, *self.moved, "--dry-run").stdout
        self.assertIn(f"would write: {self.golden(0.2)}: largest difference", changed)
        self.assertEqual(before, {p: p.read_bytes() for p in self.goldens.iterdir()})
        self.assertIn("0 of 2 would be written", self.update(*self.base, "--dry-run").stdout)
        # What counts as the same stays.
        self.update(*self.base, *self.moved, "--tolerance", 255, "--max-differing", 1)
        self.assertEqual(before, {p: p.read_bytes() for p in self.goldens.iterdir()})


class Ignored(GoldenTest):
    def setUp(self):
        super().setUp()
        self.update()
        # A golden with a block of 20 x 10 pixels that nobody draws.
        rows = pixels(self.golden(0).read_bytes())
        block = lambda x, y: (255, 0, 255) if 30 <= x < 50 and 5 <= y < 15 else rows[y][x]
        self.golden(0).write_bytes(png(96, 54, block, colour=RGB))

    def test_a_rectangle_is_neither_compared_nor_counted(self):
        self.assertIn("200 of 5184 pixels", self.check(5, reports=False).stdout)
        side = self.goldens / "scene-t0.000000.ignore.yaml"
        side.write_text("ignore:\n  - {x: 30, y: 5, width: 20, height: 10, why: a stamp}\n")
        self.check(0)
        still = self.report()["stills"][0]
        self.assertEqual((5184 - 200, 0), (still["measures"]["pixels"], still["measures"]["differing_pixels"]))
        self.assertEqual([{"x": 30, "y": 5, "width": 20, "height": 10}], still["ignored"])
        # One column short, ten pixels are seen; two rectangles that overlap cover their union.
        side.write_text("ignore: [{x: 31, y: 5, width: 19, height: 10}, {x: 40, y: 0, width: 15, height: 20}]\n")
        found = self.check(5).stdout
        self.assertIn(f"10 of {5184 - 9 * 10 - 15 * 20} pixels", found)
        # The same for all of a scene.
        side.unlink()
        (self.goldens / "scene.ignore.yaml").write_text("ignore: [{x: 30, y: 5, width: 20, height: 10}]\n")
        self.check(0)
        self.assertEqual([], self.report()["orphans"])

    def test_mistakes_are_named_by_their_place(self):
        side = self.goldens / "scene.ignore.yaml"
        for text, words in (("ignore: [{x: 0, y: 0, width: 97, height: 1}]", "leaves the picture of 96x54"),
                            ("ignore: [{x: 0, y: 0, width: 96, height: 54}]", "nothing to compare"),
                            ("ignore:\n  - {x: 0, y: 0, widht: 5, height: 1}", "2:18: error: unknown key 'widht'"),
                            ("ignore:\n  - {x: 0, y: 0, widht: 5, height: 1}", "did you mean 'width'"),
                            ("ignore: [{x: 0, y: 0, width: 0, height: 1}]", "'width' must be a whole number"),
                            ("ignore: [{x: 0.5, y: -1, width: 1, height: 1}]", "'y' must be a whole number"),
                            ("ignore: [[0, 0, 1, 1]]", "a rectangle is a mapping"),
                            ("ignored: []", "the only one is 'ignore'"), ("{}", "expected 'ignore:'"),
                            ("[]", "expected 'ignore:'"), ("ignore: [{x: 1", "scene.ignore.yaml:")):
            side.write_text(text + "\n")
            result = run("golden", "check", *self.base)
            self.assert_exit(2, result)
            self.assertIn(words, result.stderr, text)


class Orphans(GoldenTest):
    def test_goldens_and_side_files_without_a_scene_are_named(self):
        self.update()
        for name in ("old-t1.000000.png", "scene-t0.400000.png", "old.ignore.yaml"):
            (self.goldens / name).write_bytes(self.golden(0).read_bytes())
        for name in ("notes.txt", "logo.png", "x-t1.png"):
            (self.goldens / name).write_text("no golden")
        result = self.check(0)
        named = re.findall(r"^orphan: (.*): none of these", result.stdout, re.M)
        self.assertEqual([str(self.goldens / n) for n in ("old-t1.000000.png", "old.ignore.yaml",
                                                          "scene-t0.400000.png")], named)
        self.assertEqual(named, self.report()["orphans"])
        self.assertNotIn("orphan", self.check(0, "-q").stdout)
        self.assertIn("orphan", self.check(5, "--orphans-fail").stdout)
        self.assertIn("orphan", self.update(*self.base).stdout)
        for k in range(9):
            (self.goldens / f"o-t{k}.000000.png").write_text("")
        self.assertIn("orphans: 2 more\n", self.check(0).stdout)
        self.assertEqual(12, len(self.report()["orphans"]))


class Html(GoldenTest):
    def page(self):
        return Page(self.reports["html"].read_text())

    def test_the_page_has_the_pictures_and_no_more_than_60_kb_besides(self):
        self.update()
        self.check(5, *self.moved)
        page = self.page()
        files = {}
        for k, time in enumerate((0, 0.2)):
            golden = self.golden(time).read_bytes()
            drawn = (self.folder / "r-drawn" / f"scene-t{time:.6f}.drawn.png").read_bytes()
            files[k] = golden
            self.assertEqual(golden, page.pictures[f"g{k}"])
            # What has changed, laid on the golden at its place, is what was drawn.
            style = next(a["style"] for t, a in page.tags if t == "i" and a.get("class") == f"c{k} m")
            left, top, width, height = map(int, re.findall(r"(\d+)px", style))
            patch, rows, want = pixels(page.pictures[f"c{k}"]), pixels(golden), pixels(drawn)
            self.assertEqual((height, width), (len(patch), len(patch[0])))
            self.assertLess(width * height, 96 * 54)
            for y in range(height):
                rows[top + y][left:left + width] = patch[y]
            self.assertEqual(want, rows)
        embedded = sum(map(len, page.pictures.values()))
        size = self.reports["html"].stat().st_size
        self.assertLessEqual(size, embedded * 4 / 3 + 60_000)
        drawn = sum(p.stat().st_size for p in (self.folder / "r-drawn").glob("*.drawn.png"))
        self.assertLessEqual(size, sum(map(len, files.values())) + drawn + 60_000)
        text = " ".join(page.texts)
        for words in ("Expected", "Actual", "Difference", "blink", "slider", "more than the 2 of 255 allowed",
                      "limits: 2 of 255 and 1 % of the pixels"):
            self.assertIn(words, text)

    def test_the_page_loads_nothing_and_runs_one_script(self):
        self.update()
        self.check(5, *self.moved)
        text = self.reports["html"].read_text()
        self.assertNotRegex(re.sub(r"url\(data:image/png;base64,[^)]*\)|url\(#amplify\)", "", text), r"url\(|src=|href=|http:")
        script = re.search(r"<script>(.*?)</script>", text)[1]
        wanted = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
        policy = next(a["content"] for t, a in self.page().tags if t == "meta" and "content" in a)
        self.assertEqual("default-src 'none'; img-src data:; style-src 'unsafe-inline'; "
                         f"script-src 'sha256-{wanted}'", policy)
        # The amplifier is difference_image()'s: 0 stays, k becomes 48 + 8 k.
        table = re.search(r'feFuncR type="table" tableValues="([^"]*)"', text)[1].split()
        self.assertEqual(256, len(table))
        for k, value in enumerate(table):
            self.assertAlmostEqual(min(255, 48 + 8 * k) if k else 0, 255 * float(value), delta=0.02)

    def test_all_the_same_missing_unreadable_and_other_sizes(self):
        self.update()
        self.check(0)
        self.assertEqual({}, self.page().pictures)
        self.golden(0).unlink()
        self.golden(0.2).write_bytes(b"GIF89a")
        self.check(5)
        page = self.page()
        self.assertEqual(["w0", "w1"], sorted(page.pictures))
        self.assertIn("unreadable", " ".join(page.texts))
        self.update()
        result = run("golden", "check", *self.base, "--size", "64x36", "--html", self.reports["html"], "-y")
        self.assert_exit(5, result)
        self.assertEqual(["g0", "g1", "w0", "w1"], sorted(self.page().pictures))
        self.assertIn("sizes differ (96x54, drawn 64x36)", " ".join(self.page().texts))

    def test_transparent_pictures_are_there_whole(self):
        see_through = ["--set", "background=transparent", "--set", "camera={from: [0, -3, 0.5], to: [0, 0, 0.3]}"]
        self.update(*self.base, *see_through)
        self.check(5, *see_through, *self.moved)
        self.assertEqual(["d0", "d1", "g0", "g1", "w0", "w1"], sorted(self.page().pictures))

    def test_hostile_names_are_escaped_everywhere(self):
        name = "a<img src=x onerror=alert(1)>&\"'\x1b[31m\u202e"
        scene = self.folder / f"{name}.yaml"
        scene.write_text(SMALL_SCENE)
        self.base[0] = scene
        self.check(5)
        page = self.page()
        self.assertNotIn("img", [tag for tag, _ in page.tags])
        self.assertFalse([a for _, a in page.tags if any(k.startswith("on") for k in a)])
        self.assertIn("a<img src=x onerror=alert(1)>", " ".join(page.texts))
        raw = self.reports["html"].read_text() + self.reports["xml"].read_text()
        self.assertNotRegex(raw, "[\x00-\x08\x0b-\x1f\x7f-\x9f\u202e]")
        case = xml.parse(self.reports["xml"]).getroot().find(".//testcase")
        self.assertIn("<img src=x onerror=alert(1)>&\"'", case.get("name"))
        self.assertEqual(str(scene), self.report()["stills"][0]["scene"])


class JunitAndJson(GoldenTest):
    def test_junit_counts_by_kind(self):
        other = self.write("other.yaml", SMALL_SCENE)
        broken = self.write("broken.yaml", "carom: 1\nbals: []\n")
        self.update(self.scene, other, *self.base[1:])
        self.golden(0).unlink()
        self.golden(0.2).write_bytes(b"")
        run("golden", "check", self.scene, other, broken, *self.base[1:], "--junit", self.reports["xml"])
        root = xml.parse(self.reports["xml"]).getroot()
        self.assertEqual(("testsuites", "5", "1", "2"), (root.tag, *(root.get(k) for k in (
            "tests", "failures", "errors"))))
        self.assertEqual([("2", "1", "1"), ("2", "0", "0"), ("1", "0", "1")], [tuple(
            s.get(k) for k in ("tests", "failures", "errors")) for s in root])
        cases = root.findall(".//testcase")
        self.assertEqual(["missing", "unreadable", None, None, "invalid"], [
            c[0].get("type") if len(c) else None for c in cases])
        self.assertEqual("scene-t0.000000", cases[0].get("name"))

    def test_reports_of_the_same_have_the_same_bytes_and_are_not_replaced_unasked(self):
        self.update()
        self.check(5, *self.moved)
        before = {k: p.read_bytes() for k, p in self.reports.items()}
        self.check(5, *self.moved)
        self.assertEqual(before, {k: p.read_bytes() for k, p in self.reports.items()})
        for option, path in (("--html", "html"), ("--junit", "xml"), ("--json", "json")):
            self.assert_exit(4, run("golden", "check", *self.base, option, self.reports[path]))
        self.assert_exit(2, run("golden", "check", *self.base, "--json", self.scene, "-y"))
        self.assert_exit(2, run("golden", "check", *self.base, "--html", "x", "--json", "x"))
        self.assertEqual(SMALL_SCENE, self.scene.read_text())


class Accept(GoldenTest):
    def setUp(self):
        super().setUp()
        self.update()
        self.old = {t: self.golden(t).read_bytes() for t in (0, 0.2)}
        self.check(5, *self.moved)
        self.drawn = {t: (self.folder / "r-drawn" / f"scene-t{t:.6f}.drawn.png").read_bytes() for t in (0, 0.2)}

    def accept(self, code, *options, **keywords):
        result = run("golden", "accept", "--from", self.reports["json"], *options, **keywords)
        self.assert_exit(code, result)
        return result

    def goldens_now(self):
        return {t: self.golden(t).read_bytes() for t in (0, 0.2)}

    def test_all_or_chosen_ones(self):
        self.assertIn("would accept", self.accept(0, "--dry-run").stdout)
        self.assertEqual(self.old, self.goldens_now())
        self.assertIn(f"accepted: {self.golden(0.2)} (replaced)", self.accept(0, "--only", "scene-t0.200000").stdout)
        self.assertEqual({0: self.old[0], 0.2: self.drawn[0.2]}, self.goldens_now())
        self.check(5, *self.moved)
        self.accept(0, "--only", "scene")
        self.assertEqual(self.drawn, self.goldens_now())
        self.check(0, *self.moved)
        self.assertIn("nothing to accept", self.accept(0).stdout)

    def test_names_that_are_not_there(self):
        result = self.accept(2, "--only", "scene-t0.200000,scene-t0.20000")
        self.assertIn("did you mean 'scene-t0.200000'?", result.stderr)
        self.assertEqual(self.old, self.goldens_now())

    def test_what_has_changed_since_is_refused_before_anything_is_written(self):
        second = self.folder / "r-drawn" / "scene-t0.200000.drawn.png"
        second.write_bytes(self.drawn[0])
        self.assertIn("is not the picture", self.accept(2).stderr)
        self.assertEqual(self.old, self.goldens_now())
        second.unlink()
        self.accept(2)
        second.write_bytes(self.drawn[0.2])
        self.golden(0.2).write_bytes(self.drawn[0])
        self.assertIn("has changed since", self.accept(2).stderr)
        self.assertEqual(self.old[0], self.golden(0).read_bytes())
        self.golden(0.2).unlink()
        self.assertIn("has changed since", self.accept(2).stderr)

    def test_a_report_from_elsewhere_can_do_no_harm(self):
        report = self.report()
        for change, words in (({"name": "../scene-t0.000000"}, "no name of a still"), ({"name": "scene"}, "no name"),
                              ({"drawn": 7}, "without 'drawn'"), ({"golden_checksum": None}, "golden_checksum")):
            hostile = json.loads(json.dumps(report))
            hostile["stills"][0].update(change)
            self.reports["json"].write_text(json.dumps(hostile))
            self.assertIn(words, self.accept(2).stderr)
        # A text in place of a picture, with its right checksum.
        (self.folder / "r-drawn" / "scene-t0.000000.drawn.png").write_text("#!/bin/sh\n")
        self.accept(2)
        for text in ("", "[]", "{}", "{\"carom_golden_report\": 2, \"stills\": []}", "\x00\xff"):
            self.reports["json"].write_text(text)
            self.assertIn("no report of", self.accept(2).stderr)
        self.assertEqual(self.old, self.goldens_now())

    def test_a_report_may_be_moved_with_its_pictures(self):
        # Goldens are found from where one is, pictures from where the report is.
        project = self.folder / "P"
        project.mkdir()
        (project / "scene.yaml").write_text(SMALL_SCENE)
        options = ["scene.yaml", "--dir", "goldens", "--size", "32x18", "--time", "0"]
        (project / "out").mkdir()
        self.assert_exit(5, run("golden", "check", *options, "--json", "out/r.json", cwd=project))
        elsewhere = self.folder / "downloads"
        shutil.move(project / "out", elsewhere)
        self.assert_exit(0, run("golden", "accept", "--from", elsewhere / "r.json", cwd=project))
        self.assert_exit(0, run("golden", "check", *options, cwd=project))


class Services(ProgramTest):
    """The CI files of docs/goldens.md, by running their commands in a project as they would be."""

    def files(self):
        text = (SOURCE / "docs" / "goldens.md").read_text()
        blocks = [yaml.safe_load(b) for b in re.findall(r"^```yaml\n(.*?)^```", text, re.M | re.S)]
        github = next(b for b in blocks if "jobs" in b)
        gitlab = next(b for b in blocks if "goldens" in b)
        steps = github["jobs"]["goldens"]["steps"]
        kept = next(s["with"]["path"] for s in steps if "upload-artifact" in s.get("uses", ""))
        yield "\n".join(s["run"] for s in steps if "run" in s and s["name"] != "Install carom"), kept.split()
        artifacts = gitlab["goldens"]["artifacts"]
        yield "\n".join(gitlab["goldens"]["script"]), artifacts["paths"] + [artifacts["reports"]["junit"]]

    def test_their_commands_pass_fail_and_leave_what_is_kept(self):
        found = 0
        for number, (commands, kept) in enumerate(self.files()):
            found += 1
            project = self.folder / f"p{number}"
            (project / "scenes").mkdir(parents=True)
            (project / "scenes" / "a.yaml").write_text(SMALL_SCENE.replace("fps: 20", "fps: 20, stills: [0, 0.2]"))
            tools = self.folder / "bin"
            tools.mkdir(exist_ok=True)
            if not (tools / "carom").exists():
                (tools / "carom").symlink_to(CAROM)
            path = f"{tools}:/usr/bin:/bin"

            def service(script):
                return subprocess.run(["bash", "-e", "-c", script], cwd=project, env={"PATH": path}, text=True,
                                      capture_output=True, timeout=300)
            missing = service(commands)
            self.assertEqual(5, missing.returncode, missing.stderr)
            for name in kept:
                self.assertTrue((project / name).exists(), name)
            self.assertEqual(0, service("carom golden accept --from goldens.json").returncode)
            passed = service(commands)
            self.assertEqual(0, passed.returncode, passed.stdout + passed.stderr)
            (project / "scenes" / "a.yaml").write_text(SMALL_SCENE)
            self.assertNotEqual(0, service(commands).returncode)
        self.assertEqual(2, found)


if __name__ == "__main__":
    unittest.main()
