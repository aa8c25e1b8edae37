#!/usr/bin/env bash
# What layers cost beside the picture: CPU milliseconds a frame of drawing and encoding the picture,
# of each layer by itself with its file, and of all together. Medians of RUNS (5).
# usage: [RUNS=5] [SCENES="A B"] bench/layers.sh [CAROM]
set -euo pipefail
cd "$(dirname "$0")/.."
RUNS=${RUNS:-5} SCENES=${SCENES:-scenes/figure9.yaml scenes/gallery/follow.yaml} python3 - "${1:-build/release/carom}" <<'PY'
import json
import os
import statistics
import subprocess
import sys
import tempfile

CAROM, RUNS = sys.argv[1], int(os.environ["RUNS"])
LAYERS = ["depth", "distance", "segmentation", "normals", "flow", "backflow", "coordinates"]
FRAMES = 60


def cost(scene, layers, folder):
    """CPU ms a frame of the picture and of its layers."""
    stats = f"{folder}/stats.json"
    words = ["--layers", ",".join(layers)] if layers else []
    subprocess.run([CAROM, "render", scene, "-o", f"{folder}/frames/", "--size", "1280x720", "--frames",
                    f"0-{FRAMES - 1}", "-q", "-y", "--stats", stats, *words], check=True)
    with open(stats, encoding="utf-8") as file:
        cpu = json.load(file)["cpu_s"]
    picture = sum(cpu[stage] for stage in ("draw", "read", "encode", "write"))
    return 1000 * picture / FRAMES, 1000 * cpu.get("layers", 0) / FRAMES


with tempfile.TemporaryDirectory() as folder:
    for scene in os.environ["SCENES"].split():
        pictures = [cost(scene, [], folder)[0] for _ in range(RUNS)]
        print(f"{scene}: the picture alone {statistics.median(pictures):.1f} ms")
        for layers in [[layer] for layer in LAYERS] + [LAYERS]:
            values = [cost(scene, layers, folder)[1] for _ in range(RUNS)]
            print(f"  {'all' if len(layers) > 1 else layers[0]:<14} {statistics.median(values):7.1f} ms", flush=True)
PY
