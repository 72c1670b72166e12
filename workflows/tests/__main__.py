"""Runs the tests of both workflows side by side: most of their time goes into starting the engine."""

import subprocess
import sys

tests = [subprocess.Popen([sys.executable, "-m", "unittest", name]) for name in ("test_estimate", "test_train")]
sys.exit(any([test.wait() for test in tests]))
