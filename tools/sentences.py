"""The sentences in the C++ sources of the library, and the sources that the app reaches.

A sentence is a string literal with what it is joined to by + and what fmt::format fills in; each value is a numbered
place, {0}, {1}, .... Literals within an argument, such as those of a choice `a ? "..." : "..."`, are sentences of their own.
"""

import functools
import pathlib
import re

TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)|(?P<raw>R"(?P<end>\w*)\(.*?\)(?P=end)")|(?P<text>"(?:[^"\\\n]|\\.)*")"""
    r"""|(?P<letter>'(?:[^'\\\n]|\\.)+')|(?P<word>\w+(?:::\w+)*)|(?P<sign>->|::|==|!=|<=|>=|&&|\|\||\S)|\s+""",
    re.S,
)
PLACE = re.compile(r"\{[^{}]*\}")
VALUE = "\0"
# What stands before an expression, and is none.
NO_VALUE = {"return", "throw", "case", "else", "const", "auto"}
# Fewer words than these are a name or a value, not a sentence.
FEWEST_WORDS = 3
INCLUDE = re.compile(r'#include "(frangia/[^"]+)"')


def unescaped(text):
    return re.sub(r"\\(.)", lambda found: {"n": "\n", "t": "\t"}.get(found.group(1), found.group(1)), text)


def numbered(text):
    """Places for values as {0}, {1}, ... in their order."""
    count = iter(range(100))
    return re.sub(VALUE, lambda _: "{%d}" % next(count), text)


def placed(text):
    """A format string with a mark for each value, and its doubled braces as single ones."""
    text = PLACE.sub(VALUE, text.replace("{{", "\1").replace("}}", "\2"))
    return text.replace("\1", "{").replace("\2", "}")


@functools.cache
def tokens_of(source):
    """(kind, text, end) of each token, literals in a row joined; a literal's text is what it stands for.

    `end` is the index of the bracket that closes one, or of the last token where none does.
    """
    tokens = []
    open_brackets = []
    for found in TOKEN.finditer(source):
        if found["text"] is not None:
            body = unescaped(found["text"][1:-1])
            if tokens and tokens[-1][0] == "text":
                tokens[-1] = ("text", tokens[-1][1] + body, 0)
            else:
                tokens.append(("text", body, 0))
        elif found["comment"] is None and not found.group().isspace():
            kind = "word" if found["word"] else "letter" if found["letter"] else "raw" if found["raw"] else "sign"
            text = found.group()
            if text in ("(", "[", "{"):
                open_brackets.append(len(tokens))
            elif text in (")", "]", "}") and open_brackets:
                opening = open_brackets.pop()
                tokens[opening] = ("sign", tokens[opening][1], len(tokens))
            tokens.append((kind, text, 0))
    for opening in open_brackets:
        tokens[opening] = ("sign", tokens[opening][1], len(tokens) - 1)
    return tokens


def is_sign(tokens, i, signs):
    return i < len(tokens) and tokens[i][0] == "sign" and tokens[i][1] in signs


def closing(tokens, i):
    """The index of the bracket that closes the one at `i`."""
    return tokens[i][2]


def term(tokens, i):
    """The text of the operand that begins at `i`, and the index behind it; None where none begins."""
    if i >= len(tokens):
        return None
    kind, text, _ = tokens[i]
    if kind == "text":
        return text, i + 1
    if kind == "letter":
        return unescaped(text[1:-1]), i + 1
    if kind == "sign" and text == "*":
        return term(tokens, i + 1)
    if kind == "sign" and text == "(":
        return VALUE, closing(tokens, i) + 1
    if kind != "word" or text in NO_VALUE:
        return None
    held = i + 2 < len(tokens) and is_sign(tokens, i + 1, "({") and tokens[i + 2][0] == "text"
    if text == "fmt::format" and held:
        return placed(tokens[i + 2][1]), closing(tokens, i + 1) + 1
    if text == "std::string" and held and closing(tokens, i + 1) == i + 3:
        return tokens[i + 2][1], i + 4
    end = i + 1
    while end < len(tokens) and tokens[end][0] == "sign":
        if tokens[end][1] in ("(", "["):
            end = closing(tokens, end) + 1
        elif tokens[end][1] in (".", "->", "::") and end + 1 < len(tokens) and tokens[end + 1][0] == "word":
            end += 2
        else:
            break
    return VALUE, end


def within(tokens, begin, end):
    """The range of tokens between the first brackets of an operand, without the literal that it formats."""
    for k in range(begin, end):
        if is_sign(tokens, k, "([{"):
            named = tokens[begin][1] if k == begin + 1 else ""
            first = k + 2 if named in ("fmt::format", "std::string") and tokens[k + 1][0] == "text" else k + 1
            return first, closing(tokens, k)
    return end, end


def texts_between(tokens, begin, end, skip, only=None):
    """The texts of all operands in a range of tokens; with `only`, of those within calls of functions of these names."""
    i = begin
    while i < end:
        if tokens[i][0] == "word" and tokens[i][1] in skip and is_sign(tokens, i + 1, "("):
            i = closing(tokens, i + 1) + 1
            continue
        if only is not None:
            if tokens[i][0] == "word" and is_sign(tokens, i + 1, "(") and only(tokens[i][1].split("::")[-1]):
                behind = closing(tokens, i + 1)
                yield from texts_between(tokens, i + 2, behind, skip)
                i = behind
            i += 1
            continue
        found = term(tokens, i)
        if found is None:
            i += 1
            continue
        text, behind = found
        operands = [(i, behind)]
        while is_sign(tokens, behind, "+") and (more := term(tokens, behind + 1)):
            operands.append((behind + 1, more[1]))
            text += more[0]
            behind = more[1]
        if text.strip(VALUE):
            yield text
        for operand in operands:
            yield from texts_between(tokens, *within(tokens, *operand), skip)
        i = max(behind, i + 1)


def is_sentence(text, fewest_words):
    words = re.findall(r"[A-Za-z]{2,}", re.sub(r"\{\d+\}", "", text))
    return (
        len(words) >= fewest_words
        and (" " in text.strip() or fewest_words == 1)
        and "\n" not in text
        and not text.startswith("frangia/")
    )


def sentences(source, skip=(), only=None, fewest_words=FEWEST_WORDS):
    """The sentences of a source in their order; those in calls of the functions `skip` are left out.

    `only` is a test of names: the sentences are then those in calls of such functions alone.
    """
    tokens = tokens_of(source)
    found = dict.fromkeys(numbered(text) for text in texts_between(tokens, 0, len(tokens), set(skip), only))
    return [text for text in found if is_sentence(text, fewest_words)]


def module(file):
    return file.split("/")[1]


def stem(file):
    """The module and the name of a file without its ending, which a header and its source share."""
    return module(file), pathlib.Path(file).stem


def reached(root, entry):
    """The sources and headers that those of the module `entry` include, directly or through others.

    A header brings the source of its name; a source without a header of its name comes with any header of its module that
    it includes, since one of them declares what it defines.
    """
    top = pathlib.Path(root) / "src"
    files = {
        str(path.relative_to(top)): INCLUDE.findall(path.read_text())
        for path in sorted(top.rglob("*"))
        if path.suffix in (".h", ".cpp")
    }
    sources = [file for file in files if file.endswith(".cpp")]
    headers = {stem(file) for file in files if file.endswith(".h")}
    brings = {}
    for file in sources:
        brings.setdefault(stem(file), []).append(file)
        if stem(file) not in headers:
            for header in files[file]:
                if module(header) == module(file):
                    brings.setdefault(header, []).append(file)
    seen = {file for file in files if file.startswith(f"frangia/{entry}/")}
    waiting = list(seen)
    while waiting:
        file = waiting.pop()
        own = brings.get(stem(file), []) + brings.get(file, []) if file.endswith(".h") else []
        for other in [*files[file], *own]:
            if other in files and other not in seen:
                seen.add(other)
                waiting.append(other)
    return sorted(seen)
