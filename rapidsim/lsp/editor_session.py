"""A client and its programs: which are open, with which texts, findings and late results."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from lsprotocol import types as lsp

from rapidsim.analysis.rules.table import detectors_of
from rapidsim.diagnostics import Diagnostic
from rapidsim.files import InputError
from rapidsim.jobs.inputs.job import Job
from rapidsim.jobs.inputs.selection import Selection, choose_selection
from rapidsim.lsp.background import RunAnswer
from rapidsim.lsp.positions import Encoding, LineTable
from rapidsim.lsp.programs import frozen, job_of_file, job_of_folder
from rapidsim.lsp.run_results import NO_RESULTS, RunResults
from rapidsim.lsp.semantic_tokens import SemanticTokenEncoder
from rapidsim.lsp.uris import Uris, is_file, path_of
from rapidsim.lsp.view import Document, View
from rapidsim.values import value_class
from rapidsim.workspace.changes import TextChange, changed_text
from rapidsim.workspace.workspace import Workspace


class OpenProgram:
    """A program with its workspace and the results of the second process."""

    def __init__(self, job: Job | None, uris: Uris, encoding: Encoding) -> None:
        """Load the texts of a job; without one, texts are only those that are opened.

        Raises:
            InputError: If the settings select a rule that does not exist.
        """
        self.job = job
        self._selection: Selection | None = None
        if job is None:
            self.workspace = Workspace()
        else:
            self._selection = choose_selection(job.station.check, (), (), ())
            rules = detectors_of(self._selection.includes)
            self.workspace = Workspace(job.tasks, rules, job.cell)
        self.view = View(self.workspace, uris, encoding)
        self.results: RunResults = NO_RESULTS
        self.encoder = SemanticTokenEncoder()
        self.edit_count = 0
        """Number of changes of any text."""
        self._result_count = 0

    @property
    def state(self) -> str:
        """Identifier of the present texts and late results."""
        return f"{id(self)}.{self.edit_count}.{self._result_count}"

    @property
    def paths(self) -> tuple[str, ...]:
        """Paths of all texts."""
        return self.workspace.paths

    def findings(self, path: str) -> tuple[Diagnostic, ...]:
        """Findings in a text, those of moves and runs behind the others."""
        found = self.workspace.findings(path)
        if self._selection is not None:
            found = self._selection.filter(found)
        return (*found, *self.results.findings.get(path, ()))

    def name_of(self, path: str) -> str | None:
        """Return the spelling of a path in the workspace; None if it has no such file."""
        if path in self.paths:
            return path
        for one in self.paths:
            if _is_same(one, path):
                return one
        return None

    def frozen_job(self) -> Job | None:
        """Return the job with the present texts; None without one."""
        return None if self.job is None else frozen(self.job, self.workspace)

    def take_findings(self, findings: Sequence[Diagnostic]) -> None:
        """Take the findings of the second process on the present texts."""
        by_path: dict[str, tuple[Diagnostic, ...]] = {}
        for path in self.paths:
            known = {(one.code, one.order) for one in self.workspace.findings(path)}
            by_path[path] = tuple(
                one
                for one in findings
                if one.span is not None
                and one.span.file == path
                and (one.code, one.order) not in known
            )
        self.results = RunResults(by_path, self.results.moves, self.results.summary)
        self._result_count += 1

    def take_run(self, answer: RunAnswer) -> None:
        """Take the moves of a run on the present texts."""
        self.results = RunResults(self.results.findings, answer.moves, answer.summary)
        self._result_count += 1


@value_class(frozen=True, slots=True, eq=False)
class OpenDocument:
    """A document with its program."""

    program: OpenProgram
    document: Document

    @property
    def path(self) -> str:
        """Path of the document in the workspace."""
        return self.document.path

    @property
    def findings(self) -> tuple[Diagnostic, ...]:
        """Findings in the document."""
        return self.program.findings(self.path)


class EditorSession:
    """The programs that a client works on."""

    def __init__(
        self,
        encoding: Encoding = Encoding.UTF16,
        on_problem: Callable[[str], None] = lambda message: None,
    ) -> None:
        """Begin without programs.

        Args:
            encoding: Code units of the client's columns.
            on_problem: Receives a sentence about a station file or module that cannot be read.
        """
        self.encoding = encoding
        self.uris = Uris()
        self.programs: list[OpenProgram] = []
        self._on_problem = on_problem
        self._opened: set[str] = set()

    def open_folder(self, path: str) -> None:
        """Load the program of a folder, if it is one and not loaded yet."""
        loaded = {path for one in self.programs if one.job for path in one.job.request.paths}
        if path in loaded:
            return
        try:
            found = job_of_folder(path)
            if found is not None:
                self.programs.append(OpenProgram(found, self.uris, self.encoding))
        except InputError as error:
            self._on_problem(error.message)

    def open(self, uri: str, text: str) -> frozenset[str]:
        """Take a text in place of the one on the disk; return the paths with new findings."""
        self.close(uri)
        program = self._program_of(uri) or self._load(uri)
        path = program.name_of(path_of(uri)) or path_of(uri)
        self.uris.learn(uri, path)
        self._opened.add(uri)
        is_known = path in program.paths
        if is_known and program.workspace.text(path) == text:
            return frozenset(program.paths)
        program.workspace.open(path, text)
        program.edit_count += 1
        return frozenset(program.paths)

    def change(
        self, uri: str, changes: Sequence[lsp.TextDocumentContentChangeEvent]
    ) -> frozenset[str]:
        """Apply the changes of a client; return the paths with new findings."""
        found = self.find(uri)
        if found is None:
            return frozenset()
        program, path = found.program, found.path
        workspace = program.workspace
        edits = text_changes(found.document.lines, changes)
        changed = workspace.change(path, edits)
        program.results = program.results.after(path, edits, workspace.text(path))
        program.edit_count += 1
        return changed.paths

    def close(self, uri: str) -> frozenset[str]:
        """Return to the text on the disk; return the paths with new findings."""
        if uri not in self._opened:
            return frozenset()
        self._opened.discard(uri)
        found = self.find(uri)
        if found is None:
            return frozenset()
        changed = found.program.workspace.close(found.path)
        found.program.encoder.close(found.path)
        found.program.edit_count += 1
        if not found.program.paths:
            self.programs.remove(found.program)
        return changed.paths | {found.path}

    def reload(self) -> None:
        """Read all programs again from the disk, under the texts that are open."""
        texts = {uri: self.text(uri) for uri in self._opened}
        folders = [
            one.job.request.paths[0]
            for one in self.programs
            if one.job is not None and Path(one.job.request.paths[0]).is_dir()
        ]
        self.programs.clear()
        self._opened.clear()
        for folder in dict.fromkeys(folders):
            self.open_folder(folder)
        for uri, text in texts.items():
            if text is not None:
                self.open(uri, text)

    def find(self, uri: str) -> OpenDocument | None:
        """Return a document; None if no program has it."""
        program = self._program_of(uri)
        if program is None:
            return None
        path = program.name_of(self.uris.path(uri))
        return None if path is None else OpenDocument(program, program.view.document(path))

    def text(self, uri: str) -> str | None:
        """Return the text of a document; None if no program has it."""
        found = self.find(uri)
        return None if found is None else found.document.text

    def documents(self) -> Iterator[OpenDocument]:
        """Yield all documents, program by program, whether or not the client has opened them."""
        for program in self.programs:
            for path in program.paths:
                yield OpenDocument(program, program.view.document(path))

    def is_open(self, uri: str) -> bool:
        """Whether the client has a document open."""
        return uri in self._opened

    def is_save(self, change: lsp.FileEvent) -> bool:
        """Whether a change on the disk is only that an open text was saved."""
        if change.type is lsp.FileChangeType.Deleted or not self.is_open(change.uri):
            return False
        text = self.text(change.uri)
        try:
            return text is not None and Path(path_of(change.uri)).read_bytes() == text.encode()
        except OSError:
            return False

    def _program_of(self, uri: str) -> OpenProgram | None:
        path = self.uris.path(uri)
        for program in self.programs:
            if path in program.paths:
                return program
        for program in self.programs if is_file(uri) else ():
            if program.name_of(path) is not None:
                return program
        return None

    def _load(self, uri: str) -> OpenProgram:
        """Load the program of a file; one alone if it is not on the disk or cannot be read."""
        program: OpenProgram | None = None
        try:
            found = job_of_file(path_of(uri)) if is_file(uri) else None
            program = None if found is None else OpenProgram(found, self.uris, self.encoding)
        except InputError as error:
            self._on_problem(error.message)
        program = program or OpenProgram(None, self.uris, self.encoding)
        self.programs.append(program)
        return program


def text_changes(
    table: LineTable, changes: Sequence[lsp.TextDocumentContentChangeEvent]
) -> list[TextChange]:
    """Return the changes of a client by offset; each refers to the text that the last one left.

    Args:
        table: The text before them.
        changes: Changes in their order.
    """
    edits: list[TextChange] = []
    for change in changes:
        if edits:
            table = LineTable(changed_text(table.text, edits[-1:]), table.encoding)
        if isinstance(change, lsp.TextDocumentContentChangePartial):
            start = table.offset(change.range.start)
            end = max(start, table.offset(change.range.end))
        else:
            start, end = 0, len(table.text)
        edits.append(TextChange(start, end, change.text))
    return edits


def _is_same(name: str, path: str) -> bool:
    """Whether two paths name one file, such as by a link or in another case."""
    if Path(name).name.lower() != Path(path).name.lower():
        return False
    try:
        return Path(name).samefile(path)
    except OSError:
        return False
