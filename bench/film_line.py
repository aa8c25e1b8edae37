#!/usr/bin/env python3
"""How near the film line is to the encoder alone: whole films by the program, from its start to its
end, beside x264 on the same frames from memory (bench/encoder_alone).

usage: bench/film_line.py [CAROM [ENCODER_ALONE]] [--repeats N]

CPU is that of the whole process, user and system, from the kernel. Where others use the processors
too, frames/s and wall say little; CPU and its ratio to x264 hold.
"""

import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

HUNDRED = """\
carom: 1
simulation: {duration: 10}
materials: {rubber: {restitution: 0.9, friction: 0.3}}
surfaces: [{name: floor, plane: {normal: [0, 0, 1], offset: 0}, material: rubber}]
balls: [{name: a, radius: 0.05, material: rubber, position: [-0.9, -0.9, 0.3],
         repeat: {count: [10, 10, 1], spacing: 0.2, jitter: 0.05, seed: 1}}]
camera: {from: [0, -4, 1.5], to: [0, 0, 0.3], fov_deg: 40}
"""

# All lie still from the beginning; the same size and number of balls as Figure 9.
AT_REST = """\
carom: 1
simulation: {duration: 10}
surfaces: [{name: floor, plane: {normal: [0, 0, 1], offset: 0}}]
materials: {clay: {restitution: 0, friction: 1}}
balls: [{name: a, radius: 0.12, material: clay, position: [-1, 0, 0.12], repeat: {count: [5, 1, 1], spacing: 0.5}}]
camera: {from: [0, -6, 1.5], to: [0, 0, 1], fov_deg: 40}
"""


class Run:
    """A film: frames a second, wall and CPU milliseconds a frame."""

    def __init__(self, carom, scene, out, frames, words):
        before, start = os.times(), time.monotonic()
        subprocess.run([carom, "render", scene, "-o", out, "-q", "-y", *words], check=True)
        wall, after = time.monotonic() - start, os.times()
        cpu = after.children_user + after.children_system - before.children_user - before.children_system
        self.rate, self.wall, self.cpu = frames / wall, 1000 * wall / frames, 1000 * cpu / frames


def main():
    words = sys.argv[1:]
    repeats = int(words[words.index("--repeats") + 1]) if "--repeats" in words else 3
    names = [w for i, w in enumerate(words) if not w.startswith("-") and (i == 0 or words[i - 1] != "--repeats")]
    carom = names[0] if names else "build/bench/carom"
    alone = names[1] if len(names) > 1 else str(pathlib.Path(carom).parent / "bench/encoder_alone")
    cores = os.cpu_count()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        hundred, rest = folder / "hundred.yaml", folder / "rest.yaml"
        hundred.write_text(HUNDRED)
        rest.write_text(AT_REST)
        cases = [("Figure 9, 1080p veryfast", "scenes/figure9.yaml", "1920x1080", "veryfast", "f.mp4"),
                 ("Figure 9, 1080p ultrafast", "scenes/figure9.yaml", "1920x1080", "ultrafast", "f.mp4"),
                 ("Figure 9, 720p veryfast", "scenes/figure9.yaml", "1280x720", "veryfast", "f.mp4"),
                 ("100 balls, 1080p veryfast", hundred, "1920x1080", "veryfast", "f.mp4"),
                 ("at rest, 1080p veryfast", rest, "1920x1080", "veryfast", "f.mp4"),
                 ("Figure 9, 1080p PNG", "scenes/figure9.yaml", "1920x1080", None, "frames/")]
        print(f"{'':28} frames/s   wall    CPU  x264 alone  wall/(CPU/{cores})  CPU/x264   (ms a frame)")
        for title, scene, size, preset, out in cases:
            options = ["--size", size] + (["--preset", preset] if preset else [])
            encoder, frames = None, 600
            if preset:
                text = subprocess.run([alone, str(scene), size, preset], check=True, capture_output=True,
                                      text=True).stdout.split()
                frames, encoder = int(text[0]), float(text[2])
            runs = [Run(carom, str(scene), str(folder / out), frames, options) for _ in range(repeats)]
            middle = {key: statistics.median(getattr(run, key) for run in runs) for key in ("rate", "wall", "cpu")}
            print(f"{title:28} {middle['rate']:8.0f} {middle['wall']:6.2f} {middle['cpu']:6.2f} "
                  + (f"{encoder:11.2f}" if encoder else f"{'':11}")
                  + f" {middle['wall'] / (middle['cpu'] / cores):14.2f}"
                  + (f" {middle['cpu'] / encoder:9.2f}" if encoder else ""), flush=True)


if __name__ == "__main__":
    main()
