#!/usr/bin/env bash
# What OSMesa and EGL cost beside each other: CPU milliseconds of drawing and reading back a frame,
# and a still from the start of the program to the PNG, with and without the driver's shader cache.
# Both take turns; medians of RUNS (9), and the median of the ratios of neighbours.
# usage: [RUNS=9] bench/backends.sh [CAROM]
set -euo pipefail
cd "$(dirname "$0")/.."
RUNS=${RUNS:-9} python3 - "${1:-build/release/carom}" <<'PY'
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

CAROM, RUNS = sys.argv[1], int(os.environ["RUNS"])
BACKENDS = ("osmesa", "egl")


def film(backend, scene, folder):
    stats = f"{folder}/stats.json"
    subprocess.run([CAROM, "render", scene, "--backend", backend, "-o", f"{folder}/f.raw", "--size", "1280x720",
                    "--frames", "0-119", "-q", "-y", "--stats", stats], check=True)
    with open(stats, encoding="utf-8") as file:
        found = json.load(file)
    return 1000 * (found["cpu_s"]["draw"] + found["cpu_s"]["read"]) / found["frames"]


def still(backend, scene, folder, **environment):
    begin = time.perf_counter()
    subprocess.run([CAROM, "still", scene, "--time", "1", "--backend", backend, "-o", f"{folder}/s.png", "-q", "-y"],
                   check=True, env={**os.environ, **environment})
    return 1000 * (time.perf_counter() - begin)


MEASURES = {
    "figure9, 120 frames: draw and read, CPU ms a frame": lambda b, d: film(b, "scenes/figure9.yaml", d),
    "follow, 120 frames: draw and read, CPU ms a frame": lambda b, d: film(b, "scenes/gallery/follow.yaml", d),
    "figure9, a still with the shader cache, ms": lambda b, d: still(b, "scenes/figure9.yaml", d),
    "figure9, a still without it, ms":
        lambda b, d: still(b, "scenes/figure9.yaml", d, MESA_SHADER_CACHE_DISABLE="true"),
}
print(f"{'':<52} {'OSMesa':>8} {'EGL':>8} {'EGL / OSMesa':>13}")
with tempfile.TemporaryDirectory() as folder:
    for name, measure in MEASURES.items():
        found = {backend: [] for backend in BACKENDS}
        for run in range(RUNS + 1):  # the first is not counted
            for backend in BACKENDS if run % 2 else BACKENDS[::-1]:
                value = measure(backend, folder)
                if run > 0:
                    found[backend].append(value)
        ratio = statistics.median(e / o for o, e in zip(*found.values()))
        print(f"{name:<52} {statistics.median(found['osmesa']):8.2f} {statistics.median(found['egl']):8.2f} "
              f"{ratio:13.3f}", flush=True)
PY
