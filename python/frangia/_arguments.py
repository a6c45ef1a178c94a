"""Wrong arguments, in one sentence with the right call.

pybind11 answers a call that fits no signature with all signatures and all values, arrays included. The functions of
this package are wrapped: where that happens, the wrapper compares the arguments with the signatures, which pybind11
writes into docstrings, and names the argument that is wrong, what it is and what to give instead.
"""

from __future__ import annotations

import difflib
import functools
import inspect
import os
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy

from . import _frangia


class ArgumentError(_frangia.InputError, TypeError):
    """A function is called with arguments that it does not take. The text says what to give instead."""


# How the values of a type are made.
MAKERS = {
    "AbsolutePhase": "frangia.unwrap_temporal(maps, projector_px) or frangia.AbsolutePhase(phase)",
    "FrameStack": "frangia.FrameStack(frames, frangia.Pattern.fringes(shifts_rad, period_px=20))",
    "InspectionPlan": 'frangia.read_inspection_plan("inspection.toml") or frangia.InspectionPlan(align="best-fit")',
    "FringeDirection": "frangia.FringeDirection.VERTICAL",
    "LinearAlgorithm": 'frangia.read_algorithm("my-algorithm.toml")',
    "Mesh": 'frangia.read_mesh("part.ply") or frangia.Mesh(vertices, triangles)',
    "NoiseModel": "frangia.NoiseModel(floor_counts2, slope_counts)",
    "Pattern": "frangia.Pattern.fringes(shifts_rad, period_px=20)",
    "PhaseAlgorithm": 'frangia.least_squares(shifts_rad) or frangia.phase_algorithm("4-step", shifts_rad)',
    "Rig": 'frangia.read_rig("rig.toml") or frangia.rig_preset("digital")',
    "Scan": 'frangia.read_scan("folder")',
    "WrappedPhase": "frangia.wrap_phase(frames, shifts_rad) or frangia.WrappedPhase(phase)",
}

# Arguments of which the signature says `object`: what they may be.
OBJECTS = {
    "algorithm": "str | LinearAlgorithm",
    "exposure_ms": "float | str",
    "frames": "Iterable[ArrayLike]",
    "mean": "Optional[ArrayLike]",
    "modulation": "Optional[ArrayLike]",
    "part": "str | Mesh",
    "phase": "ArrayLike",
    "progress": "Optional[Callable]",
    "reference": "Optional[os.PathLike] | Mesh",
    "rig": "str | Rig",
    "sigma": "Optional[ArrayLike]",
    "steps": "Iterable[Step]",
    "triangles": "ArrayLike",
    "unwrap": "Optional[Callable]",
    "unwrap_spatially": "Optional[Callable]",
    "values": "Optional[ArrayLike]",
    "vertices": "ArrayLike",
    "wrap": "Optional[Callable]",
}

WORDS = {
    "ArrayLike": "an array",
    "Callable": "a function",
    "Step": "a name or a pair of a name and a value",
    "bool": "True or False",
    "float": "a number",
    "int": "a whole number",
    "os.PathLike": "a path",
    "str": "a text",
}
PLURALS = {
    "ArrayLike": "arrays",
    "Step": "names and of pairs of a name and a value",
    "float": "numbers",
    "int": "whole numbers",
    "os.PathLike": "paths",
    "str": "texts",
}
COUNTS = {2: "two", 3: "three", 4: "four"}


@dataclass
class Parameter:
    name: str
    kind: str  # as pybind11 writes it, without the module
    needed: bool
    by_name_only: bool


def split_arguments(text: str) -> list[str]:
    """The parts of a list between its outermost commas."""
    parts, depth, begin = [], 0, 0
    for i, character in enumerate(text):
        depth += (character in "[(<{") - (character in "])>}")
        if character == "," and depth == 0:
            parts.append(text[begin:i].strip())
            begin = i + 1
    last = text[begin:].strip()
    return parts + [last] if last else parts


def parameters_of(signature: str) -> list[Parameter]:
    """The parameters of a signature such as `maps: List[WrappedPhase], *, name: str = 'x', **kwargs`, without self."""
    out, by_name_only = [], False
    for text in split_arguments(signature):
        if text == "*":
            by_name_only = True
            continue
        declaration, _, default = text.partition(" = ")
        name, _, kind = declaration.partition(": ")
        if name not in ("self", "/"):
            kind = re.sub(r"frangia\._\w+\.", "", kind).strip()
            kind = OBJECTS.get(name, kind) if kind in ("object", "Iterable") else kind
            out.append(Parameter(name, kind, not default, by_name_only))
    return out


def signatures_of(function: Any) -> list[list[Parameter]]:
    text = function.__doc__ or ""
    pattern = r"^\d+\. \w+\((.*)\) -> " if "Overloaded function" in text else r"^\w+\((.*)\) -> "
    return [parameters_of(found) for found in re.findall(pattern, text, re.M)]


def inner(kind: str) -> list[str]:
    """The types in the brackets of a generic one."""
    return split_arguments(kind[kind.index("[") + 1 : -1])


def is_array(value: object) -> bool:
    try:
        return bool(numpy.asarray(value).dtype.kind in "biuf")
    except ValueError:  # rows of several lengths
        return False


def is_step(value: object) -> bool:
    return isinstance(value, str) or (
        isinstance(value, (tuple, list)) and len(value) == 2 and isinstance(value[0], str)
    )


def is_number(value: Any, convert: Callable[[Any], object]) -> bool:
    if isinstance(value, (str, bytes)):
        return False
    try:
        convert(value)
    except (TypeError, ValueError, OverflowError):
        return False
    return True


SIMPLE: dict[str, Callable[[Any], bool]] = {
    "ArrayLike": is_array,
    "Callable": callable,
    "Step": is_step,
    "bool": lambda value: value is None or hasattr(type(value), "__bool__"),
    "float": lambda value: is_number(value, float),
    "int": lambda value: not isinstance(value, float) and is_number(value, int),
    "os.PathLike": lambda value: isinstance(value, (str, bytes, os.PathLike)),
    "str": lambda value: isinstance(value, (str, bytes)),
}


def fits(value: Any, kind: str) -> bool:
    """Whether a value may be of the type; True where that is not known."""
    if " | " in kind:
        return any(fits(value, one) for one in kind.split(" | "))
    if kind.startswith("Optional["):
        return value is None or fits(value, inner(kind)[0])
    if kind.startswith(("List[", "Iterable[")):
        sequence = isinstance(value, Iterable) and not isinstance(value, (str, bytes))
        return sequence and all(fits(item, inner(kind)[0]) for item in value)
    if kind.startswith("Tuple["):
        kinds = inner(kind)
        try:
            items = list(value)
        except TypeError:
            return False
        return len(items) == len(kinds) and all(map(fits, items, kinds))
    if kind in SIMPLE:
        return SIMPLE[kind](value)
    bound = getattr(_frangia, kind, None)
    return not inspect.isclass(bound) or isinstance(value, bound)


def article(noun: str) -> str:
    return ("an " if noun[0] in "AEIOUaeiou" else "a ") + noun


def size(shape: tuple[int, ...]) -> str:
    return " x ".join(map(str, shape))


def described(value: Any) -> str:
    """What a value is, without its content."""
    if isinstance(value, numpy.ndarray):
        if value.ndim == 0:
            return f"the number {value}"
        return f"an array of {value.dtype}, {size(value.shape)}" + (" values" if value.ndim == 1 else "")
    if value is None or isinstance(value, (bool, numpy.bool_)):
        return str(value)
    if isinstance(value, (int, float, numpy.number)):
        return f"the number {value}"
    if isinstance(value, str):
        return f'the text "{value}"' if len(value) <= 40 else "a text"
    if inspect.isclass(value):
        return f"the class {value.__name__}"
    name = type(value).__name__
    if isinstance(value, (list, tuple)):
        kinds = sorted({item_kind(item) for item in value})
        content = f" of {len(value)} {kinds[0]}" if len(kinds) == 1 else f" of {len(value)} items"
        return f"{article(name)}{content if value else ' that is empty'}"
    if callable(value):
        return "a function"
    return article(name)


def item_kind(value: object) -> str:
    if isinstance(value, numpy.ndarray):
        return f"arrays of {value.dtype}"
    if isinstance(value, (int, float, numpy.number)):
        return "numbers"
    return "texts" if isinstance(value, str) else f"{type(value).__name__} objects"


def wanted(kind: str) -> str:
    """What to give for a type, and how such a value is made."""
    if " | " in kind:
        return " or ".join(wanted(one) for one in kind.split(" | "))
    if kind.startswith("Optional["):
        return wanted(inner(kind)[0])
    if kind.startswith(("List[", "Iterable[")):
        item = inner(kind)[0]
        if item.startswith("Tuple["):
            return f"a list of tuples, each of {wanted(item)}"
        return f"a list of {PLURALS.get(item, item + ' objects')}" + made(item)
    if kind.startswith("Tuple["):
        kinds = inner(kind)
        return f"{COUNTS.get(len(kinds), len(kinds))} values: {', '.join(map(wanted, kinds))}"
    if found := re.fullmatch(r"numpy\.ndarray\[numpy\.\w+\[(\d+), 1\]\]", kind):
        return f"{found[1]} numbers"
    return WORDS.get(kind, article(kind)) + made(kind)


def made(kind: str) -> str:
    return f", such as {MAKERS[kind]}" if kind in MAKERS else ""


def need(name: str, argument: str, value: object, kind: str) -> None:
    """Raises ArgumentError where an argument of a function in Python is of another type."""
    if not fits(value, kind):
        raise ArgumentError(f"{name}: {argument} is {described(value)}; give {wanted(kind)}")


def need_members(name: str, argument: str, value: object, kind: str, *members: str) -> None:
    """The same for a type of another package, which is known by its members."""
    if not all(hasattr(value, member) for member in members):
        raise ArgumentError(f"{name}: {argument} is {described(value)}; give {article(kind)}")


def call_of(name: str, parameters: list[Parameter]) -> str:
    """The shortest right call."""
    return f"{name}({', '.join(p.name + ('=...' if p.by_name_only else '') for p in parameters if p.needed)})"


@dataclass
class Call:
    """The values of a call as one signature takes them."""

    values: dict[str, Any]
    surplus: int  # values without a name that have no place
    twice: list[str]  # names of arguments that also have a place
    unknown: list[str]
    wrong: list[Parameter]  # parameters whose values are of another type
    missing: list[Parameter]

    def faults(self) -> float:
        """Of several signatures, the one with the fewest is meant; what is missing counts half."""
        return self.surplus + len(self.twice) + len(self.unknown) + len(self.wrong) + 0.5 * len(self.missing)


def places_of(parameters: list[Parameter]) -> list[Parameter]:
    """Those that take values without a name."""
    return [p for p in parameters if not p.by_name_only and not p.name.startswith("*")]


def call_with(parameters: list[Parameter], given: tuple[Any, ...], named: dict[str, Any]) -> Call:
    places = places_of(parameters)
    values = dict(zip((p.name for p in places), given))
    known = {p.name: p for p in parameters}
    twice = [name for name in named if name in values]
    unknown = [name for name in named if name not in known]
    if any(p.name.startswith("**") for p in parameters):  # of numbers, the faults of the simulator
        known.update({name: Parameter(name, "float", False, True) for name in unknown})
        unknown = []
    values.update({name: value for name, value in named.items() if name in known and name not in values})
    wrong = [known[name] for name, value in values.items() if not fits(value, known[name].kind)]
    missing = [p for p in parameters if p.needed and p.name not in values and not p.name.startswith("*")]
    return Call(values, max(0, len(given) - len(places)), twice, unknown, wrong, missing)


def sentence_of(name: str, parameters: list[Parameter], call: Call) -> str | None:
    """The first fault of a call; None where none is found."""
    if call.surplus:
        places = places_of(parameters)
        most = ", ".join(p.name for p in places) or "nothing"
        count = len(places) + call.surplus
        return f"{count} arguments without a name are given; it takes {most}; name the others, NAME=VALUE"
    if call.twice:
        return f"{call.twice[0]} is given twice, by its place and by its name; give it once"
    if call.unknown:
        known = sorted(p.name for p in parameters)
        nearest = difflib.get_close_matches(call.unknown[0], known, 1)
        hint = f"did you mean {nearest[0]}?" if nearest else f"it takes {', '.join(known) or 'nothing'}"
        return f"there is no argument {call.unknown[0]}; {hint}"
    if call.wrong:
        wrong = call.wrong[0]
        return f"{wrong.name} is {described(call.values[wrong.name])}; give {wanted(wrong.kind)}"
    if call.missing:
        return f"{call.missing[0].name} is missing; call {call_of(name, parameters)}"
    for p in parameters:
        value = call.values.get(p.name)
        if p.kind == "int" and value is not None and not 0 <= int(value) < 2**31:
            return f"{p.name} is {described(value)}; give a whole number from 0"
    return None


def explain(function: Any, name: str, given: tuple[Any, ...], named: dict[str, Any]) -> str:
    """One sentence on a call that fits none of a function's signatures."""
    signatures = signatures_of(function)
    calls = [(call_with(parameters, given, named), parameters) for parameters in signatures]
    if calls:
        call, parameters = min(calls, key=lambda one: one[0].faults())
        sentence = sentence_of(name, parameters, call)
        if sentence is not None:
            return f"{name}: {sentence}"
    return f"{name} does not take these arguments; call {' or '.join(call_of(name, p) for p in signatures)}"


def is_refusal(error: Exception, function: Any) -> bool:
    """Whether pybind11 found no signature, or no type for the value of an argument; not an error of a caller's code."""
    text = str(error)
    return text.startswith((f"{function.__name__}(): incompatible", "Unable to cast Python instance"))


def checked(function: Any, name: str, bound: bool = False) -> Any:
    """The function, which raises ArgumentError where pybind11 refuses the arguments. bound: the first one is self."""

    @functools.wraps(function)
    def call(*given: Any, **named: Any) -> Any:
        try:
            return function(*given, **named)
        except (TypeError, RuntimeError) as error:
            if not is_refusal(error, function):
                raise
        raise ArgumentError(explain(function, name, given[1:] if bound else given, named))

    return call


def refusing(kind: type) -> Any:
    """The constructor of a class whose values only functions of the package make."""

    def __init__(self: object, *given: Any, **named: Any) -> None:
        raise ArgumentError(f"frangia.{kind.__name__} has no constructor; functions of frangia return such objects")

    return __init__


def check_class(kind: type) -> None:
    """Wraps the methods of a class of an extension module."""
    if "__init__(" not in (getattr(kind, "__init__").__doc__ or ""):
        setattr(kind, "__init__", refusing(kind))
    for name, member in list(vars(kind).items()):
        full = f"frangia.{kind.__name__}.{name}"
        if isinstance(member, staticmethod):
            setattr(kind, name, staticmethod(checked(member.__func__, full)))
        elif name == "__init__" and (member.__doc__ or "").startswith("__init__("):
            setattr(kind, name, checked(getattr(kind, name), f"frangia.{kind.__name__}", bound=True))
        elif not name.startswith("_") and callable(member):
            setattr(kind, name, checked(getattr(kind, name), full, bound=True))


def checked_members(module: Any) -> dict[str, Any]:
    """The functions of an extension module, wrapped, by their names. Its classes are changed in place."""
    functions = {}
    for name, member in vars(module).items():
        if name.startswith("_"):
            continue
        if inspect.isclass(member):
            if not issubclass(member, Exception):
                check_class(member)
        elif callable(member):
            functions[name] = checked(member, f"frangia.{name}")
    return functions
