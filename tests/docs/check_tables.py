"""Each table of a page is whole: an empty line inside it would show the rows below as text.

Usage: check_tables.py FOLDER, the top folder of the project.
"""

import pathlib
import re
import sys

from pages import pages_of, without_blocks

RULE = re.compile(r"\|( *:?-+:? *\|)+")


def mistakes(top):
    for page in pages_of(top):
        for table in re.findall(r"(?:^\|.*\n?)+", without_blocks(page.read_text()), re.MULTILINE):
            rows = table.splitlines()
            if len(rows) < 2 or not RULE.fullmatch(rows[1].strip()):
                yield f"{page.relative_to(top)}: not a table with a head: {rows[0]}"


if __name__ == "__main__":
    found = list(mistakes(pathlib.Path(sys.argv[1])))
    print("\n".join(found))
    sys.exit(1 if found else 0)
