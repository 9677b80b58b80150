"""The picture of the first page, drawn again from the results."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"
SCRIPT = DOCS / "plots" / "plots.py"


class Plots(unittest.TestCase):
    def test_the_picture_of_the_first_page_has_the_figures_of_the_results(self):
        texts = lambda picture: re.findall("<!-- (.*?) -->", picture.read_text(encoding="utf-8"))
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, SCRIPT, "--output", folder, DOCS / "results" / "worlds_times.csv"],
                           check=True, stdout=subprocess.DEVNULL)
            drawn = texts(pathlib.Path(folder) / "speed.svg")
        self.assertEqual(drawn, texts(DOCS / "plots" / "speed.svg"))
        self.assertIn("17.4 µs: 46.8 times as fast", drawn)


if __name__ == "__main__":
    unittest.main()
