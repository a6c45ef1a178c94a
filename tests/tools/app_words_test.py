"""The message catalogues of the app: every text in every language, with the same values, and without paths or backticks."""

import re
import sys
import unittest
from pathlib import Path

WEB = Path(sys.argv.pop()) / "web" / "src"
LANGUAGES = 3
# Rows of sentences of the library, which tools/check_faults.py compares with the sources: the first column is the sentence
# as it is, the others may leave values out.
FAULT = "fault."
ROW = re.compile(r"^  (?:'([^']+)'|(\w+)): \[(.*?)\],$", re.M | re.S)
TEXT = re.compile(r"'((?:[^'\\]|\\.)*)'|\"((?:[^\"\\]|\\.)*)\"")
PATH = re.compile(r"(?<![\w ])/\w|\bdocs/|\w/\w+\.\w+")


def rows():
    found = {}
    for file in sorted([*(WEB / "messages").glob("*.ts"), *WEB.glob("steps/*/words.ts")]):
        for quoted, plain, body in ROW.findall(file.read_text()):
            texts = ["".join(one) for one in TEXT.findall(body)]
            found.setdefault(quoted or plain, []).append(texts)
    return found


class AppWords(unittest.TestCase):
    def test_every_text_is_there_in_every_language(self):
        self.assertGreater(len(rows()), 500)
        for name, variants in rows().items():
            self.assertEqual(len(variants), 1, f"{name} is defined twice")
            self.assertEqual(len(variants[0]), LANGUAGES, name)
            self.assertTrue(all(text.strip() for text in variants[0]), name)

    def test_every_language_says_the_same_values(self):
        for name, (texts,) in rows().items():
            values = [sorted(re.findall(r"\{(\w+)\}", text)) for text in texts]
            for other in values[1:]:
                if name.startswith(FAULT):
                    self.assertLessEqual(set(other), set(values[0]), name)
                else:
                    self.assertEqual(other, values[0], name)

    def test_no_text_has_a_backtick_or_a_path(self):
        for name, (texts,) in rows().items():
            for text in texts[1:] if name.startswith(FAULT) else texts:
                self.assertNotIn("`", text, name)
                self.assertNotRegex(text, PATH, name)

    def test_every_text_is_used(self):
        code = "".join(
            file.read_text() for file in WEB.rglob("*.ts") if file.parent.name != "messages" and file.name != "words.ts"
        )
        made = re.findall(r"`(\w+\.[\w.]*)\$\{", code)  # `job.${kind}`
        unused = [
            name
            for name in rows()
            if not name.startswith(FAULT)
            and f"'{name.removesuffix('One')}'" not in code
            and not any(name.startswith(one) for one in made)
        ]
        self.assertEqual(unused, [])


unittest.main()
