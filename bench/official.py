#!/usr/bin/env python3
"""The official drop tests, then and now, in a vacuum and in air: tables and plots of docs/real-balls.md.

usage: official.py CAROM [--write]

Prints two tables: whether the paper's balls pass each rule, and what their coefficients are in speeds.
--write puts them between the page's markers, and makes docs/balls/*.svg (with gnuplot): what air, rolling
resistance and a coefficient that falls with the speed do to each ball.
"""
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "real-balls.md"
BEGIN, END = "<!-- official:begin -->\n", "<!-- official:end -->\n"
PLOTS = ROOT / "docs" / "balls"
COLORS = ("#c8501e", "#2a6fb0", "#2f8f4e", "#7b3fa0", "#8a6d00")

# scene, ball, height it falls from [m]
TESTS = {"fiba_basketball": ("basketball", 1.8), "fivb_volleyball": ("volleyball", 1.0),
         "fifa_football": ("football", 2.0), "itf_tennis": ("tennis", 2.54),
         "ittf_table_tennis": ("table_tennis", 0.305)}

# scene, whose rule, window of the first rebound [m], measured to, the text it is from
RULES = [
    ("fiba_basketball", "FIBA 2010", (1.20, 1.40), "top", "Official Basketball Rules 2010, the paper's reference 8"),
    ("fiba_basketball", "FIBA now", (1.035, 1.085), "bottom", "*Basketball Equipment 2020*, as Wikipedia gives it"),
    ("fivb_volleyball", "the paper", (0.60, 0.66), "bottom", "its Table 1; the FIVB's rules name no rebound"),
    ("fifa_football", "FIFA 2010", (1.20, 1.65), "bottom", "FIFA Approved, until 2015 (adsport.sk)"),
    ("fifa_football", "FIFA now", (1.35, 1.55), "bottom", "FIFA Quality Pro (derbystar.de, decathlon.in)"),
    ("itf_tennis", "ITF, then and now", (1.346, 1.473), "bottom", "Rules of Tennis, Appendix I: 53 to 58 inches"),
    ("ittf_table_tennis", "ITTF, then and now", (0.240, 0.260), "bottom", "Technical Leaflet T3 (2016)"),
]


def run(carom, *words):
    done = subprocess.run([str(word) for word in (carom, *words)], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return done.stdout


def simulated(carom, scene, folder, *settings):
    """Peaks [s, m], and the impacts' approach and separation speeds, of a scene's first ball."""
    stats, events = Path(folder) / "stats.json", Path(folder) / "events.csv"
    words = [word for setting in settings for word in ("--set", setting)]
    run(carom, "simulate", scene, "-o", Path(folder) / "motion.csv", "--events", events, "--stats", stats,
        "-y", "-q", *words)
    peaks = next(iter(json.loads(stats.read_text())["balls"].values()))["peaks"]
    lines = [line.split(",") for line in events.read_text().splitlines()]
    rows = [dict(zip(lines[0], line)) for line in lines[1:]]
    impacts = [(float(row["approach_speed"]), float(row["separation_speed"])) for row in rows
               if row["kind"] == "impact"]
    return [(peak["time"], peak["height"]) for peak in peaks], impacts


def official(name):
    return ROOT / "scenes" / "official" / f"{name}.yaml"


IN_AIR = ("air.density=1.225",)


def diameter(carom, scene):
    """By where the ball's middle starts: a radius above what it falls from."""
    rows = [row.split(",") for row in run(carom, "simulate", official(scene), "-o", "-", "--set",
                                          "simulation.duration=0.001", "--set", "film.stills=[]").splitlines()]
    return 2 * (float(rows[1][rows[0].index("z")]) - TESTS[scene][1])


def verdict(height, window):
    low, high = window
    return "passes" if low <= height <= high else f"{100 * (low - height):.1f} cm short" if height < low else \
        f"{100 * (height - high):.1f} cm too high"


def coefficient(carom, drop, rebound, *words):
    return json.loads(run(carom, "fit", "--drop", drop, "--rebound", repr(rebound), "--json", *words))["restitution"]


def tables(carom):
    passes = ["| Ball | Rule | From, m | To, m | As ε: vacuum, air | In a vacuum | In air | Text |",
              "|---|---|---:|---|---|---|---|---|"]
    speeds = ["| Ball | The paper's ε | Impact, m/s: vacuum, air | Rebound, m/s: vacuum, air | "
              "First rebound, m: vacuum, air | ε that rebounds as high in air |", "|---|---:|---|---|---|---:|"]
    with tempfile.TemporaryDirectory() as folder:
        found = {name: (simulated(carom, official(name), folder), simulated(carom, official(name), folder, *IN_AIR))
                 for name in TESTS}
        for scene, rule, window, to, source in RULES:
            ball, drop = TESTS[scene]
            up = diameter(carom, scene) if to == "top" else 0
            heights = [peaks[0][1] + up for peaks, _ in found[scene]]
            place = " (top)" if to == "top" else ""
            bounds = [[coefficient(carom, drop, height - up, *words) for height in window]
                      for words in ((), ("--air", "--ball", ball))]
            passes.append(f"| {ball} | {rule} | {drop} | {window[0]}–{window[1]}{place} | "
                          + ", ".join(f"{low:.3f}–{high:.3f}" for low, high in bounds) + " | "
                          + " | ".join(f"{height:.3f}: {verdict(height, window)}" for height in heights)
                          + f" | {source} |")
        for scene, (ball, drop) in TESTS.items():
            (peaks, impacts), (peaks_air, impacts_air) = found[scene]
            (v, u), (v_air, u_air) = impacts[0], impacts_air[0]
            fit = coefficient(carom, drop, peaks[0][1], "--air", "--ball", ball)
            speeds.append(f"| {ball} | {u / v:.4f} | {v:.3f}, {v_air:.3f} | {u:.3f}, {u_air:.3f} | "
                          f"{peaks[0][1]:.3f}, {peaks_air[0][1]:.3f} | {fit:.4f} |")
    return "\n".join(passes) + "\n\n" + "\n".join(speeds) + "\n"


def gnuplot(name, title, x, y, curves, extra=""):
    """curves: (title, points)."""
    blocks, words = [], []
    for i, (label, points) in enumerate(curves):
        blocks.append(f"$data{i} << EOD\n" + "\n".join(f"{a!r} {b!r}" for a, b in points) + "\nEOD\n")
        words.append(f"$data{i} with linespoints lw 2 pt 7 ps 0.5 lc rgb '{COLORS[i]}' title '{label}'")
    script = "".join(blocks) + (
        "set terminal svg size 800,480 font 'Inter,14' background 'white'\n"
        f"set output '{PLOTS / name}.svg'\nset title '{title}'\nset xlabel '{x}'\nset ylabel '{y}'\n"
        f"set grid lc rgb '#dddddd'\nset border 3\nset tics nomirror\nset key outside right\n{extra}\n"
        "plot " + ", ".join(words) + "\n")
    done = subprocess.run(["gnuplot"], input=script, text=True, capture_output=True)
    if done.returncode != 0:
        sys.exit(done.stderr)


def plot_air(carom, folder):
    curves = []
    for scene, (ball, _) in TESTS.items():
        long = ("simulation.duration=6",)
        vacuum, _ = simulated(carom, official(scene), folder, *long)
        air, _ = simulated(carom, official(scene), folder, *long, *IN_AIR)
        count = min(8, len(vacuum), len(air))
        curves.append((ball.replace("_", " "), [(n + 1, 100 * air[n][1] / vacuum[n][1]) for n in range(count)]))
    gnuplot("air", "What air leaves of each rebound", "rebound", "height, % of that in a vacuum", curves,
            "set xrange [0.8:8.2]")


def plot_speed(carom, folder):
    """The first rebound over the drop, with the viscoelastic law that has the paper's coefficient at the test."""
    curves = []
    for scene, (ball, drop) in TESTS.items():
        (_, impacts) = simulated(carom, official(scene), folder)
        v, u = impacts[0]
        part = (1 - math.sqrt(1 - 2.4 * (1 - u / v))) / 1.2  # of 1 - x + 0.6 x^2 = e
        gamma = part / v**0.2
        points = []
        for factor in (0.05, 0.1, 0.25, 0.5, 1, 2, 4):
            law = {"carom": 1, "simulation": {"duration": 12},
                   "materials": {"m": {"restitution": {"viscoelastic": {"gamma": gamma}}}},
                   "surfaces": [{"name": "floor", "plane": {}}],
                   "balls": [{"name": "a", "preset": ball, "material": "m", "drop_height": factor * drop}]}
            path = Path(folder) / "law.yaml"
            path.write_text(json.dumps(law))
            peaks, _ = simulated(carom, path, folder)
            points.append((factor, 100 * peaks[0][1] / (factor * drop)))
        curves.append((ball.replace("_", " "), points))
    gnuplot("speed", "A coefficient that falls with the speed (viscoelastic)", "drop over that of the test",
            "first rebound, % of the drop", curves, "set logscale x\nset xrange [0.04:5]")


def plot_rolling(carom, folder):
    """From 2 m/s, the published coefficients of rolling resistance, alone and with air."""
    balls = {"billiard ball on cloth, 0.010": (0.028575, 0.17, 0.01), "golf ball, Stimpmeter 13, 0.043":
             (0.021335, 0.04593, 0.043), "golf ball, Stimpmeter 8, 0.070": (0.021335, 0.04593, 0.0699)}
    curves = []
    for label, (radius, mass, rolling) in balls.items():
        scene = {"carom": 1, "simulation": {"duration": 25}, "materials": {"m": {"friction": 1, "rolling": rolling}},
                 "surfaces": [{"name": "floor", "plane": {}, "material": "m"}],
                 "pairs": [{"between": ["m", "m"], "friction": 0.5, "rolling": rolling}],
                 "balls": [{"name": "a", "radius": radius, "mass": mass, "material": "m",
                            "position": [0, 0, radius], "velocity": [2, 0, 0], "spin": [0, 2 / radius, 0]}]}
        path = Path(folder) / "rolling.yaml"
        path.write_text(json.dumps(scene))
        rows = run(carom, "simulate", path, "-o", "-", "--rate", 5).splitlines()
        at = {name: i for i, name in enumerate(rows[0].split(","))}
        points = [(float(row.split(",")[at["x"]]), float(row.split(",")[at["vx"]])) for row in rows[1:]]
        moving = [i for i, (_, v) in enumerate(points) if v > 0]
        curves.append((label, points[:moving[-1] + 2]))
    gnuplot("rolling", "Rolling from 2 m/s", "way, m", "speed, m/s", curves, "set logscale x\nset xrange [0.3:25]\nset key inside left bottom")


def main():
    carom = Path(sys.argv[1]).resolve()
    made = tables(carom)
    if "--write" not in sys.argv:
        sys.stdout.write(made)
        return
    page = PAGE.read_text(encoding="utf-8")
    before, rest = page.split(BEGIN)
    PAGE.write_text(before + BEGIN + made + END + rest.split(END)[1], encoding="utf-8")
    PLOTS.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        plot_air(carom, folder)
        plot_speed(carom, folder)
        plot_rolling(carom, folder)


if __name__ == "__main__":
    main()
