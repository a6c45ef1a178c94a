#!/bin/sh
# Installs the build tree into a folder of its own, builds examples/find_package from there and lets it reconstruct a
# simulated scan: install_test.sh SOURCE_DIR BUILD_DIR
set -eu
source_dir=$1
build_dir=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build_dir" --prefix "$work/usr" >"$work/install.log"

# Public headers are installed, internal ones are not.
test -f "$work/usr/include/frangia/reconstruct/reconstruct.h"
test -z "$(find "$work/usr/include" -name internal)"

cmake -S "$source_dir/examples/find_package" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/usr" >"$work/configure.log"
cmake --build "$work/build" >"$work/build.log" || { cat "$work/build.log"; exit 1; }
"$work/usr/bin/frangia" --quiet simulate ball-bar --views 2 --rig "$source_dir/examples/python/small-rig.toml" -o "$work/scan"
"$work/build/scan_to_mesh" "$work/scan" "$work/mesh.ply"
test -s "$work/mesh.ply"

# The installed program finds what reads CAD files.
if [ -f "$build_dir/lib/frangia/frangia_cad.so" ]; then
  "$build_dir/tests/make_cad_parts" "$work" >"$work/parts.log"
  "$work/usr/bin/frangia" --quiet inspect "$work/mesh.ply" --reference "$work/primitives.step" --align none >"$work/inspect.log"
fi

# A module that does not exist is refused, and so is another minor version.
refuses() {
  mkdir -p "$work/refused"
  printf 'cmake_minimum_required(VERSION 3.25)\nproject(refused LANGUAGES CXX)\nfind_package(frangia %s)\n' "$1" \
    >"$work/refused/CMakeLists.txt"
  if cmake -S "$work/refused" -B "$work/refused/build" -DCMAKE_PREFIX_PATH="$work/usr" >"$work/refused.log" 2>&1; then
    echo "find_package(frangia $1) was accepted"
    exit 1
  fi
}
refuses "0.2 REQUIRED COMPONENTS telepathy"
refuses "0.3 REQUIRED"
