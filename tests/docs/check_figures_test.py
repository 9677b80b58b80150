"""The mistakes that check_figures.py notices, with the data of the project.

Usage: check_figures_test.py FOLDER, the top folder of the project.
"""

import pathlib
import sys
import unittest

from check_figures import Data, blocks_of, has_figures, is_rounded, mistakes_of

TOP = pathlib.Path(sys.argv.pop(1))
TABLE = """| scene | best ODE space | predictive | collide | whole tick |
|---|---:|---:|---:|---:|
| some objects | 96.1 µs (quadtree) | 2.38 µs | 40 × | 1.9 × |
"""
GAS = "stepped.json; rows: gas 1,000"
TEXT = "Ten thousand of them take 9.2 µs per tick; the quadtree takes 5.5 ms, in `one_2.5` run of 3."
STILL = "means.csv; rows: still 10,000 @ predictive | still 10,000 @ quadtree; besides: 3"


class Figures(unittest.TestCase):
    def setUp(self):
        self.data = Data(TOP)

    def mistakes(self, block, comment):
        return list(mistakes_of(block, comment, self.data))

    def test_right_figures_pass(self):
        self.assertEqual(self.mistakes(TABLE, GAS), [])
        self.assertEqual(self.mistakes(TEXT, STILL), [])

    def test_each_wrong_cell_is_noticed(self):
        changes = {"96.1 µs": "96.2 µs", "2.38": "2.39", "40 ×": "–", "1.9 ×": "1.8 ×", "quadtree": "sap"}
        for right, wrong in changes.items():
            self.assertEqual(len(self.mistakes(TABLE.replace(right, wrong), GAS)), 1, wrong)

    def test_instructions_in_worlds_are_thousands(self):
        table = "| scene | n | ours | hash | best ODE / ours |\n|---|---|---|---|---|\n| shelves | 10,000 | {} | – | {} |"
        self.assertEqual(self.mistakes(table.format("148", "37.26"), "worlds_instructions.json"), [])
        self.assertEqual(len(self.mistakes(table.format("1,519", "6.60"), "worlds_instructions.json")), 2)

    def test_another_row_is_noticed(self):
        self.assertEqual(len(self.mistakes(TABLE, "stepped.json; rows: gas 10,000")), 4)
        self.assertEqual(len(self.mistakes(TABLE, "stepped.json; rows: gas 1,000 | gas 10,000")), 1)
        self.assertEqual(self.mistakes(TABLE, "stepped.json; rows: gas 7"), ['no row "gas 7" in stepped.json'])

    def test_an_unknown_column_file_or_option_is_noticed(self):
        self.assertEqual(self.mistakes(TABLE.replace("collide", "price"), GAS), ['no column "price" in stepped.json'])
        self.assertEqual(self.mistakes(TABLE, "steps.json"), ["there is no docs/results/steps.json"])
        self.assertEqual(len(self.mistakes(TABLE, GAS + "; colour: red")), 1)

    def test_a_column_can_be_of_a_second_file_and_a_row_need_not_be_in_it(self):
        table = TABLE.replace("whole tick", "collide + dCollide").replace("1.9 ×", "{}")
        both = "stepped.json, contact.json; rows: gas 1,000"
        self.assertEqual(self.mistakes(table.format("29 ×"), both), [])
        self.assertEqual(len(self.mistakes(table.format("28 ×"), both)), 1)
        for text, wrong in (("–", 0), ("29 ×", 1)):
            table_of_100 = table.format(text).replace("96.1 µs (quadtree)", "2.22 µs").replace("2.38", "0.24").replace("40", "9.4")
            self.assertEqual(len(self.mistakes(table_of_100, both.replace("1,000", "100"))), wrong)

    def test_a_text_has_the_named_figures_and_no_others(self):
        self.assertEqual(len(self.mistakes(TEXT.replace("9.2", "9.1"), STILL)), 2)
        self.assertEqual(len(self.mistakes(TEXT, STILL.replace("; besides: 3", ""))), 1)
        self.assertEqual(len(self.mistakes(TEXT, STILL.replace(" | ", " | still 10,000 @ hash | "))), 1)
        self.assertEqual(len(self.mistakes(TEXT, "means.csv; besides: 9.2, 5.5, 3")), 1)

    def test_a_reason_is_enough_where_there_are_no_data(self):
        self.assertEqual(self.mistakes(TABLE, "none: measured by hand"), [])
        self.assertEqual(len(self.mistakes(TABLE, "none: ")), 1)

    def test_tables_and_measured_texts_have_figures_and_names_have_none(self):
        self.assertTrue(has_figures(TABLE))
        self.assertTrue(has_figures(TEXT))
        self.assertFalse(has_figures("| option | meaning |\n|---|---|\n| `--n 10` | how many of `3` |\n"))
        self.assertFalse(has_figures("P16 is from 2026."))

    def test_a_comment_belongs_to_the_block_below_it(self):
        page = f"Text.\n\n<!-- figures: {GAS} -->\n{TABLE}\n```\n| 1 |\n```\n\n<!-- figures: none: x -->\n\nText."
        self.assertEqual([comment for _, comment, _ in blocks_of(page)], [None, GAS, None, ""])

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
