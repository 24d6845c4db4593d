#!/usr/bin/env python3
"""Counts what the house rules limit, and prints a line for each violation: path:line: rule: what is wrong.

private-methods, data-members  a class is small; a record, a struct of public fields, may have any number of them
class-files                    the methods of a class are defined in its header and one source
own-header                     a source has a header of its own name beside it
file-lines, function-lines     files and functions are short
layers                         which top folder may include which
folder-circle                  folders do not include each other in a circle
loose-file                     nothing lies in tools/ itself but main.cpp, scripts and what describes the folder
enum-words                     the words of an enumeration stand in one table
cmake-filter, cmake-glob       CMake collects the sources of its own folder, without regular expressions

The figures and exemptions stand in limits.py. The files are those that git knows, or all where the root has no .git.
Exit code: 0 nothing found, 1 violations, 2 the tree could not be read.
"""

import argparse
import pathlib
import sys

sys.dont_write_bytecode = True  # the folder of the sources stays clean

import code_rules
import folder_rules
import word_rules
from tree import Tree, TreeError

RULES = code_rules.RULES + folder_rules.RULES + word_rules.RULES
REPOSITORY = pathlib.Path(__file__).resolve().parents[2]


def violations(tree):
    return sorted(violation for rule in RULES for violation in rule(tree))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", metavar="DIR", type=pathlib.Path, default=REPOSITORY, help="the tree to look at")
    root = parser.parse_args().root
    try:
        tree = Tree(root)
        found = violations(tree)
    except TreeError as error:
        print(f"house rules: {error}", file=sys.stderr)
        return 2
    for path, line, rule, what in found:
        print(f"{path}:{line}: {rule}: {what}")
    print(f"house rules: {len(tree.files)} files, {len(found)} violations")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
