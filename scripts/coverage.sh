#!/usr/bin/env bash
# Line and branch coverage of src/scene, sim, motion and media by their unit tests and by the program's
# tests, measured by gcov.
#   scripts/coverage.sh [CTEST_ARGUMENTS...]     (e.g. -L input; default: all tests)
# Prints a table by file and the sums; build/coverage/coverage.json has the same for programs, and
# index.html shows the lines. Branches that only exceptions take are not counted.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh --group film --group test --group coverage --only-packages
cmake --preset coverage >/dev/null
nice -n 15 cmake --build --preset coverage
find build/coverage -name '*.gcda' -delete
nice -n 15 ctest --preset coverage "$@" || echo "coverage: tests failed; what they ran counts"
cd build/coverage
nice -n 15 gcovr --root ../.. --object-directory . --filter '.*/src/(scene|sim|motion|media)/' \
    --exclude-throw-branches --exclude-unreachable-branches --gcov-ignore-parse-errors \
    --txt --json-summary coverage.json --html-details index.html --print-summary
for folder in scene sim motion media; do
    python3 - "$folder" <<'PY'
import json, sys
files = [f for f in json.load(open("coverage.json"))["files"] if f"src/{sys.argv[1]}/" in f["filename"]]
def share(kind):
    total, hit = (sum(f[f"{kind}_{what}"] for f in files) for what in ("total", "covered"))
    return f"{hit} of {total} ({hit / total:.1%})" if total else "none"
print(f"{sys.argv[1]:7} lines {share('line')}, branches {share('branch')}")
PY
done
