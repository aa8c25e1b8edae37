"""The process among others: what it is started with, what the system does not give it."""

import fcntl
import os
import pty
import resource
import signal
import struct
import subprocess
import termios
import time
import unittest

from faults import FaultyTest
from long_work import GAS, RESTING
from program import CAROM, SMALL_SCENE, ProgramTest, run

DROP = ["fit", "--drop", "1.8", "--rebound", "1.3"]


def closing(*descriptors):
    return lambda: [os.close(d) for d in descriptors]


class Streams(ProgramTest):
    def commands(self):
        """Words after the program, and the exit code that they have with all streams open."""
        scene, out = self.scene, self.folder / "out"
        out.mkdir(exist_ok=True)
        invalid = self.write("invalid.yaml", self.scene.read_text().replace("radius", "radios"))
        goldens = ["--dir", self.folder / "goldens"]
        if not (self.folder / "a.png").exists():
            run("still", scene, "--time", "0", "-o", self.folder / "a.png")
            run("still", scene, "--time", "0.4", "-o", self.folder / "b.png")
            run("golden", "update", scene, *goldens, "--time", "0.1")
        return [
            (["render", scene, "-o", out / "f.mp4", "-y", "--progress", "bar", "-v"], 0),
            (["render", scene, "-o", out / "g.mkv", "-o", out / "%d.png", "-y", "--progress", "bar"], 0),
            (["still", scene, "--time", "0.2", "-o", out / "s.png", "-y"], 0),
            (["simulate", scene, "-o", "-", "--progress", "bar"], 0),
            (["check", scene], 0),
            (["check", invalid], 3),
            (["check", "nosuch.yaml"], 2),
            (["compare", self.folder / "a.png", self.folder / "b.png"], 5),
            (["golden", "check", scene, *goldens, "--time", "0.1"], 0),
            ([*DROP, "-o", out / "p.svg", "-y"], 0),
            (["fit", "--drop", "1"], 2),
            (["figures", "-o", out, "--only", "table1", "-y"], 0),
            (["accuracy", scene, "-o", out, "-y", "--steps", "0.01", "--repeats", "1"], 0),
            (["schema"], 0),
            (["info"], 0),
            (["nosuch"], 2),
            (["render", scene], 2),
            (["render", scene, "-o", self.folder / "no" / "f.mp4"], 4),
        ]

    def test_standard_error_that_cannot_be_written_changes_nothing(self):
        read, write = os.pipe()
        os.close(read)
        full = os.open("/dev/full", os.O_WRONLY)
        for command, code in self.commands():
            words = [CAROM, *map(str, command)]
            right = subprocess.run(words, capture_output=True)
            self.assertEqual(code, right.returncode, f"{command} {right.stderr}")
            for how in ({"stderr": full}, {"stderr": write}, {"preexec_fn": closing(2)}):
                result = subprocess.run(words, stdout=subprocess.PIPE, **how)
                self.assertEqual(code, result.returncode, f"{command} {how}")
                if "accuracy" not in command:  # times
                    self.assertEqual(right.stdout, result.stdout, f"{command} {how}")
        os.close(write)
        os.close(full)

    def test_closed_descriptors_are_not_given_to_files(self):
        command = ["render", self.scene, "--progress", "bar", "-o"]
        self.assert_exit(0, run(*command, self.folder / "right.mp4"))
        right = (self.folder / "right.mp4").read_bytes()
        for closed in ([2], [0], [1], [0, 2], [1, 2], [0, 1, 2]):
            film = self.folder / f"{'_'.join(map(str, closed))}.mp4"
            result = subprocess.run([CAROM, *map(str, command), str(film)], preexec_fn=closing(*closed))
            self.assertEqual(0, result.returncode, closed)
            self.assertEqual(right, film.read_bytes(), closed)

    def test_a_closed_descriptor_that_is_asked_for_is_an_error(self):
        for words, closed, code in ((["simulate", self.scene, "-o", "-"], 1, 4), (["check", "-"], 0, 2)):
            result = subprocess.run([CAROM, *map(str, words)], stderr=subprocess.PIPE, preexec_fn=closing(closed))
            self.assertEqual(code, result.returncode, result.stderr)
            self.assertIn(b"Bad file descriptor", result.stderr)

    def test_a_reader_of_messages_that_goes_away_changes_nothing(self):
        film = self.folder / "f.mp4"
        command = f"{CAROM} render {self.scene} -o {film} --fps 400 --progress bar -v 2>&1 | head -1; exit ${{PIPESTATUS[0]}}"
        result = subprocess.run(["bash", "-c", command], capture_output=True)
        self.assertEqual(0, result.returncode)
        self.assertTrue(film.exists())


class Limits(ProgramTest):
    def test_a_file_that_may_not_grow_is_a_write_error(self):
        def little():
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
        noise = self.write("resting.yaml", RESTING.replace("1e6", "10"))
        out = self.folder / "out"
        out.mkdir()
        for command in (["simulate", noise, "-o", out / "m.csv"],
                        ["simulate", self.scene, "--stats", out / "s.json", "--events", out / "e.csv",
                         "--rate", "2000", "-o", out / "m.csv"],
                        ["still", self.scene, "--time", "0.2", "-o", out / "s.png", "--size", "1280x720"],
                        ["render", self.scene, "-o", out / "f.mp4", "--size", "640x360"],
                        ["render", self.scene, "-o", out / "f.mkv", "--size", "640x360"],
                        ["render", self.scene, "-o", out / "%d.png", "--size", "640x360"],
                        ["render", self.scene, "-o", "-", "--format", "gif", "--size", "640x360"],
                        ["golden", "update", self.scene, "--dir", out, "--time", "0.2", "--size", "640x360"],
                        [*DROP, "-o", out / "p.svg"],
                        [*DROP, "-o", out / "p.png"]):
            temporary = self.folder / "tmp"
            temporary.mkdir(exist_ok=True)
            result = run(*command, preexec_fn=little, env={**os.environ, "TMPDIR": str(temporary)})
            self.assert_exit(4, result)
            self.assertIn("File too large", result.stderr, command)
            self.assertEqual([], [p.name for p in [*out.iterdir(), *temporary.iterdir()]], command)

    def test_a_full_disk_ends_the_rows_at_once_and_says_why(self):
        resting = self.write("resting.yaml", RESTING)
        start = time.monotonic()
        result = run("simulate", resting, "-o", "/dev/full")
        self.assert_exit(4, result)
        self.assertIn("/dev/full': No space left on device", result.stderr)
        self.assertLess(time.monotonic() - start, 10)  # all rows would take minutes

    def test_a_folder_that_cannot_be_written_is_found_before_simulating(self):
        gas = self.write("gas.yaml", GAS)  # would take for ever
        file = self.write("file", "")
        for target in ("frames/", "frames/%05d.png"):
            result = run("render", gas, "-o", file / target, "--set", "film.speed=1e5", timeout=20)
            self.assert_exit(4, result)
            self.assertIn("Not a directory", result.stderr)
        if os.getuid() == 0:
            return  # may write everywhere
        closed = self.folder / "closed"
        closed.mkdir(mode=0o500)
        for target in ("", "frames/", "%05d.png"):
            result = run("render", gas, "-o", closed / target, "--set", "film.speed=1e5", timeout=20)
            self.assert_exit(4, result)
            self.assertIn("Permission denied", result.stderr)


class Faults(FaultyTest):
    def assert_does_without(self, words, result, right):
        """The same as with all, or an exit code of 1 that says what could not be had."""
        said = f"{words}\n{result.stderr}"
        if result.returncode == 1:
            self.assertRegex(result.stderr, b"(?i)thread|resource temporarily unavailable|memory", said)
        else:
            self.assertEqual(0, result.returncode, said)
            if "mkv" in words:  # x264 codes otherwise with other numbers of threads
                self.assertGreater(len(result.stdout), 0.5 * len(right.stdout), said)
            else:
                self.assertEqual(right.stdout, result.stdout, said)

    def test_fewer_threads_do_the_same(self):
        png = ["render", self.scene, "-o", "-", "--format", "png", "--frames", "0-2"]
        film = ["render", self.scene, "-o", "-", "--format", "mkv"]
        still = ["still", self.scene, "--time", "0.2", "-o", "-"]
        for words, most in ((["check", self.scene], 1), (["simulate", self.scene, "-o", "-"], 2), (DROP, 1),
                            (still, 4), (png, 5), (film, 6)):
            right = run(*words, text=False)
            self.assert_exit(0, right)
            done = 0
            for which in [str(n) for n in range(1, most + 1)] + ["1+", "2+"]:
                result = self.short_of(words, FAIL_THREAD=which)
                self.assert_does_without(words, result, right)
                done += result.returncode == 0
            print(f"    {words[0]}: {done} of {most + 2} do with fewer threads")
            self.assertGreater(done, 0)

    def test_frames_and_goldens_are_made_with_no_thread(self):
        # With a camera frames are drawn while the motion is computed, where there is a thread for that.
        for name, camera in (("a", ""), ("b", "camera: {from: [0, -3, 1], to: [0, 0, 0.3]}\n")):
            scene = self.write(f"{name}.yaml", SMALL_SCENE + camera)
            frames, right = self.folder / name, self.folder / f"{name}_right"
            self.assertEqual(0, self.short_of(["render", scene, "-o", frames], FAIL_THREAD="1+").returncode)
            self.assertEqual(0, run("render", scene, "-o", right).returncode)
            self.assert_exit(0, run("compare", frames, right, "--tolerance", "0"))

    def test_what_needs_no_film_does_without_film_libraries(self):
        for words in (["simulate", self.scene, "-o", "-", "--stats", self.folder / "s.json"],
                      ["still", self.scene, "--time", "0", "-o", "-"]):
            self.assertEqual(0, self.short_of(words, FAIL_LIBRARY="avcodec").returncode)
        result = self.short_of(["render", self.scene, "-o", self.folder / "f.mp4"], FAIL_LIBRARY="avcodec")
        self.assertEqual(1, result.returncode)
        self.assertIn(b"films need FFmpeg", result.stderr)
        result = self.short_of(["still", self.scene, "--time", "0", "-o", "-"], FAIL_LIBRARY="OSMesa,EGL")
        self.assertEqual(1, result.returncode)
        self.assertIn(b"pictures need OSMesa", result.stderr)

    def test_the_environment_does_not_choose_another_driver(self):
        still = ["still", self.scene, "--time", "0.2", "-o", "-"]
        self.assert_environment_changes_nothing(still, (
            "GALLIUM_DRIVER=d3d12", "GALLIUM_DRIVER=zink", "GALLIUM_DRIVER=swr", "GALLIUM_DRIVER=none",
            "MESA_GLSL_VERSION_OVERRIDE=120", "MESA_GL_VERSION_OVERRIDE=2.1", "LP_PERF=no_blend",
            "MESA_EXTENSION_OVERRIDE=-GL_ARB_texture_float", "LP_NUM_THREADS=0"))

    def test_too_little_memory_is_said(self):
        scene = self.write("gas.yaml", GAS.replace("1e6", "1"))
        for megabytes in (150, 300, 500, 800, 1200):
            for words in (["simulate", scene, "-o", "-"], ["still", scene, "--time", "0", "-o", "-"],
                          ["render", scene, "-o", self.folder / f"{megabytes}.mp4"]):
                def little():
                    resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))
                result = run(*words, text=False, preexec_fn=little)
                self.assertIn(result.returncode, (0, 1), f"{megabytes} MB: {words} {result.stderr}")
                if result.returncode == 1:
                    self.assertRegex(result.stderr, b"(?i)memory|thread|unavailable|failed to map", words)
                    self.assertNotIn(b"GL_", result.stderr)


class Terminals(ProgramTest):
    def lines(self, words, columns, later=None, term="xterm"):
        """What a terminal of so many columns gets from standard error; `later` are its columns soon after."""
        leader, follower = pty.openpty()
        def set_size(width):
            fcntl.ioctl(follower, termios.TIOCSWINSZ, struct.pack("HHHH", 24, width, 0, 0))
        set_size(columns)
        process = subprocess.Popen([CAROM, *map(str, words)], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=follower, env={**os.environ, "TERM": term})
        text = b""
        end = time.monotonic() + 2.5
        while time.monotonic() < end:
            if later and text.count(b"\r") >= 3:
                set_size(later)
                later, mark = None, len(text)
                text += b"|"
            fcntl.fcntl(leader, fcntl.F_SETFL, os.O_NONBLOCK)
            try:
                text += os.read(leader, 4096)
            except BlockingIOError:
                time.sleep(0.02)
            if text.count(b"\r") >= 8:
                break
        process.send_signal(signal.SIGTERM)
        process.wait()
        os.close(leader)
        os.close(follower)
        return text.decode()

    def test_a_bar_fits_the_terminal_as_it_is(self):
        gas = self.write("gas.yaml", GAS)
        for columns, later in ((40, None), (20, None), (200, None), (80, 30), (30, 80)):
            text = self.lines(["simulate", gas, "-o", self.folder / "m.csv"], columns, later)
            bars = text.split("\r\033[K")[1:]
            self.assertGreaterEqual(len(bars), 5, text)
            before = [b for b in text.split("|")[0].split("\r\033[K")[1:]]
            self.assertTrue(all(len(b) < columns for b in before), before)
            self.assertFalse(any("\n" in b for b in bars[:-1]), bars)
            if later:
                after = text.split("|")[1].split("\r\033[K")[2:-1]
                self.assertTrue(after and all(len(b) < later for b in after), after)

    def test_a_dumb_terminal_gets_plain_lines(self):
        gas = self.write("gas.yaml", GAS)
        for progress in ("auto", "bar"):
            text = self.lines(["simulate", gas, "-o", self.folder / "m.csv", "--progress", progress], 80, term="dumb")
            self.assertNotIn("\033", text)
            self.assertLessEqual(text.count("\n"), 3, text)

    def test_long_simulations_show_seconds_of_motion(self):
        gas = self.write("gas.yaml", GAS)
        for words in (["simulate", gas, "-o", self.folder / "m.csv"],
                      ["render", gas, "-o", self.folder / "f.mp4", "--set", "film.speed=1e6"],
                      ["still", gas, "--time", "1", "-o", self.folder / "s.png"]):
            text = self.lines(words, 120)
            self.assertRegex(text, r"\[=* *\] \d+/1000000 s simulated, [\d.]+/s, [\d:]+ left")
        until_rest = self.write("rest.yaml", GAS.replace("duration: 1e6", "duration: rest, max_duration: 1e5"))
        self.assertRegex(self.lines(["simulate", until_rest, "-o", self.folder / "m.csv"], 120),
                         r"\r\033\[K\d+\.\d+ s simulated, [\d.]+/s")


if __name__ == "__main__":
    unittest.main()
