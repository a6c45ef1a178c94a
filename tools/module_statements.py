"""Reads the statements of the modules in CMakeLists.txt."""
import dataclasses
import pathlib
import re


@dataclasses.dataclass
class ModuleStatement:
    name: str
    uses: list[str]  # the modules whose headers it may include


KEYWORDS = ("USES", "LIBS", "PRIVATE_LIBS", "PRIVATE_HEADERS")


def module_statements(cmake_lists: pathlib.Path) -> list[ModuleStatement]:
    """The `frangia_module(NAME USES ...)` of a CMakeLists.txt, in their order: that of the path of light."""
    statements = []
    for text in re.findall(r"^\s*frangia_module\((.*?)\)", cmake_lists.read_text(), re.M | re.S):
        name, *words = text.split()
        keyword, uses = None, []
        for word in words:
            if word in KEYWORDS:
                keyword = word
            elif keyword == "USES":
                uses.append(word)
        statements.append(ModuleStatement(name, uses))
    return statements
