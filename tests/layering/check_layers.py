#!/usr/bin/python3
"""Proves by the #include lines that dependencies of lib/ and port/ point down only, that other
compilers than g++ and clang++ meet none of their extensions, and that files and functions stay
readable:

    check_layers.py [ROOT]

Exit status 1 and one line for each offence.
"""

import os
import re
import sys

# A folder of lib/ and what it may include besides itself and weir/. All that those may include is
# allowed too.
BELOW = {
    "base": [],
    "math": ["base"],
    "geometry": ["math"],
    "contour": ["geometry"],
    "grid": ["math"],
    "fluid": ["grid"],
    "solid": ["contour", "fluid"],
    "pressure": ["solid"],
    "step": ["pressure"],
    "world": ["step"],
}
# Headers that a freestanding compiler brings, or that need no code behind them.
STANDARD = {"cstddef", "cstdint", "cstring", "new", "type_traits", "limits", "emmintrin.h"}
PORTS_WITH_LIBC = ("port/host/",)
# What MSVC does not know, and the conditions under which it does not see it: loops in lanes, a
# kind of processor that it does not compile for, or base/compiler.hpp's own.
EXTENSION = re.compile(r"\b(__builtin_\w+|__attribute__|__asm__|asm|__restrict\w*|__typeof\w*|typeof|"
                       r"__int128|__atomic_\w+|__sync_\w+)\b")
NOT_FOR_ALL = re.compile(r"\b(WEIR_GNU_COMPILER|WEIR_HAS_\w*|WEIR_LOOPS_OF_M0|__ARM_\w+|__thumb2__|"
                         r"__SSE2__)\b")
FOR_ALL = ("lib/", "port/host/", "port/include/")
LONGEST_LINE = 100
LONGEST_FILE = 400
LONGEST_FUNCTION = 80

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def reachable(folder):
    """The folders below a folder, itself included."""
    found, todo = set(), [folder]
    while todo:
        here = todo.pop()
        if here not in found:
            found.add(here)
            todo += BELOW[here]
    return found


def sources(root, top):
    for folder, _, files in sorted(os.walk(os.path.join(root, top))):
        for name in sorted(files):
            if name.endswith((".hpp", ".cpp", ".h", ".c")):
                yield os.path.relpath(os.path.join(folder, name), root).replace(os.sep, "/")


def includes(lines):
    for number, line in enumerate(lines, 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1) == "<", match.group(2)


def check_library(path, lines, seen):
    folder = path.split("/")[1]
    public = path.startswith("lib/include/")
    for number, system, name in includes(lines):
        where = f"{path}:{number}: "
        top = name.split("/")[0]
        if system:
            if name not in STANDARD:
                yield where + f"<{name}>: the library is freestanding"
        elif public:
            if top != "weir":
                yield where + f'a public header includes "{name}", which users do not have'
        elif "/" not in name:
            yield where + f'"{name}": write folder/name'
        elif top == "weir":
            pass
        elif top not in BELOW:
            yield where + f'"{name}": the library knows no folder {top}'
        elif folder in BELOW:
            seen.setdefault(folder, set()).add(top)
            if top not in reachable(folder):
                yield where + f'"{name}": {folder} may not include {top}'
    if not public and folder not in BELOW:
        yield f"{path}: folder {folder} has no place in the order"


def check_port(path, lines):
    for number, system, name in includes(lines):
        top = name.split("/")[0]
        if system and path.startswith(PORTS_WITH_LIBC):
            continue
        if system and name not in STANDARD:
            yield f"{path}:{number}: <{name}>: only the host's port has a libc"
        if not system and top in BELOW:
            yield f'{path}:{number}: "{name}": a port includes the public headers only'


def cycles(seen):
    """Folders that reach themselves through others, whatever the table says."""
    for start in sorted(seen):
        todo, found = list(seen[start] - {start}), set()
        while todo:
            here = todo.pop()
            if here not in found:
                found.add(here)
                todo += seen.get(here, set()) - {here}
        if start in found:
            yield f"lib/{start}: part of a cycle of includes"


def function_lengths(lines):
    """Line and length of each block that is neither namespace, type nor initialiser."""
    opened = []
    in_comment = False
    for number, line in enumerate(lines, 1):
        code = re.sub(r'"(\\.|[^"\\])*"|\'(\\.|[^\'\\])\'', '""', line)
        code = re.sub(r"//.*", "", code)
        if in_comment or "/*" in code:
            in_comment = "*/" not in code
            continue
        for at, character in enumerate(code):
            if character == "{":
                before = code[:at].strip()
                outer = re.match(r'(inline |extern )?(namespace|struct|class|enum|union|extern)\b|'
                                 r'template <.*> (struct|class)|.*=\s*$', before)
                inside = any(kind == "function" for kind, _ in opened)
                kind = "outer" if outer and "(" not in before else "function"
                opened.append((kind if not inside else "inner", number))
            elif character == "}" and opened:
                kind, start = opened.pop()
                if kind == "function":
                    yield start, number - start + 1


def check_extensions(path, lines):
    """Each open #if: whether its present part is for some compilers or processors only."""
    open_parts = []
    for number, line in enumerate(lines, 1):
        directive = re.match(r"\s*#\s*(if|ifdef|ifndef|elif|else|endif)\b(.*)", line)
        if directive:
            word, condition = directive.groups()
            for following in lines[number:] if line.endswith("\\") else []:
                condition += following
                if not following.endswith("\\"):
                    break
            if word in ("elif", "else", "endif") and open_parts:
                open_parts.pop()
            if word != "endif":
                positive = re.sub(r"!\s*(defined\s*\(\s*)?\w+", "", condition)
                narrow = word != "ifndef" and NOT_FOR_ALL.search(positive) is not None
                open_parts.append(narrow)
        found = EXTENSION.search(re.sub(r'"(\\.|[^"\\])*"|//.*', "", line))
        if found and not directive and not any(open_parts):
            yield f"{path}:{number}: {found.group(0)}: MSVC does not know it (base/compiler.hpp)"


def check_size(path, lines):
    if len(lines) > LONGEST_FILE:
        yield f"{path}: {len(lines)} lines, at most {LONGEST_FILE}"
    for number, line in enumerate(lines, 1):
        if len(line) > LONGEST_LINE:
            yield f"{path}:{number}: {len(line)} columns, at most {LONGEST_LINE}"
    for start, length in function_lengths(lines):
        if length > LONGEST_FUNCTION:
            yield f"{path}:{start}: a function of {length} lines, at most {LONGEST_FUNCTION}"


def offences(root):
    seen = {}
    for top in ("lib", "port"):
        for path in sources(root, top):
            with open(os.path.join(root, path), encoding="utf-8") as file:
                lines = file.read().splitlines()
            yield from check_size(path, lines)
            if path.startswith(FOR_ALL):
                yield from check_extensions(path, lines)
            yield from check_library(path, lines, seen) if top == "lib" else check_port(path, lines)
    yield from cycles(seen)
    if not seen:
        yield f"{root}: no library found"


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    root = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "..", "..")
    found = list(offences(root))
    for line in found:
        print(line)
    print(f"check_layers: {len(found)} offences")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
