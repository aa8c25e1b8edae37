#!/usr/bin/env bash
# Makes what the documents show again: the README's still, and the references in docs/scene.md and docs/sweeps.md.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --group film --preset release
carom=build/release/carom

$carom still scenes/figure9.yaml --time 0.9 -o docs/figure9.png -y

# The references stand between two markers.
reference=$(mktemp)
trap 'rm -f "$reference"' EXIT
for of in scene:scene sweep:sweeps; do
    $carom schema "${of%:*}" --reference > "$reference"
    scripts/put_block.sh "docs/${of#*:}.md" reference "$reference"
done
