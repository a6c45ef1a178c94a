#!/usr/bin/env python3
"""How far a value goes through the sources: `python3 tools/follow_value.py [-v]`, or `... TYPE FROM [UNTIL ...]`.

Definition, which does not change, so that counts of different commits compare:

- A *holder* of a type is the type itself and each struct or class with a member whose declaration names a holder.
- A *stay* is a function under src/frangia whose return type or parameters name a holder, or a member function of a
  holder. Overloads are one stay; functions of the same name in different files are different ones. A lambda belongs
  to the function around it.
- The *way* of a type from a function are the stays that it reaches by calls through stays alone, itself included.
  Nothing that a function of UNTIL calls belongs to the way. A call is a name followed by `(`; after `.` or `->` it
  leads to member functions alone, except for the names that containers have, which lead nowhere. It leads to a stay
  of the same file, else to all of that name that no unnamed namespace hides.
- A *climb* is a call from a stay of one module to a stay of an earlier one (CMakeLists.txt has their order): what the
  earlier module made has to come back up before the way goes on.

Counted are stays, the files that hold them, and climbs.
"""
import argparse
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
WAYS = {
    "frames of a view to their phase": (
        "FrameStack",
        "decode_view",
        ["wrap_phase", "merge_exposures", "decode_sequence", "decode_gray_code", "decode_gray_alone"],
    ),
    "a scan to its mesh": ("Scan|MeasuredViews|ViewStore", "reconstruct", ["fuse_views", "register_views"]),
    "an edit of a mesh": ("EditState", "apply_step", []),
}
CONTAINERS = {
    "size",
    "empty",
    "begin",
    "end",
    "front",
    "back",
    "at",
    "data",
    "clear",
    "resize",
    "push_back",
    "emplace_back",
    "insert",
    "erase",
    "find",
    "count",
    "value",
    "reset",
    "get",
}
KEYWORDS = {
    "if",
    "for",
    "while",
    "switch",
    "return",
    "sizeof",
    "catch",
    "alignas",
    "decltype",
    "noexcept",
    "static_assert",
}

Function = collections.namedtuple("Function", "name owner signature body file module hidden")
Struct = collections.namedtuple("Struct", "name body")


def without_comments_and_strings(text):
    """The text with comments gone and strings empty."""
    pattern = r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])*\''
    text = re.sub(pattern, lambda match: '""' if match[0][0] in "\"'R" else " ", text, flags=re.S)
    return re.sub(r"^\s*#.*$", "", text, flags=re.M)


def closing(text, start):
    """Position of the brace that closes the one at `start`."""
    depth = 0
    for match in re.compile(r"[{}]").finditer(text, start):
        depth += 1 if match[0] == "{" else -1
        if depth == 0:
            return match.start()
    return len(text)


def own_members(body):
    """The data members of a struct's body: what is left without nested braces and functions."""
    while re.search(r"\{[^{}]*\}", body):
        body = re.sub(r"\{[^{}]*\}", ";", body)
    return [part for part in body.split(";") if "(" not in part.replace("std::function<", "")]


def name_of(declaration):
    """The class and the name of a function: what precedes its parameters, outside of the angles of templates."""
    flat = declaration
    while re.search(r"<[^<>]*>", flat):
        flat = re.sub(r"<[^<>]*>", "", flat)
    found = re.search(r"(?:(\w+)::)?(~?\w+|operator\W+)\s*\(", flat)
    return (found[1], found[2]) if found else (None, None)


def parse(text, file, module, functions, structs, owner=None, hidden=False):
    at = 0
    head = 0  # where the declaration begins
    while match := re.compile(r"[;{}]|\b(?:public|private|protected):").search(text, at):
        at = match.end()
        if match[0] != "{":
            head = at
            continue
        declaration = text[head : match.start()]
        end = closing(text, match.start())
        inner = text[at:end]
        if space := re.search(r"\bnamespace\b([\w:\s]*)$", declaration):
            parse(inner, file, module, functions, structs, owner, hidden or not space[1].strip())
        elif re.search(r'extern ""\s*$', declaration):
            parse(inner, file, module, functions, structs, owner, hidden)
        elif found := re.search(r"\b(?:struct|class)\s+(?:\[\[\w+\]\]\s*)?(\w+)[^()=]*$", declaration):
            structs.append(Struct(found[1], inner))
            parse(inner, file, module, functions, structs, found[1], hidden)
        elif "(" in declaration and not re.search(r"\benum\b|=\s*$", declaration):
            of, name = name_of(declaration)
            if name and name not in KEYWORDS:
                functions.append(Function(name, of or owner, declaration, inner, file, module, hidden))
                # Members that a constructor initializes with braces come before its body.
                rest = text[end + 1 :]
                while more := re.match(r"\s*(?:,[^;{}]*)?\{", rest):
                    start = end + more.end()
                    end = closing(text, start)
                    functions[-1] = functions[-1]._replace(body=functions[-1].body + text[start:end])
                    rest = text[end + 1 :]
        at = head = end + 1


def sources():
    modules = re.findall(r"^\s*frangia_module\((\w+)", (ROOT / "CMakeLists.txt").read_text(), re.M)
    functions, structs = [], []
    for path in sorted((ROOT / "src" / "frangia").rglob("*.[hc]*")):
        module = path.relative_to(ROOT / "src" / "frangia").parts[0]
        file = str(path.relative_to(ROOT))
        parse(without_comments_and_strings(path.read_text()), file, modules.index(module), functions, structs)
    return functions, structs, modules


def holders_of(types, structs):
    holders = set(types)
    while True:
        named = re.compile(rf"\b(?:{'|'.join(map(re.escape, holders))})\b")
        more = {
            one.name for one in structs if one.name not in holders and any(map(named.search, own_members(one.body)))
        }
        if not more:
            return holders
        holders |= more


def way_of(types, begin, until, functions, structs):
    """The stays as {(file, name): module}, and the climbs as pairs of stays."""
    holders = holders_of(types, structs)
    named = re.compile(rf"\b(?:{'|'.join(map(re.escape, holders))})\b")
    stays = collections.defaultdict(list)  # name -> functions
    for function in functions:
        if function.owner in holders or named.search(function.signature):
            stays[function.name].append(function)
    if begin not in stays:
        sys.exit(f"no function {begin} takes or returns {', '.join(types)}")
    reached, climbs = {}, set()
    open_ends = list(stays[begin])
    for function in open_ends:
        reached[function.file, function.name] = function.module
    done = set()
    while open_ends:
        function = open_ends.pop()
        if id(function) in done or function.name in until:
            continue
        done.add(id(function))
        for member, name in set(
            re.findall(r"(\.|->)?\b(\w+)\s*\(", function.signature.partition(")")[2] + function.body)
        ):
            if member and name in CONTAINERS:
                continue
            named_so = [one for one in stays.get(name, []) if not member or one.owner]
            same_file = [one for one in named_so if one.file == function.file]
            for called in same_file or [one for one in named_so if not one.hidden]:
                if called.module > function.module:
                    continue  # a function of the same name in a later module cannot be called
                if called.module < function.module:
                    climbs.add(((function.file, function.name), (called.file, called.name)))
                reached[called.file, called.name] = called.module
                open_ends.append(called)
    return reached, climbs


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-v", "--verbose", action="store_true", help="name the stays and the climbs")
    parser.add_argument("types", nargs="?", metavar="TYPE", help="one or several, with | between them")
    parser.add_argument("begin", nargs="?", metavar="FROM")
    parser.add_argument("until", nargs="*", metavar="UNTIL")
    arguments = parser.parse_args()
    ways = WAYS
    if arguments.begin:
        ways = {f"{arguments.types} from {arguments.begin}": (arguments.types, arguments.begin, arguments.until)}
    functions, structs, modules = sources()
    for title, (types, begin, until) in ways.items():
        reached, climbs = way_of(types.split("|"), begin, set(until), functions, structs)
        files = {file for file, _ in reached}
        print(f"{title}: {len(reached)} stays, {len(files)} files, {len(climbs)} climbs")
        if arguments.verbose:
            for (file, name), module in sorted(reached.items(), key=lambda one: (-one[1], one[0])):
                print(f"  {modules[module]:14} {name:40} {file}")
            for caller, called in sorted(climbs):
                print(f"  climb: {caller[1]} -> {called[1]} ({called[0]})")


if __name__ == "__main__":
    main()
