#!/usr/bin/env python3
"""Do the tests notice a wrong operator? Edits one operator at a time, builds, runs the tests of that folder.

usage: scripts/mutants.py [--count N] [--seed S] [--folders sim,motion,scene,media] [--minutes M] [--only FILE]
       scripts/mutants.py --survivors

Works in a copy of the committed tree, build/mutants/tree, with a build folder of its own; compiles through ccache. The
mutants of all sources are put in an order by the seed, as many of each folder as its share of the operators; N (50) are
tried, those of earlier calls not again: build/mutants/results.tsv has a line for each (file, line, column, from, to,
result). Results: caught (a test fails, ends by a signal, or does not end in ten times its time), uncompiled (not
counted), survived. --minutes ends earlier; --survivors lists what survived so far, with the lines.

Prints the share that was caught. Exit 0, whatever it is.
"""

import argparse
import collections
import os
import pathlib
import random
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
WORK = ROOT / "build/mutants"
TREE, BUILD, RESULTS = WORK / "tree", WORK / "build", WORK / "results.tsv"

# As clang-format sets them, a binary operator has blanks around it, which brackets of templates, pointers and signs
# have not.
SWAPS = {" < ": [" <= ", " > "], " <= ": [" < "], " > ": [" >= ", " < "], " >= ": [" > "], " == ": [" != "],
         " != ": [" == "], " + ": [" - "], " - ": [" + "], " * ": [" / "], " / ": [" * "], " && ": [" || "],
         " || ": [" && "], " += ": [" -= "], " -= ": [" += "], "++": ["--"], "std::min(": ["std::max("],
         "std::max(": ["std::min("], "(!": ["("], "return true;": ["return false;"], "return false;": ["return true;"],
         " 0.5 ": [" 0.25 "], " ? ": [" && false ? "], "continue;": ["break;"]}
OPERATOR = re.compile("|".join(re.escape(o) for o in sorted(SWAPS, key=len, reverse=True)))

# Folder -> the programs that test it, the nearest first.
TESTS = {"sim": ["sim_tests"], "motion": ["motion_tests", "sim_tests"], "scene": ["scene_tests"],
         "media": ["media_tests"]}


def masked(text):
    """The text with comments, texts, preprocessor lines and includes blanked, at the same places."""
    def blank(match):
        return re.sub(r"[^\n]", "\0", match[0])
    text = re.sub(r'//[^\n]*|/\*.*?\*/|R"\(.*?\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', blank, text, flags=re.S)
    return re.sub(r"(?m)^#[^\n]*(?:\\\n[^\n]*)*|^template[^\n]*|CAROM_CHECK\([^\n]*|static_assert\([^\n]*", blank, text)


def mutants_of(path):
    text = path.read_text()
    for match in OPERATOR.finditer(masked(text)):
        line = text.count("\n", 0, match.start()) + 1
        column = match.start() - text.rfind("\n", 0, match.start())
        for other in SWAPS[match[0]]:
            yield (str(path.relative_to(TREE)), line, column, match[0].strip(), other.strip(), match.start(), match[0],
                   other)


def ordered(folders, seed, only):
    numbers = random.Random(seed)
    queues = []
    for folder in folders:
        queue = [m for p in sorted((TREE / "src" / folder).rglob("*.cpp")) if only in str(p) for m in mutants_of(p)]
        numbers.shuffle(queue)
        queues += [((i + numbers.random()) / len(queue), m) for i, m in enumerate(queue)]
    return [m for _, m in sorted(queues, key=lambda pair: pair[0])]


def call(words, seconds=None):
    """The exit code; None when the time is up."""
    process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=TREE,
                               start_new_session=True)
    try:
        return process.wait(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, 9)
        process.wait()
        return None


def prepare(programs):
    TREE.mkdir(parents=True, exist_ok=True)
    subprocess.run("git archive HEAD | tar -x -C " + str(TREE), shell=True, check=True, cwd=ROOT)
    subprocess.run(["cmake", "--preset", "release-tests", "-B", str(BUILD)], check=True, cwd=TREE,
                   stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", str(BUILD), "-j", "1", "--target", *programs], check=True, cwd=TREE,
                   stdout=subprocess.DEVNULL)
    seconds = {}
    for program in programs:
        start = time.monotonic()
        if call([str(BUILD / "tests" / program), "--gtest_brief=1"]) != 0:
            sys.exit(f"{program} fails without any mutant")
        seconds[program] = time.monotonic() - start
    return seconds


def result_of(mutant, seconds):
    folder = mutant[0].split("/")[1]
    for program in TESTS[folder]:
        if call(["cmake", "--build", str(BUILD), "-j", "1", "--target", program]) != 0:
            return "uncompiled"
        test = [str(BUILD / "tests" / program), "--gtest_brief=1", "--gtest_fail_fast"]
        if call(test, 10 * seconds[program] + 20) != 0:
            return "caught"
    return "survived"


def try_one(mutant, seconds):
    file, line, column, _, _, at, old, new = mutant
    path = TREE / file
    text = path.read_text()
    assert text[at:at + len(old)] == old
    try:
        path.write_text(text[:at] + new + text[at + len(old):])
        result = result_of(mutant, seconds)
    finally:
        path.write_text(text)
    with RESULTS.open("a") as results:
        results.write("\t".join(map(str, (*mutant[:5], result))) + "\n")
    return result


def done():
    if not RESULTS.exists():
        return []
    return [line.split("\t") for line in RESULTS.read_text().splitlines()]


def summary():
    counts = collections.defaultdict(collections.Counter)
    for file, *_, result in done():
        counts[file.split("/")[1]][result] += 1
        counts["all"][result] += 1
    for folder, of in counts.items():
        tried = of["caught"] + of["survived"]
        share = f"{of['caught'] / tried:.0%}" if tried else "-"
        print(f"{folder:8} {tried:5} mutants, {of['caught']:5} caught ({share}), {of['survived']:4} survived, "
              f"{of['uncompiled']:3} not compiled")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folders", default="sim,motion,scene,media")
    parser.add_argument("--minutes", type=float, default=1e9)
    parser.add_argument("--only", default="", help="files whose path holds this")
    parser.add_argument("--survivors", action="store_true")
    options = parser.parse_args()
    if options.survivors:
        for file, line, column, old, new, result in done():
            if result == "survived":
                print(f"{file}:{line}:{column}: '{old}' -> '{new}':"
                      f" {(ROOT / file).read_text().splitlines()[int(line) - 1].strip()}")
        return summary()
    folders = options.folders.split(",")
    end = time.monotonic() + 60 * options.minutes
    seconds = prepare(sorted({program for folder in folders for program in TESTS[folder]}))
    known = {tuple(row[:5]) for row in done()}
    left = options.count
    for mutant in ordered(folders, options.seed, options.only):
        if left == 0 or time.monotonic() > end:
            break
        if tuple(map(str, mutant[:5])) in known:
            continue
        result = try_one(mutant, seconds)
        left -= result != "uncompiled"
        print(f"{result:10} {mutant[0]}:{mutant[1]}:{mutant[2]}: '{mutant[3]}' -> '{mutant[4]}'", flush=True)
    summary()


if __name__ == "__main__":
    main()
