"""The translations have every text of the sources, and no other.

Usage: translations_test.py LUPDATE SOURCE_FOLDER FILE.ts
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml


def texts_in(file):
    """Maps contexts and texts to whether they are translated."""
    texts = {}
    for context in xml.parse(file).getroot().findall("context"):
        name = context.findtext("name")
        for message in context.findall("message"):
            is_translated = message.find("translation").get("type") is None
            texts[name, message.findtext("source")] = is_translated
    return texts


def main():
    lupdate, sources, translations = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        updated = pathlib.Path(folder, "updated.ts")
        shutil.copy(translations, updated)
        subprocess.run(
            [lupdate, "-silent", "-no-obsolete", "-locations", "none", "-I", sources]
            + [str(pathlib.Path(sources, part)) for part in ("ui", "app/gui")]
            + ["-ts", str(updated)],
            check=True,
        )
        after = texts_in(updated)
    before = texts_in(translations)
    missing = [text for text, is_translated in after.items() if not is_translated]
    unused = sorted(before.keys() - after.keys())
    for context, text in missing:
        print(f"not translated: {context}: {text}")
    for context, text in unused:
        print(f"not in the sources, or not as lupdate finds it: {context}: {text}")
    print(f"{len(after)} texts")
    return 1 if missing or unused or len(after) < 1000 else 0


if __name__ == "__main__":
    sys.exit(main())
