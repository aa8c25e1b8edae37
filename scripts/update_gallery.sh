#!/usr/bin/env bash
# Draws docs/gallery/ and writes docs/gallery.md: of each scene in scenes/gallery its title, what its
# first lines say, and the picture of the middle one of its film.stills. Look at them before
# committing.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --group film --preset release
page=docs/gallery.md
mkdir -p docs/gallery
{
    echo "# Gallery"
    echo
    echo "What scenes can show, a scene for each: \`scenes/gallery/NAME.yaml\`. A film of one of them is"
    echo "\`scripts/film.sh scenes/gallery/NAME.yaml\`. The pictures are stills of 640x360, drawn by"
    echo "\`scripts/update_gallery.sh\`, which writes this page; smaller ones of the same instants are the"
    echo "golden pictures that the tests compare with."
} >"$page.new"
for scene in scenes/gallery/*.yaml; do
    name=$(basename "$scene" .yaml)
    title=$(sed -n 's/^title: *//p' "$scene" | sed 's/^"\(.*\)"$/\1/')
    mapfile -t times < <(sed -n 's/.*stills: *\[\([^]]*\)\].*/\1/p' "$scene" | tr ',' '\n' | tr -d ' ')
    [ ${#times[@]} -gt 0 ] || { echo "update_gallery: $scene has no film.stills" >&2; exit 1; }
    time=${times[$((${#times[@]} / 2))]}
    build/release/carom still "$scene" --time "$time" --size 640x360 -y -o "docs/gallery/$name.png"
    {
        echo
        echo "## ${title:-$name}"
        echo
        sed -n '/^#/!q;s/^# \{0,1\}//p' "$scene"
        echo
        echo "![${title:-$name}](gallery/$name.png)"
        echo
        echo "[$name.yaml](../scenes/gallery/$name.yaml) at $time s"
    } >>"$page.new"
done
mv "$page.new" "$page"
