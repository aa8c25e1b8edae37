#!/usr/bin/env bash
# Films scenes: scripts/film.sh SCENE... [-- OPTION...]
# Sets up a fresh machine (packages, release build), then films each SCENE to out/<name>.mp4.
# What stands behind -- goes to `carom render` as it is.
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)

scenes=() options=()
while [ $# -gt 0 ]; do
    if [ "$1" = -- ]; then shift; options=("$@"); break; fi
    scenes+=("$1"); shift
done
if [ ${#scenes[@]} -eq 0 ]; then
    echo "usage: scripts/film.sh SCENE... [-- OPTION...]" >&2
    exit 2
fi

"$top/scripts/setup.sh" --group film --preset release
for scene in "${scenes[@]}"; do
    film="$top/out/$(basename "${scene%.*}").mp4"
    echo "film: $scene -> $film"
    "$top/build/release/carom" render "$scene" -o "$film" -y "${options[@]}"
done
