"""What the Python module costs: import, the first motion, and many short scenes beside the C++ library.

usage: PYTHONPATH=build/package/python RATE=build/package/bench/library_rate bench/python_cost.py [COUNT]

CPU time, which the machine's other work hardly shows; medians of fresh processes. COUNT (100,000) short
scenes by Python and by C++ in turns, tenths of them at a time: the rates are of all, the ratio the median.
"""

import os
import pathlib
import statistics
import subprocess
import sys

FIGURE8 = pathlib.Path(__file__).resolve().parents[1] / "scenes" / "figure8.yaml"
COUNT = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
ROUNDS = 10
CLOCK = "import time; t = time.process_time(); {}; print(time.process_time() - t)"
BY_PYTHON = """
import time, carom
text = open({path!r}).read()
scene = carom.load(text)
hashes = 0
t = time.process_time()
for _ in range({count}):
    hashes += carom.simulate({scene}).hash
print(time.process_time() - t, format(hashes % 2**64, "016x"))
"""


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()


def fresh_ms(before, timed):
    code = before + "; " + CLOCK.format(timed)
    return statistics.median(1000 * float(output(sys.executable, "-c", code)[0]) for _ in range(9))


print(f"import numpy            {fresh_ms('import os', 'import numpy'):7.1f} ms")
print(f"import carom            {fresh_ms('import os', 'import carom'):7.1f} ms")
print(f"numpy, then carom       {fresh_ms('import numpy', 'import carom'):7.1f} ms more")
print(f"carom and its first array {fresh_ms('import os', 'import carom; carom.EVENT_DTYPE'):5.1f} ms")
reads = f"import carom; text = open({str(FIGURE8)!r}).read()"
print(f"first motion of Figure 8, read and simulated {fresh_ms(reads, 'carom.simulate(carom.load(text))'):5.2f} ms, "
      f"simulated {fresh_ms(reads + '; scene = carom.load(text)', 'carom.simulate(scene)'):5.2f} ms")

for what, scene in (("read", "carom.load(text)"), ("simulate", "scene")):
    count = COUNT // ROUNDS
    script = BY_PYTHON.format(path=str(FIGURE8), count=count, scene=scene)
    rounds = []
    for _ in range(ROUNDS):
        python, cpp = output(sys.executable, "-c", script), output(os.environ["RATE"], FIGURE8, str(count), what)
        assert python[1] == cpp[1], "the motions differ"
        rounds.append((float(python[0]), float(cpp[0])))
    python, cpp = (count * ROUNDS / sum(r[i] for r in rounds) for i in (0, 1))
    ratio = statistics.median(c / p for p, c in rounds)
    print(f"{COUNT} scenes, {what:8}: Python {python:6.0f}/s, C++ {cpp:6.0f}/s, "
          f"Python has {100 * ratio:.0f} % of the C++ rate")
