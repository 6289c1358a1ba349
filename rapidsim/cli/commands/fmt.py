"""`rapidsim fmt`: lay out RAPID, in place, as a difference, or only to know whether it is."""

from __future__ import annotations

from collections.abc import Sequence

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.declared import argument, option, options_of
from rapidsim.cli.terminal import current_terminal, echo, print_result, terminal_options
from rapidsim.cli.tools.differences import difference
from rapidsim.diagnostics import Diagnostic, Severity, Source
from rapidsim.export.edited_files import write_edits
from rapidsim.files import SourceFile
from rapidsim.module_files import STANDARD_INPUT, read_tasks
from rapidsim.report.findings.merging import merged
from rapidsim.report.findings.text import concise
from rapidsim.syntax.formatting import Style, WordCase, formatting_edits
from rapidsim.syntax.parser import parse
from rapidsim.text_edits import TextEdit, edited_text
from rapidsim.values import value_class

_LARGEST_INDENT = 8


@value_class(frozen=True, slots=True)
class FmtOptions:
    """Modules to lay out, and the style."""

    paths: tuple[str, ...] = argument("PATH...", nargs=-1, required=True)
    check: bool = option("--check", is_flag=True, help="Change nothing; exit 1 if fmt would.")
    diff: bool = option("--diff", is_flag=True, help="Show what fmt would change; change nothing.")
    indent: int | None = option(
        "--indent",
        type=click.IntRange(1, _LARGEST_INDENT),
        metavar="N",
        help="Spaces per level.  [default: what the file uses most, else 4]",
    )
    words: str = option(
        "--words",
        type=click.Choice([case.value for case in WordCase]),
        default=WordCase.UPPER.value,
        show_default=True,
        help="Reserved words in capitals, or as they are written.",
    )


@click.command()
@options_of(FmtOptions)
@terminal_options
def fmt(options: FmtOptions) -> int:
    """Lay out RAPID modules: indentation, reserved words, trailing white space.

    PATH is a module, a .pgf program file, a folder or a backup; - reads standard input and prints
    the result. Comments, line breaks, alignment within lines and line ends are kept. A file with
    syntax errors is left unchanged, and its errors are shown.
    """
    terminal = current_terminal()
    files = _files(options.paths)
    style = Style(options.indent, WordCase(options.words))
    edits: dict[str, tuple[TextEdit, ...]] = {}
    errors: list[Diagnostic] = []
    for file in files:
        found = [
            one
            for one in parse(Source(file.name, file.text)).diagnostics
            if one.severity is Severity.ERROR
        ]
        errors += found
        if not found and (needed := formatting_edits(file.text, style)):
            edits[file.name] = needed
    _apply(edits, files, options)
    if errors:
        echo(
            concise(merged(errors), terminal.palette), err=True, nl=False, palette=terminal.palette
        )
    if not terminal.quiet and options.paths != ("-",):
        broken = len({error.span.file for error in errors if error.span is not None})
        echo(_summary(len(edits), broken, len(files), options), err=True)
    is_only_looked_at = options.check or options.diff
    return ExitCode.FINDINGS if errors or (edits and is_only_looked_at) else ExitCode.CLEAN


def _files(paths: Sequence[str]) -> tuple[SourceFile, ...]:
    """The files of all tasks, each once."""
    by_name = {file.name: file for task in read_tasks(paths) for file in task.files}
    return tuple(by_name.values())


def _apply(
    edits: dict[str, tuple[TextEdit, ...]], files: Sequence[SourceFile], options: FmtOptions
) -> None:
    """Write the changed files, or show the changes."""
    if options.diff:
        echo(difference(edits, files), nl=False)
    elif options.check:
        for name in edits:
            echo(f"{name} is not laid out")
    else:
        write_edits(
            {name: of for name, of in edits.items() if name != STANDARD_INPUT},
            files,
            subject="changes of the layout",
        )
        for file in files:
            if file.name == STANDARD_INPUT:
                print_result(edited_text(file.text, edits.get(file.name, ())))


def _summary(changed: int, broken: int, total: int, options: FmtOptions) -> str:
    """Summary: `2 files changed, 1 left as it is (syntax errors), 4 unchanged`."""
    would = "would be changed" if options.check or options.diff else "changed"
    left = f"left as {'they are' if broken > 1 else 'it is'} (syntax errors)"
    counts = [(changed, would), (broken, left), (total - changed - broken, "unchanged")]
    (first, what), *others = [(count, text) for count, text in counts if count]
    return ", ".join(
        [f"{first} file{'s' * (first != 1)} {what}", *(f"{count} {text}" for count, text in others)]
    )
