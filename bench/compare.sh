#!/usr/bin/env bash
# What comparing two PNGs costs, beside npm's odiff-bin where it is installed: Figure 9 at two
# instants in 1920x1080 and 3840x2160, and each picture with itself. CPU and wall milliseconds, the
# median of 9 runs, programs in turns; odiff without anti-aliasing detection and without a picture of
# the difference, as `carom compare` without --diff.
# usage: bench/compare.sh [CAROM [ODIFF]]
set -euo pipefail
cd "$(dirname "$0")/.."
carom=$(realpath "${1:-build/release/carom}")
odiff=${2:-$(command -v odiff || true)}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

for size in 1920x1080 3840x2160; do
    for time in 0.5 1.4; do
        "$carom" still scenes/figure9.yaml --time $time --size $size -q -o "$folder/$size-$time.png"
    done
done

python3 - "$folder" "$carom" "$odiff" <<'PY'
import os
import resource
import statistics
import subprocess
import sys
import time

folder, carom, odiff = sys.argv[1:4]


def cost(command):
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return 1000 * cpu, 1000 * (time.perf_counter() - begin)


programs = {"carom": [carom, "compare"]}
if odiff:
    programs["odiff"] = [odiff, "--parsable-stdout", "--threshold=0"]
for size in ("1920x1080", "3840x2160"):
    a, b = (os.path.join(folder, f"{size}-{t}.png") for t in ("0.5", "1.4"))
    for what, pair in (("two instants", (a, b)), ("with itself", (a, a))):
        found = {name: [] for name in programs}
        for _ in range(9):
            for name, command in programs.items():
                found[name].append(cost([*command, *pair]))
        for name, runs in found.items():
            cpu, wall = (statistics.median(column) for column in zip(*runs))
            print(f"{size} {what:<12} {name}: {cpu:7.1f} ms CPU, {wall:7.1f} ms wall")
PY
