#!/usr/bin/env bash
# Runs `carom accuracy` on every scene that the documents show, and prints the table of
# docs/accuracy.md: what each needs for 1 % and 0.1 % of its extent. Usage: gallery_accuracy.sh
# CAROM DIR; DIR gets a folder of plots and numbers for each scene.
set -euo pipefail
cd "$(dirname "$0")/.."
carom=$1 folder=$2

echo "| Scene | Extent [m] | Trusted up to [s] | exact: steps | exact: CPU s per s | fixed for 1 %: step [s], CPU over exact's | for 0.1 % |"
echo "|---|---:|---:|---:|---:|---|---|"
for scene in scenes/figure8.yaml scenes/figure9.yaml scenes/gallery/*.yaml; do
    name=$(basename "$scene" .yaml)
    "$carom" accuracy "$scene" -o "$folder/$name" -y -q > "$folder/$name.txt"
    # value KEY: of the JSON's top level, which has one key a line.
    value() { sed -n "s/^  \"$1\": \(.*[^,]\),\{0,1\}$/\1/p" "$folder/$name/accuracy.json"; }
    awk -F, -v scene="$name" -v extent="$(value extent_m)" -v trusted="$(value trusted_until_s)" \
        -v chaotic="$(value chaotic)" '
        NR == 1 {for (i = 1; i <= NF; i++) column[$i] = i; next}
        $1 == "exact" {cost = $column["cpu_s_per_s"]; steps = $column["steps"]; next}
        $column["status"] == "done" {
            for (target = 1; target <= 2; target++)
                if ($column["position_error_relative"] <= (target == 1 ? 1e-2 : 1e-3) &&
                    (!(target in best) || $column["cpu_s_per_s"] < best[target])) {
                    best[target] = $column["cpu_s_per_s"]
                    step[target] = $column["step_s"]
                }
        }
        function answer(target) {
            if (!(target in best)) return "none"
            ratio = best[target] / cost
            return sprintf("%g, %s times", step[target], ratio >= 10 ? sprintf("%.0f", ratio) : sprintf("%.2g", ratio))
        }
        END {
            printf "| %s | %.3g | %s | %d | %.2g | %s | %s |\n", scene, extent,
                   chaotic == "true" ? sprintf("%.3g", trusted) : "its end", steps, cost, answer(1), answer(2)
        }' "$folder/$name/accuracy.csv"
done
