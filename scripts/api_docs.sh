#!/usr/bin/env bash
# The pages of all headers, by Doxygen, to out/api/html/index.html. Fails on any warning.
set -euo pipefail
cd "$(dirname "$0")/.."

if ! command -v doxygen >/dev/null; then
    echo "api_docs: needs the package doxygen" >&2
    exit 1
fi
mkdir -p out
doxygen docs/Doxyfile
echo "api_docs: out/api/html/index.html"
