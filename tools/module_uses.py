"""Reads which modules each module may include, from the statements frangia_module(NAME ... USES ...) of CMakeLists.txt."""
import re


def module_uses(root):
    """Module -> the modules that it states after USES; both in the order of CMakeLists.txt. `root` is a pathlib.Path."""
    uses = {}
    for statement in re.findall(r"^\s*frangia_module\((.*?)\)", (root / "CMakeLists.txt").read_text(), re.M | re.S):
        name, *words = statement.split()
        keyword, uses[name] = None, []
        for word in words:
            if word in ("USES", "LIBS", "PRIVATE_LIBS", "PRIVATE_HEADERS"):
                keyword = word
            elif keyword == "USES":
                uses[name].append(word)
    return uses
