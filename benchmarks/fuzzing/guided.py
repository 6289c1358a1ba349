"""Coverage-guided damage of the files that people hand over.

    python -m fuzzing.guided KIND|all COUNT [OPTION OF LIBFUZZER...]

Needs atheris, which has no wheel for all systems. What reaches new code is kept in `fuzz-corpus`,
which `-merge=1` shrinks; what a reader does not refuse in words, in `fuzz-failures`. Of `all` kinds
the first byte chooses one; STEP, which a process of its own reads, is not among them.
"""

from __future__ import annotations

import hashlib
import sys
import tempfile
import traceback
from pathlib import Path

CORPUS = Path("fuzz-corpus")
ALL = "all"
_MOST_BYTES = 4000
_ROOMS = (
    *("files", "module_files", "pack_and_go", "backinfo", "collisions.meshes", "station"),
    *("json_records", "applications", "jobs.inputs", "jobs.cache", "jobs.checking.baseline"),
    *("motion.waypoints", "motion.robot.urdf", "server.journal", "server.replay", "syntax"),
)
"""What is watched: the readers, and what they are made of."""


def main() -> None:
    """Fuzz one kind of file, or all."""
    kind, count, *options = sys.argv[1:]
    import atheris  # noqa: PLC0415 - Optional package.

    with atheris.instrument_imports(include=[f"rapidsim.{room}" for room in _ROOMS]):
        from fuzzing.readers import (  # noqa: PLC0415 - With instruments.
            READERS,
            Tried,
            keep,
            signature_of,
        )

    # What another process reads shows no code that it reaches, and takes a thousand times as long.
    quick = [name for name, reader in READERS.items() if reader.cost == 1]
    kinds = quick if kind == ALL else [kind]
    corpus = CORPUS / kind.replace(" ", "_")
    corpus.mkdir(parents=True, exist_ok=True)
    readers = []
    for number, name in enumerate(kinds):
        readers.append(Tried(READERS[name], Path(tempfile.mkdtemp(prefix="fuzz-"))))
        for seed in READERS[name].seeds:
            data = bytes([number]) + seed
            (corpus / hashlib.sha256(data).hexdigest()[:16]).write_bytes(data)
    known: set[str] = set()

    def read(data: bytes) -> None:
        if not data:
            return
        number = data[0] % len(readers)
        try:
            readers[number](data[1:])
        except Exception as error:
            signature = signature_of(kinds[number], error)
            if signature in known:
                return
            known.add(signature)
            keep(signature, data[1:])
            print(f"{signature}\n{traceback.format_exc(limit=-4)}", flush=True)

    arguments = [f"-runs={count}", f"-max_len={_MOST_BYTES}", "-timeout=20", "-rss_limit_mb=3000"]
    atheris.Setup([sys.argv[0], str(corpus), *arguments, *options], read)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
