"""Each kind of file that people hand over, damaged: its reader returns or refuses it in words.

`python -m fuzzing.guided all 40000` looks for such files by what code they reach.
"""

import pytest
from fuzzing.readers import READERS, read_damaged
from laws import cases


@pytest.mark.parametrize("kind", READERS)
def test_a_damaged_file(kind: str) -> None:
    read_damaged(kind, cases(2000), 5)
