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
major, minor, patch = map(int, version.split("."))
number = str(10000 * major + 100 * minor + patch)
others = {
    "CITATION.cff": found("CITATION.cff", r"^version: (.*)$"),
    "CHANGELOG.md": found("CHANGELOG.md", r"^## \[([0-9.]+)\]"),
    "packaging/vcpkg/vcpkg.json": found("packaging/vcpkg/vcpkg.json", r'^  "version": "(.*)",$'),
}
wrong = {file: other for file, other in others.items() if other != version}
header = "include/ode_predictive_space/predictive_space.h"
macro = found(header, r"^#define ODE_PREDICTIVE_SPACE_VERSION ([0-9]+)$")
comment = found(header, r"^/\*\* The version of this header, ([0-9.]+):")
if (macro, comment) != (number, version):
    wrong[header] = f"{macro} ({comment})"
# The Debian packages of the shared libraries have the version of the binary interface in their names.
interface = f"0.{minor}" if major == 0 else str(major)
for library in ("libode-predictive-space", "libode-predictive-space-haptics"):
    if not (top / f"packaging/debian/{library}{interface}.install").is_file():
        wrong[f"packaging/debian/{library}*.install"] = f"none for the interface {interface}"
for file, other in wrong.items():
    print(f"{file}: {other}, but the version is {version}")
sys.exit(bool(wrong))
