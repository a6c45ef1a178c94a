"""Names the sources above 400 lines: `python3 tools/check_length.py FILE...`"""
import pathlib
import sys

MOST = 400

long = [
    f"{path} ({lines})"
    for path in map(pathlib.Path, sys.argv[1:])
    if (lines := len(path.read_text().splitlines())) > MOST
]
if long:
    sys.exit(f"above {MOST} lines: {', '.join(long)}; a file is one concept: split it")
