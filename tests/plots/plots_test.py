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

    def draw(self, gains):
        """Runs the script on these records; returns the pictures by name."""
        (self.folder / "table1.json").write_text(json.dumps(gains), encoding="utf-8")
        with tempfile.TemporaryDirectory() as out:
            subprocess.run([sys.executable, SCRIPT, "--output", out, self.folder / "table1.json"], check=True, stdout=subprocess.DEVNULL)
            return {picture.name: picture.read_bytes() for picture in pathlib.Path(out).iterdir()}

    def test_a_picture_is_drawn_when_its_records_are_there(self):
        self.assertEqual(set(self.draw(table1())), {"table1.svg"})
        self.assertEqual(set(self.draw([])), set())
        self.assertEqual(self.draw(table1()), self.draw(table1()))

    def test_the_picture_of_the_first_page_has_the_figures_of_the_results(self):
        texts = lambda picture: re.findall("<!-- (.*?) -->", picture.read_text(encoding="utf-8"))
        subprocess.run([sys.executable, SCRIPT, "--output", self.folder, DOCS / "results" / "worlds_times.csv"],
                       check=True, stdout=subprocess.DEVNULL)
        self.assertEqual(texts(self.folder / "speed.svg"), texts(DOCS / "plots" / "speed.svg"))
        self.assertIn("17.4 µs: 46.8 times as fast", texts(self.folder / "speed.svg"))


if __name__ == "__main__":
    unittest.main()
