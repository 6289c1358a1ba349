"""Programs as agents send them: texts by file name, in a folder that lasts for one call."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory

from rapidsim.files import InputError
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.module_files import MODULE_SUFFIXES
from rapidsim.station.station import FILE_NAME
from rapidsim.values import value_class

MOST_FILES = 200
LARGEST = 5_000_000
"""Characters of all files."""


@value_class(frozen=True, slots=True)
class SentProgram:
    """A program in a temporary folder."""

    folder: Path
    request: RunRequest

    def text(self, text: str) -> str:
        """A message with files named as the agent named them."""
        return text.replace(f"{self.folder}/", "").replace(f"{self.folder}\\", "")


@contextmanager
def sent_program(
    files: Mapping[str, str], robot: str | None, station: str | None, *, strict: bool
) -> Iterator[SentProgram]:
    """Lay out a program for one call; nothing else of the disk is read.

    Args:
        files: Texts of modules by file name; a name may have folders.
        robot: Name of an arm of the catalogue.
        station: Text of a station file.
        strict: Whether what is unknown fails, too.

    Raises:
        InputError: If there are no files, or too many, or a name leads elsewhere.
    """
    if not files:
        raise InputError("`files` is empty", "send an object of file name to text")
    if len(files) > MOST_FILES or sum(map(len, files.values())) > LARGEST:
        raise InputError(f"at most {MOST_FILES} files and {LARGEST:,} characters are accepted")
    if robot is not None and robot.lower().endswith(".urdf"):
        raise InputError("a robot is named as in the catalogue; files are not read")
    with TemporaryDirectory(prefix="rapidsim-") as name:
        folder = Path(name).resolve()
        for file, text in files.items():
            place = folder / _inside(file)
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_text(text, encoding="utf-8", newline="")
        home = folder / "HOME-of-the-run"
        home.mkdir()
        # A station of its own: that of a folder above would be found otherwise.
        (folder / FILE_NAME).write_text(station or "", encoding="utf-8")
        request = RunRequest(
            paths=(str(folder),),
            robot=robot,
            station=str(folder / FILE_NAME),
            strict=strict,
            home=str(home),
            max_time_s=600.0,
            max_wall_s=20.0,
        )
        yield SentProgram(folder, request)


def _inside(file: str) -> PurePosixPath:
    path = PurePosixPath(file.replace("\\", "/"))
    if path.is_absolute() or ".." in path.parts or ":" in file or not path.name:
        raise InputError(f"`{file}` is no name of a file to send", "use names such as `Main.mod`")
    if path.suffix.lower() not in (*MODULE_SUFFIXES, ".cfg", ".pgf", ".txt", ".xml"):
        suffixes = ", ".join(MODULE_SUFFIXES)
        raise InputError(f"`{file}` is no RAPID file", f"RAPID modules end in {suffixes}")
    return path
