#!/usr/bin/env bash
# Exports every scene that comes with carom as .glb and has Khronos' validator look at it (npm's
# gltf-validator, which npm fetches into a temporary folder): neither errors nor warnings.
#   scripts/check_gltf.sh [PROGRAM]      default build/release/carom
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(realpath "${1:-build/release/carom}")
command -v npm >/dev/null || { echo "check_gltf: skipped, there is no npm"; exit 0; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
npm install --silent --ignore-scripts --prefix "$folder" gltf-validator@2.0.0-dev.3.10 >"$folder/log" 2>&1 || {
    echo "check_gltf: skipped, npm has no gltf-validator: $(tail -n 1 "$folder/log")"
    exit 0
}
for scene in $(scripts/golden_scenes.sh); do
    "$program" simulate "$scene" -o "$folder/$(basename "$scene" .yaml).glb" -q -y
done
cat >"$folder/check.js" <<'JS'
const validator = require('gltf-validator'), fs = require('fs');
(async () => {
    let failed = 0;
    const files = fs.readdirSync('.').filter(f => f.endsWith('.glb'));
    for (const file of files) {
        const {issues} = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)));
        if (issues.numErrors + issues.numWarnings === 0) continue;
        failed += 1;
        console.log(file, issues.messages.slice(0, 5));
    }
    console.log(`check_gltf: ${files.length - failed} passed, ${failed} failed`);
    process.exit(failed || !files.length ? 1 : 0);
})();
JS
cd "$folder" && node check.js
