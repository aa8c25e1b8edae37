#!/usr/bin/env bash
# Builds the library, static and shared, Debug and Release, and the Python module, installs all of it
# into one prefix, and uses it from there: examples/consumer against each of the four libraries, by
# CMake and by pkg-config, and the tests of the module, which is built as a wheel too. Takes minutes.
#   scripts/test_package.sh [--release-only]
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
configurations=(Debug Release)
[ "${1:-}" != --release-only ] || configurations=(Release)

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix

for configuration in "${configurations[@]}"; do
    build=build/package-${configuration,,}
    echo "package: building $configuration"
    cmake -B "$build" -G Ninja -DCMAKE_BUILD_TYPE="$configuration" -DCAROM_BUILD_LIBRARY=ON \
        -DCAROM_BUILD_PYTHON="$([ "$configuration" = Release ] && echo ON || echo OFF)" \
        -DPython3_EXECUTABLE=/usr/bin/python3 -DCAROM_PRECOMPILE=ON -DCMAKE_INSTALL_PREFIX=/usr >"$work/log"
    cmake --build "$build" >>"$work/log" || { tail -50 "$work/log" >&2; exit 1; }
    cmake --install "$build" --prefix "$prefix" >>"$work/log"
done

# Nothing of the inside is shown.
library=$(find "$prefix" -name 'libcarom.so.*.*.*')
if nm -D --defined-only --demangle "$library" | grep ' [TBDRVW] ' | grep -E ' carom::' | grep -qv 'carom::v1::'; then
    echo "package: the shared library shows names of the inside" >&2
    exit 1
fi

for configuration in "${configurations[@]}"; do
    for static in OFF ON; do
        echo "package: the example with $configuration, static $static"
        build=$work/consumer-$configuration-$static
        cmake -S examples/consumer -B "$build" -G Ninja -DCMAKE_BUILD_TYPE="$configuration" \
            -DCONSUMER_STATIC=$static -DCMAKE_PREFIX_PATH="$prefix/usr;$prefix" >"$work/log"
        cmake --build "$build" >>"$work/log" || { tail -50 "$work/log" >&2; exit 1; }
        cmake --build "$build" --target scene_update >>"$work/log"
        ctest --test-dir "$build" --output-on-failure --no-tests=error | tail -3
        needed=$(readelf -d "$build/consumer" | grep -c 'libcarom' || true)
        [ "$needed" = "$([ $static = ON ] && echo 0 || echo 1)" ]
    done
done

echo "package: the example by pkg-config"
export PKG_CONFIG_PATH; PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name carom.pc)")
# shellcheck disable=SC2046
g++ -std=c++20 examples/consumer/consumer.cpp -o "$work/consumer" $(pkg-config --cflags --libs carom)
(cd "$work" && LD_LIBRARY_PATH=$(dirname "$library") ./consumer film.mp4 && [ -s film.mp4 ])

test_module() {
    PYTHONPATH=$1 CAROM=$(find "$prefix" -path '*/bin/carom') CAROM_SOURCE_DIR=$root \
        /usr/bin/python3 -B tests/python/test_module.py
}
echo "package: the Python module"
test_module "$(dirname "$(find "$prefix" -path '*/carom/__init__.py')")/.."

# Without network: what builds and what it needs are packages of the system.
echo "package: the Python module as a wheel"
CAROM_WHEEL_BUILD=$root/build/package-release /usr/bin/python3 -m pip wheel . --no-index --no-build-isolation --no-deps \
    --wheel-dir "$work/wheel" >"$work/log" 2>&1 || { tail -50 "$work/log" >&2; exit 1; }
/usr/bin/python3 -m pip install --no-index --no-deps --target "$work/site" "$work"/wheel/carom-*.whl >"$work/log" 2>&1 ||
    { tail -50 "$work/log" >&2; exit 1; }
test_module "$work/site"
