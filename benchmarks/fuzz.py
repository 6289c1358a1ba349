"""Throw what nobody would write at rapidsim: `python benchmarks/fuzz.py WHAT`.

`programs` makes whole programs from the grammar and the signatures of the library, most of them
without an error, and sends each through `check` with reach, `run` within limits and `run` cut at a
random instant; one in fifty with reports, plots and recordings. What fails is kept in
`fuzz-failures`, once a cause and as small as it gets, with the command and the traceback. Clean
programs must also keep the laws of `fuzzing/laws.py`. `texts` throws bad texts at `check`. `system`
lets each call of a command that reads or writes fail, one after the other; `times` calls each
routine with odd arguments, and looks at the clock; `memory` measures what small files take; `files`
damages all kinds of files (`python -m fuzzing.guided` does so by what code they reach). `nightly`
is `programs` in several processes until it is stopped: it keeps what is new and prints counts.

A program follows from seed and number alone: `--begin 4711 --count 1` makes one again.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Mapping
from types import MappingProxyType

from fuzzing.injections import fuzz_system
from fuzzing.memory import fuzz_memory
from fuzzing.readers import fuzz_files
from fuzzing.report import fuzz_nightly, fuzz_programs
from fuzzing.texts import fuzz_texts
from fuzzing.times import fuzz_times

_CAMPAIGNS: Mapping[str, Callable[[argparse.Namespace], bool]] = MappingProxyType(
    {
        "programs": lambda asked: fuzz_programs(
            asked.seed, range(asked.begin, asked.begin + asked.count)
        ),
        "nightly": lambda asked: fuzz_nightly(asked.seed, asked.begin, asked.processes),
        "texts": lambda asked: fuzz_texts(asked.count, asked.seed),
        "files": lambda asked: fuzz_files(asked.count, asked.seed),
        "system": lambda asked: fuzz_system(),
        "times": lambda asked: fuzz_times(),
        "memory": lambda asked: fuzz_memory(),
    }
)
"""Campaigns by name; they return whether nothing failed."""


def main() -> None:
    """Fuzz, print, and fail if anything failed."""
    # What was found before is no answer here.
    os.environ["RAPIDSIM_NO_CACHE"] = "1"
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=tuple(_CAMPAIGNS))
    parser.add_argument("--count", type=int, default=20_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--begin", type=int, default=0, help="the number of the first program")
    parser.add_argument("--processes", type=int, default=2, help="of nightly")
    asked = parser.parse_args()
    sys.exit(not _CAMPAIGNS[asked.what](asked))


if __name__ == "__main__":
    main()
