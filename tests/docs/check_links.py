"""Each relative link of a page leads to a file of the project, and to a heading of it if the link names one.

Usage: check_links.py FOLDER, the top folder of the project.
"""

import pathlib
import re
import sys

from pages import pages_of, without_blocks


def anchors(page):
    """The anchors that hosts of Git repositories make of headings."""
    for heading in re.findall(r"^#+ (.*)$", without_blocks(page.read_text()), re.MULTILINE):
        yield re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def mistakes(top):
    for page in pages_of(top):
        for link in re.findall(r"\]\(([^)\s]+)\)", without_blocks(page.read_text())):
            path, _, anchor = link.partition("#")
            target = page.parent / path if path else page
            if "://" in link:
                continue
            if not target.exists():
                yield f"{page.relative_to(top)}: there is no {link}"
            elif anchor and anchor not in anchors(target):
                yield f"{page.relative_to(top)}: no heading for {link}"


if __name__ == "__main__":
    found = list(mistakes(pathlib.Path(sys.argv[1])))
    print("\n".join(found))
    sys.exit(1 if found else 0)
