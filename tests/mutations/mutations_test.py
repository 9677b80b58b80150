"""The table of faults fits the sources, and what the script reads out of GoogleTest's output is right."""

import collections
import pathlib
import tempfile
import unittest

import faults as table
import run_mutations


def fault_with(find, replace="", equivalent=""):
    return table.Fault("name", "near", "file", find, replace, equivalent=equivalent)


class TableTest(unittest.TestCase):
    def test_each_fault_can_be_planted(self):
        for fault in table.FAULTS:
            with self.subTest(fault.name):
                text = (run_mutations.TOP / fault.file).read_text()
                self.assertNotEqual(run_mutations.planted(text, fault), text)

    def test_there_are_enough_for_each_stage(self):
        self.assertGreaterEqual(len(table.FAULTS), 40)
        stages = collections.Counter(fault.stage for fault in table.FAULTS)
        self.assertEqual(set(stages), set(table.STAGES))
        self.assertGreaterEqual(min(stages.values()), 4)

    def test_names_are_unique(self):
        names = [fault.name for fault in table.FAULTS]
        self.assertEqual(len(names), len(set(names)))

    def test_the_suites_of_likely_tests_are_known(self):
        for fault in table.FAULTS:
            for suite, _ in fault.first:
                self.assertIn(suite, run_mutations.SUITES, fault.name)


class ScriptTest(unittest.TestCase):
    def test_a_text_that_is_missing_or_there_twice_is_refused(self):
        for text in ("b", "a a"):
            with self.assertRaises(run_mutations.Failure):
                run_mutations.planted(text, fault_with("a"))
        self.assertEqual(run_mutations.planted("x a y", fault_with("a", "b")), "x b y")

    def test_the_first_test_that_failed_is_named(self):
        output = "[ RUN      ] A.b\n[       OK ] A.b (0 ms)\n[ RUN      ] C.d/1\n[  FAILED  ] C.d/1, where ... (1 ms)\n"
        self.assertEqual(run_mutations.first_failure(output), "C.d/1")

    def test_a_test_that_crashed_is_named(self):
        self.assertEqual(run_mutations.first_failure("[ RUN      ] A.b\n[       OK ] A.b (0 ms)\n[ RUN      ] C.d\n"), "C.d")
        self.assertEqual(run_mutations.first_failure(""), "the start of the program")

    def test_a_fault_is_as_expected_when_it_is_noticed_or_equivalent(self):
        for test, reason, expected in (("A.b", "", True), ("", "", False), ("", "why", True), ("A.b", "why", False)):
            result = run_mutations.Result(fault_with("a", equivalent=reason), test, 0)
            self.assertEqual(result.as_expected, expected, (test, reason))

    def test_an_unknown_name_is_refused(self):
        with self.assertRaises(run_mutations.Failure):
            run_mutations.chosen_faults(["no_such_fault"], [])

    def test_a_copy_is_brought_up_to_date_and_keeps_the_times_of_the_rest(self):
        with tempfile.TemporaryDirectory() as folder:
            tree = run_mutations.Tree(pathlib.Path(folder), [])
            tree.update()
            copy = pathlib.Path(folder) / "CMakeLists.txt"
            before = copy.stat().st_mtime_ns
            tree.update()
            self.assertEqual(copy.stat().st_mtime_ns, before)
            copy.write_text("planted")
            (pathlib.Path(folder) / "removed.cpp").touch()
            tree.update()
            self.assertFalse((pathlib.Path(folder) / "removed.cpp").exists())
            self.assertEqual(copy.read_bytes(), (run_mutations.TOP / "CMakeLists.txt").read_bytes())


if __name__ == "__main__":
    unittest.main()
