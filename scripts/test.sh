#!/usr/bin/env bash
# Sets up a fresh machine with the test packages, then runs the tests: all in a release build, and
# those of what reads and writes files with the address and undefined behaviour sanitizers. What takes
# longer, as simulation and drawing with them, is in scripts/test_long.sh.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --group film --group test --preset release-tests --preset asan
for preset in release-tests asan; do
    echo "test: preset $preset"
    ctest --preset "$preset" -j "$(nproc)"
done
