#!/usr/bin/env python3
"""Looks at what the program builds on: may each be used, and is each there once?

Crates are those that are built on any platform, as `cargo tree` tells them, of every Cargo.lock in the
repository but those of what only measures or fuzzes; packages of npm are those of every
package-lock.json. Says what is wrong and ends with 1, or says nothing.
"""

import json
import re
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# Licences that ask for no more than that they are passed on with the program.
ALLOWED = {
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "MIT",
    "MIT-0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
}

# Crates that are there in several versions, each with the reason.
TWICE = {
    "miniz_oxide": "png and flate2, of pictures in pixels, have not agreed yet",
    "shlex": "trycmd and cc, tests and builds alone, have not agreed yet",
    "syn": "half of the derive macros have gone on to 3; nothing of it is in the program",
}


def allows(expression, allowed=ALLOWED):
    """Whether an SPDX expression leaves a choice that is allowed.

    >>> allows("MIT"), allows("GPL-3.0"), allows(""), allows(None)
    (True, False, False, False)
    >>> allows("GPL-3.0 OR MIT"), allows("GPL-3.0 AND MIT"), allows("Unlicense/MIT")
    (True, False, True)
    >>> allows("(MIT OR Apache-2.0) AND Unicode-3.0"), allows("(MIT OR GPL-3.0) AND GPL-3.0")
    (True, False)
    >>> allows("MIT AND (GPL-3.0 OR Zlib)"), allows("MIT OR GPL-3.0 AND AGPL-3.0")
    (True, True)
    >>> allows("Apache-2.0 WITH LLVM-exception"), allows("MIT WITH something")
    (True, False)
    >>> allows("MIT MIT"), allows("(MIT"), allows("MIT OR"), allows("SEE LICENSE IN x")
    (False, False, False, False)
    """
    words = re.findall(r"[()]|[^\s()/]+|/", expression or "")
    # AND binds closer than OR; an old way to write OR is a slash.
    either = {"OR", "/"}

    def any_of():
        found = all_of()
        while words and words[0] in either:
            words.pop(0)
            found = all_of() or found
        return found

    def all_of():
        found = one()
        while words and words[0] == "AND":
            words.pop(0)
            found = one() and found
        return found

    def one():
        word = words.pop(0)
        if word == "(":
            found = any_of()
            if words.pop(0) != ")":
                raise ValueError
            return found
        if words and words[0] == "WITH":
            word = f"{word} {words.pop(0)} {words.pop(0)}"
        return word in allowed

    try:
        found = any_of()
    except (IndexError, ValueError):
        return False
    return found and not words


# What is built by who measures or fuzzes, and handed to nobody.
OURS_ALONE = ("benches/", "fuzz/")


def crates(folder=ROOT):
    """The crates that what lies in a folder, its tests and its benches build on, on any platform."""
    # `cargo metadata` lists what Cargo.lock names for features that nobody asks for as well.
    command = ["cargo", "tree", "--locked", "--all-features", "--target", "all", "--edges"]
    command += ["normal,build,dev", "--prefix", "none", "--no-dedupe", "--format", "{p}\t{l}"]
    listed = subprocess.run(command, cwd=folder, check=True, stdout=subprocess.PIPE).stdout
    return crates_of(listed.decode())


def crates_of(listed):
    """The crates that `cargo tree` lists, without those that lie in the repository.

    >>> crates_of("own v0.1.0 (/home/own)\\tMIT\\nb v1.0.0 (proc-macro)\\tMIT OR Zlib\\na v2.0.0\\t\\n")
    [{'name': 'a', 'version': '2.0.0', 'license': ''}, {'name': 'b', 'version': '1.0.0', 'license': 'MIT OR Zlib'}]
    """
    found = set()
    for line in listed.splitlines():
        package, _, licence = line.partition("\t")
        name, version, *rest = package.split()
        if not any("/" in word for word in rest):
            found.add((name, version.removeprefix("v"), licence))
    return [dict(zip(("name", "version", "license"), crate)) for crate in sorted(found)]


def complaints_of_crates(found, twice=TWICE):
    """What is wrong with crates.

    >>> crate = lambda name, version, licence: dict(name=name, version=version, license=licence)
    >>> complaints_of_crates([crate("a", "1", "MIT"), crate("b", "1", "GPL-3.0")], {})
    ['b 1: its licence is GPL-3.0']
    >>> complaints_of_crates([crate("a", "1", "MIT"), crate("a", "2", "MIT")], {})
    ['a is there in versions 1, 2']
    >>> complaints_of_crates([crate("a", "1", "MIT"), crate("a", "2", "MIT")], {"a": "so"})
    []
    >>> complaints_of_crates([crate("a", "1", "MIT")], {"a": "so"})
    ['a is there once: there is nothing to excuse']
    """
    complaints = []
    versions = defaultdict(list)
    for crate in found:
        versions[crate["name"]].append(crate["version"])
        if not allows(crate["license"]):
            complaints.append(f"{crate['name']} {crate['version']}: its licence is {crate['license']}")
    for name, all_of_it in versions.items():
        if len(all_of_it) > 1 and name not in twice:
            complaints.append(f"{name} is there in versions {', '.join(all_of_it)}")
    for name in twice:
        if len(versions[name]) < 2:
            complaints.append(f"{name} is there once: there is nothing to excuse")
    return complaints


def complaints_of_npm(lock):
    """What is wrong with the packages of a package-lock.json.

    >>> complaints_of_npm({"lockfileVersion": 1})
    ['the lock file is of version 1, which tells no licences']
    >>> package = lambda version, licence: dict(version=version, license=licence)
    >>> complaints_of_npm({"lockfileVersion": 3, "packages": {
    ...     "": {}, "node_modules/a": package("1", "ISC"),
    ...     "node_modules/a/node_modules/@b/c": package("2", "GPL-3.0"), "node_modules/d": {}}})
    ['@b/c 2: its licence is GPL-3.0', 'd ?: its licence is None']
    """
    version = lock.get("lockfileVersion", 1)
    if version < 2:
        return [f"the lock file is of version {version}, which tells no licences"]
    complaints = []
    for place, package in lock["packages"].items():
        # The repository's own packages lie elsewhere.
        if "node_modules/" in place and not package.get("link") and not allows(package.get("license")):
            name = place.rpartition("node_modules/")[2]
            told = f"{name} {package.get('version', '?')}: its licence is {package.get('license')}"
            complaints.append(told)
    return complaints


def locks(name):
    """Every lock file of this name that is part of the repository."""
    command = ["git", "ls-files", "-z", "--", name, f"*/{name}"]
    listed = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE).stdout
    return [ROOT / found for found in listed.decode().split("\0") if found]


def main():
    found = {}
    for lock in locks("Cargo.lock"):
        name = str(lock.relative_to(ROOT))
        if not name.startswith(OURS_ALONE):
            listed = crates(lock.parent)
            # What the program has twice for a reason others may have, too.
            twice = TWICE if lock.parent == ROOT else {
                name: why for name, why in TWICE.items()
                if sum(crate["name"] == name for crate in listed) > 1
            }
            found[name] = complaints_of_crates(listed, twice)
    for lock in locks("package-lock.json"):
        found[str(lock.relative_to(ROOT))] = complaints_of_npm(json.loads(lock.read_text()))
    complaints = [f"{name}: {what}" for name, all_of_it in found.items() for what in all_of_it]
    for complaint in complaints:
        print(complaint, file=sys.stderr)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
