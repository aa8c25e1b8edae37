#!/usr/bin/env bash
# Opens a page of `carom report` in headless Chromium: no word on the console, no request, balls where
# `carom still` has them, the film plays, axe and html-validate find nothing; screenshots to look at.
# And `carom view` beside an editor.
#   scripts/check_report.sh [PROGRAM [FOLDER]]
# PROGRAM: default build/release/carom. FOLDER: where screenshots stay, default out/report.
# Skipped, saying why, where Chromium, node or npm's packages are not there.
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(realpath "${1:-build/release/carom}")
folder=${2:-out/report}
mkdir -p "$folder"
folder=$(realpath "$folder")
scene=scenes/figure9.yaml
skip() { echo "check_report: skipped, $1"; exit 0; }
browser=$(command -v chromium || command -v chromium-browser) || skip "there is no chromium"
command -v node >/dev/null && command -v npm >/dev/null || skip "there is no node and npm"
npm install --silent --ignore-scripts --no-save --prefix "$folder" puppeteer-core@25 axe-core@4 html-validate@9 \
    >"$folder/npm.log" 2>&1 || skip "npm does not give puppeteer-core: $(tail -n 1 "$folder/npm.log")"

"$program" report "$scene" -o "$folder/report.html" -y -q
"$program" report "$scene" -o "$folder/again.html" -y -q
cmp "$folder/report.html" "$folder/again.html"
echo "ok   the same bytes again"

# 20 instants, none near an impact; the layers say which pixels are whose.
mkdir -p "$folder/stills"
list=
for k in $(seq 1 20); do
    time=$(awk "BEGIN {print 0.137 * $k}")
    "$program" still "$scene" --time "$time" --size 1280x720 --layers segmentation \
        -o "$folder/stills/$k.png" -y -q
    list="$list${list:+,}{\"time\":$time,\"png\":\"$folder/stills/$k.segmentation.png\"}"
done
echo "{\"stills\":[$list]}" >"$folder/stills.json"

# Pages with a table of runs: of several scenes, and of a sweep.
"$program" report scenes/figure8.yaml "$scene" -o "$folder/overview.html" -y -q
"$program" sweep scenes/sweeps/restitution.yaml -o "$folder/sweep" -q
"$program" report "$folder/sweep" -o "$folder/sweep.html" -y -q

(cd "$folder" && cat >.htmlvalidate.json <<'JSON' && npx html-validate report.html overview.html sweep.html)
{"extends": ["html-validate:standard"],
 "rules": {"long-title": "off", "no-implicit-button-type": "off", "no-inline-style": "error",
           "require-sri": "off", "void-style": "off", "prefer-native-element": "off"}}
JSON
echo "ok   html-validate"
node tests/browser/report_checks.js "$browser" "$folder/report.html" "$folder" "$folder/stills.json"
node tests/browser/table_checks.js "$browser" "$folder" "$folder/overview.html" "$folder/sweep.html"
cp "$scene" "$folder/edited.yaml"
node tests/browser/view_checks.js "$browser" "$program" "$folder/edited.yaml" "$folder"
