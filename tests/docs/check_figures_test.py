"""The mistakes that check_figures.py notices, with data made here.

Usage: check_figures_test.py FOLDER, the top folder of the project.
"""

import json
import pathlib
import sys
import tempfile
import unittest

from check_figures import Data, is_rounded, mistakes_of

TOP = pathlib.Path(sys.argv.pop(1))
TABLE = """| scene | best ODE space | predictive | collide | whole tick |
|---|---:|---:|---:|---:|
| some objects | 96.1 µs (quadtree) | 2.38 µs | 40 × | 1.9 × |
"""
GAS = "stepped.json; rows: gas 1,000"
TIMES = {"predictive-box": 2.38, "quadtree": 96.14, "sap": 98}
STEPPED = [{"scene": "gas", "n": 1000, "begin_s": None, "end_s": None, "space": space, "mean_us": time, "median_us": time,
            "p99_us": time, "p999_us": time, "best_ode_ratio": 96.14 / time, "best_ode_ratio_of_wholes": 1.91}
           for space, time in TIMES.items()]
TEXT = "Ten thousand of them take 9.2 µs per tick; the quadtree takes 5.5 ms, in `one_2.5` run of 3."
STILL = "haptic_loop.csv; rows: still @ predictive | still @ quadtree; besides: 3"
LOOP = "space,predictive,quadtree,hash\nstill,9.2,5534,"


class Figures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        docs = pathlib.Path(folder.name) / "docs"
        (docs / "results").mkdir(parents=True)
        (docs / "plots").symlink_to(TOP.resolve() / "docs" / "plots")
        (docs / "results" / "stepped.json").write_text(json.dumps(STEPPED))
        (docs / "results" / "haptic_loop.csv").write_text(LOOP)
        self.data = Data(docs.parent)

    def mistakes(self, block, comment):
        return list(mistakes_of(block, comment, self.data))

    def test_right_figures_pass(self):
        self.assertEqual(self.mistakes(TABLE, GAS), [])
        self.assertEqual(self.mistakes(TEXT, STILL), [])

    def test_each_wrong_cell_is_noticed(self):
        changes = {"96.1 µs": "96.2 µs", "2.38": "2.39", "40 ×": "–", "1.9 ×": "1.8 ×", "quadtree": "sap"}
        for right, wrong in changes.items():
            self.assertEqual(len(self.mistakes(TABLE.replace(right, wrong), GAS)), 1, wrong)

    def test_an_unknown_column_file_or_option_is_noticed(self):
        self.assertEqual(self.mistakes(TABLE.replace("collide", "price"), GAS), ['no column "price" in stepped.json'])
        self.assertEqual(self.mistakes(TABLE, "steps.json"), ["there is no docs/results/steps.json"])
        self.assertEqual(len(self.mistakes(TABLE, GAS + "; colour: red")), 1)

    def test_a_text_has_the_named_figures_and_no_others(self):
        self.assertEqual(len(self.mistakes(TEXT.replace("9.2", "9.1"), STILL)), 2)
        self.assertEqual(len(self.mistakes(TEXT, STILL.replace("; besides: 3", ""))), 1)
        self.assertEqual(len(self.mistakes(TEXT, STILL.replace(" | ", " | still @ simple | "))), 1)
        self.assertEqual(len(self.mistakes(TEXT, "haptic_loop.csv; besides: 9.2, 5.5, 3")), 1)

    def test_rounding_is_that_of_the_printed_digits(self):
        for printed, value, right in (
            ("4.3", 4.2501, True),
            ("4.3", 4.2499, False),
            ("17,600", 17599.4, True),
            ("17,600", 17649, True),
            ("17,600", 17651, False),
            ("100", 100.4, True),
            ("100", 104, False),
        ):
            self.assertEqual(is_rounded(printed, value, 3), right, (printed, value))
        self.assertTrue(is_rounded("230", 232.5, 2))
        self.assertFalse(is_rounded("230", 232.5, 3))


if __name__ == "__main__":
    unittest.main()
