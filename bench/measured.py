#!/usr/bin/env python3
"""Published measurements beside what carom makes of them: the tables of docs/real-balls.md.

usage: measured.py CAROM [--write]

Each row is one number that somebody has measured and published, and the same number of a scene of
scenes/measured, which names the source. Prints Markdown; --write puts it between the page's markers.
"""
import csv
import math
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "real-balls.md"
BEGIN, END = "<!-- measured:begin -->\n", "<!-- measured:end -->\n"
FOOT, YARD = 0.3048, 0.9144

NEWTON = "Newton 1726, II, Exper. 13"
TRACKMAN = "TrackMan, PGA Tour averages"
STATCAST = "Statcast"

# scene, ball, what is read, factor to the unit, unit, measured, its uncertainty (None: none is given), source
ROWS = [
    *[("newton_globes", f"globe_{i}", "fall", 1, "s", seconds, 0.25, NEWTON)
      for i, seconds in enumerate((8.2, 7.7, 7.7, 7.95, 8.2, 7.7), 1)],
    ("golf_flights", "driver", "carry", 1 / YARD, "yd", 275, None, TRACKMAN),
    ("golf_flights", "driver", "apex", 1 / YARD, "yd", 32, None, TRACKMAN),
    ("golf_flights", "wood_3", "carry", 1 / YARD, "yd", 243, None, TRACKMAN),
    ("golf_flights", "iron_3", "carry", 1 / YARD, "yd", 212, None, TRACKMAN),
    ("golf_flights", "iron_4", "carry", 1 / YARD, "yd", 203, None, TRACKMAN),
    ("golf_flights", "iron_5", "carry", 1 / YARD, "yd", 194, None, TRACKMAN),
    ("golf_flights", "iron_5", "apex", 1 / YARD, "yd", 31, None, TRACKMAN),
    ("baseball_flights", "stanton", "carry", 1 / FOOT, "ft", 462, None, f"{STATCAST}, Kagan 2016"),
    ("baseball_flights", "hard_hit", "carry", 1 / FOOT, "ft", 350, None, f"{STATCAST}, Tango 2024"),
    ("stimpmeter", "ball", "speed after 30 in", 1 / FOOT, "ft/s", 6.00, None, "USGA"),
    ("golf_restitution", "viscoelastic_130", "restitution", 1, "", 0.797, None, "USGA, by Wikipedia"),
    ("golf_restitution", "plastic_130", "restitution", 1, "", 0.797, None, "USGA, by Wikipedia"),
    ("off_glass", "steep", "spin over rolling", 1, "", 1.0, None, "Rémond et al. 2023"),
    ("off_glass", "middle", "spin over rolling", 1, "", 1.0, None, "Rémond et al. 2023"),
]


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Run:
    """A scene's motion at 1000 rows a second, and its events."""

    def __init__(self, carom, scene, folder):
        motion, events = Path(folder) / "motion.csv", Path(folder) / "events.csv"
        done = subprocess.run([carom, "simulate", ROOT / "scenes" / "measured" / f"{scene}.yaml", "-o", motion,
                               "--events", events, "--rate", "1000", "-y", "-q"], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(done.stderr)
        self.motion, self.events = rows_of(motion), rows_of(events)

    def of(self, ball):
        return [{k: float(v) for k, v in row.items() if k != "ball"} for row in self.motion if row["ball"] == ball]

    def first_impact(self, ball):
        return next(row for row in self.events if row["ball"] == ball and row["kind"] == "impact")


def fall(run, ball):
    return float(run.first_impact(ball)["time"])


def carry(run, ball):
    return float(run.first_impact(ball)["x"]) - run.of(ball)[0]["x"]


def apex(run, ball):
    motion = run.of(ball)
    return max(row["z"] for row in motion) - motion[0]["z"]


def restitution(run, ball):
    return float(run.first_impact(ball)["restitution"])


def speed_after_30_in(run, ball):
    """Between two rows in proportion to the way."""
    motion, way = run.of(ball), 30 * 0.0254
    at = [math.dist([row[k] for k in "xyz"], [motion[0][k] for k in "xyz"]) for row in motion]
    speed = [math.hypot(row["vx"], row["vy"], row["vz"]) for row in motion]
    i = next(i for i, s in enumerate(at) if s >= way)
    part = (way - at[i - 1]) / (at[i] - at[i - 1])
    return speed[i - 1] + part * (speed[i] - speed[i - 1])


def spin_over_rolling(run, ball):
    """r w / v after the impact: 1 rolls, less slides."""
    last = run.of(ball)[-1]
    return 0.02 * last["wy"] / last["vx"]


READ = {"fall": fall, "carry": carry, "apex": apex, "restitution": restitution,
        "speed after 30 in": speed_after_30_in, "spin over rolling": spin_over_rolling}


def text(value):
    return f"{value:.3f}" if value < 2 else f"{value:.2f}" if value < 20 else f"{value:.0f}"


def table(carom):
    lines = ["| Scene | Ball | What | Measured | carom | Off | Source |", "|---|---|---|---:|---:|---:|---|"]
    runs = {}
    with tempfile.TemporaryDirectory() as folder:
        for scene, ball, what, factor, unit, measured, uncertainty, source in ROWS:
            run = runs.setdefault(scene, None) or Run(carom, scene, folder)
            runs[scene] = run
            found = READ[what](run, ball) * factor
            unit = f" {unit}" if unit else ""
            spread = "" if uncertainty is None else f" ± {uncertainty}"
            lines.append(f"| {scene} | {ball} | {what} | {text(measured)}{spread}{unit} | {text(found)}{unit} | "
                         f"{100 * (found / measured - 1):+.1f} % | {source} |")
    return "\n".join(lines) + "\n"


def main():
    made = table(Path(sys.argv[1]).resolve())
    if "--write" not in sys.argv:
        sys.stdout.write(made)
        return
    page = PAGE.read_text(encoding="utf-8")
    before, rest = page.split(BEGIN)
    PAGE.write_text(before + BEGIN + made + END + rest.split(END)[1], encoding="utf-8")


if __name__ == "__main__":
    main()
