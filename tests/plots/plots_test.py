"""The pictures of docs/plots have the figures of docs/results; the same data give the same bytes."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PLOTS = pathlib.Path(__file__).resolve().parents[2] / "docs" / "plots"


def draw():
    """The pictures by name."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, PLOTS / "plots.py", "--output", folder], check=True, stdout=subprocess.DEVNULL)
        return {picture.name: picture.read_text(encoding="utf-8") for picture in pathlib.Path(folder).iterdir()}


class Plots(unittest.TestCase):
    def test_the_pictures_have_the_figures_of_the_results(self):
        texts = lambda picture: re.findall("<!-- (.*?) -->", picture)
        drawn = draw()
        for picture in PLOTS.glob("*.svg"):
            self.assertEqual(texts(drawn.pop(picture.name)), texts(picture.read_text(encoding="utf-8")), picture.name)
        self.assertEqual(drawn, {})

    def test_the_same_data_give_the_same_bytes(self):
        self.assertEqual(draw(), draw())


if __name__ == "__main__":
    unittest.main()
