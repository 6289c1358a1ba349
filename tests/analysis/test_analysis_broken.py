"""Text the parser could not read: no program, and no blame on names it may have declared."""

from rapidsim.analysis.passes.checker import check
from rapidsim.diagnostics import Source
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse


def with_broken_declaration(text: str, unread: str) -> tree.File:
    """The file as if the parser had given up the stretch `unread`."""
    file = parse(Source("broken.mod", text.replace(unread, " " * len(unread)))).file
    (module,) = file.modules
    start = text.index(unread)
    broken = tree.InvalidStatement(start, start + len(unread))
    source = Source("broken.mod", text)
    items = (broken, *module.items)
    whole = tree.Module(module.start, module.end, source, module.name, module.attributes, items)
    return tree.File(source, (whole,), ())


def test_a_name_in_unread_text_is_not_held_missing() -> None:
    unread = "VAR num heights{3 := [1,2,3];"
    text = f"MODULE m\n{unread}\nPROC main()\nheights{{1}}:=hieghts{{2}};\nENDPROC\nENDMODULE\n"
    checked = check([with_broken_declaration(text, unread)])
    assert checked.program is None
    assert [one.violation.message for one in checked.diagnostics] == ["`hieghts` is not declared"]


def test_findings_come_in_the_order_of_files_and_text() -> None:
    second = Source("b.mod", "MODULE b\nPROC p()\nx:=1;\ny:=1;\nENDPROC\nENDMODULE\n")
    first = Source("c.mod", "MODULE c\nVAR num n:=TRUE;\nPROC main()\nz:=1;\nENDPROC\nENDMODULE\n")
    checked = check([parse(first).file, parse(second).file])
    places = [(one.span.file, one.span.line) for one in checked.diagnostics if one.span]
    assert places == [("c.mod", 2), ("c.mod", 4), ("b.mod", 3), ("b.mod", 4)]


def test_a_mistake_in_a_literal_aggregate_is_pointed_at() -> None:
    value = '[[600,0,"up"],[0,0,1],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]'
    text = f"MODULE m\nCONST robtarget p:={value};\nENDMODULE\n"
    checked = check([parse(Source("m.mod", text)).file])
    pointed = [one.span.text for one in checked.diagnostics if one.span]
    assert pointed == ['"up"', "[0,0,1]"]
