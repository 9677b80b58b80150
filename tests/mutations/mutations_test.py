"""The table of faults fits the sources."""

import unittest

import faults as table
import run_mutations


class TableTest(unittest.TestCase):
    def test_each_fault_can_be_planted(self):
        for fault in table.FAULTS:
            with self.subTest(fault.name):
                text = (run_mutations.TOP / fault.file).read_text()
                self.assertNotEqual(run_mutations.planted(text, fault), text)

    def test_names_are_unique(self):
        names = [fault.name for fault in table.FAULTS]
        self.assertEqual(len(names), len(set(names)))

    def test_the_suites_of_likely_tests_are_known(self):
        for fault in table.FAULTS:
            for suite, _ in fault.first:
                self.assertIn(suite, run_mutations.SUITES, fault.name)


if __name__ == "__main__":
    unittest.main()
