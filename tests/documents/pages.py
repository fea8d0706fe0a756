"""The documents of the repository."""

import glob
import os


def pages(root):
    """Paths of all pages, in order."""
    found = glob.glob(os.path.join(root, "*.md")) + glob.glob(os.path.join(root, "docs/**/*.md"), recursive=True)
    return sorted(found + [os.path.join(root, name) for name in ("installer/README.md", "examples/README.md")])
