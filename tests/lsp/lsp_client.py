"""A client of the language server on standard input and output, without a library."""

from __future__ import annotations

import json
import queue
import subprocess
import sys
import threading
from typing import Any

_TIMEOUT_S = 60.0


class Client:
    """A server in a process of its own, and the messages that it sent."""

    def __init__(self, capabilities: dict[str, Any] | None = None, **initialize: object) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-m", "rapidsim", "lsp"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        self._lock = threading.Lock()
        self._incoming: queue.Queue[dict[str, Any] | None] = queue.Queue()
        self._others: list[dict[str, Any]] = []
        self._number = 0
        threading.Thread(target=self._read, daemon=True).start()
        self.server: dict[str, Any] = self.request(
            "initialize",
            {
                "processId": None,
                "rootUri": None,
                "capabilities": capabilities or {},
                **initialize,
            },
        )
        self.notify("initialized", {})

    def notify(self, method: str, parameters: object) -> None:
        """Send a notification."""
        self._send({"method": method, "params": parameters})

    def start(self, method: str, parameters: object) -> int:
        """Send a request, and return its number."""
        self._number += 1
        self._send({"id": self._number, "method": method, "params": parameters})
        return self._number

    def request(self, method: str, parameters: object) -> Any:
        """The result of a request; raises with the error of the server."""
        answer = self.answer(self.start(method, parameters))
        if "error" in answer:
            raise RuntimeError(answer["error"]["message"])
        return answer["result"]

    def answer(self, number: int) -> dict[str, Any]:
        """The answer to a request."""
        return self._next(lambda message: message.get("id") == number and "method" not in message)

    def notification(self, method: str) -> Any:
        """The parameters of the next notification, or request of the server, of a method."""
        message = self._next(lambda one: one.get("method") == method)
        return message.get("params")

    def diagnostics(self, uri: str) -> list[dict[str, Any]]:
        """The next findings that the server publishes for a document."""
        while (found := self.notification("textDocument/publishDiagnostics"))["uri"] != uri:
            pass
        return list(found["diagnostics"])

    def open(self, uri: str, text: str) -> None:
        """Open a document."""
        document = {"uri": uri, "languageId": "rapid", "version": 1, "text": text}
        self.notify("textDocument/didOpen", {"textDocument": document})

    def change(self, uri: str, version: int, *changes: dict[str, Any]) -> None:
        """Change a document."""
        self.notify(
            "textDocument/didChange",
            {
                "textDocument": {"uri": uri, "version": version},
                "contentChanges": list(changes),
            },
        )

    def close(self) -> tuple[int, str]:
        """End the server in order; its exit code, and what it wrote to standard error."""
        self.request("shutdown", None)
        self.notify("exit", None)
        _, errors = self._process.communicate(timeout=_TIMEOUT_S)
        return self._process.returncode, errors.decode()

    def _next(self, is_meant: Any) -> dict[str, Any]:
        for index, message in enumerate(self._others):
            if is_meant(message):
                return self._others.pop(index)
        while True:
            received = self._incoming.get(timeout=_TIMEOUT_S)
            if received is None:
                code = self._process.wait(_TIMEOUT_S)
                assert self._process.stderr is not None
                errors = self._process.stderr.read().decode()
                raise AssertionError(f"the server has ended with {code}: {errors}")
            if is_meant(received):
                return received
            self._others.append(received)

    def _send(self, message: dict[str, Any]) -> None:
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        assert self._process.stdin is not None
        with self._lock:
            self._process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
            self._process.stdin.flush()

    def _read(self) -> None:
        stream = self._process.stdout
        assert stream is not None
        while header := stream.readline():
            length = 0
            while header.strip():
                name, _, value = header.partition(b":")
                if name.lower() == b"content-length":
                    length = int(value)
                header = stream.readline()
            message = json.loads(stream.read(length))
            if "id" in message and "method" in message:
                self._send({"id": message["id"], "result": None})
            self._incoming.put(message)
        self._incoming.put(None)
