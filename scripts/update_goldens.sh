#!/usr/bin/env bash
# Draws the golden pictures of every scene again, where they differ. Look at them before committing.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --group film --preset release
find scenes -name '*.yaml' -not -path 'scenes/hard/*' -not -path 'scenes/measured/*' | sort | xargs build/release/carom golden update --dir tests/golden --size 320x180
