#!/usr/bin/env python3
"""Swaps the space in each of ODE's demos, in one line, and runs it beside the original: 500 steps without a window.

In a copy of a demo, each creation of a hash, simple, quadtree or sweep-and-prune space becomes dPredictiveSpaceCreate(), and one
header is included. Nothing else changes. Original and copy are recorded under the launcher, which replaces nothing, and their
pairs are compared with those that simple spaces find in a replay.

Prints a Markdown table. Exit status: 0; 1 when a swapped demo ends unlike its original, has a wrong pair, or does not compile.
"""
import argparse
import os
import re
import shutil
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "support"))
from replayed import compared  # noqa: E402

CREATION = re.compile(r"\bd(Hash|Simple|QuadTree|SweepAndPrune)SpaceCreate\s*\(")
LONGEST_RUN = 900  # seconds
HEADER = "#include <ode_predictive_space/predictive_space.h>\n"


@dataclass
class Run:
    ending: str
    collides: int = 0
    differences: int = 0  # collides that missed pairs


def arguments_from(text, begin):
    """The arguments of a call and the position of their end; begin is behind the parenthesis."""
    arguments, depth, last = [], 0, begin
    for at in range(begin, len(text)):
        if text[at] in "([":
            depth += 1
        elif text[at] in ")]" and depth > 0:
            depth -= 1
        elif depth == 0 and text[at] in ",)":
            arguments.append(text[last:at].strip())
            last = at + 1
            if text[at] == ")":
                return arguments, at + 1
    raise ValueError("a call has no end")


def swapped(text):
    """The text with its creations swapped, and their number. Comments are swapped, too."""
    result, at, count = "", 0, 0
    for call in CREATION.finditer(text):
        arguments, end = arguments_from(text, call.end())
        result += text[at:call.start()] + f"dPredictiveSpaceCreate({arguments[0] or '0'})"
        at, count = end, count + 1
    return HEADER + result + text[at:], count


def with_fewer_objects(name, text):
    """10,000 balls would begin in 4 cubic metres: millions of contacts, and a minute for the first step."""
    return re.sub(r"(#define NUM) 10000\b", r"\1 1000", text) if name == "demo_space_stress" else text


class Demos:
    def __init__(self, options):
        self.source = Path(options.ode_source).resolve()
        self.build = Path(options.build).resolve()
        self.work = Path(options.work).resolve()
        self.library = Path(options.ode_library).resolve()
        self.headers = options.ode_headers
        self.only = options.only
        self.environment = dict(os.environ, LD_LIBRARY_PATH=str(self.library.parent))
        self.tool = self.build / "ode_predictive_space/preload/ode-predictive"
        self.space_folder = self.build / "ode_predictive_space"

    def names(self):
        files = sorted((self.source / "ode/demo").glob("demo_*.c*"))
        return [file for file in files if not self.only or file.stem in self.only]

    def prepare(self):
        shutil.rmtree(self.work, ignore_errors=True)
        for kind in ("original", "swapped"):
            shutil.copytree(self.source / "ode/demo", self.work / kind)
        shutil.copytree(self.source / "include/drawstuff", self.work / "include/drawstuff")
        (self.work / "include/drawstuff/version.h").write_text("#define DS_VERSION 2\n")
        subprocess.run(["cc", "-O1", "-c", HERE / "headless_drawstuff.c", "-o", self.work / "drawstuff.o"], check=True)

    def compile(self, kind, file):
        text = with_fewer_objects(file.stem, file.read_text(errors="surrogateescape"))
        count = len(CREATION.findall(text))
        if kind == "swapped":
            text, count = swapped(text)
        copy = self.work / kind / file.name
        copy.write_text(text, errors="surrogateescape")
        command = ["cc" if file.suffix == ".c" else "c++", "-O1", "-w", f"-I{self.work}/include",
                   *(f"-I{folder}" for folder in self.headers), f"-I{HERE.parents[2]}/include", '-DDRAWSTUFF_TEXTURE_PATH=""', copy,
                   self.work / "drawstuff.o", "-o", self.work / kind / file.stem, self.library, f"-L{self.space_folder}",
                   "-lode_predictive_space", f"-Wl,-rpath,{self.space_folder}", "-lstdc++", "-lm", "-lpthread"]
        subprocess.run(command, check=True)
        return count

    def run(self, kind, file):
        """A signal ends a demo that crashes or aborts, and with it the launcher."""
        recording = self.work / kind / (file.stem + ".odehist")
        command = [self.tool, "run", "--space", "none", "--record", recording, self.work / kind / file.stem]
        try:
            ended = subprocess.run(command, cwd=self.work, env=self.environment, timeout=LONGEST_RUN, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        except subprocess.TimeoutExpired:
            return Run(f"took more than {LONGEST_RUN} s")
        output = ended.stdout.decode(errors="replace")
        (self.work / kind / (file.stem + ".output")).write_text(output)
        status = ended.returncode
        ending = "goes on" if status == 0 else f"ends with {status}" if status > 0 else f"ends by {signal.Signals(-status).name}"
        assertion = re.search(r'assertion "([^"]*)" failed', output, re.IGNORECASE)
        collides, differing = compared(self.tool, recording)[:2] if recording.exists() else (0, 0)
        return Run(ending + (f" (`{assertion[1]}`)" if assertion else ""), collides, differing)

    def judge(self, file):
        try:
            count = self.compile("original", file)
            self.compile("swapped", file)
        except subprocess.CalledProcessError:
            return f"| {file.stem} | | does not compile | | | |", False
        if count == 0:
            return f"| {file.stem} | 0 | {self.run('original', file).ending} | – | – | – |", True
        original, ours = self.run("original", file), self.run("swapped", file)
        is_well = ours.differences == 0 and (ours.ending == "goes on" or ours.ending == original.ending)
        return (f"| {file.stem} | {count} | {original.ending} | {ours.ending} | {original.differences:,} of "
                f"{original.collides:,} | {ours.differences:,} of {ours.collides:,} |"), is_well


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ode-source", required=True, help="folder of ODE's source, with ode/demo")
    parser.add_argument("--ode-library", required=True, help="libode.so of that source")
    parser.add_argument("--ode-headers", action="append", default=[], help="folder of that library's headers, unless installed")
    parser.add_argument("--build", required=True, help="folder that the project is built in")
    parser.add_argument("--work", required=True, help="scratch folder, emptied")
    parser.add_argument("only", nargs="*", help="names of demos; all of them unless named")
    demos = Demos(parser.parse_args())
    demos.prepare()
    print("| demo | creations | original, 500 steps | swapped | original: collides with other pairs | swapped |")
    print("|---|---:|---|---|---:|---:|")
    all_well = True
    with ThreadPoolExecutor(max_workers=2) as workers:
        for line, is_well in workers.map(demos.judge, demos.names()):
            print(line, flush=True)
            all_well = all_well and is_well
    return 0 if all_well else 1


if __name__ == "__main__":
    sys.exit(main())
