#!/usr/bin/env bash
# What a still costs from the start of the program to the PNG with no shader cache: for every scene,
# at the last of its film.stills, the median of 5 by the clock and of CPU time. Several programs,
# with commas between them, take turns, so that they meet the same minutes of the machine.
# SIZE=1920x1080 measures pictures of that size; WARM=1 leaves the shader cache on, for programs that
# have drawn the scene before.
# usage: [SIZE=WxH] [WARM=1] bench/cold_stills.sh [CAROM[,OTHER...] [SCENE...]]
set -euo pipefail
cd "$(dirname "$0")/.."
carom=${1:-build/release/carom}
shift || true
if [ $# -eq 0 ]; then
    set -- scenes/*.yaml scenes/gallery/*.yaml scenes/official/*.yaml
fi

if [ -z "${WARM:-}" ]; then
    export MESA_SHADER_CACHE_DISABLE=true
fi
SIZE=${SIZE:-} python3 - "$carom" "$@" <<'PY'
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time

RUNS = 5
programs, scenes = sys.argv[1].split(","), sys.argv[2:]
size = ["--size", os.environ["SIZE"]] if os.environ["SIZE"] else []

def cpu():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


print(f"{'scene':<24} {'at, s':>7} {'wall, s':>8} {'CPU, s':>7}")
with tempfile.TemporaryDirectory() as folder:
    for scene in scenes:
        with open(scene, encoding="utf-8") as file:
            at = re.search(r"stills: \[([^\]]*)\]", file.read()).group(1).split(",")[-1].strip()
        walls, cpus = {p: [] for p in programs}, {p: [] for p in programs}
        for run in range(RUNS + 1):  # the first one is not counted
            for program in programs:
                begin, used = time.perf_counter(), cpu()
                subprocess.run([program, "still", scene, "--time", at, *size, "-q", "-y",
                                "-o", f"{folder}/still.png"], check=True)
                if run > 0:
                    walls[program].append(time.perf_counter() - begin)
                    cpus[program].append(cpu() - used)
        name = scene.rsplit("/", 1)[-1].removesuffix(".yaml")
        for program in programs:
            print(f"{name:<24} {at:>7} {statistics.median(walls[program]):8.2f} "
                  f"{statistics.median(cpus[program]):7.2f}"
                  + (f"  {program}" if len(programs) > 1 else ""), flush=True)
PY
