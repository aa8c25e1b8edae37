#!/usr/bin/env bash
# What filming Figure 9 at 1280x720 costs: frames per second end to end (median of 5), CPU
# milliseconds a frame by stage, and peak memory for 10 s and for 100 s of film.
# usage: bench/film.sh [CAROM]
set -euo pipefail
cd "$(dirname "$0")/.."
carom=${1:-build/release/carom}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

for k in 1 2 3 4 5; do
    "$carom" render scenes/figure9.yaml -q -o "$folder/film.mp4" -y --stats "$folder/$k.json"
done
"$carom" render scenes/figure9.yaml -q -o "$folder/film.mp4" -y --set simulation.duration=100 --stats "$folder/long.json"

python3 - "$folder" <<'PY'
import json
import statistics
import sys

runs = [json.load(open(f"{sys.argv[1]}/{k}.json")) for k in range(1, 6)]
long = json.load(open(f"{sys.argv[1]}/long.json"))
rates = sorted(r["frames"] / r["wall_s"] for r in runs)
print(f"frames/s, end to end: median {statistics.median(rates):.0f}, {rates[0]:.0f} to {rates[-1]:.0f}")
for stage in runs[0]["cpu_s"]:
    values = [1000 * r["cpu_s"][stage] / r["frames"] for r in runs]
    print(f"  {stage:<8} {statistics.median(values):7.3f} ms a frame")
print(f"peak memory: {max(r['peak_rss_bytes'] for r in runs) / 1e6:.0f} MB for 10 s, "
      f"{long['peak_rss_bytes'] / 1e6:.0f} MB for 100 s of film")
PY
