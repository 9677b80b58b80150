"""Runs a page: writes its programs, runs its commands in their order, and compares their output with the page.

Usage: check_tutorial.py TOP PAGE SCRATCH COMPILER [PREFIX [FLAGS...]]

TOP is the project's folder, SCRATCH one for the files of the page. A block of C++ that begins with a comment with the name of
a file is written to that file. All blocks of `sh` run in one shell. A block of `text` is the output of the block before it; a
line `...` of it stands for any lines. `c++` is COMPILER with FLAGS, which has warnings as errors.

A PREFIX in which the libraries are installed replaces the page's own build: blocks that call ./run are left out. Without it,
they run in a copy of the project.
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from pages import blocks

END = "--- end of block {} ---"
FOLDERS = ["demos", "include", "ode_predictive_space", "packaging", "docs"]


def prepare(top, scratch, prefix):
    """A folder in which the commands of the page can run."""
    shutil.rmtree(scratch, ignore_errors=True)
    if prefix:
        (scratch / "build/tutorial").mkdir(parents=True)
        (scratch / "build/tutorial/prefix").symlink_to(prefix)
        (scratch / "demos").symlink_to(top / "demos")
        return
    scratch.mkdir(parents=True)
    for name in FOLDERS:
        shutil.copytree(top / name, scratch / name)
    for path in top.iterdir():
        if path.is_file():
            shutil.copy2(path, scratch)


def write_compiler(folder, compiler, flags):
    folder.mkdir()
    script = folder / "c++"
    command = shlex.join([compiler, "-Wall", "-Wextra", "-Werror", *flags])
    script.write_text(f'#!/bin/sh\nexec {command} "$@"\n')
    script.chmod(0o755)


def steps(text, with_run):
    """(input of the shell, expected output or None) of each block."""
    found = []
    for source, language, block in blocks(text):
        named = re.match(r"// ([\w.]+)\n", block)
        if language == "cpp" and named and not source:
            found.append([f"cat >{named[1]} <<'END_OF_FILE'\n{block}END_OF_FILE\n", None])
        elif language == "sh" and (with_run or "./run" not in block):
            found.append([block, None])
        elif language == "text":
            found[-1][1] = block
        elif language not in ("cpp", "sh"):
            raise ValueError(f"what is a block of '{language}'?")
    return found


def run(script, scratch, tools):
    environment = dict(os.environ, PATH=f"{tools}:{os.environ['PATH']}")
    return subprocess.run(["bash", "-e", "-u", "-o", "pipefail", "-c", script], cwd=scratch, env=environment,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)


def agrees(shown, printed):
    pattern = r"(?:.*\n)*".join(re.escape(part) for part in re.split(r"^\.\.\.\n", shown, flags=re.MULTILINE))
    return re.fullmatch(pattern, printed) is not None


def mistakes(found, output):
    for number, (commands, shown) in enumerate(found):
        printed, end, output = output.partition(END.format(number) + "\n")
        if not end:
            yield f"this failed:\n{commands}with:\n{printed}"
            return
        if shown is not None and not agrees(shown, printed):
            yield f"the page shows:\n{shown}but\n{commands}prints:\n{printed}"


def main():
    top, page, scratch = map(pathlib.Path, sys.argv[1:4])
    compiler, prefix, flags = sys.argv[4], "".join(sys.argv[5:6]), [flag for flag in sys.argv[6:] if flag]
    found = steps(page.read_text(), not prefix)
    if not any(shown for _, shown in found):
        sys.exit(f"{page} shows no output")
    prepare(top, scratch, prefix)
    write_compiler(scratch / "tools", compiler, flags)
    script = "".join(f"{commands}echo '{END.format(number)}'\n" for number, (commands, _) in enumerate(found))
    done = run(script, scratch, scratch / "tools")
    wrong = list(mistakes(found, done.stdout))
    print("\n".join(wrong) or done.stdout)
    sys.exit(1 if wrong or done.returncode else 0)


if __name__ == "__main__":
    main()
