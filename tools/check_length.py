"""Names the sources above 250 lines that do not state at the top why: `python3 tools/check_length.py FILE...`"""
import pathlib
import sys

MOST = 250
REASON = "// Above 250 lines: "

silent = [path for path in map(pathlib.Path, sys.argv[1:])
          if (lines := path.read_text().splitlines()) and len(lines) > MOST and not lines[0].startswith(REASON)]
if silent:
    sys.exit(f"{', '.join(map(str, silent))}: above {MOST} lines; split it, or say why not in its first line: '{REASON}...'")
