"""The pictures of docs/plots, drawn from the output of the benchmarks: the same files give the same bytes."""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"
SCRIPT = DOCS / "plots" / "plots.py"


def timing(scene, objects, space, mean, ticks=100, **more):
    return {
        "name": f"collide/{scene}/{objects}/{space}/iterations:{ticks}/manual_time",
        "iterations": ticks,
        "real_time": mean,
        **more,
    }


def scale():
    return [
        timing(scene, objects, space, factor * objects)
        for scene in ("gas", "game")
        for objects in (10, 100, 1000)
        for space, factor in (("predictive-box", 0.01), ("sap", 0.1), ("a space of tomorrow", 1))
    ]


def table1():
    return [
        {
            "table": "table1",
            "block": block,
            "n": objects,
            "other": other,
            "gain_percent": gain,
            "paper_gain_percent": 80,
        }
        for block, gain in (("broad phase", 90), ("broad and narrow phase", 40), ("whole tick", -120))
        for objects in (20, 40)
        for other in ("brute", "sap", "quadtree", "hash")
    ]


class Plots(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        self.addCleanup(self.temporary.cleanup)

    def draw(self, timings, gains, output="pictures"):
        """Runs the script on a file of each benchmark; returns the pictures by name."""
        (self.folder / "clock.json").write_text(json.dumps({"benchmarks": timings}), encoding="utf-8")
        (self.folder / "table1.json").write_text(json.dumps(gains), encoding="utf-8")
        out = self.folder / output
        subprocess.run(
            [sys.executable, SCRIPT, "--output", out, self.folder / "clock.json", self.folder / "table1.json"],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        return {picture.name: picture.read_bytes() for picture in out.iterdir()}

    def test_each_picture_is_drawn_when_its_records_are_there(self):
        self.assertEqual(set(self.draw(scale(), [], "a")), {"cost.svg"})
        self.assertEqual(set(self.draw([], table1(), "b")), {"table1.svg"})
        self.assertEqual(set(self.draw([], [], "c")), set())
        self.assertEqual(set(self.draw(scale(), table1(), "d")), {"cost.svg", "table1.svg"})

    def test_the_picture_of_the_first_page_has_the_figures_of_the_results(self):
        texts = lambda picture: re.findall("<!-- (.*?) -->", picture.read_text(encoding="utf-8"))
        subprocess.run([sys.executable, SCRIPT, "--output", self.folder, DOCS / "results" / "worlds_times.csv"],
                       check=True, stdout=subprocess.DEVNULL)
        self.assertEqual(texts(self.folder / "speed.svg"), texts(DOCS / "plots" / "speed.svg"))
        self.assertIn("17.4 µs: 46.8 times as fast", texts(self.folder / "speed.svg"))


if __name__ == "__main__":
    unittest.main()
