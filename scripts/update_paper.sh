#!/usr/bin/env bash
# Makes what docs/paper.md shows again: its pictures in docs/paper, its tables and verdicts.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --group film --preset release
carom=build/release/carom
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT

$carom figures -o "$made" -q --only plots,tables,pictures
$carom still scenes/official/fiba_basketball.yaml --time 2.5 --size 960x540 -o "$made/fiba_basketball.png" -q
cp "$made"/*.svg "$made"/figure8.png "$made"/figure9-montage.png "$made"/fiba_basketball.png docs/paper/

for scene in scenes/official/*.yaml; do
    $carom simulate "$scene" -o /dev/null 2>&1 | sed 's/^carom: /- /'
done > "$made/verdicts.md"

# Each block stands between two markers.
for block in table1 table2 errata figure8-rebounds verdicts; do
    scripts/put_block.sh docs/paper.md "$block" "$made/$block.md"
done
