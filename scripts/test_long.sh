#!/usr/bin/env bash
# What scripts/test.sh leaves out because it takes long or needs large packages: all tests with the
# address and undefined behaviour sanitizers and with that of threads, the Debug build, the film in a
# browser, format and lint.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --group film --group test --group bench --group fuzz --group long \
    --preset dev --preset tsan --preset release-tests --preset bench

echo "test_long: format"
git ls-files '*.cpp' '*.h' | xargs clang-format --dry-run --Werror
echo "test_long: the pages of all headers, without warnings"
scripts/api_docs.sh
echo "test_long: lint"
git ls-files 'src/*.cpp' | xargs -P "$(nproc)" -n 4 clang-tidy --quiet -p build/dev

cmake --preset asan
cmake --build --preset asan-all
for preset in dev tsan asan-all; do
    echo "test_long: preset $preset"
    ctest --preset "$preset" -j "$(nproc)"
done

echo "test_long: the same motion in Debug and Release"
cmake --build --preset release-tests --target carom
CAROM=build/release-tests/carom CAROM_OTHER=build/dev/carom CAROM_SOURCE_DIR=. \
    python3 -B tests/cli/test_same_motion.py -v

echo "test_long: each call to the system fails once"
cmake --build --preset release-tests --target faults
CAROM=build/release-tests/carom CAROM_FAULTS=build/release-tests/tests/faults/faults.so \
    python3 -B tests/faults/fault_points.py

echo "test_long: fuzzing, two minutes a target"
scripts/fuzz.sh 2

echo "test_long: the hardened release"
cmake --preset release
cmake --build --preset release
scripts/check_hardening.sh --program build/release/carom

echo "test_long: errors of the benches"
for bench in hard_cases simbenchmark gas_laws; do
    "build/bench/bench/$bench" --quick >/dev/null
done

echo "test_long: library, Python module, the example project"
scripts/setup.sh --group film --group package
scripts/test_package.sh

echo "test_long: frames of a run that is killed 20 times"
CAROM_KILLS=20 CAROM=build/release-tests/carom CAROM_SOURCE_DIR=. \
    python3 -B tests/cli/test_chunks.py -v Resume.test_killed_and_resumed_is_unbroken

echo "test_long: motions as glTF, read by Khronos' validator; a report in a browser"
scripts/check_gltf.sh build/release-tests/carom
scripts/check_report.sh build/release-tests/carom
echo "test_long: a sweep through Slurm"
scripts/test_slurm.sh build/release-tests/carom

echo "test_long: film in a browser"
build/release-tests/carom render scenes/figure9.yaml -o out/figure9.mp4 -y
python3 -B tests/browser/play_film.py out/figure9.mp4
