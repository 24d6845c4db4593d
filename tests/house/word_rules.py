"""The words of an enumeration stand in one table.

A file spells an enum class where it has string literals for half of its enumerators, and for two at least.
A literal counts where the whole of it is the name, with '-' or ' ' for '_' too: help texts and messages are longer.
Comments are passed over.
"""

import fnmatch
import re

from limits import LIMITS, OTHER_VOCABULARIES, PRODUCT
from tree import Violation, full_name, is_in, short_name

ENUM_CLASS = re.compile(r"\benum\s+(?:class|struct)\b")
# Comments, raw strings, strings, characters: what comes first is taken whole. Group 2 is the text of a plain string.
TOKEN = re.compile(
    r"""//[^\n]*|/\*.*?\*/|R"([^(\s]*)\(.*?\)\1"|"((?:\\.|[^"\\\n])*)"|'(?:\\[^']*|[^'\\])'""", re.DOTALL)


def literals(text):
    """The lines of the first places of the string literals, by their text as a name."""
    found = {}
    for match in TOKEN.finditer(text):
        if match[2] is not None:
            found.setdefault(re.sub("[- ]", "_", match[2]), text.count("\n", 0, match.start()) + 1)
    return found


def enumerations(tree):
    """The enum classes of the product, each as its tag and the set of its enumerators."""
    found = {}
    for tag in tree.tags_of("enum"):
        if is_in(tag["path"], PRODUCT) and ENUM_CLASS.search(tag["pattern"]):
            found[tag["path"], full_name(tag)] = (tag, set())
    for tag in tree.tags_of("enumerator"):
        if (tag["path"], tag.get("scope")) in found:
            found[tag["path"], tag["scope"]][1].add(tag["name"])
    return found.values()


def has_other_words(name, path):
    return any(fnmatch.fnmatchcase(name, enum) and fnmatch.fnmatchcase(path, file) for enum, file in OTHER_VOCABULARIES)


def enum_words(tree):
    limit = LIMITS["word_tables"]
    spelt = {path: literals(tree.text(path)) for path in tree.code if is_in(path, PRODUCT)}
    for tag, names in enumerations(tree):
        places = []
        for path, words in spelt.items():
            lines = sorted(words[name] for name in names if name in words)
            if len(lines) >= max(2, len(names) / 2) and not has_other_words(tag["name"], path):
                places.append(f"{path}:{lines[len(lines) // 2]}")
        if len(places) > limit:
            what = f"the words of {short_name(full_name(tag))} stand in {len(places)} files (limit {limit}): "
            yield Violation(tag["path"], tag["line"], "enum-words", what + ", ".join(places))


RULES = (enum_words,)
