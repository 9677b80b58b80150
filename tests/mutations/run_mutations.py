#!/usr/bin/env python3
"""Do the tests notice a mistake in the code? Plants the deliberate faults of faults.py one by one in a copy of the tree,
builds the tests for each, runs them until the first one fails, and prints a Markdown table: fault, stage, the test that
noticed it.

Tests that compare with a known hash of results (GOLDEN) are left out: they fail at any change.

Exit status: 0 when each fault was noticed, or is said to be equivalent and was not; else 1.
"""

import argparse
import dataclasses
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

import faults as table

TOP = pathlib.Path(__file__).resolve().parent.parent.parent
SUITES = {  # paths of the programs; quick ones first
    "prediction": "tests/prediction/prediction_test",
    "broadphase": "tests/broadphase/broadphase_tests",
    "shapes": "tests/shape/shape_tests",
    "surface": "tests/surface/surface_tests",
    "space": "tests/space/space_tests",
    "times": "tests/times/times_tests",
    "contract": "tests/contract/contract_tests",
    "faults": "tests/faults/fault_tests",
    "shape_contract": "tests/shape/shape_contract_tests",
    "colliders": "tests/shape/shape_colliders_test",
    "differential": "tests/differential/differential_tests",
    "recordings": "tests/recording/history_tests",
    "histories": "tests/fuzz/contact_history_tests",
    "haptics": "tests/haptics/haptics_test",
    "soak": "tests/soak/soak_test",
}
GOLDEN = "*TheSameToTheLastBit*:*Golden*"
LONGEST_RUN = 300  # seconds; a fault may keep a test from ending


class Failure(Exception):
    pass


@dataclasses.dataclass
class Result:
    fault: table.Fault
    test: str  # the test that noticed; empty if none did
    seconds: float

    @property
    def as_expected(self):
        return bool(self.test) != bool(self.fault.equivalent)

    @property
    def verdict(self):
        return f"equivalent: {self.fault.equivalent}" if self.fault.equivalent and not self.test else self.test or "**no test**"


def planted(text, fault):
    """The text of a file with the fault in it."""
    places = text.count(fault.find)
    if places != 1:
        raise Failure(f"{fault.name}: its text is {places} times in {fault.file}")
    return text.replace(fault.find, fault.replace)


def first_failure(output):
    """The name of the test in which a GoogleTest program failed or ended, from its output."""
    failed = re.search(r"^\[  FAILED  \] ([\w./]+)", output, re.MULTILINE)
    if failed:
        return failed.group(1)
    begun = re.findall(r"^\[ RUN      \] ([\w./]+)", output, re.MULTILINE)
    return begun[-1] if begun else "the start of the program"


def files_in(top):
    """The files of a tree, without built ones."""
    names = (path.relative_to(top) for path in top.rglob("*") if path.is_file())
    return {name for name in names if name.parts[0] not in ("build", ".git")}


class Tree:
    """A copy of the tree, and its build."""

    def __init__(self, root, options):
        self.root = root
        self.build_folder = root / "build"
        self.options = options

    def update(self):
        """Brings the copy up to date. An unchanged file keeps its time, so that it is not compiled again."""
        present = files_in(TOP)
        for name in files_in(self.root) - present:
            (self.root / name).unlink()
        for name in present:
            source, copy = TOP / name, self.root / name
            if copy.is_file() and copy.read_bytes() == source.read_bytes():
                continue
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, copy)

    def configure(self):
        """Little optimisation makes compiling twice as fast."""
        self.call(["cmake", "-S", ".", "-B", str(self.build_folder), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
                   "-DCMAKE_C_FLAGS_RELWITHDEBINFO=-O1", "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1"] + self.options)

    def build(self, suite):
        self.call(["ninja", "-C", str(self.build_folder), pathlib.Path(SUITES[suite]).name])

    def call(self, command):
        done = subprocess.run(command, cwd=self.root, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            raise Failure(f"{' '.join(command)}:\n{done.stdout[-3000:]}")

    def failing_test(self, suite, pattern):
        """The first test of the suite that fails, or an empty string."""
        self.build(suite)
        command = [str(self.build_folder / SUITES[suite]), f"--gtest_filter={pattern}-{GOLDEN}", "--gtest_fail_fast",
                   "--gtest_brief=0"]
        try:
            done = subprocess.run(command, cwd=self.build_folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  text=True, errors="replace", timeout=LONGEST_RUN)
        except subprocess.TimeoutExpired as expired:
            return first_failure((expired.stdout or b"").decode(errors="replace")) + " (does not end)"
        if done.returncode == 0 and "[==========] Running 0 tests" in done.stdout:
            raise Failure(f"no test of {suite} is called {pattern}")
        return first_failure(done.stdout) + (" (crash)" if done.returncode < 0 else "") if done.returncode != 0 else ""


def noticed_by(tree, fault, suites):
    for suite, pattern in fault.first + tuple((suite, "*") for suite in suites):
        test = tree.failing_test(suite, pattern)
        if test:
            return test
    return ""


def try_fault(tree, fault, suites):
    path = tree.root / fault.file
    original = path.read_text()
    begin = time.monotonic()
    try:
        path.write_text(planted(original, fault))
        return Result(fault, noticed_by(tree, fault, suites), time.monotonic() - begin)
    except Failure as failure:
        print(f"mutations: {fault.name}: {failure}", file=sys.stderr)
        return Result(fault, "", time.monotonic() - begin)
    finally:
        path.write_text(original)


def summary(results):
    noticed = sum(bool(result.test) for result in results)
    equivalent = sum(result.as_expected and not result.test for result in results)
    return f"{len(results)} faults: {noticed} noticed, {equivalent} equivalent, {len(results) - noticed - equivalent} not noticed"


def chosen_faults(names, stages):
    known = {fault.name for fault in table.FAULTS}
    for name in names:
        if name not in known:
            raise Failure(f"there is no fault {name}")
    return [fault for fault in table.FAULTS
            if (not names or fault.name in names) and (not stages or fault.stage in stages)]


def parse_arguments():
    parser = argparse.ArgumentParser(prog="./run dev mutations", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", action="append", default=[], metavar="NAME", help="this fault; may be given again")
    parser.add_argument("--stage", action="append", default=[], choices=table.STAGES, help="the faults of this stage; may be given again")
    parser.add_argument("--suites", nargs="*", default=list(SUITES), choices=SUITES, metavar="SUITE",
                        help=f"which suites run as a whole when the likely tests do not fail (default: all of them: "
                             f"{', '.join(SUITES)})")
    parser.add_argument("--folder", type=pathlib.Path, default=TOP / "build/mutations", help="where the copy is built")
    parser.add_argument("--ode-source", help="the source of ODE, for the build")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    options = [f"-DODE_SOURCE_DIR={os.path.abspath(arguments.ode_source)}"] if arguments.ode_source else []
    tree = Tree(arguments.folder.resolve() / "tree", options)
    try:
        faults = chosen_faults(arguments.only, arguments.stage)
        tree.update()
        for fault in faults:
            planted((tree.root / fault.file).read_text(), fault)
        tree.configure()
        print("| fault | stage | noticed by | seconds |\n|---|---|---|---|", flush=True)
        results = []
        for fault in faults:
            results.append(try_fault(tree, fault, arguments.suites))
            print(f"| {fault.name} | {fault.stage} | {results[-1].verdict} | {results[-1].seconds:.0f} |", flush=True)
    except Failure as failure:
        sys.exit(f"mutations: {failure}")
    print(f"\n{summary(results)}")
    sys.exit(0 if all(result.as_expected for result in results) else 1)


if __name__ == "__main__":
    main()
