"""Answers as bodies of Robot Web Services: JSON, HAL JSON, XHTML, and the text of an event."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from html import escape
from typing import Final
from urllib.parse import quote

from rapidsim.server.messages import Answer, ErrorAnswer, Item
from rapidsim.values import value_class

JSON: Final = "application/json"
XHTML: Final = "application/xhtml+xml"
_DONE: Final = 294912
"""Code of success in RobotWare 7."""
_PARTS: Final = {"sys-options-li": "options", "dev-id": "devices"}
"""The name under which JSON has the parts of an item of a class; `attrib` for all others."""
_NUMBERS: Final = {"ios-signal-li": ("lvalue",)}
"""Fields of listed items that JSON of RobotWare 6 has as numbers, by class."""
_XHTML_KINDS: Final = {"sys-options": "sys-option"}
"""Classes that RobotWare 7 names otherwise in XHTML than in JSON."""
_BEGIN: Final = (
    '<?xml version="1.0" encoding="UTF-8"?><html xmlns="http://www.w3.org/1999/xhtml"><head>'
)
_HEAD: Final = f"{_BEGIN}<title>rapidsim</title>"


@value_class(frozen=True, slots=True)
class RequestLocation:
    """Addresses of a request, to which those in its answer are relative."""

    root: str
    """Root of the server, with the slash at its end."""
    path: str
    """Decoded path, without slashes at its ends."""
    query: str = ""

    def base_path(self, answer: Answer) -> str:
        """Path to which hrefs are relative."""
        if answer.base is not None:
            return answer.base
        if answer.resources is not None and self.path.startswith("rw/"):
            return "/".join(self.path.split("/")[:2])
        return self.path

    def base(self, answer: Answer) -> str:
        """Address to which hrefs are relative."""
        path = self.base_path(answer)
        return f"{self.root}{quote(path)}/" if path else self.root

    def itself(self, answer: Answer) -> str:
        """Href of the requested resource."""
        inside = self.path.removeprefix(self.base_path(answer)).strip("/")
        return f"{inside}?{self.query}" if self.query else inside


def json_body(answer: Answer, location: RequestLocation) -> str:
    """Return an answer as JSON."""
    base = location.base_path(answer)
    links = {"base": location.base(answer)}
    if answer.following:
        links["next"] = _with_json(_relative(answer.following, base))
    links |= {one: _with_json(one) for one in answer.links}
    state = [_json_item(one, base, _with_json) for one in answer.items]
    for one in answer.resources or ():
        state.append(_json_item(one, base, _with_json) | _numbers(one))
    return json.dumps({"_links": _json_links(links), "_embedded": {"_state": state}})


def _with_json(href: str) -> str:
    """Return an address whose answer is JSON, too."""
    return f"{href}{'&' if '?' in href else '?'}json=1"


def _numbers(item: Item) -> dict[str, object]:
    """The fields of a listed item that are numbers, not texts."""
    return {key: json.loads(item.fields[key]) for key in _NUMBERS.get(item.kind, ())}


def json_refusal(refusal: ErrorAnswer, root: str) -> str:
    """Return an error as JSON."""
    status = {"code": refusal.code, "msg": refusal.message}
    embedded = {"status": status, "_state": list[object]()}
    return json.dumps({"_links": _json_links({"base": root}), "_embedded": embedded})


def hal_body(answer: Answer, location: RequestLocation) -> str:
    """Return an answer as HAL JSON, in the format of RobotWare 7.

    Lists of resources stand apart and have no status; ampersands are escaped as in XHTML.
    """
    base = location.base_path(answer)
    links = {"base": location.base(answer), "self": location.itself(answer)}
    if answer.following:
        links["next"] = _relative(answer.following, base)
    shown: dict[str, object] = {
        "_links": _json_links({key: escape(one, quote=False) for key, one in links.items()})
    }
    if answer.resources is None:
        shown["status"] = {"code": _DONE}
    if answer.items or answer.resources is None:
        shown["state"] = [_hal_item(one, base, location.root) for one in answer.items]
    resources = [_json_item(one, base) for one in answer.resources or ()]
    resources += [{**_itself(one), "_title": one} for one in answer.links]
    if resources or answer.resources is not None:
        shown["_embedded"] = {"resources": resources}
    return json.dumps(shown)


def hal_refusal(refusal: ErrorAnswer, root: str) -> str:
    """Return an error as HAL JSON."""
    status = {"code": refusal.code, "msg": refusal.message}
    return json.dumps({"_links": _json_links({"base": root}), "status": status})


def xhtml_body(answer: Answer, location: RequestLocation) -> str:
    """Return an answer as a page."""
    base = location.base_path(answer)
    links = "".join(f'<a href="{_quoted(one)}" rel="{_quoted(one)}"/>' for one in answer.links)
    if answer.following:
        links += f'<a href="{_quoted(_relative(answer.following, base))}" rel="next"/>'
    shown = (*answer.items, *(answer.resources or ()))
    items = "".join(_xhtml_item(one, base) for one in shown)
    itself = _quoted(location.itself(answer))
    content = f'<div class="state"><a href="{itself}" rel="self"/>{links}<ul>{items}</ul></div>'
    return _page(location.base(answer), content)


def xhtml_refusal(refusal: ErrorAnswer, root: str) -> str:
    """Return an error as a page."""
    return _page(root, _status(refusal))


def later_xhtml_refusal(refusal: ErrorAnswer, root: str) -> str:
    """Return an error as a page of RobotWare 7, which has no title."""
    return _page(root, _status(refusal), _BEGIN)


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
    shown = "".join(_xhtml_item(one, base="") for one in items)
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


def _json_links(links: Mapping[str, str]) -> dict[str, object]:
    return {name: {"href": href} for name, href in links.items()}


def _itself(href: str) -> dict[str, object]:
    return {"_links": _json_links({"self": href})} if href else {}


def _relative(href: str, base: str) -> str:
    """Return an address below the root relative to another, if it is below that one."""
    if not href or href.startswith("/"):
        return href
    inside = href.removeprefix(f"{base}/") if base else href
    return inside if inside != href or not base else f"/{href}"


def _json_item(item: Item, base: str, address: Callable[[str], str] = str) -> dict[str, object]:
    href = _relative(item.href, base)
    shown: dict[str, object] = {
        **_itself(address(href) if href else ""),
        "_type": item.kind,
        "_title": item.title,
        **item.fields,
    }
    if item.arguments:
        shown["argv"] = [{"type": "string", "value": one} for one in item.arguments]
    if item.parts:
        shown[_PARTS.get(item.kind, "attrib")] = [
            _json_item(one, base, address) for one in item.parts
        ]
    return shown


def _hal_item(item: Item, base: str, root: str) -> dict[str, object]:
    if not item.is_nested:
        return _json_item(item, base)
    inside: dict[str, object] = {**item.fields}
    if item.error:
        inside["_links"] = _json_links({"error": f"{root}{_reason(item)}"})
    return {"_type": item.kind, "_title": item.title, item.title: inside}


def _reason(item: Item) -> str:
    return f"rw/retcode?code={item.error}"


def _xhtml_item(item: Item, base: str) -> str:
    spans = [
        f'<span class="{_quoted(name)}">{escape(_plain(text), quote=False)}</span>'
        for name, text in item.fields.items()
    ]
    spans += [
        f'<span class="arg{number}" type="string">{escape(_plain(text), quote=False)}</span>'
        for number, text in enumerate(item.arguments, start=1)
    ]
    parts = "".join(_xhtml_item(one, base) for one in item.parts)
    inside = f"<ul>{parts}</ul>" if parts else ""
    href = _relative(item.href, base)
    itself = f'<a href="{_quoted(href)}" rel="self"/>' if href else ""
    if item.error:
        itself += f'<a href="/{_reason(item)}" rel="error"/>'
    kind = _XHTML_KINDS.get(item.kind, item.kind)
    return (
        f'<li class="{_quoted(kind)}" title="{_quoted(item.title)}">'
        f"{itself}{''.join(spans)}{inside}</li>"
    )


def _quoted(text: str) -> str:
    return escape(_plain(text))


def _plain(text: str) -> str:
    """Return a text in one line, without characters that a page must not contain."""
    return "".join(one if one >= " " else " " for one in text if one not in "\ufffe\uffff")
