"""Writes the type stubs of the extension modules from their own signatures.

    PYTHONPATH=build/release/python python3 python/make_stubs.py            write python/frangia/*.pyi
    PYTHONPATH=build/release/python python3 python/make_stubs.py --check    compare them with the modules

pybind11 puts the signature of each function into its docstring; this reads these.
"""

import difflib
import importlib
import inspect
import pathlib
import re
import sys

sys.path.remove(str(pathlib.Path(__file__).resolve().parent))  # the sources, which have no modules beside them
import frangia  # noqa: E402,F401  adds methods to Mesh
from frangia._arguments import split_arguments  # noqa: E402

FOLDER = pathlib.Path(__file__).parent / "frangia"

HEADER = '''"""Types of the extension module; python/make_stubs.py writes this file."""

import os
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, ClassVar, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

'''

# The modules, and what their stubs import.
MODULES = {
    "_frangia": "from ._notebook import Picture\n",
    "_acquisition": "from ._frangia import Rig, Scan\n",
}

# What an argument without a type in C++ accepts, by its name.
ARGUMENTS = {
    "progress": "Callable[[float, str], object] | None",
    "wrap": "Callable[[FrameStack, PhaseAlgorithm, NoiseModel], Any] | None",
    "unwrap_spatially": "Callable[[WrappedPhase], Any] | None",
    "unwrap": "Callable[[list[WrappedPhase]], Any] | None",
    "part": "str | Mesh",
    "reference": "Mesh | str | os.PathLike[str] | None",
    "rig": "str | Rig",
    "exposure_ms": "float | str",
    "algorithm": "str | LinearAlgorithm",
    "frames": "Iterable[ArrayLike]",
    "vertices": "ArrayLike",
    "triangles": "ArrayLike",
    "phase": "ArrayLike",
    "sigma": "ArrayLike | None",
    "modulation": "ArrayLike | None",
    "mean": "ArrayLike | None",
    "values": "ArrayLike | None",
    "steps": "Iterable[str | tuple[str, object]]",
}


def type_of(text, returned=False):
    """A type of pybind11 as one of Python."""
    text = re.sub(r"frangia\._\w+\.", "", text.strip())
    if "::" in text:
        sys.exit(
            f"make_stubs.py: the module has a signature with the type {text} of C++; bind that type before its use"
        )
    text = re.sub(r"numpy\.ndarray\[numpy\.(\w+)(\[[^\]]*\])?(, [^\]]*)?\]", r"NDArray[np.\1]", text)
    text = text.replace("numpy.ndarray", "NDArray[Any]")
    text = text.replace("os.PathLike", "Path" if returned else "str | os.PathLike[str]")
    while found := re.search(r"Optional\[((?:[^\[\]]|\[[^\[\]]*\])*)\]", text):
        text = text[: found.start()] + found.group(1) + " | None" + text[found.end() :]
    while found := re.search(r"Union\[((?:[^\[\]]|\[[^\[\]]*\])*)\]", text):
        text = text[: found.start()] + " | ".join(split_arguments(found.group(1))) + text[found.end() :]
    for old, new in (("List[", "list["), ("Dict[", "dict["), ("Tuple[", "tuple[")):
        text = text.replace(old, new)
    text = re.sub(
        r"\b(list|dict|tuple|Iterable)\b(?!\[)",
        lambda kind: kind[0] + ("[Any, Any]" if kind[0] == "dict" else "[Any, ...]" if kind[0] == "tuple" else "[Any]"),
        text,
    )
    if not returned:  # NumPy's arrays are taken from whatever they can be made of
        text = re.sub(r"NDArray\[(?:[^\[\]]|\[[^\[\]]*\])*\]", "ArrayLike", text)
        text = re.sub(r"\blist\[(?=[^\]]*\])", "Iterable[", text) if text.startswith("list[") else text
    return text


def default_of(text):
    return "..." if "<" in text or text in ("inf", "-inf", "nan") else text


def argument_of(text):
    if text in ("*", "/"):
        return text
    if text == "**kwargs":
        return "**faults: float"
    declaration, _, default = text.partition(" = ")
    name, _, kind = declaration.partition(":")
    if name in ("self", "arg0") and not default:
        return "self"
    kind = ARGUMENTS.get(name, "Any") if kind.strip() == "object" else type_of(kind)
    return f"{name}: {kind}" + (f" = {default_of(default)}" if default else "")


def signatures(function):
    """(arguments, type of the result, text) of each overload."""
    doc = function.__doc__ or ""
    found = re.findall(r"^(?:\d+\. )?\w*\((.*)\) -> (.+)$", doc, re.M)
    if doc.count("Overloaded function"):
        texts = re.split(r"^\d+\. .*$", doc, flags=re.M)[1:]
        found = re.findall(r"^\d+\. \w*\((.*)\) -> (.+)$", doc, re.M)
    else:
        found, texts = found[:1], [doc.partition("\n")[2]]
    for (arguments, result), text in zip(found, texts):
        yield [argument_of(a) for a in split_arguments(arguments)], type_of(result, True), text.strip()


def docstring(text, indent):
    lines = [line.strip() for line in text.strip().splitlines() if line.strip()]
    if not lines:
        return []
    return [indent + '"""' + ("\n" + indent).join(lines) + '"""']


def function_stub(name, function, indent=""):
    found = list(signatures(function))
    lines = []
    for arguments, result, text in found:
        if len(found) > 1:
            lines.append(f"{indent}@overload")
        is_static = indent and (not arguments or arguments[0] != "self")
        if is_static:
            lines.append(f"{indent}@staticmethod")
        lines.append(f"{indent}def {name}({', '.join(arguments)}) -> {result}:")
        lines += docstring(text, indent + "    ") or []
        lines.append(f"{indent}    ...")
    return lines


def property_stub(name, member, indent):
    result = "Any"
    if found := re.search(r"-> (.+)$", member.fget.__doc__ or "", re.M):
        result = type_of(found.group(1), True)
    return [
        f"{indent}@property",
        f"{indent}def {name}(self) -> {result}:",
        *docstring(member.__doc__ or "", indent + "    "),
        f"{indent}    ...",
    ]


def class_stub(kind):
    indent = "    "
    bases = [b.__name__ for b in kind.__bases__ if b.__name__ not in ("object", "pybind11_object")]
    lines = [f"class {kind.__name__}" + (f"({', '.join(bases)})" if bases else "") + ":"]
    entries = getattr(kind, "__members__", None)
    text = (kind.__doc__ or "").partition("Members:")[0]
    lines += docstring(text, indent)
    if entries is not None:
        lines += [f"{indent}{name}: ClassVar[{kind.__name__}]" for name in entries]
        lines.append(f"{indent}__members__: ClassVar[dict[str, {kind.__name__}]]")
        lines += [f"{indent}def __init__(self, value: int) -> None: ...", f"{indent}def __int__(self) -> int: ..."]
        for name in ("name", "value"):
            lines += [f"{indent}@property", f"{indent}def {name}(self) -> {'str' if name == 'name' else 'int'}: ..."]
    elif not issubclass(kind, Exception):
        for name, member in sorted(vars(kind).items()):
            member = inspect.unwrap(getattr(member, "__func__", member))  # without the check of arguments
            if getattr(member, "__module__", "") == "frangia._arguments":
                continue
            if isinstance(member, property):
                lines += property_stub(name, member, indent)
            elif inspect.isfunction(member):  # added in Python
                lines += [f"{indent}def {name}{inspect.signature(member)}:".replace("'", "")]
                lines += [*docstring(member.__doc__ or "", indent * 2), f"{indent * 2}..."]
            elif name == "__init__" or not name.startswith("_"):
                lines += function_stub(name, getattr(kind, name), indent)
    if len(lines) == 1:
        lines.append(f"{indent}...")
    return lines + [""]


def stubs(module):
    lines = []
    members = {n: m for n, m in vars(module).items() if not n.startswith("_")}
    kinds = [m for m in members.values() if inspect.isclass(m)]
    for kind in sorted(kinds, key=lambda k: (len(k.__mro__) if issubclass(k, Exception) else 99, k.__name__)):
        lines += class_stub(kind)
    for name, member in sorted(members.items()):
        if not inspect.isclass(member):
            lines += function_stub(name, member) + [""]
    version = "__version__: str\n\n" if hasattr(module, "__version__") else ""
    imports = HEADER + MODULES[module.__name__.rpartition(".")[2]] + "\n"
    return imports + version + "\n".join(lines).rstrip() + "\n"


def main():
    same = True
    for name in MODULES:
        path = FOLDER / f"{name}.pyi"
        try:
            made = stubs(importlib.import_module(f"frangia.{name}"))
        except ImportError as error:  # built without calibration
            print(f"make_stubs.py: {path.name} is left as it is: {error}")
            continue
        if "--check" not in sys.argv:
            path.write_text(made)
            continue
        kept = path.read_text().splitlines()
        difference = list(difflib.unified_diff(kept, made.splitlines(), str(path), "the module", n=0, lineterm=""))
        print("\n".join(difference))
        same = same and not difference
    if not same:
        sys.exit("make_stubs.py: the stubs are not those of the modules; run python/make_stubs.py")


if __name__ == "__main__":
    main()
