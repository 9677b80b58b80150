"""The pages of the documentation, for the tests that read them."""

import re


def pages_of(top):
    return sorted([*top.glob("*.md"), *(top / "docs").rglob("*.md"), *(top / "packaging").glob("*.md")])


def blocks(text):
    """The blocks of code of a page: (source named by the comment above, or None; language; text)."""
    pattern = r"(?:^<!-- from ([^ ]+) -->\n)?^```(\w*)\n(.*?)^```$"
    return re.findall(pattern, text, re.MULTILINE | re.DOTALL)


def without_blocks(text):
    return re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)
