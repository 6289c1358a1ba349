"""Compute the LALR table of the grammar with Lark: `python -m rapidsim.syntax.build_table`.

The only module that imports Lark, and the only place that reads Lark's internal parse table. Nobody
runs it but who changes the grammar, so that another version of Lark can break no check.
"""

from __future__ import annotations

import io
import json
import logging
from typing import Any

import lark
from lark.grammar import Rule as LarkRule
from lark.grammar import Terminal
from lark.lexer import PatternStr
from lark.parsers.lalr_analysis import Shift

from rapidsim.shipped import shipped
from rapidsim.syntax.table import ACCEPT, END, GRAMMAR_FILE, TABLE_FILE, Exported, fingerprint


class GrammarConflictError(Exception):
    """The grammar is not LALR(1); the message is Lark's list of conflicts."""


def main() -> None:
    """Write the table to the folder of the grammar."""
    folder = shipped("grammars")
    table = export((folder / GRAMMAR_FILE).read_text(encoding="utf-8"))
    (folder / TABLE_FILE).write_text(written(table), encoding="utf-8", newline="\n")


def export(grammar: str) -> Exported:
    """Compute the table of a grammar.

    Raises:
        GrammarConflictError: When the grammar is not LALR(1).
    """
    parser = _lark(grammar)
    rules = sorted(parser.rules, key=str)
    states, terminals, nonterminals = _numbered_states(parser, rules)
    strings = {
        terminal.name: terminal.pattern.value
        for terminal in parser.terminals
        if isinstance(terminal.pattern, PatternStr)
    }
    return {
        "grammar": fingerprint(grammar),
        "terminals": len(terminals),
        "symbols": terminals + nonterminals,
        "words": {text: name for name, text in sorted(strings.items()) if text.isalpha()},
        "marks": {text: name for name, text in sorted(strings.items()) if not text.isalpha()},
        "patterns": {
            terminal.name: terminal.pattern.value
            for terminal in sorted(parser.terminals, key=lambda terminal: str(terminal.name))
            if terminal.name not in strings
        },
        "rules": [_rule(rule) for rule in rules],
        "states": states,
    }


def written(table: Exported) -> str:
    """Format the table as text, one rule and one state per line, for reviews of changes."""
    lines = []
    for key, value in table.items():
        if isinstance(value, list) and key != "symbols":
            rows = ",\n".join(json.dumps(row, separators=(",", ":")) for row in value)
            lines.append(f'"{key}": [\n{rows}\n]')
        else:
            lines.append(f'"{key}": {json.dumps(value)}')
    return "{\n" + ",\n".join(lines) + "\n}\n"


def _lark(grammar: str) -> lark.Lark:
    # Lark resolves a shift/reduce conflict silently, but logs it at debug level.
    log = io.StringIO()
    handler = logging.StreamHandler(log)
    level = lark.logger.level
    lark.logger.addHandler(handler)
    lark.logger.setLevel(logging.DEBUG)
    try:
        parser = lark.Lark(
            grammar, parser="lalr", lexer="basic", start="file", maybe_placeholders=True, debug=True
        )
    except lark.exceptions.GrammarError as error:
        raise GrammarConflictError(str(error)) from error
    finally:
        lark.logger.removeHandler(handler)
        lark.logger.setLevel(level)
    if "conflict" in log.getvalue().lower():
        raise GrammarConflictError(log.getvalue())
    return parser


def _numbered_states(
    parser: lark.Lark, rules: list[LarkRule]
) -> tuple[list[list[int]], list[str], list[str]]:
    """Number states in the order in which a search from the start reaches them.

    Lark's own numbers follow the order of sets, which differs from run to run.

    Returns:
        The rows, the terminals and the nonterminals; a row alternates symbol and action.
    """
    table: Any = parser.parser.parser._parse_table
    rule_numbers = {rule: number for number, rule in enumerate(rules)}
    nonterminal_names = {str(rule.origin.name) for rule in rules}
    nonterminals = sorted(nonterminal_names)
    terminals = sorted(
        {symbol for row in table.states.values() for symbol in row} - nonterminal_names
    )
    symbol_numbers = {symbol: number for number, symbol in enumerate(terminals + nonterminals)}
    start, end = table.start_states["file"], table.end_states["file"]
    numbers = {start: 0}
    order = [start]
    rows: list[list[int]] = []
    for state in order:
        if state == end:
            rows.append([symbol_numbers[END], ACCEPT])
            continue
        row: list[int] = []
        for symbol in sorted(table.states[state], key=symbol_numbers.__getitem__):
            action, target = table.states[state][symbol]
            if action is Shift:
                if target not in numbers:
                    numbers[target] = len(order)
                    order.append(target)
                encoded = numbers[target] + (symbol not in nonterminal_names)
            else:
                encoded = -(rule_numbers[target] + 1)
            row += [symbol_numbers[symbol], encoded]
        rows.append(row)
    return rows, terminals, nonterminals


def _rule(rule: LarkRule) -> tuple[str, int, str | None, list[int | None]]:
    """Format a rule as origin, length, build, children; see `table.GrammarRule`."""
    origin = str(rule.origin.name)
    absent = _absent_before(rule)
    children: list[int | None] = []
    for position, symbol in enumerate(rule.expansion):
        children += [None] * absent[position]
        if not (isinstance(symbol, Terminal) and symbol.filter_out):
            children.append(position)
    children += [None] * absent[-1]
    build: str | None = rule.alias or origin
    if origin.startswith("__"):
        build = ""
    elif origin.startswith("_") or (rule.options.expand1 and not rule.alias and len(children) == 1):
        assert len(children) == 1, f"a rule that vanishes needs one child: {rule}"
        build = None
    return origin, len(rule.expansion), build, children


def _absent_before(rule: LarkRule) -> list[int]:
    """Number of absent optional children before each symbol, and after the last."""
    if not rule.options.empty_indices:
        return [0] * (len(rule.expansion) + 1)
    flags = "".join(str(int(absent)) for absent in rule.options.empty_indices)
    return [len(ones) for ones in flags.split("0")]


if __name__ == "__main__":
    main()
