#!/usr/bin/env bash
# Makes what the documents show again: the README's still, and the references in docs/scene.md and docs/sweeps.md.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --group film --preset release
carom=build/release/carom

$carom still scenes/figure9.yaml --time 0.9 -o docs/figure9.png -y

# The references stand between two markers.
for of in scene:scene sweep:sweeps; do
    document=docs/${of#*:}
    $carom schema "${of%:*}" --reference > docs/reference.tmp
    awk '/<!-- reference:begin -->/ {print; while ((getline line < "docs/reference.tmp") > 0) print line; skip = 1}
         /<!-- reference:end -->/ {skip = 0}
         !skip && !/<!-- reference:begin -->/ {print}' "$document.md" > "$document.tmp"
    mv "$document.tmp" "$document.md"
    rm docs/reference.tmp
done
