"""What the figures depend on, and its checksum: sources of verbs, of modules and of sections, files, shared scans."""
import ast
import functools
import hashlib
import os
import pathlib
import re
import sys
from typing import NamedTuple

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SHARED = ROOT.parent / "shared" / "scans"
sys.path.append(str(ROOT / "tools"))

from module_statement import module_uses, with_used  # noqa: E402


class Inputs(NamedTuple):
    """What a section depends on besides its own source; lists of words.

    `verbs` are those of the program that it runs, `modules` count with what they use, `files` are files and folders of the
    repository, `shared` are scans of ../shared/scans. `case_s` is the estimated time of a case on two idle cores, for a
    section that was never measured.
    """

    verbs: str = ""
    modules: str = ""
    files: str = ""
    shared: str = ""
    case_s: float = 10


@functools.cache
def file_checksum(path):
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else "missing"


def checksum(paths):
    """Of the names and bytes of files, in any order."""
    lines = sorted(f"{os.path.relpath(path, ROOT)} {file_checksum(path)}" for path in set(paths))
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()[:16]


def files_of(path):
    """A file, or all files of a folder."""
    if not path.is_dir():
        return [path]
    return [file for file in path.rglob("*") if file.is_file() and "__pycache__" not in file.parts]


@functools.cache
def module_files(modules):
    """The sources of modules (a tuple) and of those that they use."""
    found = with_used(modules, module_uses(ROOT))
    return [file for module in sorted(found) for file in files_of(ROOT / "src" / "frangia" / module)]


@functools.cache
def verb_files(verb):
    """The sources that a verb of the program runs.

    The program's own are followed by their includes: a header brings the source of its name, a header of a subfolder
    the whole folder. Modules count as a whole, with what they use.
    """
    apps = ROOT / "apps" / "frangia"
    left, files, modules = [apps / f"{verb}_verb.cpp"], set(), set()
    while left:
        file = left.pop()
        if file in files or not file.is_file():
            continue
        files.add(file)
        left.append(file.with_suffix(".cpp"))
        if file.parent != apps:
            left += file.parent.glob("*.[hc]*")
        for header in re.findall(r'^\s*#include "([^"]+)"', file.read_text(), re.M):
            module = re.match(r"frangia/(\w+)/", header)
            if module:
                modules.add(module[1])
            else:
                left += [file.parent / header, apps / header]
    return sorted(files) + module_files(tuple(sorted(modules)))


@functools.cache
def version_of(verb):
    """The version of what a verb of the program does: the checksum of its sources."""
    return checksum(verb_files(verb))


NO_INPUTS = ("inputs", "scans", "page")  # no result depends on how it is kept and written


def scripts_of(name):
    """The source of a section, study.py, and the scripts of this folder, of the sections and of tools that they import."""
    found, left = [], [HERE / "sections" / f"{name}.py", HERE / "study.py"]
    while left:
        file = left.pop()
        if file in found:
            continue
        found.append(file)
        for node in ast.walk(ast.parse(file.read_text())):
            names = (
                [one.name for one in node.names]
                if isinstance(node, ast.Import)
                else [node.module]
                if isinstance(node, ast.ImportFrom)
                else []
            )
            for one in names:
                if one not in NO_INPUTS:
                    left += [
                        path
                        for folder in (HERE / "sections", HERE, HERE.parent)
                        if (path := folder / f"{one}.py").is_file()
                    ]
    return found


def inputs_checksum(name, inputs):
    """Of all that the results of a section depend on."""
    files = scripts_of(name)
    for verb in inputs.verbs.split():
        if not verb_files(verb):
            raise SystemExit(
                f"figures: tools/figures/table.py states the verb '{verb}' for {name}, which the program does not have"
            )
        files += verb_files(verb)
    files += module_files(tuple(inputs.modules.split()))
    for path in inputs.files.split():
        if not (ROOT / path).exists():
            raise SystemExit(f"figures: {path}, which tools/figures/table.py states for {name}, does not exist")
        files += files_of(ROOT / path)
    for scan in inputs.shared.split():
        files += files_of(SHARED / scan)
    return checksum(files)
