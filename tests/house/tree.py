"""The files below a root that the house rules look at, and what Universal Ctags finds in them."""

import collections
import functools
import json
import os
import pathlib
import posixpath
import re
import subprocess
import tempfile

from limits import FOLDERS, SKIPPED

CODE = (".cpp", ".hpp", ".h", ".c")
SCRIPTS = (".sh", ".py")
CTAGS = ["ctags", "--options=NONE", "--output-format=json", "--fields=+naeKSstl", "--kinds-C++=+p",
         "--pattern-length-limit=0", "-L", "-", "-o", "-"]
ALIGNAS = re.compile(r"\balignas\([^()]*\)")  # Ctags passes over members behind it
NAMELESS = "__anon"  # what Ctags begins the names of nameless namespaces, structs and lambdas with
INCLUDE = re.compile(r'\s*#\s*include\s*"([^"]+)"')

# In `path:line: rule: what`.
Violation = collections.namedtuple("Violation", "path line rule what")
Include = collections.namedtuple("Include", "path line target")


class TreeError(Exception):
    """The tree cannot be read; the message says what to do."""


def is_cmake(path):
    return posixpath.basename(path) == "CMakeLists.txt" or path.endswith(".cmake")


def is_in(path, folders):
    return path.startswith(tuple(folder + "/" for folder in folders))


def walked_files(root):
    for folder, folders, names in os.walk(root):
        folders[:] = [name for name in folders if name != "__pycache__"]
        for name in names:
            yield pathlib.Path(folder, name).relative_to(root).as_posix()


def git_files(root):
    command = ["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    listed = subprocess.run(command, capture_output=True, text=True)
    if listed.returncode != 0:
        raise TreeError(f"git cannot list the files of {root}: {listed.stderr.strip()}")
    return [path for path in listed.stdout.split("\0") if path and (root / path).is_file()]


class Tree:
    """The files that git knows below the root, or all files where the root is no work tree of git."""

    def __init__(self, root):
        self.root = pathlib.Path(root)
        found = git_files(self.root) if (self.root / ".git").exists() else walked_files(self.root)
        wanted = (p for p in set(found) if is_in(p, FOLDERS) and not p.startswith(SKIPPED) or p == "CMakeLists.txt")
        self.files = sorted(wanted)
        if not self.files:
            raise TreeError(f"there are no files of the house in {root}")
        self.code = [path for path in self.files if path.endswith(CODE)]
        self.cmake = [path for path in self.files if is_cmake(path)]
        self.written = [path for path in self.files if path.endswith(CODE + SCRIPTS) or is_cmake(path)]

    @functools.lru_cache(maxsize=None)
    def text(self, path):
        return (self.root / path).read_text(encoding="utf-8", errors="replace")

    @functools.cached_property
    def includes(self):
        """The includes in quotes that name files of this tree."""
        known, found = set(self.files), []
        for path in self.code:
            for number, line in enumerate(self.text(path).splitlines(), 1):
                match = INCLUDE.match(line)
                if not match:
                    continue
                beside = posixpath.normpath(posixpath.join(posixpath.dirname(path), match[1]))
                target = next((name for name in (match[1], beside) if name in known), None)
                if target:
                    found.append(Include(path, number, target))
        return found

    @functools.cached_property
    def tags(self):
        paths = [path for path in self.files if path.endswith(CODE + (".py",))]
        if not paths:
            return []
        try:
            with tempfile.TemporaryDirectory() as copies:
                self.copy_without_alignas(paths, pathlib.Path(copies))
                run = subprocess.run(CTAGS, cwd=copies, input="\n".join(paths), capture_output=True, text=True)
        except FileNotFoundError as missing:
            raise TreeError("ctags is missing: apt-get install universal-ctags") from missing
        if run.returncode != 0:
            raise TreeError(f"Universal Ctags with JSON is needed: apt-get install universal-ctags\n{run.stderr}")
        tags = (tag for tag in map(json.loads, run.stdout.splitlines()) if tag.get("_type") == "tag")
        return [tag for tag in tags if tag["kind"] != "function" or not tag["name"].startswith(NAMELESS)]

    def copy_without_alignas(self, paths, folder):
        for path in paths:
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_text(ALIGNAS.sub("", self.text(path)), encoding="utf-8")

    def tags_of(self, *kinds):
        """The tags of these kinds in C++ and C."""
        return [tag for tag in self.tags if tag["kind"] in kinds and tag["language"] in ("C++", "C")]


def full_name(tag):
    return f"{tag['scope']}::{tag['name']}" if "scope" in tag else tag["name"]


def short_name(name):
    """Without the namespace of the house and the names that Ctags gives to nameless ones."""
    return "::".join(part for part in name.split("::") if part != "bladefit" and not part.startswith(NAMELESS))
