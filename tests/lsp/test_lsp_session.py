"""Programs of a session: what belongs together, texts over the disk, any edit, any request."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from laws import PROFILE, cases
from lsp_documents import HERE, URI, kind_of_parameters, opened
from lsprotocol import types as lsp

from rapidsim.analysis.occurrences.rename import RenameRefusedError
from rapidsim.lsp.completion import completions
from rapidsim.lsp.editor_session import EditorSession, OpenDocument
from rapidsim.lsp.positions import Encoding, LineTable
from rapidsim.lsp.requests import REQUESTS
from rapidsim.lsp.uris import uri_of

MAIN = "MODULE m\n  PROC main()\n    helper;\n  ENDPROC\nENDMODULE\n"
HELPER = "MODULE h\n  PROC helper()\n  ENDPROC\nENDMODULE\n"
PROGRAMS = sorted((Path(__file__).parents[2] / "programs").rglob("*.mod"))


def codes(session: EditorSession, uri: str) -> list[str]:
    found = session.find(uri)
    assert found is not None
    return [one.code for one in found.findings]


def write(folder: Path, **texts: str) -> dict[str, str]:
    """Files of a folder, with their URIs."""
    for name, text in texts.items():
        (folder / f"{name}.mod").write_text(text)
    return {name: uri_of(str(folder / f"{name}.mod")) for name in texts}


def test_modules_of_a_folder_are_one_task(tmp_path: Path) -> None:
    uris = write(tmp_path, main=MAIN, helper=HELPER)
    session = EditorSession()
    session.open(uris["main"], MAIN)
    assert codes(session, uris["main"]) == []
    changed = session.open(uris["helper"], HELPER.replace("helper", "other"))
    assert str(tmp_path / "main.mod") in changed
    assert codes(session, uris["main"]) == ["N209"]
    session.close(uris["helper"])
    assert codes(session, uris["main"]) == []


def test_two_mains_are_two_programs(tmp_path: Path) -> None:
    uris = write(tmp_path, one=MAIN, two=MAIN.replace("MODULE m", "MODULE n"), helper=HELPER)
    session = EditorSession()
    session.open(uris["one"], MAIN)
    assert codes(session, uris["one"]) == ["N209"]
    session.open(uris["two"], MAIN)
    assert len(session.programs) == 2


def test_a_station_file_says_what_belongs_together(tmp_path: Path) -> None:
    (tmp_path / "rapidsim.toml").write_text(
        '[[task]]\nname="T_ROB1"\nmodules=["sub/main.mod","sub/helper.mod"]\n'
        '[signals]\ndoGo={type="do"}\n[check]\nignore=["N209"]\n'
    )
    (tmp_path / "sub").mkdir()
    text = MAIN.replace("helper;", "helper;\n    SetDO doGo,1;\n    missing;")
    uris = write(tmp_path / "sub", main=text, helper=HELPER)
    session = EditorSession()
    session.open(uris["main"], text)
    assert codes(session, uris["main"]) == []
    assert session.programs[0].job is not None


def test_a_broken_station_file_is_told_once_and_stops_nothing(tmp_path: Path) -> None:
    (tmp_path / "rapidsim.toml").write_text("[robot\n")
    uris = write(tmp_path, main=MAIN)
    told: list[str] = []
    session = EditorSession(on_problem=told.append)
    session.open(uris["main"], MAIN)
    assert codes(session, uris["main"]) == ["N209"]
    assert len(told) == 1
    assert "rapidsim.toml" in told[0]


def test_a_folder_is_opened_as_a_program(tmp_path: Path) -> None:
    write(tmp_path, main=MAIN, helper=HELPER)
    session = EditorSession()
    session.open_folder(str(tmp_path))
    assert sorted(Path(of.path).name for of in session.documents()) == ["helper.mod", "main.mod"]
    session.open_folder(str(tmp_path / "absent"))
    session.open_folder(str(tmp_path))
    assert len(session.programs) == 1


def test_a_link_is_the_file_it_leads_to(tmp_path: Path) -> None:
    uris = write(tmp_path, main=MAIN, helper=HELPER)
    session = EditorSession()
    session.open(uris["main"], MAIN)
    (tmp_path / "links").mkdir()
    link = tmp_path / "links" / "helper.mod"
    try:
        link.symlink_to(tmp_path / "helper.mod")
    except OSError:
        pytest.skip("no links here")
    session.open(uri_of(str(link)), HELPER)
    assert len(session.programs) == 1


def test_reloading_keeps_open_texts(tmp_path: Path) -> None:
    uris = write(tmp_path, main=MAIN, helper=HELPER)
    session = EditorSession()
    session.open(uris["main"], MAIN.replace("helper", "later"))
    write(tmp_path, helper=HELPER.replace("helper", "later"))
    session.reload()
    assert codes(session, uris["main"]) == []


def test_a_document_that_is_closed_and_not_on_the_disk_is_forgotten() -> None:
    session = EditorSession()
    session.open(URI, MAIN)
    session.close(URI)
    assert session.find(URI) is None
    assert session.programs == []
    assert session.close(URI) == frozenset()
    assert session.change(URI, []) == frozenset()


def test_any_edits_leave_the_text_of_the_client() -> None:
    """Texts follow edits as a client counts them, however it splits characters and lines."""
    chance = random.Random(1)
    for encoding in Encoding:
        session = EditorSession(encoding)
        text = "MODULE m\r\r\n  ! é💡\n  PROC main()\r    a:=1;\r\n  ENDPROC\nENDMODULE\n"
        session.open(URI, text)
        for _ in range(cases(100)):
            table = LineTable(text, encoding)
            start, end = sorted(chance.randrange(len(text) + 1) for _ in range(2))
            end = min(end, start + 6)
            new = chance.choice(["", "x", "\r", "\n", "💡", '"', "IF a THEN\n", ";"])
            range_ = table.range(start, end)
            start, end = table.offset(range_.start), table.offset(range_.end)
            text = text[:start] + new + text[end:]
            session.change(URI, [lsp.TextDocumentContentChangePartial(range_, new)])
            assert session.text(URI) == text


def test_the_whole_text_may_be_sent() -> None:
    session = EditorSession()
    session.open(URI, MAIN)
    session.change(URI, [lsp.TextDocumentContentChangeWholeDocument(HELPER)])
    assert session.text(URI) == HELPER


def parameters(chance: random.Random, method: str, table: LineTable) -> dict[str, object]:
    """Random parameters of a request."""

    def position() -> lsp.Position:
        found = table.position(chance.randrange(len(table.text) + 1))
        return lsp.Position(found.line + chance.choice([0, 0, 0, 1]), found.character)

    first, last = sorted([position(), position()])
    options = lsp.FormattingOptions(4, True)
    of_method: dict[str, dict[str, object]] = {
        lsp.TEXT_DOCUMENT_REFERENCES: {"context": lsp.ReferenceContext(True)},
        lsp.TEXT_DOCUMENT_RENAME: {"new_name": chance.choice(["fresh", "IF", "p10"])},
        lsp.TEXT_DOCUMENT_CODE_ACTION: {"context": lsp.CodeActionContext([])},
        lsp.TEXT_DOCUMENT_FORMATTING: {"options": options},
        lsp.TEXT_DOCUMENT_RANGE_FORMATTING: {"options": options},
        lsp.TEXT_DOCUMENT_ON_TYPE_FORMATTING: {"options": options, "ch": ";"},
        lsp.TEXT_DOCUMENT_SELECTION_RANGE: {"positions": [position()]},
        lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL_DELTA: {"previous_result_id": "1"},
    }
    return {**of_method.get(method, {}), "position": first, "range": lsp.Range(first, last)}


def ask_anything(document: OpenDocument, chance: random.Random) -> None:
    """Ask for methods at random places: for all in `ci`, else for some."""
    table = document.document.lines
    methods = list(REQUESTS)
    for method in chance.sample(methods, 6) if PROFILE == "fast" else methods:
        kind = kind_of_parameters(method)
        names = {one.name for one in kind.__attrs_attrs__}
        given = parameters(chance, method, table)
        try:
            REQUESTS[method].answer(
                document,
                kind(text_document=HERE, **{k: v for k, v in given.items() if k in names}),
            )
        except RenameRefusedError:
            # It is a sentence for the user.
            continue
    place = parameters(chance, "", table)["position"]
    assert isinstance(place, lsp.Position)
    completions(document.document, place, snippets=True)


def test_no_request_raises_in_any_text() -> None:
    """Texts that end anywhere, with any line ends and characters, as typing makes them."""
    chance = random.Random(7)
    for number in range(cases(1000)):
        text = chance.choice(PROGRAMS).read_text(encoding="latin-1")[:2500]
        text = text[: chance.randrange(len(text) + 1)]
        if number % 3 == 0:
            text = text.replace("\n", chance.choice(["\r\n", "\r\r\n", "\r"]))
        if number % 5 == 0:
            at = chance.randrange(len(text) + 1)
            text = text[:at] + chance.choice(["💡", '"', "\\", "(", "MODULE x", "IF "]) + text[at:]
        encoding = chance.choice(list(Encoding))
        document, _ = opened(text.replace("^", ""), encoding)
        ask_anything(document, chance)


def test_no_request_raises_while_a_program_is_typed() -> None:
    """One session that types at random places, asked after each change."""
    chance = random.Random(3)
    document, _ = opened(PROGRAMS[0].read_text(encoding="latin-1").replace("^", ""))
    session = EditorSession()
    session.open(URI, document.document.text)
    for _ in range(cases(100)):
        found = session.find(URI)
        assert found is not None
        table = found.document.lines
        at = chance.randrange(len(table.text) + 1)
        end = min(len(table.text), at + chance.choice([0, 0, 1, 5]))
        new = chance.choice(["a", ";", "\n", "IF x THEN\n", "ENDPROC\n", "", "💡", '"'])
        event = lsp.TextDocumentContentChangePartial(table.range(at, end), new)
        session.change(URI, [event])
        found = session.find(URI)
        assert found is not None
        ask_anything(found, chance)
