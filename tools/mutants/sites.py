"""Where a C++ source can be changed by one operator or constant, and into what. It reads tokens, not the grammar; what
does not compile is left to the compiler."""
import dataclasses
import re

# Comments, literals and directives. Numbers are tokens of their own: the quotes in 1'000 begin no character.
TOKEN = re.compile(
    r"""(?P<number>(?<![\w.])(?:0[xX][\da-fA-F']+|\d[\d']*(?:\.\d*)?(?:[eE][+-]?\d+)?)[a-zA-Z]*)
    |(?P<comment>//[^\n]*|/\*.*?\*/|^[ \t]*\#(?:\\\n|[^\n])*)
    |(?P<text>R"(?P<mark>\w*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+')""",
    re.S | re.M | re.X,
)
HIDDEN = "\x01"  # what must not be changed, one for each character of it

# Their arguments decide nothing that a result shows: capacities, progress.
CALLS = re.compile(r"\b(?:static_assert|assert|reserve|report|stage|note|warn)\(")
# How the work is divided, which changes no result.
CHUNKS = re.compile(
    r"""\bconstexpr\ [^;=]*\bk\w*Chunk\w*\ =[^;]*;
    |\+\ (?:k\w*Chunk\w*|chunk)\ -\ 1\)\ /\ (?:k\w*Chunk\w*|chunk)\b
    |\b\w+_chunks\([^;,]*,\ \d[\d']*""",
    re.X,
)
DECLARATIONS = re.compile(r"^[ \t]*(?:using|typedef|template|namespace|struct|class|friend)\b[^\n]*", re.M)
TEMPLATE_ARGUMENTS = re.compile(r"(?<=\w)<[^<>;(){}]*>")

# A comparison is reversed: the bound alone, as in < and <=, tells nothing between numbers that are measured.
OTHER = {
    "+": "-",
    "-": "+",
    "*": "/",
    "/": "*",
    "%": "*",
    "<": ">",
    ">": "<",
    "<=": ">=",
    ">=": "<=",
    "==": "!=",
    "!=": "==",
    "&&": "||",
    "||": "&&",
    "+=": "-=",
    "-=": "+=",
    "*=": "/=",
    "/=": "*=",
}
# clang-format writes a blank on both sides of binary operators, and on neither side of the marks of types.
BINARY = re.compile(
    r"(?<=[\w)\]}\x01]) (" + "|".join(map(re.escape, sorted(OTHER, key=len, reverse=True))) + r")(?=\s)"
)
UNARY = re.compile(r"(?<=[(\[{ ])(?:!(?=[\w(])|(?<![\w)\]}] )-(?=[\w(])|(?<=return )-(?=[\w(]))")
WORD = re.compile(r"\b(?:true|false)\b")
SMALLEST = 1e-6  # constants below it keep a divisor from zero


@dataclasses.dataclass(frozen=True)
class Site:
    """A place in a source, and the texts that can stand there instead."""

    path: str
    start: int
    end: int
    choices: tuple


def hide(text, begin, end):
    hidden = "".join("\n" if mark == "\n" else HIDDEN for mark in text[begin:end])
    return text[:begin] + hidden + text[end:]


def end_of_group(text, begin):
    """Where the parentheses or braces close in which `begin` is."""
    depth = 0
    for position in range(begin, len(text)):
        depth += (text[position] in "([{") - (text[position] in ")]}")
        if depth < 0:
            return position
    return len(text)


def changeable(text):
    """The text of a source with all hidden that must not be changed, at the same places."""
    literals = []
    for token in TOKEN.finditer(text):
        if not token["number"]:
            text = hide(text, *token.span())
            if token["text"]:
                literals.append(token)
    for token in literals:  # the arguments after the text of a message
        text = hide(text, token.end(), end_of_group(text, token.end()))
    for call in CALLS.finditer(text):
        text = hide(text, call.end(), end_of_group(text, call.end()))
    for pattern in (DECLARATIONS, CHUNKS):
        for unchanged in pattern.finditer(text):
            text = hide(text, *unchanged.span())
    while found := TEMPLATE_ARGUMENTS.search(text):
        text = hide(text, *found.span())
    return text


def other_constants(number):
    """An integer becomes one more or less; a fraction zero or ten times itself."""
    digits, suffix = re.fullmatch(r"(0[xX][\da-fA-F']+|[\d'.eE+-]+)(\w*)", number).groups()
    digits = digits.replace("'", "")
    if re.fullmatch(r"0[xX].*|\d+", digits):
        value = int(digits, 0 if digits[:2] in ("0x", "0X") else 10)
        return tuple(f"{other}{suffix}" for other in (value + 1, value - 1) if other >= 0)
    value = float(digits)
    if value == 0.0:
        return (f"1.0{suffix}",)
    return () if value < SMALLEST else (f"0.0{suffix}", f"{value * 10!r}{suffix}")


def sites(path, text):
    """All places of a source, in their order."""
    visible = changeable(text)
    found = [Site(path, *operator.span(1), (OTHER[operator[1]],)) for operator in BINARY.finditer(visible)]
    found += [Site(path, *operator.span(), ("",)) for operator in UNARY.finditer(visible)]
    found += [
        Site(path, *word.span(), ({"true": "false", "false": "true"}[word[0]],)) for word in WORD.finditer(visible)
    ]
    for token in TOKEN.finditer(visible):
        if token["number"]:
            found.append(Site(path, *token.span(), other_constants(token[0])))
    return sorted((site for site in found if site.choices), key=lambda site: site.start)
