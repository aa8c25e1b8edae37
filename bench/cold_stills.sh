#!/usr/bin/env bash
# What a still costs from the start of the program to the PNG with no shader cache: for every scene,
# at the last of its film.stills, the median of 5 by the clock and of CPU time. Several programs,
# with commas between them, take turns, so that they meet the same minutes of the machine.
# usage: bench/cold_stills.sh [CAROM[,OTHER...] [SCENE...]]
set -euo pipefail
cd "$(dirname "$0")/.."
carom=${1:-build/release/carom}
shift || true
if [ $# -eq 0 ]; then
    set -- scenes/*.yaml scenes/gallery/*.yaml scenes/official/*.yaml
fi

MESA_SHADER_CACHE_DISABLE=true python3 - "$carom" "$@" <<'PY'
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time

RUNS = 5
programs, scenes = sys.argv[1].split(","), sys.argv[2:]

def cpu():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


print(f"{'scene':<24} {'at, s':>7} {'wall, s':>8} {'CPU, s':>7}")
with tempfile.TemporaryDirectory() as folder:
    for scene in scenes:
        with open(scene, encoding="utf-8") as file:
            at = re.search(r"stills: \[([^\]]*)\]", file.read()).group(1).split(",")[-1].strip()
        walls, cpus = {p: [] for p in programs}, {p: [] for p in programs}
        for _ in range(RUNS):
            for program in programs:
                begin, used = time.perf_counter(), cpu()
                subprocess.run([program, "still", scene, "--time", at, "-q", "-y",
                                "-o", f"{folder}/still.png"], check=True)
                walls[program].append(time.perf_counter() - begin)
                cpus[program].append(cpu() - used)
        name = scene.rsplit("/", 1)[-1].removesuffix(".yaml")
        for program in programs:
            print(f"{name:<24} {at:>7} {statistics.median(walls[program]):8.2f} "
                  f"{statistics.median(cpus[program]):7.2f}"
                  + (f"  {program}" if len(programs) > 1 else ""), flush=True)
PY
