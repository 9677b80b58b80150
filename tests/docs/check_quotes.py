"""A block of code under a comment `<!-- from FILE -->` is consecutive lines of that file, but for an indentation common to all.

Usage: check_quotes.py FOLDER PAGE..., the top folder of the project, and pages all of whose C++ must be from a file.
"""

import pathlib
import sys
import textwrap

from pages import blocks, pages_of


def is_part(block, text):
    """Whether its lines are consecutive in the text, except for a common indentation."""
    lines = text.splitlines()
    size = len(block.splitlines())
    starts = range(len(lines) - size + 1)
    return any(textwrap.dedent("\n".join(lines[i : i + size])) == textwrap.dedent(block).rstrip("\n") for i in starts)


def mistakes(top, strict):
    for page in pages_of(top):
        for source, language, block in blocks(page.read_text()):
            where = f"{page.relative_to(top)}: the block that begins with {block.splitlines()[:1]}"
            if source and not is_part(block, (top / source).read_text()):
                yield f"{where} is not in {source}"
            elif not source and language == "cpp" and page in strict:
                yield f"{where} is from no file"


if __name__ == "__main__":
    top = pathlib.Path(sys.argv[1])
    found = list(mistakes(top, [top / name for name in sys.argv[2:]]))
    print("\n".join(found))
    sys.exit(1 if found else 0)
