"""Runs the program on a system that does not give it something."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from program import CAROM, SOURCE, ProgramTest, run


class FaultyTest(ProgramTest):
    """With faults.c before the libraries."""

    @classmethod
    def setUpClass(cls):
        if b"__asan_init" in pathlib.Path(CAROM).read_bytes() or b"__tsan_init" in pathlib.Path(CAROM).read_bytes():
            raise unittest.SkipTest("sanitizers must be the first library")
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.faults = pathlib.Path(folder.name) / "faults.so"
        compiler = next(c for c in ("cc", "gcc", "clang") if shutil.which(c))
        subprocess.run([compiler, "-shared", "-fPIC", "-o", cls.faults, SOURCE / "tests/cli/faults.c", "-ldl"], check=True)

    def short_of(self, words, **faults):
        return run(*words, text=False, env={**os.environ, "LD_PRELOAD": str(self.faults), **faults})
