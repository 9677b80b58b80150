"""The drawings in docs/drawings are those that draw.py makes: the same texts, and the same lines within a point."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "docs" / "drawings"
TOLERANCE = 1.0  # points, as versions of matplotlib place labels slightly differently


def draw(folder):
    command = [sys.executable, FOLDER / "draw.py", "--output", folder]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return {path.name: path.read_text(encoding="utf-8") for path in pathlib.Path(folder).glob("*.svg")}


def texts(svg):
    """matplotlib draws texts as paths, and writes each into a comment above."""
    return re.findall(r"<!-- (.*?) -->", svg)


def paths(svg):
    """(commands, coordinates) of each path beside letters, which are in <defs>."""
    drawn = re.sub(r"<defs>.*?</defs>", "", svg, flags=re.DOTALL)
    for data in re.findall(r'<path [^>]*?\bd="(.*?)"', drawn, re.DOTALL):
        yield re.sub(r"[^A-Za-z]", "", data), [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", data)]


class Drawings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            cls.drawn = draw(folder)
        cls.committed = {path.name: path.read_text(encoding="utf-8") for path in FOLDER.glob("*.svg")}

    def test_each_drawing_is_there_and_no_other(self):
        self.assertEqual(set(self.committed), set(self.drawn))

    def test_the_texts_are_those_of_the_script(self):
        for name, svg in self.drawn.items():
            self.assertEqual(texts(self.committed[name]), texts(svg), name)
            self.assertTrue(texts(svg), name)

    def test_the_lines_are_where_the_script_draws_them(self):
        for name, svg in self.drawn.items():
            committed, drawn = list(paths(self.committed[name])), list(paths(svg))
            self.assertEqual([commands for commands, _ in committed], [commands for commands, _ in drawn], name)
            for (_, there), (_, here) in zip(committed, drawn):
                farthest = max((abs(a - b) for a, b in zip(there, here)), default=0)
                self.assertLessEqual(farthest, TOLERANCE, name)

if __name__ == "__main__":
    unittest.main()
