"""Numbers computed from large inputs, stored by the content that they are of.

An entry has the fingerprint of its own bytes in front: one that is damaged counts as missing.
"""

from __future__ import annotations

import sys
import sysconfig
from hashlib import blake2b
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from rapidsim.jobs.cache.fingerprints import fingerprint, of_folder
from rapidsim.jobs.cache.result_store import ResultStore
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.frames.transform import Array

_CODE = Path(__file__).parents[2] / "collisions"
"""Code that computes the numbers."""
_SIZE = 20
"""Size of a fingerprint [bytes]."""


@value_class(frozen=True, slots=True)
class NumberStore:
    """Numbers by content, in a store of results."""

    store: ResultStore

    def numbers(self, content: bytes) -> Array | None:
        """Return the numbers (k,) stored for a content; None if there are none."""
        data = self.store.data(self._key(content))
        if data is None or _digest(data[_SIZE:]) != data[:_SIZE]:
            return None
        import numpy as np

        try:
            found = np.load(BytesIO(data[_SIZE:]), allow_pickle=False)
        except (ValueError, OSError, EOFError):
            return None
        return found if found.dtype == np.float64 and found.ndim == 1 else None

    def keep_numbers(self, content: bytes, numbers: Array) -> None:
        """Store numbers (k,) computed for a content."""
        import numpy as np

        stream = BytesIO()
        np.save(stream, numbers, allow_pickle=False)
        data = stream.getvalue()
        self.store.keep_data(self._key(content), _digest(data) + data)
        self.store.tidy()

    def _key(self, content: bytes) -> str:
        import numpy as np

        machine = sys.version, sysconfig.get_platform(), np.__version__
        return fingerprint(of_folder(_CODE), machine, blake2b(content).digest())


def _digest(data: bytes) -> bytes:
    return blake2b(data, digest_size=_SIZE).digest()
