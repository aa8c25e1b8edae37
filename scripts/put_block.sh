#!/usr/bin/env bash
# Puts the text of FILE between two markers of PAGE: <!-- BLOCK:begin --> and <!-- BLOCK:end -->.
#   scripts/put_block.sh PAGE BLOCK FILE
set -euo pipefail
page=$1 block=$2 file=$3
for marker in begin end; do
    grep -qxF "<!-- $block:$marker -->" "$page" || { echo "put_block: $page has no <!-- $block:$marker -->" >&2; exit 1; }
done
awk -v begin="<!-- $block:begin -->" -v end="<!-- $block:end -->" -v file="$file" '
    $0 == end {skip = 0}
    !skip {print}
    $0 == begin {while ((getline line < file) > 0) print line; skip = 1}' "$page" >"$page.new"
mv "$page.new" "$page"
