#!/usr/bin/env bash
# Makes what docs/accuracy.md shows of the benches again: tables in the page, charts and CSVs in
# docs/accuracy. Takes about 20 minutes of one processor; --coarse leaves out the smallest steps of
# SimBenchmark (then about 10), which is no page to commit. --rows H32,H33 measures these rows of the
# hard cases alone, beside three known ones, and puts them into the page and its CSV: for rows that
# are new where no quiet machine is at hand.
set -euo pipefail
cd "$(dirname "$0")/.."

finest=0 rows=
case "${1:-}" in
    "") ;;
    --coarse) finest=1e-3 ;;
    --rows) rows=${2:?update_accuracy.sh: --rows needs ids, as H32,H33} ;;
    *) echo "update_accuracy.sh: unknown option '$1' (known: --coarse, --rows IDS)" >&2; exit 2 ;;
esac

scripts/setup.sh --group film --group bench --preset bench
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT

where() {
    echo "$(date -u +%Y-%m-%d) on $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(g++ --version | head -n 1), $(head -n 1 "$made/log")"
}

if [ -n "$rows" ]; then
    beside=H1,H14,H28
    build/bench/bench/hard_cases $(tr , '\n' <<< "$beside,$rows" | sed 's/^/--case /') --out "$made" |
        tee "$made/log"
    scripts/accuracy_rows.py "$rows" "$beside" "$made" "$(where)"
    exit
fi

build/bench/bench/hard_cases --out "$made" | tee "$made/log"
build/bench/bench/simbenchmark --finest "$finest" --out "$made"
mkdir -p docs/accuracy "$made/scenes"
scripts/gallery_accuracy.sh "$PWD/build/bench/carom" "$made/scenes" > "$made/gallery.md"
for scene in figure8 capsule_rail; do cp "$made/scenes/$scene/accuracy.svg" "$made/scene_$scene.svg"; done
cp "$made"/*.svg "$made"/*.csv docs/accuracy/
echo "Made $(where)." > "$made/environment.md"
: > "$made/hard_cases_rows.md"  # all rows are of this run

# Each block stands between two markers.
for block in environment gallery hard_cases hard_cases_rows hard_cases_failures simbenchmark_targets \
             simbenchmark_bouncing simbenchmark_elastic_666 simbenchmark_666; do
    scripts/put_block.sh docs/accuracy.md "$block" "$made/$block.md"
done
