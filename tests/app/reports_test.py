"""Numbers and figures of every command's report: in one run, since both look at the same reports.

usage: reports_test.py PROGRAM SOURCE_FOLDER
"""

import sys
import unittest

if __name__ == "__main__":
    # Named here: without names and a module unittest looks for tests in the working folder.
    unittest.main(module=None, argv=[sys.argv[0], "json_schema_test", "redesign_card_test", "report_figures_test"])
