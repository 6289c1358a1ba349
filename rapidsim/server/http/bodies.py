"""Answers as bodies of Robot Web Services: JSON, HAL JSON, XHTML, and the text of an event."""

from __future__ import annotations

import json
from collections.abc import Iterable
from html import escape
from typing import Final

from rapidsim.server.messages import Answer, ErrorAnswer, Item

JSON: Final = "application/json"
XHTML: Final = "application/xhtml+xml"
_DONE: Final = 294912
"""Code of success in RobotWare 7."""
_PARTS: Final = {"sys-options-li": "options"}
"""The name under which JSON has the parts of an item of a class; `attrib` for all others."""
_BEGIN: Final = (
    '<?xml version="1.0" encoding="UTF-8"?><html xmlns="http://www.w3.org/1999/xhtml"><head>'
)
_HEAD: Final = f"{_BEGIN}<title>rapidsim</title>"


def json_body(answer: Answer, base: str) -> str:
    """Return an answer as JSON."""
    links = {"base": {"href": base}, **{one: {"href": one} for one in answer.links}}
    items = [_json_item(one) for one in answer.items]
    return json.dumps({"_links": links, "_embedded": {"_state": items}})


def json_refusal(refusal: ErrorAnswer, base: str) -> str:
    """Return an error as JSON."""
    status = {"code": refusal.code, "msg": refusal.message}
    embedded = {"status": status, "_state": list[object]()}
    return json.dumps({"_links": {"base": {"href": base}}, "_embedded": embedded})


def hal_body(answer: Answer, base: str) -> str:
    """Return an answer as HAL JSON, in the format of RobotWare 7."""
    links: dict[str, object] = {"base": {"href": base}}
    if answer.following:
        links["next"] = {"href": answer.following}
    items = [_json_item(one) for one in answer.items]
    resources = [{"_links": {"self": {"href": one}}, "_title": one} for one in answer.links]
    shown: dict[str, object] = {"_links": links, "status": {"code": _DONE}, "state": items}
    if resources:
        shown["_embedded"] = {"resources": resources}
    return json.dumps(shown)


def hal_refusal(refusal: ErrorAnswer, base: str) -> str:
    """Return an error as HAL JSON."""
    status = {"code": refusal.code, "msg": refusal.message}
    return json.dumps({"_links": {"base": {"href": base}}, "status": status})


def xhtml_body(answer: Answer, base: str) -> str:
    """Return an answer as a page."""
    links = "".join(f'<a href="{_quoted(one)}" rel="{_quoted(one)}"/>' for one in answer.links)
    if answer.following:
        links += f'<a href="{_quoted(answer.following)}" rel="next"/>'
    items = "".join(_xhtml_item(one) for one in answer.items)
    return _page(base, f'<div class="state"><a href="" rel="self"/>{links}<ul>{items}</ul></div>')


def xhtml_refusal(refusal: ErrorAnswer, base: str) -> str:
    """Return an error as a page."""
    return _page(base, _status(refusal))


def later_xhtml_refusal(refusal: ErrorAnswer, base: str) -> str:
    """Return an error as a page of RobotWare 7, which has no title."""
    return _page(base, _status(refusal), _BEGIN)


def subscribed(group: int, link: str, base: str) -> str:
    """Return the page of a new subscription group.

    Public clients rely on this exact order of attributes, with none after them.
    """
    href = _quoted(link)
    return _page(
        base,
        f'<div class="state"><a href="subscription/{group}" rel="group"></a>'
        f'<a href="{href}" rel="self"></a></div>',
    )


def event_text(group: int, items: Iterable[Item]) -> str:
    """Return a change as one frame of a websocket: a page in one line, which clients need."""
    shown = "".join(_xhtml_item(one) for one in items)
    return (
        f'{_HEAD}</head><body><div class="state"><a href="subscription/{group}" rel="group"></a>'
        f"<ul>{shown}</ul></div></body></html>"
    )


def _status(refusal: ErrorAnswer) -> str:
    message = escape(_plain(refusal.message))
    return (
        f'<div class="status"><span class="code">{refusal.code}</span>'
        f'<span class="msg">{message}</span></div>'
    )


def _page(base: str, content: str, head: str = _HEAD) -> str:
    return f'{head}<base href="{_quoted(base)}"/></head><body>{content}</body></html>'


def _json_item(item: Item) -> dict[str, object]:
    shown: dict[str, object] = {"_type": item.kind, "_title": item.title, **item.fields}
    if item.arguments:
        shown["argv"] = [{"type": "string", "value": one} for one in item.arguments]
    if item.parts:
        shown[_PARTS.get(item.kind, "attrib")] = [_json_item(one) for one in item.parts]
    return shown


def _xhtml_item(item: Item) -> str:
    spans = [
        f'<span class="{_quoted(name)}">{escape(_plain(text), quote=False)}</span>'
        for name, text in item.fields.items()
    ]
    spans += [
        f'<span class="arg{number}" type="string">{escape(_plain(text), quote=False)}</span>'
        for number, text in enumerate(item.arguments, start=1)
    ]
    parts = "".join(map(_xhtml_item, item.parts))
    inside = f"<ul>{parts}</ul>" if parts else ""
    itself = f'<a href="{_quoted(item.href)}" rel="self"/>' if item.href else ""
    return (
        f'<li class="{_quoted(item.kind)}" title="{_quoted(item.title)}">'
        f"{itself}{''.join(spans)}{inside}</li>"
    )


def _quoted(text: str) -> str:
    return escape(_plain(text))


def _plain(text: str) -> str:
    """Return a text in one line, without characters that a page must not contain."""
    return "".join(one if one >= " " else " " for one in text if one not in "\ufffe\uffff")
