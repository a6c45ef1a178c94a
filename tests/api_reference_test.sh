#!/bin/sh
# Builds the API reference in a temporary folder and fails on any warning, such as a public entity that is not
# documented: api_reference_test.sh SOURCE_DIR DOXYGEN
set -eu
cd "$1"
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
(cat docs/Doxyfile; echo "OUTPUT_DIRECTORY = $out") | "$2" -
