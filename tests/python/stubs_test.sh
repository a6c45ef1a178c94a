#!/bin/sh
# The type stubs are those of the modules, and the package passes mypy where that is installed.
set -eu
source=$1
python=$2
"$python" "$source/python/make_stubs.py" --check
if "$python" -c 'import mypy' 2>/dev/null; then
  cd "$source/python"
  "$python" -m mypy --strict --ignore-missing-imports --cache-dir=/dev/null frangia
fi
