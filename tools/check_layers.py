"""Fails when a header is included against the path of light. Run from CTest."""
import pathlib
import re
import sys

# Each module may include itself and anything before it.
ORDER = "core pattern frames rig phase range views surface mesh files inspect devices simulate scan".split()

root = pathlib.Path(sys.argv[1]) / "src" / "frangia"
errors = []
for path in sorted(root.rglob("*.[hc]*")):
    module = path.relative_to(root).parts[0]
    if module not in ORDER:
        errors.append(f"{path}: folder '{module}' has no place in the order")
        continue
    for number, line in enumerate(path.read_text().splitlines(), 1):
        used = re.match(r'\s*#include "frangia/(\w+)/', line)
        if used and ORDER.index(used[1]) > ORDER.index(module):
            errors.append(f"{path}:{number}: {module} must not include {used[1]}")
print("\n".join(errors))
sys.exit(bool(errors))
