#!/bin/sh
# Prints the scenes that have golden pictures: all but those that are for numbers, and sweeps, which are
# no scenes.
cd "$(dirname "$0")/.."
find scenes -name '*.yaml' -not -path 'scenes/hard/*' -not -path 'scenes/measured/*' -not -path 'scenes/sweeps/*' | sort
