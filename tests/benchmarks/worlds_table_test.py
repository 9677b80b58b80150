"""Counts of worlds_table.py, in one small world of each kind.

Usage: worlds_table_test.py BUILD, the folder of the build.
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).with_name("worlds_table.py")


def run(*arguments):
    done = subprocess.run([sys.executable, "-B", SCRIPT, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


class Counts(unittest.TestCase):
    build = None

    def test_two_runs_count_the_same(self):
        with tempfile.TemporaryDirectory() as folder:
            first = pathlib.Path(folder) / "first.json"
            run("--build", self.build, "--worlds", "chain,many:2,teleport:10", "--json", first)
            records = json.loads(first.read_text())
            self.assertEqual(len(records), 3 * 5)
            for record in records:
                self.assertGreater(record["sum"], 0, record)
                self.assertTrue(record["version"])
            pairs = {(record["scene"], record["pairs"]) for record in records if record["space"] != "sap"}
            self.assertEqual(len(pairs), 3, "the spaces report the same pairs")
            again = run("--build", self.build, "--worlds", "chain", "--spaces", "predictive-box", "--against", first)
            self.assertIn("1.0000", again)
            self.assertEqual(len(run("--table", first).splitlines()), 2 + 3 + 2)

    def test_contacts_cost_more(self):
        with tempfile.TemporaryDirectory() as folder:
            sums = []
            for more in ([], ["--contacts"]):
                file = pathlib.Path(folder) / "counts.json"
                table = run("--build", self.build, "--worlds", "chain", "--spaces", "predictive-box", "--json", file, *more)
                self.assertRegex(table, r"\| chain \| 1 \| \d+\.\d \| – \| – \| – \| – \| – \|")
                sums.append(json.loads(file.read_text())[0]["sum"])
            self.assertGreater(sums[1], sums[0])


if __name__ == "__main__":
    Counts.build = sys.argv.pop()
    unittest.main()
