"""Figure 9 as a film: tags, frame count, and decoded frames against the PNGs of the same run."""

import json
import pathlib
import subprocess
import tempfile
import unittest

from program import SOURCE, run

SCENE = SOURCE / "scenes" / "figure9.yaml"
FRAMES = 120  # two seconds, with the first meetings
PSNR_BOUND_DB = 38


class Figure9(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.film = cls.folder / "figure9.mp4"
        cls.result = run("render", SCENE, "-o", cls.film, "-o", cls.folder / "png",
                         "--frames", f"0-{FRAMES - 1}", "--size", "640x360")

    def test_exit_code(self):
        self.assertEqual(0, self.result.returncode, self.result.stderr)

    def test_tags_and_frame_count(self):
        probe = subprocess.run(
            ["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-show_format", "-of", "json",
             str(self.film)], capture_output=True, text=True, check=True)
        (stream,) = json.loads(probe.stdout)["streams"]
        expected = {
            "codec_name": "h264", "profile": "High", "pix_fmt": "yuv420p", "width": 640, "height": 360,
            "color_space": "bt709", "color_primaries": "bt709", "color_range": "tv",
            "r_frame_rate": "60/1", "avg_frame_rate": "60/1", "nb_read_frames": str(FRAMES),
        }
        self.assertEqual(expected, {key: stream.get(key) for key in expected})
        self.assertIn(stream["color_transfer"], ("bt709", "iec61966-2-1"))
        self.assertAlmostEqual(FRAMES / 60, float(stream["duration"]), places=6)

    def test_index_stands_first(self):
        data = self.film.read_bytes()
        self.assertLess(data.index(b"moov"), data.index(b"mdat"))

    def test_decoded_frames_match_the_pngs(self):
        decoded = self.folder / "decoded"
        decoded.mkdir()
        subprocess.run(["ffmpeg", "-v", "error", "-i", str(self.film), "-start_number", "0", "-sws_flags",
                        "accurate_rnd+full_chroma_int+bicubic", str(decoded / "frame_%05d.png")], check=True)
        worst = 1e9
        for k in range(0, FRAMES, 7):
            name = f"frame_{k:05}.png"
            result = run("compare", self.folder / "png" / name, decoded / name, "--json")
            worst = min(worst, json.loads(result.stdout)["psnr_luma_db"] or 1e9)
        print(f"worst luma PSNR {worst:.2f} dB, bound {PSNR_BOUND_DB} dB")
        self.assertGreaterEqual(worst, PSNR_BOUND_DB)
        self.assertLess(worst, 1e9)


if __name__ == "__main__":
    unittest.main()
