#!/usr/bin/env python3
"""Checks that the app words every sentence of the library that can reach it, and that each of its rows is such a sentence.

The English sentence of a failure, warning or finding is its id, as in gettext: a row of web/src/messages/faults_*.ts
holds it with numbered places for the values, {0}, {1}, ..., and its translations. The page finds the row of a sentence
that the server sends, and the values in it.

A sentence can reach the app if its source is included by the service, directly or through others. The texts of require() name
errors of a program and stay English, except in the service. tools/english_sentences.toml lists what else stays English.
With --count the numbers of each module are printed.
"""

import pathlib
import re
import sys
import tomllib

from sentences import module, reached, sentences

# A row: "'fault.id': [" and its first column, in single or double quotes.
ROW = re.compile(r"'(fault\.\w+)': \[\s*(?:'((?:[^'\\\n]|\\.)*)'|\"((?:[^\"\\\n]|\\.)*)\")")
SERVICE = "service"
# What answers the page over HTTP, in front of the service.
SERVER = "apps/frangia/serve"
# What stays English, with the reasons: sources in the tables unseen and texts, sentences in the table single.
ENGLISH = "tools/english_sentences.toml"
THROWS = re.compile(r"Error|fail\w*|refuse\w*|warn\w*|note|reject\w*|error\w*")


def english_of(root):
    path = root / ENGLISH
    tables = tomllib.loads(path.read_text()) if path.exists() else {}
    return {name: tables.get(name, {}) for name in ("unseen", "texts", "single")}


def lists(table, file):
    """Whether a table lists a source, such as frangia/page/html_page.cpp, or the folder that it is in."""
    name = file.removeprefix("frangia/").rsplit(".", 1)[0]
    return any(name == one or name.startswith(f"{one}/") for one in table)


def seen_sentences(root, english):
    """The sentences that can reach the app, each with its source."""
    found = {}
    server = sorted((root / SERVER).glob("*.cpp"))
    for path in [*(root / "src" / file for file in reached(root, SERVICE)), *server]:
        file = str(path.relative_to(root)).removeprefix("src/")
        if lists(english["unseen"], file):
            continue
        skip = () if module(file) == SERVICE else ("require",)
        only = THROWS.fullmatch if lists(english["texts"], file) else None
        for text in sentences(path.read_text(), skip, only):
            if text not in english["single"]:
                found.setdefault(text, file)
    return found


def forms(text):
    """A sentence, and what is left of it without a value in front and a colon behind, which the page takes off."""
    yield text
    whole = text.removesuffix(": ")
    yield whole
    for lead in ("{0}: ", "{0}"):
        if whole.startswith(lead):
            yield re.sub(r"\{(\d+)\}", lambda found: "{%d}" % (int(found.group(1)) - 1), whole.removeprefix(lead))


def rows_of(root):
    rows = {}
    for path in sorted((root / "web/src/messages").glob("faults_*.ts")):
        for found in ROW.finditer(path.read_text()):
            text = found.group(2) if found.group(2) is not None else found.group(3)
            rows[found.group(1)] = re.sub(r"\\(.)", r"\1", text)
    return rows


def faults_of(root, english, seen, rows):
    everything = set()
    for path in [*(root / "src/frangia").rglob("*"), *(root / SERVER).glob("*")]:
        if path.suffix in (".h", ".cpp"):
            for text in sentences(path.read_text(), fewest_words=1):
                everything.update(forms(text))
    for name, text in rows.items():
        if text not in everything:
            yield f"{name}: no source holds the sentence '{text}'"
    for text in english["single"]:
        if text not in everything:
            yield f"{ENGLISH} lists a sentence that no source holds: '{text}'"
    if not rows:
        yield "web/src/messages holds no row of a fault"
    worded = set(rows.values())
    for text, file in seen.items():
        if worded.isdisjoint(forms(text)):
            yield f"{file}: web/src/messages has no row of '{text}'"
    every = [str(path.relative_to(root / "src")) for path in (root / "src").rglob("*.cpp")]
    every += [str(path.relative_to(root)) for path in (root / SERVER).glob("*.cpp")]
    for one in [*english["unseen"], *english["texts"]]:
        if not any(lists([one], file) for file in every):
            yield f"{ENGLISH} lists '{one}', which is no source"


def main():
    root = pathlib.Path(next((word for word in sys.argv[1:] if word != "--count"), "."))
    english = english_of(root)
    seen = seen_sentences(root, english)
    rows = rows_of(root)
    faults = list(faults_of(root, english, seen, rows))
    for fault in faults:
        print(fault)
    if "--count" in sys.argv[1:]:
        worded = set(rows.values())
        for name in sorted({module(file) for file in seen.values()}):
            texts = {text for text, file in seen.items() if module(file) == name}
            having = sum(not worded.isdisjoint(forms(text)) for text in texts)
            print(f"{name}: {having} of {len(texts)} sentences")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
