"""Whatever a page shows is executed and prints what the page says; `docs_snippets` says how."""

import configparser
import contextlib
import io
import json
import os
import re
import shlex
import shutil
import sys
import tomllib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import click
import pytest
from command_line import call
from docs_snippets import PAGES, ROOT, Edit, Snippet, commands, printed_as, snippets
from matplotlib.figure import Figure

import rapidsim
from rapidsim.cli.group import commands as command_group
from rapidsim.colours import Colours
from rapidsim.diagnostics import Source
from rapidsim.plots import followed_pictures, posture_pictures
from rapidsim.plots import write as plots_write
from rapidsim.plots.write import write_pictures
from rapidsim.station.read import read_station

STAND_INS = ROOT / "tests" / "docs" / "stand_ins"
"""Files and folders by the names that pages use for the reader's own."""
QUICK = ("frames", "matrix")
CHANGED = {
    "[[550,400,350]": "[[550,400.5,350]",
    "MoveJ pBefore, v1000": "MoveJ pBefore, v500",
    "    SetDO doGrip, 0;": "    WaitTime 0.5;\n    SetDO doGrip, 0;",
}
"""What becomes of `old/` in `new/`."""


def lay_out(folder: Path) -> None:
    """What a reader has: the programs of the repository, and programs, cells and a backup."""
    shutil.copytree(ROOT / "programs", folder / "programs")
    shutil.copytree(STAND_INS, folder, dirs_exist_ok=True)
    shutil.copytree(ROOT / "tests/rapid/system/parameters_of_a_backup", folder / "backup")
    for name in ("cell", "old", "new"):
        shutil.copytree(ROOT / "programs" / "cell", folder / name)
        (folder / name / "PickAndPlace.mod").rename(folder / name / "Main.mod")
    text = (folder / "new" / "Main.mod").read_text(encoding="utf-8")
    for before, after in CHANGED.items():
        assert before in text
        text = text.replace(before, after)
    (folder / "new" / "Main.mod").write_text(text, encoding="utf-8")


@dataclass
class Reader:
    """Somebody who does what a page says, in a folder of their own."""

    folder: Path
    space: dict[str, object] = field(default_factory=lambda: {"__name__": "page"})
    printed: str | None = None
    """What the last block has printed."""

    def do(self, snippet: Snippet) -> None:
        """Execute, write, read or compare one block."""
        if snippet.not_run is not None:
            self.printed = None
            return
        if snippet.title:
            (self.folder / snippet.title).write_text(snippet.text, encoding="utf-8")
        match snippet.language:
            case "python":
                out = io.StringIO()
                with contextlib.redirect_stdout(out), contextlib.chdir(self.folder):
                    exec(compile(snippet.text, "page", "exec"), self.space)
                self.printed = out.getvalue()
            case "sh":
                self.printed = "".join(self._commands(snippet))
            case "text":
                if self.printed is not None:
                    assert printed_as(snippet.text, self.printed), self.printed
                self.printed = None
            case "rapid":
                assert not rapidsim.parse(Source("page.mod", module_of(snippet.text))).diagnostics
            case "toml":
                tomllib.loads(snippet.text)
                if snippet.title in (None, "rapidsim.toml"):
                    file = self.folder / "read.toml"
                    file.write_text(snippet.text, encoding="utf-8")
                    read_station(file)
            case "ini":
                configparser.ConfigParser().read_string(snippet.text)
            case "json":
                json.loads(snippet.text)
            case "yaml":
                # Comes with what builds the pages; a page of CI is a document and a piece of one.
                yaml = pytest.importorskip("yaml")
                yaml.safe_load(snippet.text)
            case other:
                raise AssertionError(f"nobody knows how to try `{other}`")

    def edit(self, edit: Edit) -> None:
        """Change a file, once."""
        file = self.folder / edit.file
        text = file.read_text(encoding="utf-8")
        assert text.count(edit.old) == 1, edit.old
        file.write_text(text.replace(edit.old, edit.new), encoding="utf-8")

    def _commands(self, snippet: Snippet) -> Iterator[str]:
        lines = list(commands(snippet.text))
        for number, line in enumerate(lines, start=1):
            expected = snippet.exits if number == len(lines) else 0
            yield self._pipe(line, expected)

    def _pipe(self, line: str, expected: int) -> str:
        """Carry out commands joined by `|`, and give what they print, warnings first."""
        words = shlex.split(line, comments=True)
        *words, target = words if ">" in words[-2:-1] else [*words, ""]
        words = words[:-1] if target else words
        given, said = b"", ""
        for one in split(words, "|"):
            assert one[0] == "rapidsim", f"not run: {line}"
            ended = call(*one[1:], cwd=self.folder, stdin=given)
            given, said = ended.out.encode(), said + ended.err
            assert ended.code == expected, f"{line}: {ended.code}\n{ended.err}{ended.out}"
        if target:
            (self.folder / target).write_bytes(given)
            return said
        return said + given.decode()


def split(words: list[str], divider: str) -> Iterator[list[str]]:
    """Words between dividers."""
    while divider in words:
        place = words.index(divider)
        yield words[:place]
        words = words[place + 1 :]
    yield words


def module_of(text: str) -> str:
    """RAPID as it stands; statements alone, in a module around them."""
    if re.search(r"^\s*MODULE\b", text, re.MULTILINE):
        return text
    return f"MODULE page\nPROC main()\n{text}\nENDPROC\nENDMODULE\n"


@pytest.fixture
def few_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of pictures only the quick ones are drawn; the tests of `plots` draw all of them."""

    def write_few(
        pictures: Mapping[str, Callable[[Colours], Figure | None]], folder: Path
    ) -> tuple[Path, ...]:
        return write_pictures({name: pictures[name] for name in pictures if name in QUICK}, folder)

    for user in (plots_write, posture_pictures, followed_pictures):
        monkeypatch.setattr(user, "write_pictures", write_few)


@pytest.fixture
def _no_workers_left() -> Iterator[None]:
    """Workers of joblib live on, in the folder of the page that began them."""
    yield
    if "joblib" in sys.modules:
        sys.modules["joblib"].externals.loky.get_reusable_executor().shutdown(wait=True)


@pytest.mark.usefixtures("few_pictures", "_no_workers_left")
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_page_does_what_it_says(page: Path, tmp_path: Path) -> None:
    """`UPDATE_GOLDEN=1` writes what commands print into the page, but for what has `...`."""
    lay_out(tmp_path)
    reader = Reader(tmp_path)
    shown = page.read_text(encoding="utf-8")
    for snippet in snippets(page):
        if isinstance(snippet, Edit):
            reader.edit(snippet)
            continue
        fresh = reader.printed
        if (
            os.environ.get("UPDATE_GOLDEN")
            and snippet.language == "text"
            and fresh is not None
            and snippet.not_run is None
            and "..." not in snippet.text
        ):
            shown = shown.replace(snippet.whole, f"```text\n{fresh.strip()}\n```", 1)
            page.write_text(shown, encoding="utf-8")
            reader.printed = None
            continue
        try:
            reader.do(snippet)
        except Exception as error:
            raise AssertionError(f"{page.name}:{snippet.line}: {error}") from error


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_every_fence_is_seen(page: Path) -> None:
    """None is indented, so that none is passed over."""
    text = page.read_text(encoding="utf-8")
    fences = [line for line in text.splitlines() if line.lstrip().startswith("```")]
    seen = [one for one in snippets(page) if isinstance(one, Snippet)]
    assert len(fences) == 2 * len(seen)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_commands_in_the_text_exist(page: Path) -> None:
    """Of `rapidsim COMMAND --option` in a sentence, command and options are real."""
    for words in re.findall(r"`rapidsim ([^`|\n]+)", page.read_text(encoding="utf-8")):
        context = click.Context(command_group)
        command: click.Command = command_group
        for word in words.split():
            if isinstance(command, click.Group) and not word.startswith("-"):
                if word in ("COMMAND", "..."):
                    break
                found = command.get_command(context, word.split("|")[0])
                assert found is not None, words
                command = found
            elif word.startswith("--"):
                names = {name for one in command.get_params(context) for name in one.opts}
                assert word.split("=")[0] in names, f"{words}: {word}"
