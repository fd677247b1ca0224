#!/usr/bin/env python3
"""Checks that every file that states the version agrees with CMake's, and that the Debian packages
are built with the libraries of packages.txt.

Run it as `cmake --build BUILD --target release-check`. Exit status 0: all agree; 1: each
disagreement is one line on stderr.
"""

import argparse
import datetime
import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree


def first(pattern, text):
    match = re.search(pattern, text, re.MULTILINE)
    return match.group(1) if match else None


def disagreements(version, source, metainfo, documents):
    """Yields a sentence for each file that disagrees with `version`."""

    def differs(where, what, found, expected):
        if found != expected:
            yield f"{where}: {what} is {found}, expected {expected}"

    changelog = (source / "CHANGELOG.md").read_text(encoding="utf-8")
    newest = re.search(r"^## \[([^\]]+)\] - (\S+)$", changelog, re.MULTILINE)
    if not newest:
        yield "CHANGELOG.md: no heading of the form ## [VERSION] - DATE"
        return
    yield from differs("CHANGELOG.md", "the newest version", newest.group(1), version)
    date = newest.group(2)
    if date != "unreleased":
        try:
            datetime.date.fromisoformat(date)
        except ValueError:
            yield f"CHANGELOG.md: {date} is neither a date nor unreleased"

    release = ElementTree.parse(metainfo).getroot().find("releases/release")
    yield from differs(metainfo.name, "the newest release", release.get("version"), version)
    if date == "unreleased":
        yield from differs(metainfo.name, "the type of the release", release.get("type"), "development")
    else:
        yield from differs(metainfo.name, "the type of the release", release.get("type"), "stable")
        yield from differs(metainfo.name, "the date of the release", release.get("date"), date)

    citation = (source / "CITATION.cff").read_text(encoding="utf-8")
    yield from differs("CITATION.cff", "the version", first(r"^version: (\S+)$", citation), version)
    if date != "unreleased":
        released = first(r"^date-released: (\S+)$", citation)
        yield from differs("CITATION.cff", "the date of the release", released, date)

    debian = source / "packaging/debian/changelog"
    if debian.exists():
        found = first(r"^\S+ \(([^)-]+)(?:-[^)]*)?\)", debian.read_text(encoding="utf-8"))
        yield from differs("packaging/debian/changelog", "the upstream version", found, version)

    control = source / "packaging/debian/control"
    if control.exists():
        needed = control.read_text(encoding="utf-8").split("Standards-Version")[0]
        listed = (source / "packaging/packages.txt").read_text(encoding="utf-8")
        for package in re.findall(r"^(\S+-dev)$", listed.split("[test]")[0], re.MULTILINE):
            # zlib comes with others.
            if package != "zlib1g-dev" and not re.search(rf"^ {re.escape(package)}\b", needed, re.MULTILINE):
                yield f"packaging/debian/control: Build-Depends lacks {package} of packages.txt"

    pages = sorted(documents.glob("*/man1/*.1"))
    if not pages:
        yield f"{documents}: no manual pages"
    for page in pages:
        found = first(r'^\.TH .*"MarsView ([^"]+)"', page.read_text(encoding="utf-8"))
        yield from differs(page.name, "the version", found, version)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--version", required=True)
    for name in ("--source", "--metainfo", "--documents"):
        parser.add_argument(name, required=True, type=pathlib.Path)
    options = parser.parse_args()
    found = list(disagreements(options.version, options.source, options.metainfo, options.documents))
    for line in found:
        print(f"release-check: {line}", file=sys.stderr)
    if not found:
        print(f"release-check: all files agree on {options.version}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
