#!/usr/bin/env python3
"""Two programs of carom against each other: the motion of scenes, in turns.

usage: in_turns.py BEFORE AFTER [SCENE...] [--runs N]

Both compute each scene's motion alone (`simulate --stats`), one after the other and in alternating
order, after one run each that does not count. Prints the median of the CPU time of the motion, the
median of the ratios of neighbouring runs with its quartiles, and whether the motion is the same bit
for bit. Without scenes: Figure 8, the pile of H22, and four that it makes itself:
  bounce    one ball between two walls, for ever
  gas       216 balls in a box that lose nothing, packing 0.13
  dense     1,000 balls in a box that lose nothing, packing 0.30
  collapse  1,024 discs that lose much and gather in clusters, packing 0.35
"""
import argparse
import itertools
import json
import math
import random
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def run(program, scene):
    """CPU seconds of the motion, and its hash."""
    with tempfile.TemporaryDirectory() as folder:
        stats = Path(folder) / "stats.json"
        command = [program, "simulate", scene, "-o", Path(folder) / "motion.csv", "--rate", "1",
                   "--stats", stats, "-q"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))}: {done.stderr.strip()}")
        read = json.loads(stats.read_text())
        return read["cpu_s"]["sim"], read["motion_hash"]


def scene_of(duration, restitution, surfaces, balls):
    """A scene without gravity, as JSON, which is YAML; planes as (normal, offset), balls as (radius,
    position, velocity)."""
    return json.dumps({
        "carom": 1,
        "simulation": {"duration": duration, "gravity": [0, 0, 0]},
        "materials": {"it": {"restitution": 1}},
        "pairs": [{"between": ["it", "it"], "restitution": restitution}],
        "surfaces": [{"name": f"wall{i}", "plane": {"normal": n, "offset": o}, "material": "it"}
                     for i, (n, o) in enumerate(surfaces)],
        "balls": [{"name": f"ball{i}", "radius": r, "position": x, "velocity": v, "material": "it"}
                  for i, (r, x, v) in enumerate(balls)],
    })


def box(side, axes):
    """The planes of a box from 0 to `side` along the first so many axes."""
    planes = []
    for axis in range(axes):
        normal = [float(axis == i) for i in range(3)]
        planes += [(normal, 0), ([-n for n in normal], -side)]
    return planes


def lattice(count, axes, radius, packing, seed):
    """Balls with random velocities on a lattice of count^axes places, and the side of their box."""
    cell = (math.pi / 4 / packing if axes == 2 else math.pi / 6 / packing) ** (1 / axes) * 2 * radius
    draw = random.Random(seed)
    balls = []
    for place in itertools.product(range(count), repeat=axes):
        at = [(i + 0.5 + 0.4 * (draw.random() - 0.5) * (1 - 2 * radius / cell)) * cell for i in place]
        velocity = [draw.gauss(0, 1) for _ in range(axes)]
        balls.append((radius, at + [0.0] * (3 - axes), velocity + [0.0] * (3 - axes)))
    return balls, count * cell


def make_scenes(folder):
    discs, disc_side = lattice(32, 2, 0.05, 0.35, 1)
    gas, gas_side = lattice(6, 3, 0.05, 0.13, 2)
    dense, dense_side = lattice(10, 3, 0.05, 0.30, 3)
    bounce = [(0.1, [0, 0, 1], [0, 0, 1])]
    scenes = {
        "bounce": scene_of(20000, 1, [([0, 0, 1], 0), ([0, 0, -1], -2)], bounce),
        "gas": scene_of(20, 1, box(gas_side, 3), gas),
        "dense": scene_of(2, 1, box(dense_side, 3), dense),
        "collapse": scene_of(40, 0.6, box(disc_side, 2), discs),
    }
    for name, text in scenes.items():
        path = Path(folder) / f"{name}.yaml"
        path.write_text(text)
        yield path


def compare(options, scenes):
    print(f"{'scene':<24} {'before':>10} {'after':>10}   ratio (quartiles)      motion")
    for scene in scenes:
        times, hashes, ratios = ([], []), [None, None], []
        for turn in range(-1, options.runs):
            pair = [0.0, 0.0]
            for which in (0, 1) if turn % 2 == 0 else (1, 0):
                pair[which], hashes[which] = run(options.programs[which], scene)
            if turn < 0:
                continue
            for which in (0, 1):
                times[which].append(pair[which])
            ratios.append(pair[1] / pair[0])
        low, middle, high = statistics.quantiles(ratios, n=4)
        before, after = map(statistics.median, times)
        same = "same" if hashes[0] == hashes[1] else "another"
        print(f"{Path(scene).stem:<24} {before:>9.4f}s {after:>9.4f}s   "
              f"{middle:.3f} ({low:.3f} ... {high:.3f})   {same}", flush=True)


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("\n\n")[1][len("usage: "):])
    parser.add_argument("programs", nargs=2)
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--runs", type=int, default=7)
    options = parser.parse_intermixed_args()
    with tempfile.TemporaryDirectory() as folder:
        compare(options, options.scenes or [ROOT / "scenes" / "figure8.yaml",
                                            ROOT / "scenes" / "hard" / "h22_pile.yaml",
                                            *make_scenes(folder)])


if __name__ == "__main__":
    main()
