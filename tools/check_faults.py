#!/usr/bin/env python3
"""Checks that every sentence that the app translates is one of the library.

The English sentence of a failure or warning is its id, as in gettext: a row of web/src/messages/faults_*.ts holds it with
numbered places for the values, {0}, {1}, ..., and its translations. The page finds the row of a sentence that
the server sends, and the values in it. A sentence that is changed in a source would no longer be found: this check fails
then. It prints how many of the sentences of each module have a row.
"""
import pathlib
import re
import sys

LITERALS = re.compile(r'(?:"(?:[^"\\\n]|\\.)*"\s*)+')
ONE = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
PLACE = re.compile(r"\{[^{}]*\}")
# A row: "'fault.id': [" and its first column, in single or double quotes.
ROW = re.compile(r"'(fault\.\w+)': \[\s*(?:'((?:[^'\\\n]|\\.)*)'|\"((?:[^\"\\\n]|\\.)*)\")")
# A sentence in the source of a module: what has a blank and is passed to an error or a warning.
SENTENCE = re.compile(r"(?:Error\(|require\(|warn\(|fail\w*\(|refuse\w*\()[^;]*?((?:\"(?:[^\"\\\n]|\\.)*\"\s*)+)")
MODULES = ("calibrate", "acquisition", "devices", "service", "reconstruct", "registration", "decode", "fusion")


def unescaped(text):
    return re.sub(r"\\(.)", r"\1", text)


def numbered(text):
    """Places for values as {0}, {1}, ... in their order."""
    count = iter(range(100))
    return PLACE.sub(lambda _: "{%d}" % next(count), text)


def joined(literals):
    return numbered(unescaped("".join(ONE.findall(literals))))


def sources(root, module="**"):
    for path in sorted((root / "src/frangia").glob(f"{module}/**/*.cpp")):
        yield re.sub(r"//[^\n]*", "", path.read_text())


def main():
    root = pathlib.Path(next((word for word in sys.argv[1:] if word != "--count"), "."))
    known = {joined(found.group()) for text in sources(root) for found in LITERALS.finditer(text)}
    rows = {}
    for path in sorted((root / "web/src/messages").glob("faults_*.ts")):
        for found in ROW.finditer(path.read_text()):
            rows[found.group(1)] = unescaped(found.group(2) if found.group(2) is not None else found.group(3))
    faults = [f"{name}: no source holds the sentence '{text}'" for name, text in rows.items() if text not in known]
    if not rows:
        faults.append("web/src/messages holds no row of a fault")
    for fault in faults:
        print(fault)
    if "--count" in sys.argv[1:]:
        translated = set(rows.values())
        for module in MODULES:
            texts = {joined(found.group(1)) for text in sources(root, module) for found in SENTENCE.finditer(text)}
            texts = {text for text in texts if text.count(" ") >= 3}
            print(f"{module}: {len(texts & translated)} of {len(texts)} sentences")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
