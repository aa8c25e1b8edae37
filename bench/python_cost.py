"""What the Python module costs: import, the first motion, and many short scenes beside the C++ library.

usage: PYTHONPATH=build/package/python bench/python_cost.py   (CPU ms; the machine's other work hardly shows)
"""

import pathlib
import statistics
import subprocess
import sys
import time

FIGURE8 = (pathlib.Path(__file__).parents[1] / "scenes" / "figure8.yaml").read_text()


def cpu_ms(code):
    """Median over 9 fresh processes."""
    values = [float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)
              for _ in range(9)]
    return statistics.median(values)


clock = "import time; t = time.process_time(); {}; print(1000 * (time.process_time() - t))"
print(f"import numpy          {cpu_ms(clock.format('import numpy')):7.1f} ms")
print(f"import carom after it {cpu_ms('import numpy; ' + clock.format('import carom')):7.1f} ms")
print("first motion of Figure 8 " + str(round(cpu_ms(
    f"import carom; text = {FIGURE8!r}; " + clock.format("carom.simulate(carom.load(text))")), 2)) + " ms")

import carom  # noqa: E402

count = 20_000
text = FIGURE8
begin = time.process_time()
for _ in range(count):
    carom.simulate(carom.load(text))
both = time.process_time() - begin
scene = carom.load(text)
begin = time.process_time()
for _ in range(count):
    carom.simulate(scene)
alone = time.process_time() - begin
print(f"{count} runs of Figure 8: {count / both:.0f}/s read and simulated, {count / alone:.0f}/s simulated")
