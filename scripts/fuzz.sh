#!/usr/bin/env bash
# Coverage-guided fuzzing with libFuzzer, the address and the undefined behaviour sanitizer.
#   scripts/fuzz.sh MINUTES [TARGET...]
# Each target (all of tests/fuzz without names) runs for MINUTES on one core, at low priority. Inputs
# that reach new code are kept in build/fuzz/corpus, findings in build/fuzz/findings: put those that
# are mended into tests/fuzz/corpus/TARGET. Prints executions by target, and adds them to
# build/fuzz/runs.tsv (target, seconds, executions, inputs, findings). Exit 1 if there are findings.
set -euo pipefail
cd "$(dirname "$0")/.."
minutes=${1:?usage: scripts/fuzz.sh MINUTES [TARGET...]}
shift
seconds=$(awk -v m="$minutes" 'BEGIN {printf "%d", 60 * m}')
all=(scene set sweep csv wav sound png film motion frame)
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=("${all[@]}")

scripts/setup.sh --group film --group fuzz --only-packages
cmake --preset fuzz >/dev/null
nice -n 15 cmake --build --preset fuzz --target "${targets[@]/#/fuzz_}"

corpus=tests/fuzz/corpus kept=build/fuzz/corpus findings=build/fuzz/findings
found=0
for target in "${targets[@]}"; do
    mkdir -p "$kept/$target" "$findings"
    seeds=()
    [ ! -d "$corpus/$target" ] || seeds+=("$corpus/$target")
    case $target in motion|frame) seeds+=("$corpus/scene") ;; esac
    # The scenes of the project, as far as a target reads scenes.
    case $target in
        scene|motion|frame) find scenes -name '*.yaml' -not -path '*/sweeps/*' -size -4k -exec cp -u {} "$kept/$target/" \; ;;
        sweep) find scenes/sweeps -name '*.yaml' -exec cp -u {} "$kept/$target/" \; ;;
    esac
    dictionary=$corpus/$target.dict
    case $target in motion|frame) dictionary=$corpus/scene.dict ;; esac
    longest=8192
    case $target in wav|sound|png|film) longest=65536 ;; set|csv) longest=2048 ;; esac
    log=build/fuzz/$target.log
    # Containers cross into libraries that are not instrumented. An input that takes 30 s is a finding.
    status=0
    ASAN_OPTIONS=detect_container_overflow=0:allocator_may_return_null=1 \
        nice -n 15 "build/fuzz/tests/fuzz/fuzz_$target" "$kept/$target" "${seeds[@]}" \
        -dict="$dictionary" -max_len=$longest -max_total_time="$seconds" -timeout=30 -rss_limit_mb=2000 \
        -artifact_prefix="$findings/$target-" -print_final_stats=1 >"$log" 2>&1 || status=$?
    runs=$(grep -a -o 'stat::number_of_executed_units: [0-9]*' "$log" | tail -n 1 | awk '{print $2}')
    inputs=$(find "$kept/$target" -type f | wc -l)
    printf '%s\t%s\t%s\t%s\t%s\n' "$target" "$seconds" "${runs:-0}" "$inputs" "$status" >>build/fuzz/runs.tsv
    echo "fuzz: $target: ${runs:-0} executions, $inputs inputs kept"
    if [ $status -ne 0 ]; then
        found=1
        grep -a -E 'ERROR|broken promise|SUMMARY|Test unit written' "$log" || tail -n 5 "$log"
    fi
done
awk -F'\t' '{n += $3} END {printf "fuzz: %d executions so far (build/fuzz/runs.tsv)\n", n}' build/fuzz/runs.tsv
exit $found
