"""Fails when a header is included that CMakeLists.txt or the header's place does not allow: `check_layers.py ROOT`.

A module includes only modules that its statement in CMakeLists.txt names. A header in an `internal/` at any depth is
included only below the folder that holds this `internal/`, and by tests, benchmarks and fuzzing.
"""
import pathlib
import re
import sys

from module_statement import module_uses

root = pathlib.Path(sys.argv[1])
errors = []
uses = {}  # module -> the modules that it may include, in the order of CMakeLists.txt
for name, stated in module_uses(root).items():
    for used in stated:
        if used not in uses:
            errors.append(f"CMakeLists.txt: {name} uses {used}, which is not stated before it")
    uses[name] = stated


def includes(path):
    """The included headers of the library: line number, path below src/frangia."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if match := re.match(r'\s*#\s*include\s*"frangia/([^"]+)"', line):
            yield number, pathlib.PurePosixPath(match[1])


def owner(header):
    """The folder that an internal header belongs to, or None for a public one."""
    depth = max((at for at, part in enumerate(header.parts) if part == "internal"), default=None)
    return None if depth is None else pathlib.PurePosixPath(*header.parts[:depth])


included = {name: set() for name in uses}
sources = root / "src" / "frangia"
for path in sorted(sources.rglob("*.[hc]*")):
    place = pathlib.PurePosixPath(path.relative_to(sources))
    module = place.parts[0]
    if module not in uses:
        errors.append(f"{path}: no frangia_module({module}) in CMakeLists.txt")
        continue
    for number, header in includes(path):
        other, folder = header.parts[0], owner(header)
        if other != module:
            included[module].add(other)
            if other not in uses[module]:
                errors.append(f"{path}:{number}: {module} does not state that it uses {other}")
        if folder is not None and not place.is_relative_to(folder):
            errors.append(f"{path}:{number}: an internal header of {folder} is included outside of {folder}")
for module, allowed in uses.items():
    for used in allowed:
        if used not in included[module]:
            errors.append(f"CMakeLists.txt: {module} states that it uses {used}, but includes nothing of it")
for folder in ("apps", "examples", "python"):
    for path in sorted((root / folder).rglob("*.[hc]*")):
        for number, header in includes(path):
            if owner(header) is not None:
                errors.append(f"{path}:{number}: programs and bindings include public headers only")
print("\n".join(errors))
sys.exit(bool(errors))
