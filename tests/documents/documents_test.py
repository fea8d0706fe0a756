"""The documents keep up with the program and can be read: links and anchors lead somewhere, pictures are there and small,
what a guide calls *by its name in italics* (a button, a card, a state) is a text of the program, no page is too long, and
none uses the private phrases below.

Usage: documents_test.py SOURCE_FOLDER"""

import glob
import os
import re
import sys

from pages import pages

ROOT = sys.argv[1]
LARGEST_PICTURE = 150_000
LARGEST_ANIMATION = 3_000_000
MOST_LINES = 250

# Longer than MOST_LINES: generated, one section a command or effect.
MAY_BE_LONG = {"docs/reference/cli.md", "docs/reference/effects.md"}

# Phrases that only the authors understand, and what to write instead. Plain words (must, room) are not among them.
PRIVATE = {
    r"one who is told": "an oracle that knows the hidden effect",
    r"(is|are|was|were|be) told(?! apart)": "reported, stated, listed",
    r"(is|are) said\b": "reported, stated",
    r"would have shown from|would show from|shows from": "detection limit",
    r"(noise |in |of \d+ )widths": "standard deviations",
    r"sound (machines?|tours?)": "machine without hidden effects, tour without faults",
    r"seed of the day|case drawn|are drawn": "random seed, sampled",
    r"by far\b|hardly (any|shows)|\banew\b": "the number or the term",
    r"(fresh )?eyes": "reviewer",
    r"(spindle|machine|clock|axis|axes) stands?\b": "is at rest, stopped",
    r"(which|it|that) stands? (in|beside|below|above)": "is",
    r"from elsewhere": "from another computer, external",
    r"what is left\b": "residual error, remaining",
    r"promises? (kept|is kept)": "commitment verified",
}
# To be rewritten; the list only gets shorter. Help is text of the program; two pages are generated from its sources.
MAY_BE_PRIVATE = {"docs/method.md", "docs/proof.md", "docs/real-recordings.md",
                  "docs/reference/cli.md", "docs/reference/effects.md"}

# Italics that are no names of anything in the window.
PROSE = {"this", "why"}


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def relative(path):
    return os.path.relpath(path, ROOT)


def without_code(text):
    return re.sub(r"^ *```.*?^ *```$", "", text, flags=re.M | re.S)


def anchors(path):
    """Anchors of the headings, as GitHub makes them."""
    found = set()
    for heading in re.findall(r"^#+ (.+)$", without_code(read(path)), re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
        found.add(re.sub(r"[^\w\- ]", "", plain).replace(" ", "-"))
    return found


def links():
    dangling = []
    for path in pages(ROOT):
        for target in re.findall(r"\]\(([^)\s]+)\)", without_code(read(path))):
            if re.match(r"[a-z]+:", target):
                continue
            name, _, anchor = target.partition("#")
            other = os.path.join(os.path.dirname(path), name) if name else path
            if not os.path.exists(other) or (anchor and anchor not in anchors(other)):
                dangling.append(f"{relative(path)}: {target}")
    assert not dangling, dangling


def lengths():
    long = [f"{relative(path)}: {lines} lines" for path in pages(ROOT) if relative(path) not in MAY_BE_LONG
            and (lines := read(path).count("\n")) > MOST_LINES]
    assert not long, long


def phrases():
    found = []
    for path in pages(ROOT):
        if relative(path) in MAY_BE_PRIVATE or relative(path).startswith("docs/help/"):
            continue
        for number, line in enumerate(read(path).split("\n"), 1):
            for phrase, instead in PRIVATE.items():
                if hit := re.search(r"\b(" + phrase + ")", line, re.I):
                    found.append(f"{relative(path)}:{number}: \"{hit.group(0)}\"; write: {instead}")
    assert not found, "\n".join(found)


def pictures():
    for path in glob.glob(os.path.join(ROOT, "docs/**/images/*.png"), recursive=True):
        assert os.path.getsize(path) <= LARGEST_PICTURE, path
    for path in glob.glob(os.path.join(ROOT, "docs/images/*.webp")):
        assert os.path.getsize(path) <= LARGEST_ANIMATION, path


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
lengths()
phrases()
