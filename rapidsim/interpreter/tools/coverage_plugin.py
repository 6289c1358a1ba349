"""A plugin with which coverage.py counts the lines of RAPID modules.

In coverage's configuration, `plugins =` takes the dotted name of this module. Routines run as
Python code under the name of their RAPID file, so coverage sees RAPID lines. The plugin adds the
information that coverage lacks: which files to measure, how to decode them, and which lines are
executable. No other file imports coverage, which only developers have.

Source: coverage.py documentation, "Plug-in classes".
"""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator
from functools import cached_property
from pathlib import Path
from types import FrameType

from coverage import CoveragePlugin, FileReporter, FileTracer
from coverage.exceptions import CoverageWarning, NoSource
from coverage.plugin import CodeRegion
from coverage.plugin_support import Plugins
from coverage.types import TConfigurable, TConfigValueIn, TSourceTokenLines

from rapidsim.diagnostics import Source
from rapidsim.files import decode
from rapidsim.interpreter.tools.executable_lines import RoutineLines, routine_lines
from rapidsim.module_files import MODULE_SUFFIXES
from rapidsim.syntax.parser import parse

_MEASURED = [f"*{form(suffix)}" for suffix in MODULE_SUFFIXES for form in (str.lower, str.upper)]


def coverage_init(registry: Plugins, options: dict[str, TConfigValueIn]) -> None:
    """Register the plugin; called by coverage with the plugin's section of its options."""
    plugin = RapidPlugin()
    registry.add_configurer(plugin)
    registry.add_file_tracer(plugin)


class RapidPlugin(CoveragePlugin):
    """Answers coverage's questions about RAPID modules."""

    def configure(self, config: TConfigurable) -> None:
        """Set the options that RAPID needs unless the user has set them.

        Only RAPID modules are measured by default, without `source` and `include`. Of the tracers
        only the C tracer supports plugins.
        """
        chosen = ("run:source", "run:source_pkgs", "run:source_dirs", "run:include")
        if not any(config.get_option(option) for option in chosen):
            config.set_option("run:include", _MEASURED)
        if config.get_option("run:core") is None:
            config.set_option("run:core", "ctrace")
        if config.get_option("run:branch"):
            warnings.warn(
                "rapidsim measures lines of RAPID, no branches: the count of branches stays 0",
                CoverageWarning,
                stacklevel=2,
            )

    def file_tracer(self, filename: str) -> FileTracer | None:
        """Claim RAPID modules."""
        return _Tracer(filename) if _is_module(filename) else None

    def file_reporter(self, filename: str) -> FileReporter:
        """Describe a measured module."""
        return RapidReporter(filename)

    def find_executable_files(self, src_dir: str) -> Iterator[str]:
        """Find the modules of a `source` folder, so that modules that never run count too."""
        for path in sorted(Path(src_dir).rglob("*")):
            if path.is_file() and _is_module(path.name):
                yield str(path)


class _Tracer(FileTracer):
    """Tracer of the code of a module."""

    def __init__(self, filename: str) -> None:
        self._filename = filename

    def source_filename(self) -> str:
        return self._filename

    def line_number_range(self, frame: FrameType) -> tuple[int, int]:
        return frame.f_lineno, frame.f_lineno


class RapidReporter(FileReporter):
    """One module in a report: its text, its executable lines, its routines."""

    def source(self) -> str:
        """Return the text with RAPID's line numbers, for any encoding and line endings."""
        source = self._source
        lines = [source.line(number) for number in range(1, len(source.line_starts) + 1)]
        if not lines[-1]:
            lines.pop()
        # Python would end lines at form feeds and other characters that do not end RAPID lines.
        return "".join(" ".join(line.splitlines()) + "\n" for line in lines)

    def source_token_lines(self) -> TSourceTokenLines:
        """Return the lines for a web page; only comments are marked."""
        for line in self.source().split("\n")[:-1]:
            is_comment = line.lstrip().startswith("!")
            yield [("com" if is_comment else "txt", line)]

    def lines(self) -> set[int]:
        """The executable lines."""
        return {line for routine in self._routines for line in routine.executable}

    def translate_lines(self, lines: Iterable[int]) -> set[int]:
        """Map executed lines to reported ones, without headers, which execute once on loading."""
        return self.lines() & set(lines)

    def code_regions(self) -> list[CodeRegion]:
        """The routines, for reports by function."""
        return [
            CodeRegion("function", r.name, r.first, set(range(r.first, r.last + 1)))
            for r in self._routines
        ]

    def code_region_kinds(self) -> list[tuple[str, str]]:
        """Return the term for routines in reports."""
        return [("function", "routines")]

    @cached_property
    def _source(self) -> Source:
        try:
            data = Path(self.filename).read_bytes()
        except OSError as error:
            raise NoSource(f"No source for code: '{self.filename}': {error.strerror}") from error
        text, _ = decode(data)
        return Source(self.filename, text)

    @cached_property
    def _routines(self) -> tuple[RoutineLines, ...]:
        return routine_lines(parse(self._source).file)


def _is_module(filename: str) -> bool:
    return filename.lower().endswith(MODULE_SUFFIXES)
