"""The language server on the wire: pygls, and what happens between requests.

Requests are answered in the order of their arrival. What may take long waits a moment first, so
that a cancellation or a change that is already there counts. Checks of moves and runs are results
of the second process: they come when they come.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import os
import sys
from collections.abc import Awaitable, Callable, Iterable
from functools import partial
from pathlib import Path
from typing import Any

from lsprotocol import types as lsp
from pygls.exceptions import (
    JsonRpcContentModified,
    JsonRpcException,
    JsonRpcInvalidParams,
)
from pygls.lsp.server import LanguageServer

from rapidsim.analysis.occurrences.rename import RenameRefusedError
from rapidsim.files import InputError
from rapidsim.lsp import call_hierarchy, code_actions, code_lenses, completion, outline
from rapidsim.lsp.background import Background
from rapidsim.lsp.diagnostic_reports import document_report, workspace_report
from rapidsim.lsp.diagnostics import diagnostics_of
from rapidsim.lsp.editor_session import EditorSession, OpenDocument, OpenProgram
from rapidsim.lsp.positions import Encoding
from rapidsim.lsp.requests import REQUESTS, DocumentRequest
from rapidsim.lsp.run_results import RunSummary
from rapidsim.lsp.uris import path_of
from rapidsim.syntax.garbage_collection import gc_rarely

_MOMENT_S = 0.002
"""Wait before a long answer, in which the next message may arrive."""
_PUBLISH_DELAY_S = 0.05
"""Findings are sent when no change has come for so long."""
_CHECK_DELAY_S = 0.8
"""Moves are checked when no change has come for so long."""
_PATIENCE_S = 1.0
"""Wait for a client to accept that progress is shown; without an answer none is."""
PROGRAM = "rapidsim.program"
"""Command: the path of the program that the document of a URI belongs to; none without one."""
_WATCHED = "**/*.{mod,modx,sys,sysx,prg,MOD,SYS,PRG,toml,cfg}"


class RapidServer(LanguageServer):
    """A language server with the programs of its client."""

    def __init__(self, version: str) -> None:
        """Begin without a client."""
        super().__init__("rapidsim", version)
        self.session = EditorSession(on_problem=self.warn)
        self.background = Background()
        self.checks_moves = True
        self._dirty: set[str] = set()
        self._publishing: asyncio.TimerHandle | None = None
        self._checking: dict[OpenProgram, asyncio.TimerHandle] = {}
        self._tasks: set[asyncio.Task[None]] = set()
        self._progress_count = 0

    def warn(self, message: str) -> None:
        """Show a sentence to the user."""
        self.window_show_message(lsp.ShowMessageParams(lsp.MessageType.Warning, message))

    def begin(self, params: lsp.InitializeParams) -> None:
        """Take the settings of a client."""
        options = params.initialization_options
        if isinstance(options, dict) and options.get("checkMoves") is False:
            self.checks_moves = False
        self.session.encoding = Encoding(
            lsp.PositionEncodingKind(self.workspace.position_encoding).value
        )

    @property
    def pulls(self) -> bool:
        """Whether the client asks for findings; then none are pushed."""
        document = self.client_capabilities.text_document
        return document is not None and document.diagnostic is not None

    def changed(self, program: OpenProgram | None, paths: Iterable[str]) -> None:
        """Send findings soon, and check moves when the typing pauses."""
        loop = asyncio.get_running_loop()
        self._dirty.update(paths)
        if self._publishing is not None:
            self._publishing.cancel()
        self._publishing = loop.call_later(_PUBLISH_DELAY_S, self._publish)
        if program is None or program.job is None or not self.checks_moves:
            return
        self.background.discard_check()
        self._check_later(program)

    def _check_later(self, program: OpenProgram) -> None:
        if (waiting := self._checking.pop(program, None)) is not None:
            waiting.cancel()
        check = partial(self._start, self._check_moves, program)
        loop = asyncio.get_running_loop()
        self._checking[program] = loop.call_later(_CHECK_DELAY_S, check)

    def close(self) -> None:
        """End checks under way, whose results nobody waits for, and the second process."""
        for waiting in self._checking.values():
            waiting.cancel()
        for task in self._tasks:
            task.cancel()
        self.background.close()

    def _publish(self) -> None:
        self._publishing = None
        dirty, self._dirty = self._dirty, set()
        if self.pulls:
            # A client asks by itself after its own changes.
            return
        for path in sorted(dirty):
            uri = self.session.uris.uri(path)
            found = self.session.find(uri)
            items = [] if found is None else diagnostics_of(found.document, found.findings)
            version = None
            if found is not None and self.session.is_open(uri):
                version = self.workspace.get_text_document(uri).version
            self.text_document_publish_diagnostics(
                lsp.PublishDiagnosticsParams(uri, items, version)
            )

    def refresh(self) -> None:
        """Let the client ask again for what late results have changed."""
        client = self.client_capabilities.workspace
        if client is None:
            return
        if client.diagnostics is not None and client.diagnostics.refresh_support:
            self.workspace_diagnostic_refresh(None)

    def _refresh_results(self) -> None:
        self.refresh()
        client = self.client_capabilities.workspace
        if client is None:
            return
        if client.inlay_hint is not None and client.inlay_hint.refresh_support:
            self.workspace_inlay_hint_refresh(None)
        if client.code_lens is not None and client.code_lens.refresh_support:
            self.workspace_code_lens_refresh(None)

    def _start(self, function: Callable[[OpenProgram], Awaitable[None]], of: OpenProgram) -> None:
        async def call() -> None:
            await function(of)

        task = asyncio.get_running_loop().create_task(call())
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _check_moves(self, program: OpenProgram) -> None:
        self._checking.pop(program, None)
        job, edits = program.frozen_job(), program.edit_count
        if job is None:
            return
        async with self._progress("Checking moves"):
            found = await self.background.check(job)
        if edits != program.edit_count or program not in self.session.programs:
            return
        if found is None:
            # The text of another program changed meanwhile.
            self._check_later(program)
            return
        program.take_findings(found)
        self._dirty.update(program.paths)
        self._publish()
        self._refresh_results()

    async def run_program(
        self, uri: str, entry: str, *, records: bool, report: str = ""
    ) -> RunSummary:
        """Run a procedure of the program of a document; show times in the text.

        Args:
            uri: The document.
            entry: The procedure.
            records: Whether to write a recording next to the document.
            report: Path of a report to write; empty for none.

        Raises:
            InputError: If the document belongs to no program on the disk.
        """
        found = self.session.find(uri)
        job = None if found is None else found.program.frozen_job()
        if found is None or job is None:
            raise InputError("the text must be saved as a module before it can run")
        recording = ""
        if records:
            recording = str(Path(found.path).with_suffix(".rrd"))
        edits = found.program.edit_count
        async with self._progress(f"Running {entry}"):
            answer = await self.background.run(job, entry, recording, report)
        if edits == found.program.edit_count:
            found.program.take_run(answer)
            self._refresh_results()
        return answer.summary

    @contextlib.asynccontextmanager
    async def _progress(self, title: str) -> Any:
        """Show that something is going on, if the client can."""
        window = self.client_capabilities.window
        if window is None or not window.work_done_progress:
            yield
            return
        self._progress_count += 1
        token = f"rapidsim-{self._progress_count}"
        try:
            created = self.work_done_progress.create_async(token)
            await asyncio.wait_for(created, _PATIENCE_S)
        except (JsonRpcException, TimeoutError):
            yield
            return
        self.work_done_progress.begin(token, lsp.WorkDoneProgressBegin(title))
        try:
            yield
        finally:
            self.work_done_progress.end(token, lsp.WorkDoneProgressEnd())


def serve(version: str) -> None:
    """Answer a client on standard input and output until it ends the connection."""
    # Its messages about each request would go to standard error, and into the log of the editor.
    logging.getLogger("pygls").setLevel(logging.CRITICAL)
    server = make_server(version)
    # Whatever else is printed, here or in the second process, must not get between the messages.
    wire = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    try:
        with gc_rarely():
            server.start_io(stdout=wire)
    finally:
        server.close()


def make_server(version: str) -> RapidServer:
    """Return a server with all its features."""
    server = RapidServer(version)
    _add_lifecycle(server)
    _add_documents(server)
    for method, request in REQUESTS.items():
        server.feature(method, request.options)(_handler(server, request))
    _add_completion(server)
    _add_diagnostics(server)
    _add_workspace(server)
    _add_commands(server)
    return server


def _handler(server: RapidServer, request: DocumentRequest) -> Callable[[Any], Any]:
    def now(params: Any) -> Any:
        found = server.session.find(params.text_document.uri)
        return None if found is None else _answer(request, found, params)

    async def later(params: Any) -> Any:
        found = server.session.find(params.text_document.uri)
        if found is None:
            return None
        edits = found.program.edit_count
        await asyncio.sleep(_MOMENT_S)
        if found.program.edit_count != edits:
            raise JsonRpcContentModified("the text has changed")
        # Nothing of the document has been read before the moment passed.
        return _answer(request, found, params)

    return later if request.is_long else now


def _answer(request: DocumentRequest, of: OpenDocument, params: Any) -> Any:
    try:
        return request.answer(of, params)
    except RenameRefusedError as refused:
        raise JsonRpcInvalidParams(str(refused)) from None


def _add_lifecycle(server: RapidServer) -> None:
    @server.feature(lsp.INITIALIZE)
    def initialize(params: lsp.InitializeParams) -> None:
        server.begin(params)

    @server.feature(lsp.INITIALIZED)
    def initialized(params: lsp.InitializedParams) -> None:
        folders = list(server.workspace.folders)
        if not folders and server.workspace.root_uri:
            folders = [server.workspace.root_uri]
        for uri in folders:
            server.session.open_folder(path_of(uri))
        for program in server.session.programs:
            server.changed(program, program.paths)
        _watch_files(server)

    @server.feature(lsp.SHUTDOWN)
    def shutdown(params: None) -> None:
        server.close()


def _watch_files(server: RapidServer) -> None:
    workspace = server.client_capabilities.workspace
    watched = None if workspace is None else workspace.did_change_watched_files
    if watched is None or not watched.dynamic_registration:
        return
    options = lsp.DidChangeWatchedFilesRegistrationOptions([lsp.FileSystemWatcher(_WATCHED)])
    server.client_register_capability(
        lsp.RegistrationParams(
            [lsp.Registration("rapidsim-files", lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES, options)]
        )
    )


def _add_documents(server: RapidServer) -> None:
    session = server.session

    @server.feature(lsp.TEXT_DOCUMENT_DID_OPEN)
    def did_open(params: lsp.DidOpenTextDocumentParams) -> None:
        uri = params.text_document.uri
        paths = session.open(uri, params.text_document.text)
        _report(server, uri, paths)

    @server.feature(lsp.TEXT_DOCUMENT_DID_CHANGE)
    def did_change(params: lsp.DidChangeTextDocumentParams) -> None:
        uri = params.text_document.uri
        _report(server, uri, session.change(uri, params.content_changes))

    @server.feature(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def did_close(params: lsp.DidCloseTextDocumentParams) -> None:
        uri = params.text_document.uri
        _report(server, uri, session.close(uri))

    @server.feature(lsp.TEXT_DOCUMENT_DID_SAVE)
    def did_save(params: lsp.DidSaveTextDocumentParams) -> None:
        del params

    @server.feature(lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES)
    def did_change_files(params: lsp.DidChangeWatchedFilesParams) -> None:
        if all(session.is_save(change) for change in params.changes):
            return
        before = {path for program in session.programs for path in program.paths}
        session.reload()
        for program in session.programs:
            server.changed(program, {*program.paths, *before})
        server.refresh()


def _report(server: RapidServer, uri: str, paths: Iterable[str]) -> None:
    found = server.session.find(uri)
    server.changed(None if found is None else found.program, paths)


def _add_completion(server: RapidServer) -> None:
    options = lsp.CompletionOptions(trigger_characters=["\\", "."], resolve_provider=True)

    @server.feature(lsp.TEXT_DOCUMENT_COMPLETION, options)
    def complete(params: lsp.CompletionParams) -> lsp.CompletionList | None:
        found = server.session.find(params.text_document.uri)
        if found is None:
            return None
        document = server.client_capabilities.text_document
        client = None if document is None else document.completion
        item = None if client is None else client.completion_item
        snippets = item is not None and bool(item.snippet_support)
        return completion.completions(found.document, params.position, snippets=snippets)

    @server.feature(lsp.COMPLETION_ITEM_RESOLVE)
    def resolve(item: lsp.CompletionItem) -> lsp.CompletionItem:
        return completion.resolve(item)


def _add_diagnostics(server: RapidServer) -> None:
    options = lsp.DiagnosticOptions(
        inter_file_dependencies=True, workspace_diagnostics=True, identifier="rapidsim"
    )

    @server.feature(lsp.TEXT_DOCUMENT_DIAGNOSTIC, options)
    def diagnostic(params: lsp.DocumentDiagnosticParams) -> lsp.DocumentDiagnosticReport:
        found = server.session.find(params.text_document.uri)
        if found is None:
            return lsp.RelatedFullDocumentDiagnosticReport([])
        return document_report(found, params.previous_result_id)

    @server.feature(lsp.WORKSPACE_DIAGNOSTIC)
    def workspace_diagnostic(
        params: lsp.WorkspaceDiagnosticParams,
    ) -> lsp.WorkspaceDiagnosticReport:
        known = {one.uri: one.value for one in params.previous_result_ids}
        return workspace_report(server.session, known)


def _add_workspace(server: RapidServer) -> None:
    session = server.session

    @server.feature(lsp.WORKSPACE_SYMBOL, lsp.WorkspaceSymbolOptions(resolve_provider=False))
    async def symbols(params: lsp.WorkspaceSymbolParams) -> list[lsp.WorkspaceSymbol]:
        await asyncio.sleep(_MOMENT_S)
        views = [program.view for program in session.programs]
        return [one for view in views for one in outline.workspace_symbols(view, params.query)]

    @server.feature(lsp.WORKSPACE_DID_CHANGE_WORKSPACE_FOLDERS)
    def change_folders(params: lsp.DidChangeWorkspaceFoldersParams) -> None:
        before = list(session.programs)
        for folder in params.event.added:
            session.open_folder(path_of(folder.uri))
        for program in session.programs:
            if program not in before:
                server.changed(program, program.paths)

    @server.feature(lsp.CALL_HIERARCHY_INCOMING_CALLS)
    async def incoming(
        params: lsp.CallHierarchyIncomingCallsParams,
    ) -> list[lsp.CallHierarchyIncomingCall]:
        await asyncio.sleep(_MOMENT_S)
        found = session.find(params.item.uri)
        if found is None:
            return []
        return call_hierarchy.incoming_calls(found.document.view, params.item)

    @server.feature(lsp.CALL_HIERARCHY_OUTGOING_CALLS)
    def outgoing(
        params: lsp.CallHierarchyOutgoingCallsParams,
    ) -> list[lsp.CallHierarchyOutgoingCall]:
        found = session.find(params.item.uri)
        if found is None:
            return []
        return call_hierarchy.outgoing_calls(found.document.view, params.item)

    @server.feature(lsp.CODE_ACTION_RESOLVE)
    def resolve(action: lsp.CodeAction) -> lsp.CodeAction:
        data = action.data
        uri = data.get("uri") if isinstance(data, dict) else None
        found = session.find(uri) if isinstance(uri, str) else None
        if found is not None and action.kind == code_actions.FIX_ALL:
            action.edit = code_actions.resolve_fix_all(found.document, found.findings)
        return action


def _add_commands(server: RapidServer) -> None:
    @server.command(code_lenses.RUN)
    async def run(uri: str, entry: str = "main") -> object:
        return await _run(server, uri, entry, records=False)

    @server.command(code_lenses.RECORD)
    async def record(uri: str, entry: str = "main", report: str = "") -> object:
        return await _run(server, uri, entry, records=True, report=report)

    @server.command(PROGRAM)
    def program(uri: str) -> str | None:
        found = server.session.find(uri)
        job = None if found is None else found.program.job
        return None if job is None else job.request.paths[0]


async def _run(
    server: RapidServer, uri: str, entry: str, *, records: bool, report: str = ""
) -> object:
    try:
        summary = await server.run_program(uri, entry, records=records, report=report)
    except InputError as error:
        server.warn(error.message)
        return None
    kind = lsp.MessageType.Warning if summary.problem else lsp.MessageType.Info
    server.window_show_message(lsp.ShowMessageParams(kind, summary.sentence))
    return {
        "end": summary.end,
        "time_s": summary.time_s,
        "moves": summary.moves,
        "problem": summary.problem or None,
        "recording": summary.recording or None,
    }
