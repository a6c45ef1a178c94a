"""The modules that CMakeLists.txt states, and what each one uses."""
import re


def module_uses(root):
    """Module -> the modules whose headers it may include, both in the order of CMakeLists.txt."""
    uses = {}
    for statement in re.findall(r"^\s*frangia_module\((.*?)\)", (root / "CMakeLists.txt").read_text(), re.M | re.S):
        name, *words = statement.split()
        keyword, allowed = None, []
        for word in words:
            if word in ("USES", "LIBS", "PRIVATE_LIBS", "PRIVATE_HEADERS"):
                keyword = word
            elif keyword == "USES":
                allowed.append(word)
        uses[name] = allowed
    return uses


def with_used(modules, uses):
    """The modules, and all that they use."""
    found, left = set(), list(modules)
    while left:
        module = left.pop()
        if module not in found:
            found.add(module)
            left += uses.get(module, [])
    return found
