"""The pictures of docs/plots: drawn from what predictive_bench writes, the same files giving the same bytes."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "docs" / "plots" / "plots.py"


def timing(scene, objects, space, mean, moving=None, ticks=100):
    return {
        "scene": scene,
        "n": objects,
        "space": space,
        "seed": 1,
        "moving": moving,
        "measured_ticks": ticks,
        "in_batches": False,
        "mean_us": mean,
        "median_us": mean,
        "p999_us": 2 * mean,
        "max_us": 3 * mean,
    }


def scale():
    return [
        timing(scene, objects, space, factor * objects, moving)
        for scene, moving in (("gas", None), ("gas", 0.1), ("game", None))
        for objects in (10, 100, 1000)
        for space, factor in (("predictive-box", 0.01), ("sap", 0.1), ("a space of tomorrow", 1))
    ]


def tail():
    return [
        timing("gas", 10000, "predictive-box", 15, ticks=101),
        {
            "histogram": "tail",
            "scene": "gas",
            "n": 10000,
            "space": "predictive-box",
            "seed": 1,
            "edges_us": [10, 20, 40],
            "counts": [100, 1],
        },
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

    def draw(self, records, output="pictures"):
        """Runs the script; returns the pictures by name."""
        (self.folder / "records.json").write_text(json.dumps(records), encoding="utf-8")
        out = self.folder / output
        subprocess.run(
            [sys.executable, SCRIPT, "--output", out, self.folder / "records.json"],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        return {picture.name: picture.read_bytes() for picture in out.iterdir()}

    def test_each_picture_is_drawn_when_its_records_are_there(self):
        self.assertEqual(set(self.draw(scale(), "a")), {"cost.svg"})
        self.assertEqual(set(self.draw(tail(), "b")), {"tail.svg"})
        self.assertEqual(set(self.draw(table1(), "c")), {"table1.svg"})
        self.assertEqual(set(self.draw([], "d")), set())
        requirement = {"line": "P1", "what": "mix 20", "value": 90, "bound": ">=", "limit": 80, "unit": "%", "met": True}
        everything = self.draw(scale() + tail() + table1() + [requirement], "e")
        self.assertEqual(set(everything), {"cost.svg", "tail.svg", "table1.svg"})

    def test_the_same_records_give_the_same_bytes(self):
        records = scale() + tail() + table1()
        first = self.draw(records, "first")
        self.assertEqual(first, self.draw(records, "second"))
        self.assertNotIn(b"<dc:date>", first["cost.svg"])

    def test_other_times_give_another_picture(self):
        records = scale()
        before = self.draw(records, "before")
        records[0]["mean_us"] *= 2
        self.assertNotEqual(before, self.draw(records, "after"))

    def test_the_longer_of_two_measurements_counts(self):
        records = scale()
        before = self.draw(records, "before")
        shorter = dict(records[0], mean_us=12345, measured_ticks=1)
        self.assertEqual(before, self.draw(records + [shorter], "after"))

    def test_a_file_that_is_not_json_is_an_error(self):
        broken = self.folder / "broken.json"
        broken.write_text("[{", encoding="utf-8")
        result = subprocess.run([sys.executable, SCRIPT, broken], capture_output=True, text=True, check=False)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("plots:", result.stderr)
        self.assertNotIn("Traceback", result.stderr)


if __name__ == "__main__":
    unittest.main()
