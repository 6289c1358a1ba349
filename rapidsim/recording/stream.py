"""Recordings as files that appear whole, or not at all with a clear message."""

from __future__ import annotations

import uuid
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path

import rerun as rr
import rerun.blueprint as rrb
from rerun.chunk import RrdReader

from rapidsim.output_files import unwritten, whole_file

with suppress(ImportError):
    # Arrow imports it in C with the first texts, where a Ctrl-C is lost; here it is not.
    import_module("dateutil.relativedelta")

APPLICATION = "rapidsim"
_WRITER_FAILED = ("File-writer thread", "Failed to write")
"""Error texts of rerun for a writer that stopped earlier, and for a failure in the call itself."""

ROWS_AT_ONCE = 1 << 14
"""Number of rows to send at once: rerun takes several times their memory to write them."""
_PATIENCE_S = 30.0
"""Time [s] within which a working writer writes more data."""


class _FileStream(rr.RecordingStream):
    """Stream into a file that does not wait for a writer that has stopped.

    On a full disk rerun's writer may stop silently, and its own wait for it never ends.
    """

    def __init__(self, file: Path, recording_id: uuid.UUID) -> None:
        super().__init__(APPLICATION, recording_id=recording_id, send_properties=False)
        self._file = file

    def flush(self, *, timeout_sec: float = 1e38) -> None:
        """Write the remaining data.

        Raises:
            RuntimeError: If they cannot be written.
        """
        written, before = self._file.stat().st_size, -1
        while written > before:
            try:
                return super().flush(timeout_sec=min(timeout_sec, _PATIENCE_S))
            except RuntimeError as error:
                if any(words in str(error) for words in _WRITER_FAILED):
                    raise
            written, before = self._file.stat().st_size, written
        # At the end of the process rerun would wait for that writer, too, and for ever.
        rr.unregister_shutdown()
        raise RuntimeError(f"{_WRITER_FAILED[0]} has stopped")


@contextmanager
def recording_file(
    path: Path, recording_id: uuid.UUID, layout: rrb.Blueprint, *, view: bool = False
) -> Iterator[rr.RecordingStream]:
    """Provide a stream that is saved to a file.

    Args:
        path: Target file, which appears only when the block has ended without an error.
        recording_id: Id by which the viewer merges equal recordings.
        layout: Layout of the viewer.
        view: Whether a viewer that listens receives the data, too.

    Raises:
        InputError: If the file cannot be written.
    """
    with whole_file(path) as temporary, _strictly():
        with (
            _said_by_rerun(path),
            _FileStream(Path(temporary), recording_id) as stream,
        ):
            viewers = [rr.GrpcSink()] if view else []
            stream.set_sinks(rr.FileSink(temporary), *viewers, default_blueprint=layout)
            stream.set_log_time_enabled(False)
            stream.set_log_tick_enabled(False)
            yield stream
        _require_complete(temporary, path)


@contextmanager
def _said_by_rerun(path: Path) -> Iterator[None]:
    """Convert errors of rerun's writer to our messages; rerun prints its own on stderr."""
    try:
        yield
    except RuntimeError as error:
        if not any(words in str(error) for words in _WRITER_FAILED):
            raise
        raise unwritten(path, "the disk is full, or the file too large for it") from error


def _require_complete(temporary: Path, path: Path) -> None:
    """Raise for a file without its end: rerun writes in the background and may fail unseen."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            RrdReader(str(temporary)).store()
    except (RuntimeError, ValueError) as error:
        raise unwritten(path, "the end of the recording could not be written") from error


@contextmanager
def _strictly() -> Iterator[None]:
    """Let rerun raise where it would warn and drop data."""
    before = rr.strict_mode()
    rr.set_strict_mode(True)
    try:
        yield
    finally:
        rr.set_strict_mode(before)
