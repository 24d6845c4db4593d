"""Rules about classes, functions and the lengths of files."""

import collections
import fnmatch
import posixpath
import re

from limits import HEADER_FOLDERS, HEADERLESS, LIMITS
from tree import Violation, full_name, is_in, short_name

STATIC = re.compile(r"\bstatic\b")


class ClassParts:
    """A class or struct: its data members and methods as its body declares them."""

    def __init__(self, tag):
        self.tag = tag
        self.members = []
        self.methods = []

    def add(self, tag):
        if tag["kind"] == "member":
            if not STATIC.search(tag["pattern"]):
                self.members.append(tag)
        elif "access" in tag:
            self.methods.append(tag)

    def private_methods(self):
        return [method for method in self.methods if method["access"] != "public"]

    def is_record(self):
        """A struct of public fields without state to keep right: a setting, a report, a row.

        Its fields may be many. It has no private part, and no method but a few const or static helpers.
        """
        if self.tag["kind"] != "struct" or any(part["access"] != "public" for part in self.members + self.methods):
            return False
        changing = [m for m in self.methods if not m["signature"].endswith("const") and not STATIC.search(m["pattern"])]
        return not changing and len(self.methods) <= LIMITS["record_helpers"]


def classes(tree):
    found = {(tag["path"], full_name(tag)): ClassParts(tag) for tag in tree.tags_of("class", "struct")}
    for tag in tree.tags_of("member", "prototype", "function"):
        parts = found.get((tag["path"], tag.get("scope")))
        if parts:
            parts.add(tag)
    return found.values()


def class_sizes(tree):
    for parts in classes(tree):
        counts = [("private methods", "private_methods", len(parts.private_methods()))]
        if not parts.is_record():
            counts.append(("data members", "data_members", len(parts.members)))
        for words, key, count in counts:
            if count > LIMITS[key]:
                tag = parts.tag
                what = f"{tag['kind']} {short_name(full_name(tag))} has {count} {words} (limit {LIMITS[key]})"
                yield Violation(tag["path"], tag["line"], key.replace("_", "-"), what)


def class_files(tree):
    """Bodies of a class's methods stand in its header and one source."""
    declared = {full_name(tag): tag for tag in tree.tags_of("class", "struct")}
    bodies = collections.defaultdict(set)
    for tag in tree.tags_of("function"):
        if tag.get("scope") in declared:
            bodies[tag["scope"]].add(tag["path"])
    for name, paths in bodies.items():
        if len(paths) > LIMITS["class_files"]:
            tag = declared[name]
            what = f"methods of {short_name(name)} are defined in {len(paths)} files (limit {LIMITS['class_files']}): "
            yield Violation(tag["path"], tag["line"], "class-files", what + ", ".join(sorted(paths)))


def file_lines(tree):
    limit = LIMITS["file_lines"]
    for path in tree.written:
        count = len(tree.text(path).splitlines())
        if count > limit:
            yield Violation(path, 1, "file-lines", f"{count} lines (limit {limit})")


def function_lines(tree):
    limit = LIMITS["function_lines"]
    for tag in tree.tags:
        method_of_python = tag["language"] == "Python" and tag["kind"] == "member"
        if "end" not in tag or not (tag["kind"] == "function" or method_of_python):
            continue
        count = tag["end"] - tag["line"] + 1
        if count > limit:
            name = short_name(full_name(tag))
            if name.startswith("TEST"):
                name += tag["signature"]  # the macro's arguments are what tells the tests apart
            yield Violation(tag["path"], tag["line"], "function-lines", f"{name} has {count} lines (limit {limit})")


def own_header(tree):
    known = set(tree.files)
    for path in tree.code:
        stem, ending = posixpath.splitext(path)
        if ending not in (".cpp", ".c") or not is_in(path, HEADER_FOLDERS):
            continue
        if any(fnmatch.fnmatchcase(path, pattern) for pattern in HEADERLESS):
            continue
        if stem + ".hpp" not in known and stem + ".h" not in known:
            yield Violation(path, 1, "own-header", f"no {posixpath.basename(stem)}.hpp beside it")


RULES = (class_sizes, class_files, file_lines, function_lines, own_header)
