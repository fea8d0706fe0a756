"""The documents keep up with the program: links lead somewhere, pictures are there and small, and what a guide calls
*by its name in italics* (a button, a card, a state) is a text of the program.

Usage: documents_test.py SOURCE_FOLDER"""

import glob
import os
import re
import sys

ROOT = sys.argv[1]
LARGEST_PICTURE = 150_000

# Italics that are no names of anything in the window.
PROSE = {"this", "why"}


def documents():
    return [os.path.join(ROOT, "README.md"), os.path.join(ROOT, "installer/README.md"),
            *glob.glob(os.path.join(ROOT, "docs/**/*.md"), recursive=True)]


def links():
    dangling = []
    for path in documents():
        with open(path, encoding="utf-8") as file:
            text = file.read()
        for target in re.findall(r"\]\(([^)#\s]+)", text):
            if not target.startswith("http") and not os.path.exists(os.path.join(os.path.dirname(path), target)):
                dangling.append(f"{os.path.relpath(path, ROOT)}: {target}")
    assert not dangling, dangling


def pictures():
    for path in glob.glob(os.path.join(ROOT, "docs/**/images/*.png"), recursive=True):
        assert os.path.getsize(path) <= LARGEST_PICTURE, path


def texts_of_the_program():
    texts = []
    for folder in ("ui", "app/desktop", "app/text", "core/acquisition"):
        for path in glob.glob(os.path.join(ROOT, folder, "**/*.[ch]*"), recursive=True):
            with open(path, encoding="utf-8") as file:
                source = re.sub(r'"\s*\n\s*"', "", file.read())  # a text in pieces
            texts += re.findall(r'"((?:[^"\\]|\\.)*)"', source)
    return "\n".join(texts)


def names():
    texts = texts_of_the_program().lower()
    unknown = []
    for path in glob.glob(os.path.join(ROOT, "docs/guide/*.md")) + glob.glob(os.path.join(ROOT, "docs/help/*.md")):
        with open(path, encoding="utf-8") as file:
            text = file.read()
        for name in re.findall(r"(?<!\*)\*([^*\n]+)\*(?!\*)", text):
            parts = [part.strip(" ;.") for part in name.lower().split("…")]  # what stands there is filled in by the program
            parts = [re.sub(r"^x and z ", "", part) for part in parts if part]
            if name not in PROSE and not all(part in texts for part in parts):
                unknown.append(f"{os.path.relpath(path, ROOT)}: {name}")
    assert not unknown, "\n".join(unknown)


links()
pictures()
names()
