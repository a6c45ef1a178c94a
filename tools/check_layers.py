"""Fails when a header is included that a module's statement in CMakeLists.txt does not allow. Run from CTest."""
import pathlib
import re
import sys

from module_statement import module_uses

root = pathlib.Path(sys.argv[1])
uses = {}  # module -> the modules that it may include, in the order of CMakeLists.txt
errors = []
for name, allowed in module_uses(root).items():
    for used in allowed:
        if used not in uses:
            errors.append(f"CMakeLists.txt: {name} uses {used}, which is not stated before it")
    uses[name] = allowed

included = {name: set() for name in uses}
for path in sorted((root / "src" / "frangia").rglob("*.[hc]*")):
    module = path.relative_to(root / "src" / "frangia").parts[0]
    if module not in uses:
        errors.append(f"{path}: no frangia_module({module}) in CMakeLists.txt")
        continue
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = re.match(r'\s*#include "frangia/(\w+)/(internal/)?', line)
        if not match or match[1] == module:
            continue
        included[module].add(match[1])
        if match[1] not in uses[module]:
            errors.append(f"{path}:{number}: {module} does not state that it uses {match[1]}")
        if match[2]:
            errors.append(f"{path}:{number}: {module} includes an internal header of {match[1]}")
for module, allowed in uses.items():
    for used in allowed:
        if used not in included[module]:
            errors.append(f"CMakeLists.txt: {module} states that it uses {used}, but includes nothing of it")
for path in sorted((root / "apps").rglob("*.[hc]*")) + sorted((root / "examples").rglob("*.[hc]*")):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if re.match(r'\s*#include "frangia/\w+/internal/', line):
            errors.append(f"{path}:{number}: programs include public headers only")
print("\n".join(errors))
sys.exit(bool(errors))
