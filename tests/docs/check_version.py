"""Every mention of the version is that of CMakeLists.txt.

Usage: check_version.py SOURCE_DIR
"""

import pathlib
import re
import sys

top = pathlib.Path(sys.argv[1])


def found(file, pattern):
    match = re.search(pattern, (top / file).read_text(), re.MULTILINE)
    return match.group(1) if match else f"nothing like {pattern}"


version = found("CMakeLists.txt", r"^ +VERSION ([0-9.]+)$")
others = {
    "CITATION.cff": found("CITATION.cff", r"^version: (.*)$"),
    "CHANGELOG.md": found("CHANGELOG.md", r"^## \[([0-9.]+)\]"),
    "packaging/vcpkg/vcpkg.json": found("packaging/vcpkg/vcpkg.json", r'^  "version": "(.*)",$'),
}
wrong = {file: other for file, other in others.items() if other != version}
for file, other in wrong.items():
    print(f"{file}: {other}, not {version}")
sys.exit(bool(wrong))
