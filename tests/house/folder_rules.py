"""Rules about folders: layers, circles of includes, loose files, and what CMake collects."""

import collections
import fnmatch
import posixpath
import re

from limits import FACES, LAYERS, LOOSE_IN_TOOLS, PRODUCT
from tree import Violation, is_in

SHOWN = 3  # includes that are listed for an arrow of a circle
CMAKE_COMMENT = re.compile(r"#[^\n]*")
FILTER = re.compile(r"\blist\s*\(\s*FILTER\b[^)]*?\bREGEX\b", re.IGNORECASE)
GLOB = re.compile(r"\bfile\s*\(\s*GLOB(?:_RECURSE)?\s+\S+([^)]*)\)", re.IGNORECASE)
OWN_FOLDER = re.compile(r"^\$\{CMAKE_CURRENT_(?:SOURCE|LIST)_DIR\}")


def layer_of(path):
    return max((layer for layer in LAYERS if is_in(path, [layer])), key=len)


def layers(tree):
    for include in tree.includes:
        layer, target = layer_of(include.path), layer_of(include.target)
        if target != layer and target not in LAYERS[layer] and include.target not in LAYERS[layer]:
            allowed = ", ".join((layer, *LAYERS[layer]))
            what = f"{layer} includes {include.target} (allowed: {allowed})"
            yield Violation(include.path, include.line, "layers", what)


def node_of(path):
    folder = posixpath.dirname(path)
    return path if folder in FACES else folder


def arrows_between_folders(tree):
    arrows = collections.defaultdict(lambda: collections.defaultdict(list))
    for include in tree.includes:
        source, target = node_of(include.path), node_of(include.target)
        if source != target and is_in(include.path, PRODUCT) and is_in(include.target, PRODUCT):
            arrows[source][target].append(include)
    return {source: dict(targets) for source, targets in arrows.items()}


def circle_through(arrows, start):
    """The nodes of a shortest circle through the start; nothing where there is none."""
    before, waiting = {}, collections.deque([start])
    while waiting:
        node = waiting.popleft()
        for target in sorted(arrows.get(node, ())):
            if target == start:
                path = [node]
                while path[-1] != start:
                    path.append(before[path[-1]])
                return path[::-1]
            if target not in before:
                before[target] = node
                waiting.append(target)
    return None


def shown(includes):
    places = [f"{include.path}:{include.line}" for include in includes[:SHOWN]]
    more = [f"{len(includes) - SHOWN} more"] if len(includes) > SHOWN else []
    return ", ".join(places + more)


def folder_circles(tree):
    """One shortest circle after the other; each is taken as broken at its arrow of fewest includes before the next."""
    arrows = arrows_between_folders(tree)
    while circles := [circle for node in sorted(arrows) if (circle := circle_through(arrows, node))]:
        circle = min(circles, key=len)
        steps = list(zip(circle, circle[1:] + circle[:1]))
        what = circle[0] + "".join(f" -> {target} ({shown(arrows[source][target])})" for source, target in steps)
        source, target = min(steps, key=lambda step: len(arrows[step[0]][step[1]]))
        first = arrows[source].pop(target)[0]
        yield Violation(first.path, first.line, "folder-circle", what)


def loose_files(tree):
    for path in tree.files:
        folder, name = posixpath.split(path)
        if folder == "tools" and not any(fnmatch.fnmatchcase(name, pattern) for pattern in LOOSE_IN_TOOLS):
            yield Violation(path, 1, "loose-file", f"lies in tools itself (allowed: {', '.join(LOOSE_IN_TOOLS)})")


def reaches_outside(pattern):
    pattern = OWN_FOLDER.sub(".", pattern.strip('"'))
    return pattern.startswith(("/", "${")) or ".." in pattern.split("/")


def cmake_globs(tree):
    for path in tree.cmake:
        text = CMAKE_COMMENT.sub("", tree.text(path))
        for match in FILTER.finditer(text):
            line = text.count("\n", 0, match.start()) + 1
            yield Violation(path, line, "cmake-filter", "list(FILTER ... REGEX) says what folders should say")
        for match in GLOB.finditer(text):
            line = text.count("\n", 0, match.start()) + 1
            for pattern in filter(reaches_outside, match[1].split()):
                yield Violation(path, line, "cmake-glob", f"{pattern} reaches outside its own folder")


RULES = (layers, folder_circles, loose_files, cmake_globs)
