#!/usr/bin/env bash
# Makes what the documents show again: the README's still, and the reference in docs/scene.md.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --group film --preset release
carom=build/release/carom

$carom still scenes/figure9.yaml --time 0.9 -o docs/figure9.png -y

reference=$(mktemp)
trap 'rm -f "$reference"' EXIT
$carom schema --reference > "$reference"
scripts/put_block.sh docs/scene.md reference "$reference"
