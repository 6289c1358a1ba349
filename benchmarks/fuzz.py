"""Throw what nobody would write at rapidsim: `python benchmarks/fuzz.py WHAT`.

`programs` makes whole programs from the grammar and the signatures of the library, most of them
without an error, and sends each through `check` with reach, `run` within limits and `run` cut at a
random instant; one in fifty with reports, plots and recordings. What fails is kept in
`fuzz-failures`, once a cause and as small as it gets, with the command and the traceback. Clean
programs must also keep the laws of `fuzzing/laws.py`. `texts` throws bad texts at `check`. `system`
lets each call of a command that reads or writes fail, one after the other; `times` calls each
routine with odd arguments, and looks at the clock. `nightly` is `programs` in several processes
until it is stopped: it keeps what is new and prints counts.

A program follows from seed and number alone: `--begin 4711 --count 1` makes one again.
"""

from __future__ import annotations

import argparse
import os
import sys

from fuzzing.injections import fuzz_system
from fuzzing.report import fuzz_nightly, fuzz_programs
from fuzzing.texts import fuzz_texts
from fuzzing.times import fuzz_times


def main() -> None:
    """Fuzz, print, and fail if anything failed."""
    # What was found before is no answer here.
    os.environ["RAPIDSIM_NO_CACHE"] = "1"
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=("programs", "nightly", "texts", "system", "times"))
    parser.add_argument("--count", type=int, default=20_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--begin", type=int, default=0, help="the number of the first program")
    parser.add_argument("--processes", type=int, default=2, help="of nightly")
    asked = parser.parse_args()
    if asked.what == "texts":
        sound = fuzz_texts(asked.count, asked.seed)
    elif asked.what == "times":
        sound = fuzz_times()
    elif asked.what == "nightly":
        sound = fuzz_nightly(asked.seed, asked.begin, asked.processes)
    elif asked.what == "system":
        sound = fuzz_system()
    else:
        sound = fuzz_programs(asked.seed, range(asked.begin, asked.begin + asked.count))
    sys.exit(not sound)


if __name__ == "__main__":
    main()
