"""Names the types that two headers define: `check_type_names.py FILE...`

Two types of one qualified name that are linked into one program share what the compiler makes of them (the one
definition rule), whatever their members are. Types in unnamed namespaces are left out.
"""
import collections
import pathlib
import re
import sys

# Comments, texts and characters hold no code; raw texts come first.
NO_CODE = re.compile(
    r'R"(\w*)\(.*?\)\1"|//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])+\'', re.S
)
HEAD = re.compile(
    r"(?:^|[;{}>\s])(?P<kind>namespace|struct|class|union|enum(?:\s+(?:class|struct))?)\b(?P<rest>[^;{}()]*)$", re.S
)
ATTRIBUTES = re.compile(r"\[\[.*?\]\]|\balignas\s*\([^)]*\)|\bfinal\b")


def defined_types(text):
    """The qualified names of the types that a source defines, and the lines where they begin."""
    code = NO_CODE.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)
    code = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", lambda match: "\n" * match[0].count("\n"), code, flags=re.M)
    scopes, begin = [], 0  # a scope is its name, or None where its names are not seen from outside
    for brace in re.finditer(r"[{};]", code):
        if brace[0] == "{":
            head = HEAD.search(ATTRIBUTES.sub("", code[begin : brace.start()]))
            name = None
            if head:
                words = re.split(r"(?<!:):(?!:)", head["rest"])[0].split()  # without base classes
                name = "".join(words) or None
                if head["kind"] != "namespace" and name and None not in scopes and "<" not in name:
                    yield "::".join([*scopes, name]), code.count("\n", 0, brace.start()) + 1
            scopes.append(name)
        elif brace[0] == "}" and scopes:
            scopes.pop()
        begin = brace.end()


def main(files):
    places = collections.defaultdict(list)
    for path in files:
        for name, line in defined_types(path.read_text()):
            places[name].append(f"{path}:{line}")
    twice = {name: found for name, found in places.items() if len({place.rsplit(":", 1)[0] for place in found}) > 1}
    for name, found in sorted(twice.items()):
        print(f"{name} is defined in {' and '.join(found)}: rename one")
    return bool(twice)


if __name__ == "__main__":
    sys.exit(main(list(map(pathlib.Path, sys.argv[1:]))))
