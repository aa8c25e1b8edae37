#!/usr/bin/env python3
"""What air takes from the first rebound of the five presets: the table of docs/real-balls.md.

usage: air_rebounds.py CAROM

Each ball falls from its test's height, in a vacuum and in air of 1.225 kg/m^3, and bounces on what
gives it the paper's coefficient. Prints Markdown: speed of impact, first rebound, what `fit` reads
from that rebound with and without --air, and how far the rebound is from the closed form.
"""
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

DROPS = {"basketball": 1.8, "volleyball": 1.0, "football": 2.0, "tennis": 2.54,
         "table_tennis": 0.305}
GRAVITY = 9.81


def run(carom, *words):
    done = subprocess.run([carom, *words], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return done.stdout


def bounce(carom, preset, drop, air, folder):
    """Impact speed, peak, coefficient."""
    scene, events = Path(folder) / "scene.yaml", Path(folder) / "events.csv"
    scene.write_text(json.dumps({
        "carom": 1, "simulation": {"duration": 3}, **({"air": {}} if air else {}),
        "surfaces": [{"name": "floor", "plane": {}}],
        "balls": [{"name": "a", "preset": preset, "drop_height": drop}]}))
    stats = Path(folder) / "stats.json"
    run(carom, "simulate", scene, "-o", Path(folder) / "motion.csv", "--events", events,
        "--stats", stats, "-y", "-q")
    header, first = (line.split(",") for line in events.read_text().splitlines()[:2])
    row = dict(zip(header, first))
    peak = json.loads(stats.read_text())["balls"]["a"]["peaks"][0]["height"]
    return float(row["approach_speed"]), peak, float(row["restitution"])


def closed_form(preset, drop, e):
    """The rebound in air with buoyancy: V^2 = 2 m g' / (rho A C_D), q = V^2 / 2g'."""
    radius, mass, drag = {
        "basketball": (0.7645 / (2 * math.pi), 0.6085, 0.50),
        "volleyball": (0.66 / (2 * math.pi), 0.27, 0.47),
        "football": (0.69 / (2 * math.pi), 0.4325, 0.50),
        "tennis": (0.066995 / 2, 0.0577, 0.507),
        "table_tennis": (0.02, 0.0027, 0.45)}[preset]
    gravity = GRAVITY * (1 - 1.225 * 4 / 3 * math.pi * radius**3 / mass)
    terminal2 = 2 * mass * gravity / (1.225 * math.pi * radius**2 * drag)
    q = terminal2 / (2 * gravity)
    return q * math.log1p(-e * e * math.expm1(-drop / q))


def main():
    carom = Path(sys.argv[1]).resolve()
    print("| Ball | Drop, m | Impact, m/s: vacuum, air | First rebound, m: vacuum, air | Loss | "
          "`fit` without, with `--air` | Coefficient | Off the closed form, m |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for preset, drop in DROPS.items():
            speed, peak, e = bounce(carom, preset, drop, False, folder)
            speed_air, peak_air, _ = bounce(carom, preset, drop, True, folder)
            fits = [json.loads(run(carom, "fit", "--drop", repr(drop), "--rebound", repr(peak_air),
                                   "--json", *words))["restitution"]
                    for words in ((), ("--air", "--ball", preset))]
            off = abs(peak_air - closed_form(preset, drop, e))
            print(f"| {preset} | {drop} | {speed:.3f}, {speed_air:.3f} | {peak:.4f}, "
                  f"{peak_air:.4f} | {100 * (1 - peak_air / peak):.2f} % | {fits[0]:.6f}, "
                  f"{fits[1]:.6f} | {e:.6f} | {off:.0e} |")


if __name__ == "__main__":
    main()
