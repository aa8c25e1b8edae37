#!/usr/bin/env bash
# Draws the golden pictures of every scene again, where they differ. Look at them before committing.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --group film --preset release
scripts/golden_scenes.sh | xargs build/release/carom golden update --dir tests/golden --size 320x180
