"""Rows of the hard cases that are measured by themselves: scripts/accuracy_rows.py."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["CAROM_SOURCE_DIR"])

PAGE = """Before.
<!-- hard_cases:begin -->
| | Case | Reference | exact | Bullet |
|---|---|---|---|---|
| H1 | drop | a | **1e-15**<br>1.0e-06 | 1e-2<br>2.0e-03 |
| H3 | rolls | b | **0**<br>1.0e-06 | 3e-2<br>1.0e-03 |
<!-- hard_cases:end -->
<!-- hard_cases_rows:begin -->
<!-- hard_cases_rows:end -->
<!-- hard_cases_failures:begin -->
- H1, drop. Bullet: old.
- H3, rolls. Bullet: old.
<!-- hard_cases_failures:end -->
After.
"""

MADE = """| | Case | Reference | exact |
|---|---|---|---|
| H1 | drop | a | **1e-15**<br>2.0e-06 |
| H2 | falls | c | **0**<br>5.0e-06 |
"""


class Rows(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "accuracy").mkdir()
        (self.folder / "accuracy.md").write_text(PAGE)
        (self.folder / "accuracy/hard_cases.csv").write_text("case,error\nH1,1\nH3,3\n")
        (self.folder / "hard_cases.md").write_text(MADE)
        (self.folder / "hard_cases_failures.md").write_text("- H1, drop. exact: new.\n")
        (self.folder / "hard_cases.csv").write_text("case,error\nH1,9\nH2,2\n")

    def merge(self):
        subprocess.run([sys.executable, SOURCE / "scripts/accuracy_rows.py", "H2", "H1", self.folder, "there",
                        self.folder], check=True)
        return (self.folder / "accuracy.md").read_text()

    def test_new_rows_join_the_old_ones_in_order(self):
        page = self.merge()
        rows = [line for line in page.splitlines() if line.startswith("| H")]
        self.assertEqual(rows, [*PAGE.splitlines()[4:5], "| H2 | falls | c | **0**<br>5.0e-06 | not run |",
                                *PAGE.splitlines()[5:6]])
        self.assertIn("- H1, drop. Bullet: old.\n- H3, rolls. Bullet: old.\n", page)
        self.assertTrue(page.startswith("Before.\n") and page.endswith("After.\n"))
        self.assertEqual((self.folder / "accuracy/hard_cases.csv").read_text(), "case,error\nH1,1\nH2,2\nH3,3\n")

    def test_the_page_says_how_far_costs_compare(self):
        self.assertIn("once (there), and are not in the chart. H1, measured in the same run, cost 2.0 times",
                      self.merge())

    def test_doing_it_again_changes_nothing(self):
        self.assertEqual(self.merge(), self.merge())


if __name__ == "__main__":
    unittest.main()
