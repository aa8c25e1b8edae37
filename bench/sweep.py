#!/usr/bin/env python3
"""What a sweep costs: runs without files of short scenes, and films of 64x64 pixels and 60 frames.

usage: sweep.py [CAROM] [--rounds 5] [--runs 4000] [--films 60] [--folder /dev/shm]

Each round makes both sweeps on one core and on two, with as many jobs, in turns. Prints medians: CPU milliseconds of a
run, runs a second as they went by (on a machine that does nothing else), what the CPU time allows
on two cores, the time of 1 job against that of 2, and the cost of a start with nothing to do.
"""
import argparse
import json
import os
import shutil
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

BASE = {
    "carom": 1,
    "simulation": {"duration": 1},
    "materials": {"rubber": {"restitution": 0.8}},
    "surfaces": [{"name": "floor", "plane": {"normal": [0, 0, 1], "offset": 0}}],
    "balls": [{"name": "a", "radius": 0.1, "material": "rubber", "position": [0, 0, 1.1]}],
    "film": {"size": [64, 64], "fps": 60},
}
NUMBERS = {
    "base": "base.yaml", "mode": "random", "count": 0,
    "axes": {"balls.a.position[2]": {"uniform": [0.5, 2]}, "balls.a.mass": {"uniform": [1, 2]}},
    "results": {"top": 'peak("a", 1)', "left": 'energy("a", duration) / energy("a", 0)'},
}


CORES = sorted(os.sched_getaffinity(0))


def timed(carom, folder, name, jobs):
    """Wall and CPU seconds of a sweep into a new folder, on as many cores as jobs."""
    out = folder / "out"
    shutil.rmtree(out, ignore_errors=True)
    begin = time.monotonic()
    process = subprocess.Popen([carom, "sweep", folder / name, "-o", out, "-q", "--progress", "none", "--jobs",
                                str(jobs)], preexec_fn=lambda: os.sched_setaffinity(0, CORES[:jobs]))
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.monotonic() - begin
    if status != 0:
        raise SystemExit(f"{name} failed")
    return wall, usage.ru_utime + usage.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("carom", nargs="?", default="build/release/carom")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--runs", type=int, default=4000)
    parser.add_argument("--films", type=int, default=60)
    parser.add_argument("--folder", default="/dev/shm", help="on a file system that costs nothing")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=options.folder) as name:
        folder = Path(name)
        (folder / "base.yaml").write_text(json.dumps(BASE))
        sweeps = {"numbers.yaml": (options.runs, {**NUMBERS, "count": options.runs}),
                  "films.yaml": (options.films, {**NUMBERS, "count": options.films,
                                                 "outputs": {"film": "mp4", "quality": "draft"}}),
                  "one.yaml": (1, {**NUMBERS, "count": 1})}
        for file, (_, sweep) in sweeps.items():
            (folder / file).write_text(json.dumps(sweep))
        found = {}
        for turn in range(options.rounds):
            for file in sweeps:
                for jobs in ((1, 2) if turn % 2 == 0 else (2, 1)):
                    found.setdefault((file, jobs), []).append(timed(options.carom, folder, file, jobs))
        starts = statistics.median(cpu for _, cpu in found["one.yaml", 1])
        print(f"start and one run: {1000 * starts:.1f} ms of a processor")
        for file, (count, _) in sweeps.items():
            if count == 1:
                continue
            ratios = [a[0] / b[0] for a, b in zip(found[file, 1], found[file, 2])]
            for jobs in (1, 2):
                wall = statistics.median(w for w, _ in found[file, jobs])
                cpu = statistics.median(c for _, c in found[file, jobs])
                print(f"{file} with {jobs} jobs: {1000 * cpu / count:.3f} ms of a processor a run, {count / wall:.1f} "
                      f"runs/s went by, {2 * count / cpu:.1f} runs/s on two free cores")
            print(f"{file}: 2 jobs are {statistics.median(ratios):.2f} times as fast as 1")


main()
