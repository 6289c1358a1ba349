"""A file that a program reads and writes in memory."""

from __future__ import annotations


class MemoryFile:
    def __init__(self, content: bytearray) -> None:
        self.content = content
        self.at = 0
        self.closed = False

    def write(self, data: bytes) -> None:
        self.content += data

    def read_line(self) -> bytes | None:
        end = self.content.find(b"\n", self.at)
        end = len(self.content) if end < 0 else end
        if self.at >= len(self.content):
            return None
        line = bytes(self.content[self.at : end])
        self.at = end + 1
        return line

    def read(self, count: int) -> bytes:
        data = bytes(self.content[self.at : self.at + count])
        self.at += len(data)
        return data

    def rewind(self) -> None:
        self.at = 0

    def close(self) -> None:
        self.closed = True
