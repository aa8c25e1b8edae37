#!/usr/bin/env bash
# Installs what packages.txt lists and this machine lacks, then builds.
#   scripts/setup.sh [--group film|test|bench|coverage|fuzz|long|package]... [--preset PRESET]... [--only-packages]
# Without options: group film, preset release. Takes seconds when nothing has changed.
set -euo pipefail
cd "$(dirname "$0")/.."

groups=() presets=() build=1
while [ $# -gt 0 ]; do
    case "$1" in
        --group)  groups+=("${2:?--group needs a name}"); shift 2 ;;
        --preset) presets+=("${2:?--preset needs a name}"); shift 2 ;;
        --only-packages) build=0; shift ;;
        *) echo "setup.sh: unknown option '$1' (known: --group NAME, --preset NAME, --only-packages)" >&2; exit 2 ;;
    esac
done
[ ${#groups[@]} -gt 0 ] || groups=(film)
[ ${#presets[@]} -gt 0 ] || [ $build = 0 ] || presets=(release)

# ---- Packages: only what is missing ---------------------------------------------------------------
wanted=()
for group in "${groups[@]}"; do
    mapfile -t -O ${#wanted[@]} wanted < <(awk -v g="$group" '$1 == g {print $2}' packages.txt)
done
missing=()
for package in "${wanted[@]}"; do
    status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
    echo "setup: installing ${missing[*]}"
    as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || { echo "setup: installing packages needs root or sudo" >&2; exit 1; }
        as_root=(sudo)
    fi
    log=$(mktemp)
    install() {
        "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
            apt-get install -y --no-install-recommends "${missing[@]}" >"$log" 2>&1
    }
    # A machine's package lists may be missing or old: fetch them once and try again.
    if ! install; then
        "${as_root[@]}" apt-get update >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
        install || { cat "$log" >&2; exit 1; }
    fi
    rm -f "$log"
fi

# ---- Build ----------------------------------------------------------------------------------------
for preset in "${presets[@]}"; do
    echo "setup: building preset $preset"
    log=$(mktemp)
    if ! { cmake --preset "$preset" && cmake --build --preset "$preset"; } >"$log" 2>&1; then
        cat "$log" >&2
        echo "setup: building preset $preset failed" >&2
        exit 1
    fi
    rm -f "$log"
done
