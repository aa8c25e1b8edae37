#!/usr/bin/env python3
"""How many small changes of pictures `carom golden check` catches, and how often it is wrong.

usage: CAROM=build/release-tests/carom PYTHONPATH=build/package-release/python \\
    bench/mutated_goldens.py [--each N] [--seed S] [--backends osmesa,egl] [--kinds ball,...] [--keep DIR]

N (200) changes of each kind, spread over the committed goldens; each is a golden picture of its own,
against which the unchanged scene is checked with the default limits:

  ball    a wholly visible ball's image, with its rim, is 1 pixel further in one of 8 directions
  spin    a ball has turned by 1 degree more, about an axis across the line of sight: drawn by the program
  colour  one channel of 0.2 % of the pixels is off by 3 of 255
  letter  one letter of a caption is another one: drawn by the program
  shadow  under a ball an ellipse as wide as it has a tenth less light, or more

What changes no pixel by more than 1 of 255 (a plain ball that turns, one of few pixels, one whose marks lie behind) is
no change: pictures of other processors differ by as much. Such tries are counted, and others made for them.
False alarms: the committed goldens, with each backend, and with captions that are the same.
"""

import argparse
import collections
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

import numpy as np

import carom

ROOT = pathlib.Path(__file__).resolve().parents[1]
GOLDENS = ROOT / "tests" / "golden"
PROGRAM = os.environ.get("CAROM", str(ROOT / "build" / "release-tests" / "carom"))
SIZE = ["--size", "320x180"]
CAPTION = "Dropped from 1.8 m onto steel"
LETTERS = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"

Still = collections.namedtuple("Still", "name scene time")


def run(*words, allowed=(0,)):
    result = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
    if result.returncode not in allowed:
        raise RuntimeError(f"carom {' '.join(map(str, words))}: exit code {result.returncode}\n{result.stderr}")
    return result


def check(scenes, folder, report, *more):
    """The outcomes of stills by name, of `carom golden check`, and who drew them."""
    run("golden", "check", *scenes, "--dir", folder, *SIZE, "--json", report, "-y", "-q", "--same-renderer", 1, *more, allowed=(0, 5))
    stills = json.loads(report.read_text())["stills"]
    return {s["name"]: s for s in stills}


class Facts:
    """Where the balls of a still are in the picture: `layers.json`, once a still."""

    def __init__(self, folder):
        self.folder, self.known = folder, {}

    def of(self, still):
        if still.name not in self.known:
            out = self.folder / still.name
            made = run("render", still.scene, "-o", f"{out}/", "--set", f"film.start={still.time}", "--frames", 0,
                       *SIZE, "--layers", "segmentation", "-y", "-q", allowed=(0, 2))
            # Two runs side by side have no layers.
            self.known[still.name] = (json.loads((out / "layers.json").read_text())["frames"][0]
                                      if made.returncode == 0 else {"balls": []})
        return self.known[still.name]


def silhouette(ball, shape):
    """Pixels whose centres the ball covers."""
    mask = np.zeros(shape, bool)
    for x, rows in enumerate(ball["whole"]["columns"], ball["whole"]["left"]):
        if rows and 0 <= x < shape[1]:
            mask[max(rows[0], 0):rows[1] + 1, x] = True
    return mask


def grown(mask):
    padded = np.pad(mask, 1)
    height, width = mask.shape
    return np.any([padded[y:y + height, x:x + width] for y in range(3) for x in range(3)], axis=0)


def move_ball(picture, facts, chance):
    balls = [b for b in facts["balls"] if b["visible_share"] == 1 and b["visible_px"] >= 4]
    if not balls:
        return None
    dx, dy = chance.choice([(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1) if (x, y) != (0, 0)])
    mask = grown(silhouette(chance.choice(balls), picture.shape[:2]))
    ys, xs = np.nonzero(mask)
    inside = (ys + dy >= 0) & (ys + dy < picture.shape[0]) & (xs + dx >= 0) & (xs + dx < picture.shape[1])
    ys, xs = ys[inside], xs[inside]
    changed = picture.copy()
    changed[ys + dy, xs + dx] = picture[ys, xs]
    return changed


def change_colour(picture, facts, chance):
    opaque = np.argwhere(picture[..., 3] == 255)
    count = round(0.002 * picture.shape[0] * picture.shape[1])
    if len(opaque) < count:
        return None
    changed = picture.copy()
    channel = chance.randrange(3)
    for y, x in chance.sample(opaque.tolist(), count):
        value = int(picture[y, x, channel])
        changed[y, x, channel] = value + 3 if value < 3 or (value <= 252 and chance.random() < 0.5) else value - 3
    return changed


def change_shadow(picture, facts, chance):
    balls = [b for b in facts["balls"] if b["visible_share"] == 1 and b["visible_px"] >= 12]
    if not balls:
        return None
    mask = silhouette(chance.choice(balls), picture.shape[:2])
    ys, xs = np.nonzero(mask)
    half = (xs.max() - xs.min() + 1) / 2
    rows, columns = np.indices(mask.shape)
    ellipse = ((columns - xs.mean()) / half) ** 2 + ((rows - ys.max()) / (0.4 * half)) ** 2 <= 1
    ellipse &= ~grown(mask) & (picture[..., 3] == 255)
    code = picture[..., :3] / 255
    light = np.where(code <= 0.04045, code / 12.92, ((code + 0.055) / 1.055) ** 2.4)
    light[ellipse] = np.minimum(light[ellipse] * chance.choice([0.9, 1.1]), 1)
    code = np.where(light <= 0.0031308, light * 12.92, 1.055 * light ** (1 / 2.4) - 0.055)
    changed = picture.copy()
    changed[ellipse, :3] = np.rint(255 * code[ellipse])
    return changed


def turn_ball(still, facts, chance, folder):
    """Draws the still with one ball turned by a degree at its instant."""
    balls = [b for b in facts["balls"] if b["visible_px"] >= 12]
    if not balls or still.time == 0:
        return None
    ball = chance.choice(balls)
    motion = carom.simulate(carom.load(str(still.scene)))
    spin = motion.states(0).spin[motion.balls.index(ball["name"])]
    axis = np.array(facts["camera"]["world_from_camera"])[:3, chance.choice([0, 1])]
    spin = spin + np.deg2rad(1) / still.time * axis
    result = run("golden", "update", still.scene, "--time", still.time, "--dir", folder, *SIZE, "-q",
                 "--set", f"balls.{ball['name']}.spin=[{', '.join(map(repr, map(float, spin)))}]", allowed=(0, 2, 3))
    return folder / f"{still.name}.png" if result.returncode == 0 else None


def change_letter(still, facts, chance, folder):
    at = chance.choice([i for i, c in enumerate(CAPTION) if c.isalnum()])
    other = chance.choice([c for c in LETTERS if c != CAPTION[at]])
    run("golden", "update", still.scene, "--time", still.time, "--dir", folder, *SIZE, "-q",
        "--set", f"overlay.caption={json.dumps(CAPTION[:at] + other + CAPTION[at + 1:])}")
    return folder / f"{still.name}.png"


ON_PICTURE = {"ball": move_ball, "colour": change_colour, "shadow": change_shadow}
BY_PROGRAM = {"spin": turn_ball, "letter": change_letter}


def mutate(kind, still, original, facts, chance, work):
    """The path of a changed picture, as the program wrote it where it did; None where none could be made."""
    folder = pathlib.Path(tempfile.mkdtemp(dir=work))
    if kind in ON_PICTURE:
        changed, path = ON_PICTURE[kind](original, facts, chance), folder / f"{still.name}.png"
        if changed is not None:
            carom.write_png(path, changed)
    else:
        path = changed = BY_PROGRAM[kind](still, facts, chance, folder)
    return None if changed is None or carom.compare(path, original).largest <= 1 else path


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--each", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--backends", default="osmesa,egl")
    parser.add_argument("--kinds", default="ball,spin,colour,letter,shadow")
    parser.add_argument("--keep", type=pathlib.Path)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    scenes = sorted(p for p in (ROOT / "scenes").rglob("*.yaml") if not {"hard", "measured"} & set(p.parts))
    caption = ["--set", f"overlay.caption={json.dumps(CAPTION)}"]
    with tempfile.TemporaryDirectory() as folder:
        work = options.keep or pathlib.Path(folder)
        work.mkdir(parents=True, exist_ok=True)
        report = work / "report.json"
        captioned, drawn = work / "captioned", work / "drawn"
        run("golden", "update", *scenes, "--dir", captioned, *SIZE, "-q", *caption)
        run("golden", "update", *scenes, "--dir", drawn, *SIZE, "-q")
        alarms = checked = 0
        outcomes = check(scenes, drawn, report)
        for backend in filter(None, options.backends.split(",")):
            for where, more in ((GOLDENS, []), (captioned, caption)):
                outcomes = check(scenes, where, report, "--backend", backend, *more)
                wrong = [name for name, s in outcomes.items() if s["outcome"] != "same"]
                alarms, checked = alarms + len(wrong), checked + len(outcomes)
                print(f"{backend:7} {len(outcomes)} unchanged, {len(wrong)} false alarms {' '.join(wrong)}"
                      f" ({next(iter(outcomes.values()))['renderer']})", flush=True)
        stills = [Still(name, pathlib.Path(s["scene"]), s["time"]) for name, s in outcomes.items()]
        facts = Facts(work / "facts")
        total = caught = 0
        for kind in options.kinds.split(","):
            base, more = {"letter": (captioned, caption), "spin": (drawn, [])}.get(kind, (GOLDENS, []))
            made = found = passed_by = 0
            missed = []
            while made < options.each and passed_by < 20 * options.each:
                round_folder = pathlib.Path(tempfile.mkdtemp(prefix=kind, dir=work))
                for still in stills:
                    if made + len(list(round_folder.iterdir())) == options.each:
                        break
                    original = carom.read_png(base / f"{still.name}.png")
                    changed = mutate(kind, still, original, facts.of(still), chance, work)
                    if changed is None:
                        passed_by += 1
                        continue
                    shutil.copy(changed, round_folder)
                names = {p.stem for p in round_folder.iterdir()}
                outcomes = check(scenes, round_folder, report, *more)
                misses = [name for name in sorted(names) if outcomes[name]["outcome"] != "different"]
                missed += [f"{round_folder.name}/{name}" for name in misses]
                made, found = made + len(names), found + len(names) - len(misses)
            total, caught = total + made, caught + found
            print(f"{kind:7} {found} of {made} caught ({passed_by} tries changed nothing) {' '.join(missed)}", flush=True)
    print(f"{caught} of {total} changes caught: {100 * caught / total:.2f} %; {alarms} of {checked} false alarms")
    return 0 if caught >= 0.999 * total and alarms == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
