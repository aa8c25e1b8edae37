#!/usr/bin/env bash
# Makes what the documents show again: the README's still, and the reference in docs/scene.md.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --group film --preset release
carom=build/release/carom

$carom still scenes/figure9.yaml --time 0.9 -o docs/figure9.png -y

# The reference stands between two markers.
$carom schema --reference > docs/reference.tmp
awk '/<!-- reference:begin -->/ {print; while ((getline line < "docs/reference.tmp") > 0) print line; skip = 1}
     /<!-- reference:end -->/ {skip = 0}
     !skip && !/<!-- reference:begin -->/ {print}' docs/scene.md > docs/scene.tmp
mv docs/scene.tmp docs/scene.md
rm docs/reference.tmp
