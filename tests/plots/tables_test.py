"""The tables of docs/plots/tables.py, from docs/results."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "docs" / "plots" / "tables.py"


def contact(scene, space, sum_us, calls):
    return {
        "table": "contact",
        "scene": scene,
        "n": 1000,
        "space": space,
        "collide_us": sum_us / 4,
        "dcollide_us": sum_us * 3 / 4,
        "sum_us": sum_us,
        "calls_per_tick": calls,
        "touching_per_tick": 2,
        "calls_per_touching": calls / 2,
        "best_ode_ratio": 400 / sum_us,
        "best_ode_ratio_of_wholes": 1.5,
        "box_ratio": 100 / sum_us,
    }


def tables_of(records):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "results.json"
        file.write_text(json.dumps(records), encoding="utf-8")
        done = subprocess.run([sys.executable, str(SCRIPT), str(file)], capture_output=True, text=True, check=True)
    return done.stdout


class Tables(unittest.TestCase):
    def test_contact_is_beside_the_best_ode_space_and_beside_boxes(self):
        text = tables_of([
            contact("mix", "predictive-box", 100, 190),
            contact("mix", "predictive-shape", 50, 4),
            contact("mix", "sap", 400, 190),
            contact("mix", "quadtree", 500, 190),
        ])
        self.assertIn("| mix | 1,000 | 400 (sap) | 25.0 + 75.0 = 100 | 12.5 + 37.5 = 50.0 | 4.00 | 8.00 | 2.00 | 1.50 | 190 | "
                      "4.00 | 2.00 | 2.00 |", text)


if __name__ == "__main__":
    unittest.main()
