"""Files that come and go leave no holes in the memory of a server."""

from __future__ import annotations

import subprocess
import sys

import pytest

from rapidsim.server.memory import give_large_blocks_back

TRIED = """
from pathlib import Path
from rapidsim.server.memory import give_large_blocks_back

def resident_mb():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 2**20

give_large_blocks_back()
b"x" * 2**24  # An upload, after which the C library would keep what is smaller.
before_mb = resident_mb()
files, kept = [], []
for _ in range(200):
    files.append(b"x" * 300_000)
    kept.append(b"x" * 2_000)
del files
print(resident_mb() - before_mb)
"""


def test_what_is_free_is_given_back() -> None:
    if not give_large_blocks_back():
        pytest.skip("this C library has no such setting")
    done = subprocess.run((sys.executable, "-c", TRIED), capture_output=True, text=True, check=True)
    assert float(done.stdout) < 10.0
