"""Bad texts for `rapidsim check`.

Random bytes, soups of tokens, and the repository's programs with pieces cut, doubled, moved and
changed. Parsing, every rule, comments that suppress, fixes, all ways to print findings: nothing
may raise; what checks without an error must also load. Printed are the number of
inputs of each kind and the longest time one took, with the seed to see it again; inputs that raise
are kept in `fuzz-failures`.
"""

from __future__ import annotations

import json
import random
import time
import traceback
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import cast

from rapidsim.analysis.passes.checker import check
from rapidsim.analysis.rules.table import detectors_of
from rapidsim.analysis.suppressions import without_suppressed
from rapidsim.diagnostics import Severity, Source, all_rules
from rapidsim.files import decode
from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.interpreter.linking.loader import FatalError, load
from rapidsim.jobs.checking.fixes import choose_fixes
from rapidsim.json_records.encoding import json_of
from rapidsim.language.controller import Controller
from rapidsim.report.findings.diagnostic_records import diagnostic_record
from rapidsim.report.findings.github import github
from rapidsim.report.findings.junit import junit
from rapidsim.report.findings.merging import merged
from rapidsim.report.findings.sarif import sarif
from rapidsim.report.findings.text import full
from rapidsim.report.pages.rules import programs
from rapidsim.report.palette import PLAIN
from rapidsim.syntax.lexer import lex
from rapidsim.syntax.parser import parse
from rapidsim.text_edits import edited_text

ROOT = Path(__file__).parents[2]
FAILURES = Path("fuzz-failures")
EVERY_RULE = detectors_of(lambda rule: True)
LARGEST = 12_000
"""Programs with more characters are left out, so that many mutants can be tried."""
WORDS_AND_MARKS = """
    MODULE ENDMODULE PROC ENDPROC FUNC ENDFUNC TRAP ENDTRAP RECORD ENDRECORD ALIAS LOCAL TASK VAR
    PERS CONST IF THEN ELSEIF ELSE ENDIF FOR FROM TO STEP DO ENDFOR WHILE ENDWHILE TEST CASE
    DEFAULT ENDTEST GOTO RETURN RAISE EXIT RETRY TRYNEXT CONNECT WITH ERROR UNDO BACKWARD NOT AND
    OR XOR DIV MOD TRUE FALSE INOUT SYSMODULE num bool string robtarget x y main p10 MoveL v100
    z10 tool0 TPWrite Offs 1 2.5 .5 9E9 9E999 0xFF "text" "open := = <> <= >= < > + - * / ( ) [ ]
    { } , ; : . \\ ? | % [1,2] [[1],["a"]] ! # € <SMT> <EXP> <VAR> <TDN> <EIT> <CSE> ELS EDNIF
"""
SOUP = WORDS_AND_MARKS.split()


def fuzz_texts(examples: int, seed: int) -> bool:
    """Try texts and print; whether none raised."""
    texts = [decode(program)[0] for program in _programs()]
    kinds: dict[str, Callable[[random.Random], str]] = {
        "bytes": random_bytes,
        "tokens": random_tokens,
        "statements": lambda dice: inside(random_tokens(dice)),
        "characters changed": lambda dice: characters_changed(dice.choice(texts), dice),
        "tokens changed": lambda dice: tokens_changed(dice.choice(texts), dice),
        "spliced": lambda dice: spliced(dice.choice(texts), dice.choice(texts), dice),
    }
    failed = loaded = 0
    for kind, make in kinds.items():
        longest, which, size, total = 0.0, 0, 0, 0.0
        for number in range(examples // len(kinds) + 1):
            text = make(random.Random(f"{seed} {kind} {number}"))
            begin = time.perf_counter()
            try:
                loaded += _try(text)
            except Exception:
                failed += 1
                FAILURES.mkdir(exist_ok=True)
                (FAILURES / f"{kind} {number}.mod").write_text(text, "utf-8", "surrogatepass")
                print(f"{kind} {number}:\n{traceback.format_exc(limit=-4)}")
            seconds = time.perf_counter() - begin
            total += seconds
            if seconds > longest:
                longest, which, size = seconds, number, len(text)
        print(
            f"{kind:20} {number + 1:6} inputs, {total:6.1f} s; longest {1000 * longest:6.0f} ms"
            f" for {size} characters, number {which}"
        )
    print(f"seed {seed}: {loaded} inputs were sound and loaded, {failed} raised")
    return not failed


def _programs() -> list[bytes]:
    files = [path for folder in ("programs", "tests") for path in (ROOT / folder).rglob("*.mod")]
    found = [path.read_bytes() for path in sorted(files)]
    for rule in all_rules():
        found += [*programs(rule, "bad.mod"), *programs(rule, "good.mod")]
    return [text for text in found if 0 < len(text) < LARGEST]


def _try(text: str) -> bool:
    """Whether a text is a program that can be loaded."""
    parsed = parse(Source("fuzz.mod", text))
    checked = check([parsed.file], EVERY_RULE)
    found = without_suppressed((*parsed.diagnostics, *checked.diagnostics), [parsed.file])
    findings = merged(found)
    full(findings, PLAIN, width=80)
    github(findings)
    junit(findings, ["fuzz.mod"])
    json.dumps(
        (sarif(findings, "0"), [json_of(diagnostic_record(one)) for one in findings]),
        allow_nan=False,
    )
    fixed = edited_text(text, choose_fixes(found, unsafe=True).edits.get("fuzz.mod", ()))
    assert fixed != text or not any(one.fix for one in found), "a fix changes nothing"
    if checked.program is None or any(d.severity is Severity.ERROR for d in parsed.diagnostics):
        return False
    try:
        load(checked.program, cast(Controller, SimpleNamespace()))
    except (FatalError, NotExecutableError):
        return False
    return True


def random_bytes(dice: random.Random) -> str:
    """Bytes of any value, read as a file is."""
    return decode(dice.randbytes(dice.randrange(2000)))[0]


def random_tokens(dice: random.Random) -> str:
    """Words and marks of the language in no order."""
    return " ".join(dice.choices([*SOUP, "\n", ";\n", ";"], k=dice.randrange(300)))


def inside(statements: str) -> str:
    """Statements in a module that has a main."""
    return f"MODULE m\nVAR num x;\nPROC main()\n{statements}\nENDPROC\nENDMODULE\n"


def characters_changed(text: str, dice: random.Random) -> str:
    """A text with a few characters cut, doubled or put in."""
    for _ in range(dice.randrange(1, 8)):
        start = dice.randrange(len(text) + 1)
        stop = start + dice.choice((0, 1, 1, 2, 30))
        new = dice.choice(("", dice.choice(text or " "), chr(dice.randrange(1, 0x3000)), '"', "\n"))
        text = text[:start] + new + text[stop:]
    return text


def tokens_changed(text: str, dice: random.Random) -> str:
    """A text with a few tokens cut, put in, exchanged or said again."""
    tokens = lex(text)
    pieces = [text[a:b] for a, b in zip(tokens.starts, tokens.ends, strict=True)]
    for _ in range(dice.randrange(1, 8)):
        place = dice.randrange(len(pieces))
        match dice.randrange(4):
            case 0:
                del pieces[place : place + dice.randrange(1, 6)]
                pieces = pieces or [""]
            case 1:
                pieces.insert(place, dice.choice(SOUP))
            case 2:
                pieces[place] = dice.choice(pieces)
            case _:
                begin = dice.randrange(len(pieces))
                pieces[place:place] = pieces[begin : begin + dice.randrange(1, 40)]
    return " ".join(pieces)


def spliced(one: str, other: str, dice: random.Random) -> str:
    """The beginning and the end of one text around a piece of another."""
    cut, begin = dice.randrange(len(one) + 1), dice.randrange(len(other) + 1)
    return one[:cut] + other[begin : begin + dice.randrange(1, 2000)] + one[cut:]
