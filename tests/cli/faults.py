"""Runs the program on a system that does not give it something."""

import os
import unittest

from program import ProgramTest, run


class FaultyTest(ProgramTest):
    """With tests/faults/faults.c before the libraries."""

    @classmethod
    def setUpClass(cls):
        cls.faults = os.environ.get("CAROM_FAULTS")
        if not cls.faults:
            raise unittest.SkipTest("sanitizers must be the first library")

    def short_of(self, words, **faults):
        return run(*words, text=False, env={**os.environ, "LD_PRELOAD": self.faults, **faults})
