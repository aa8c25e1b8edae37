#!/usr/bin/env python3
"""Fails every call of each command to the system once, and looks at what becomes of it.

usage: CAROM=PROGRAM CAROM_FAULTS=FAULTS.so tests/faults/fault_points.py [--sample N] [--seed S] [--commands NAME,...]
    [--kinds KIND,...] [--list FILE.tsv] [-v]

Of each command an undisturbed run is counted (faults.c), then as many runs are made as it had calls of each kind, in
each of which one call fails. --sample N takes N of all these points, spread over commands and kinds, by the seed.
A run holds when

- it ends by itself, with an exit code that is right for what failed, and says why where that is not 0;
- what stands under a final name is whole: the same bytes as undisturbed;
- with exit code 0 all is there that is asked for;
- nothing else is left, in the folder of the output, the working folder or that for temporary files.

Prints a table of points and failures by command and kind. Exit 1 if any failed.
"""

import argparse
import collections
import json
import os
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import tempfile

CAROM, FAULTS = os.environ["CAROM"], os.environ["CAROM_FAULTS"]
KINDS = ["write", "sync", "rename", "open", "map", "alloc", "memory", "thread", "library", "folder"]
MOST_S = 60  # of a run: a hang

SCENE = """\
carom: 1
title: points
simulation: {duration: 0.3}
materials: {rubber: {restitution: 0.8, friction: 0.3}}
surfaces: [{name: floor, plane: {normal: [0, 0, 1], offset: 0}, material: rubber}]
balls:
  - {name: a, radius: 0.1, material: rubber, position: [0, 0, 0.3]}
  - {name: b, radius: 0.1, material: rubber, position: [0.25, 0, 0.4], spin: [0, 9, 0]}
film: {size: [64, 36], fps: 10}
overlay: {ruler: true, clock: true, labels: true}
"""

# Which exit codes a command may end with when a call of the kind fails. What the system lacks, and
# what the command can do without, gives 0.
CODES = {"write": {0, 4}, "sync": {0, 4}, "rename": {0, 4}, "folder": {0, 1, 4}, "open": {0, 1, 2, 4},
         "map": {0, 1, 2, 4}, "alloc": {0, 1}, "memory": {0, 1}, "thread": {0, 1}, "library": {0, 1}}


class Command:
    def __init__(self, words, varies=(), codes=(), code=0):
        self.words, self.varies, self.codes, self.code = words.split(), varies, set(codes), code


# IN and OUT are folders. `varies`: files whose bytes are not the same in every run; `codes`: besides CODES.
COMMANDS = {
    "check": Command("check IN/s.yaml"),
    "schema": Command("schema"),
    "info": Command("info"),
    "new": Command("new OUT/n.yaml"),
    "simulate": Command("simulate IN/s.yaml -o OUT/m.csv --events OUT/e.csv --stats OUT/s.json", varies=("s.json",)),
    "simulate_stdout": Command("simulate IN/s.yaml -o -"),
    "simulate_npz": Command("simulate IN/s.yaml -o OUT/m.npz"),
    "simulate_json": Command("simulate IN/s.yaml -o OUT/m.json"),
    "simulate_glb": Command("simulate IN/s.yaml -o OUT/m.glb"),
    "still": Command("still IN/s.yaml --time 0.2 -o OUT/s.png"),
    "still_layers": Command("still IN/s.yaml --time 0.2 -o OUT/s.png --layers depth,segmentation"),
    "render_mp4": Command("render IN/s.yaml -o OUT/f.mp4"),
    "render_sound": Command("render IN/s.yaml -o OUT/f.mkv -o OUT/f.wav --sound"),
    "render_frames": Command("render IN/s.yaml -o OUT/frames/"),
    "render_gif": Command("render IN/s.yaml -o OUT/f.gif"),
    "render_apng": Command("render IN/s.yaml -o OUT/f.apng"),
    "render_webp": Command("render IN/s.yaml -o OUT/f.webp"),
    "render_stdout": Command("render IN/s.yaml -o - --format mkv"),
    "golden_update": Command("golden update IN/s.yaml --dir OUT --time 0.1 --time 0.2",
                             # They say who drew them, and without OSMesa that is EGL.
                             varies=("s-t0.100000.png", "s-t0.200000.png")),
    "golden_check": Command("golden check IN/s.yaml --dir IN/goldens --time 0.1 --html OUT/h.html --junit OUT/j.xml",
                            codes=(5,)),
    "compare_pictures": Command("compare IN/goldens/s-t0.100000.png IN/other.png --diff OUT/d.png", codes=(5,), code=5),
    "compare_films": Command("compare IN/a.mp4 IN/a.mp4"),
    "join": Command("join IN/1.mp4 IN/2.mp4 -o OUT/f.mp4"),
    "fit": Command("fit --drop 1.8 --rebound 1.3 -o OUT/p.svg"),
    "figures": Command("figures -o OUT --only table1,figure4"),
    "report": Command("report IN/s.yaml -o OUT/r.html", varies=("r.html",)),
    # What failed stands in its tables.
    "sweep": Command("sweep IN/w.yaml -o OUT/runs --jobs 2",
                     varies=("runs/index.csv", "runs/dataset.json", "runs/runs/000/000000/run.json",
                             "runs/runs/000/000001/run.json")),
}


def environment(folder, **more):
    tmp = folder / "tmp"
    tmp.mkdir(exist_ok=True)
    return {"PATH": os.environ["PATH"], "TMPDIR": str(tmp), "HOME": str(folder / "home"), "LC_ALL": "C.UTF-8",
            "MESA_SHADER_CACHE_DISABLE": "true", **more}


def run(folder, words, **more):
    """The finished process in a fresh out folder; None after MOST_S."""
    for name in ("out", "tmp", "cwd"):
        shutil.rmtree(folder / name, ignore_errors=True)
        (folder / name).mkdir()
    words = [w.replace("IN/", f"{folder}/in/").replace("OUT", f"{folder}/out") for w in words]
    try:
        return subprocess.run([CAROM, *words], capture_output=True, timeout=MOST_S, cwd=folder / "cwd",
                              stdin=subprocess.DEVNULL, env=environment(folder, **more))
    except subprocess.TimeoutExpired:
        return None


def files_of(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def prepare(folder):
    inputs = folder / "in"
    inputs.mkdir()
    (inputs / "s.yaml").write_text(SCENE)
    (inputs / "w.yaml").write_text("base: s.yaml\naxes: {balls.a.mass: [1, 2]}\n"
                                   "outputs: {motion: true, stills: [0.1]}\n")
    made = [f"golden update IN/s.yaml --dir {inputs}/goldens --time 0.1",
            f"still IN/s.yaml --time 0.2 -o {inputs}/other.png", f"render IN/s.yaml -o {inputs}/a.mp4",
            f"render IN/s.yaml -o {inputs}/1.mp4 --chunk 1/2", f"render IN/s.yaml -o {inputs}/2.mp4 --chunk 2/2"]
    for words in made:
        result = run(folder, words.split())
        if result.returncode != 0:
            sys.exit(f"{words}: {result.stderr.decode()}")


class Undisturbed:
    """What the command does when nothing fails, and its calls by kind."""

    def __init__(self, folder, command):
        counts = folder / "counts"
        counts.unlink(missing_ok=True)
        result = run(folder, command.words, LD_PRELOAD=FAULTS, FAULT_COUNTS=str(counts))
        if result is None or result.returncode != command.code:
            sys.exit(f"{command.words}: {result and result.stderr.decode()}")
        self.stdout, self.files = result.stdout, files_of(folder / "out")
        self.counts = dict(zip(KINDS, struct.unpack(f"{len(KINDS)}q", counts.read_bytes())))


def is_whole(name, content):
    """Of what is not the same each time."""
    if name.endswith(".json"):
        try:
            json.loads(content)
        except ValueError:
            return False
        return True
    if name.endswith(".png"):
        return content.startswith(b"\x89PNG") and content[-8:-4] == b"IEND"
    if name.endswith(".html"):
        return content.rstrip().endswith(b"</html>")
    return len(content) > 0


def fault_in(result, folder, command, kind, right):
    """What is wrong with the run, "" for nothing."""
    if result is None:
        return "does not end"
    code = result.returncode
    if code < 0 or code >= 128:
        return f"ends with {code}"
    left = [str(p.relative_to(folder)) for name in ("tmp", "cwd") for p in (folder / name).rglob("*")]
    files = files_of(folder / "out")
    left += [name for name in files if name not in right.files]
    if left:
        return f"leaves {left[0]}"
    for name, content in files.items():
        same = content == right.files[name]
        if not same and not (name in command.varies and is_whole(name, content)) and not (
                kind == "thread" and len(content) > len(right.files[name]) / 2):
            return f"{name} is not whole"
    if code not in CODES[kind] | command.codes:
        return f"exit code {code}"
    if code == command.code:
        missing = [name for name in right.files if name not in files]
        if missing:
            return f"exit code {code} without {missing[0]}"
        if result.stdout != right.stdout and kind not in ("thread", "library") and command.words[0] != "info":
            return "exit code 0 with other output"
    elif not result.stderr.strip() and kind != "write":
        return "says nothing"
    return ""


def points_of(rights, names, kinds):
    return [(name, kind, number) for name in names for kind in kinds
            for number in range(1, rights[name].counts[kind] + 1)]


def sample(points, count, seed):
    """As many of each pair of command and kind, as far as it has them."""
    numbers = random.Random(seed)
    groups = collections.defaultdict(list)
    for point in points:
        groups[point[:2]].append(point)
    for group in groups.values():
        numbers.shuffle(group)
    order = list(groups.values())
    numbers.shuffle(order)
    chosen = []
    while len(chosen) < count and any(order):
        chosen += [group.pop() for group in order if group]
    return chosen[:count]


def table(names, kinds, tried, failed):
    print(f"{'':18}" + "".join(f"{kind:>9}" for kind in kinds))
    for name in names:
        cells = [f"{tried[name, k]}" + (f" ({failed[name, k]})" if failed[name, k] else "") for k in kinds]
        print(f"{name:18}" + "".join(f"{c:>9}" for c in cells))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--sample", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--commands", default=",".join(COMMANDS))
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--list", help="write each failure as a line: command, kind, number, what")
    parser.add_argument("-v", action="store_true", help="print each point")
    options = parser.parse_args()
    names, kinds = options.commands.split(","), options.kinds.split(",")

    tried, failed, failures = collections.Counter(), collections.Counter(), []
    above = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
    with tempfile.TemporaryDirectory(dir=above) as text:
        folder = pathlib.Path(text)
        prepare(folder)
        rights = {name: Undisturbed(folder, COMMANDS[name]) for name in names}
        points = points_of(rights, names, kinds)
        all_points = len(points)
        if options.sample:
            points = sample(points, options.sample, options.seed)
        for name, kind, number in points:
            command = COMMANDS[name]
            result = run(folder, command.words, LD_PRELOAD=FAULTS, FAULT=f"{kind}:{number}")
            wrong = fault_in(result, folder, command, kind, rights[name])
            tried[name, kind] += 1
            if options.v:
                print(name, kind, number, result and result.returncode, wrong, flush=True)
            if wrong:
                failed[name, kind] += 1
                said = result.stderr.decode(errors="replace")[-300:] if result else ""
                failures.append((name, kind, number, wrong))
                print(f"FAILED {name}: {kind} {number}: {wrong}\n    {said.strip()}", flush=True)
    table(names, kinds, tried, failed)
    print(f"{len(points)} of {all_points} points, {len(failures)} failed (in brackets)")
    if options.list:
        pathlib.Path(options.list).write_text("".join("\t".join(map(str, f)) + "\n" for f in failures))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
