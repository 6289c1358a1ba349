"""The server on the wire: one process for the module, one for what needs another client."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from lsp_client import Client

from rapidsim.lsp.uris import uri_of

pytestmark = pytest.mark.process

TEXT = """MODULE m
  CONST robtarget p1:=[[600,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  ! a counter
  VAR num count;
  PROC main()
    count:=1;
    MoveJ p1,v500,z10,tool0;
    MoveJ Offs(p1,0,0,-50),v500,fine,tool0;
  ENDPROC
ENDMODULE
"""
FAR = TEXT.replace("[[600,0", "[[9000,0")
PUSHED = {"workspace": {"workspaceEdit": {"documentChanges": True}}}
PULLED = {
    "general": {"positionEncodings": ["utf-8", "utf-16"]},
    "textDocument": {"diagnostic": {}, "completion": {"completionItem": {"snippetSupport": True}}},
    "workspace": {
        "diagnostics": {"refreshSupport": True},
        "didChangeWatchedFiles": {"dynamicRegistration": True},
    },
    "window": {"workDoneProgress": True},
}


@pytest.fixture(scope="module")
def client() -> Iterator[Client]:
    made = Client(PUSHED, initializationOptions={"checkMoves": False})
    yield made
    code, errors = made.close()
    assert (code, errors) == (0, "")


def where(uri: str, line: int, character: int) -> dict[str, object]:
    return {"textDocument": {"uri": uri}, "position": {"line": line, "character": character}}


def test_what_the_server_can_do(client: Client) -> None:
    able = client.server["capabilities"]
    assert client.server["serverInfo"]["name"] == "rapidsim"
    assert able["positionEncoding"] == "utf-16"
    assert able["textDocumentSync"]["change"] == 2
    assert able["semanticTokensProvider"]["full"] == {"delta": True}
    assert able["executeCommandProvider"]["commands"] == [
        *("rapidsim.run", "rapidsim.record", "rapidsim.program")
    ]
    assert able["codeActionProvider"]["resolveProvider"] is True
    for name in (
        *("hover", "definition", "typeDefinition", "references", "documentHighlight"),
        *("documentSymbol", "workspaceSymbol", "callHierarchy", "rename", "foldingRange"),
        *("selectionRange", "codeLens", "inlayHint", "documentFormatting", "diagnostic"),
        *("documentRangeFormatting", "completion", "signatureHelp"),
    ):
        assert able[f"{name}Provider"], name


def test_findings_follow_the_typing(client: Client) -> None:
    uri = "untitled:typing"
    client.open(uri, TEXT)
    assert client.diagnostics(uri) == []
    place = {"line": 5, "character": 4}
    client.change(uri, 2, {"range": {"start": place, "end": place}, "text": "x"})
    finding = next(one for one in client.diagnostics(uri) if one["code"] == "N201")
    assert finding["range"]["start"] == place
    client.notify("textDocument/didClose", {"textDocument": {"uri": uri}})
    assert client.diagnostics(uri) == []


def test_requests(client: Client) -> None:
    uri = "untitled:requests"
    client.open(uri, TEXT)
    (place,) = client.request("textDocument/definition", where(uri, 5, 5))
    assert place["range"]["start"] == {"line": 3, "character": 10}
    hover = client.request("textDocument/hover", where(uri, 6, 12))
    assert "CONST robtarget p1" in hover["contents"]["value"]
    found = client.request("textDocument/completion", where(uri, 5, 6))
    assert "count" in [one["label"] for one in found["items"]]
    tokens = client.request("textDocument/semanticTokens/full", {"textDocument": {"uri": uri}})
    assert len(tokens["data"]) % 5 == 0
    delta = {"textDocument": {"uri": uri}, "previousResultId": tokens["resultId"]}
    assert client.request("textDocument/semanticTokens/full/delta", delta)["edits"] == []
    symbols = client.request("workspace/symbol", {"query": "main"})
    assert "main" in [one["name"] for one in symbols]
    (item,) = client.request("textDocument/prepareCallHierarchy", where(uri, 5, 5))
    assert client.request("callHierarchy/incomingCalls", {"item": item}) == []
    assert client.request("callHierarchy/outgoingCalls", {"item": item}) == []


def test_a_refused_rename_is_an_error_with_a_sentence(client: Client) -> None:
    uri = "untitled:rename"
    client.open(uri, TEXT)
    edit = client.request("textDocument/rename", {**where(uri, 5, 5), "newName": "number"})
    assert len(edit["changes"][uri]) == 2
    with pytest.raises(RuntimeError, match="`IF` is a reserved word of RAPID"):
        client.request("textDocument/rename", {**where(uri, 5, 5), "newName": "IF"})


def test_a_change_that_overtakes_a_long_request(client: Client) -> None:
    uri = "untitled:overtaken"
    client.open(uri, TEXT)
    number = client.start(
        "textDocument/references", {**where(uri, 5, 5), "context": {"includeDeclaration": True}}
    )
    client.change(uri, 2, {"text": TEXT.replace("count", "total")})
    answer = client.answer(number)
    # Either it was answered in time, or the text had changed.
    assert "result" in answer or answer["error"]["code"] == -32801


def test_a_cancelled_request_is_answered(client: Client) -> None:
    uri = "untitled:cancelled"
    client.open(uri, TEXT)
    number = client.start("workspace/symbol", {"query": ""})
    client.notify("$/cancelRequest", {"id": number})
    answer = client.answer(number)
    assert "result" in answer or answer["error"]["code"] == -32800


def test_a_document_that_is_not_open(client: Client) -> None:
    assert client.request("textDocument/hover", where("untitled:absent", 0, 0)) is None
    found = client.request("textDocument/diagnostic", {"textDocument": {"uri": "untitled:absent"}})
    assert found["items"] == []


def test_unsaved_text_cannot_run(client: Client) -> None:
    client.open("untitled:run", TEXT)
    parameters = {"command": "rapidsim.run", "arguments": ["untitled:run", "main"]}
    assert client.request("workspace/executeCommand", parameters) is None
    assert "must be saved" in client.notification("window/showMessage")["message"]
    parameters = {"command": "rapidsim.program", "arguments": ["untitled:run"]}
    assert client.request("workspace/executeCommand", parameters) is None


def test_a_recording_comes_with_the_report_that_the_client_wants(tmp_path: Path) -> None:
    file, report = tmp_path / "m.mod", tmp_path / "report.html"
    file.write_text(TEXT)
    uri = uri_of(str(file))
    client = Client(PULLED)
    client.open(uri, TEXT)
    parameters = {"command": "rapidsim.record", "arguments": [uri, "main", str(report)]}
    result = client.request("workspace/executeCommand", parameters)
    assert result["recording"] == str(tmp_path / "m.rrd")
    assert (tmp_path / "m.rrd").is_file()
    assert "<html" in report.read_text(encoding="utf-8")
    assert client.close() == (0, "")


def test_a_client_that_pulls_runs_and_watches(tmp_path: Path) -> None:
    file = tmp_path / "m.mod"
    file.write_text(TEXT)
    uri = uri_of(str(file))
    folders = [{"uri": uri_of(str(tmp_path)), "name": "cell"}]
    client = Client(PULLED, workspaceFolders=folders)
    assert client.server["capabilities"]["positionEncoding"] == "utf-8"
    registration = client.notification("client/registerCapability")
    assert registration["registrations"][0]["method"] == "workspace/didChangeWatchedFiles"
    client.open(uri, FAR)
    # The second process finds what the text alone does not tell.
    codes: list[str] = []
    known = None
    while "K601" not in codes:
        client.notification("workspace/diagnostic/refresh")
        asked = {"textDocument": {"uri": uri}, "previousResultId": known}
        report = client.request("textDocument/diagnostic", asked)
        if report["kind"] == "full":
            known, codes = report["resultId"], [one["code"] for one in report["items"]]
    again = {"textDocument": {"uri": uri}, "previousResultId": known}
    assert client.request("textDocument/diagnostic", again)["kind"] == "unchanged"
    whole = client.request("workspace/diagnostic", {"previousResultIds": []})
    assert [Path(one["uri"]).name for one in whole["items"]] == ["m.mod"]
    # The text that the client has is run, not the one on the disk.
    client.change(uri, 2, {"text": TEXT})
    parameters = {"command": "rapidsim.run", "arguments": [uri, "main"]}
    run = client.start("workspace/executeCommand", parameters)
    # Typing is answered while the run goes on.
    assert client.request("textDocument/hover", where(uri, 5, 5)) is not None
    result = client.answer(run)["result"]
    assert (result["end"], result["moves"]) == ("ended", 2)
    parameters = {"command": "rapidsim.program", "arguments": [uri]}
    assert client.request("workspace/executeCommand", parameters) == str(tmp_path)
    lenses = client.request("textDocument/codeLens", {"textDocument": {"uri": uri}})
    titles = [one["command"]["title"] for one in lenses]
    assert titles == ["Run", "Record", f"{result['time_s']:.3f} s in the last run"]
    (tmp_path / "h.mod").write_text("MODULE h\n  PROC helper()\n  ENDPROC\nENDMODULE\n")
    created = {"changes": [{"uri": uri_of(str(tmp_path / "h.mod")), "type": 1}]}
    client.notify("workspace/didChangeWatchedFiles", created)
    assert [one["name"] for one in client.request("workspace/symbol", {"query": "helper"})] == [
        "helper"
    ]
    code, errors = client.close()
    assert (code, errors) == (0, "")
