"""The client's side of a WebSocket (RFC 6455), as far as the planner needs it."""

import base64
import os
import socket
import struct
import urllib.parse

CONTINUATION, TEXT, BINARY, CLOSE, PING, PONG = 0, 1, 2, 8, 9, 10


class Refused(Exception):
    """The server does not open the socket."""

    def __init__(self, status, head):
        super().__init__(f"status {status}")
        self.status = status
        self.head = head


class Closed(Exception):
    """The server has ended the connection, with a code if it said farewell."""

    def __init__(self, code=None):
        super().__init__(f"code {code}")
        self.code = code


def masked(data, key):
    long_key = key * (len(data) // 4 + 1)
    whole = int.from_bytes(data, "big") ^ int.from_bytes(long_key[: len(data)], "big")
    return whole.to_bytes(len(data), "big")


class WebSocket:
    """`address` is that of the page; `fields` replace fields of the request's head."""

    def __init__(self, address, timeout=20, **fields):
        url = urllib.parse.urlsplit(address)
        head = {"Host": url.netloc, "Origin": f"http://{url.netloc}", "Upgrade": "websocket", "Connection": "Upgrade"}
        head |= {
            "Sec-WebSocket-Version": "13",
            "Sec-WebSocket-Key": base64.b64encode(os.urandom(16)).decode(),
            **fields,
        }
        self._socket = socket.create_connection((url.hostname, url.port), timeout)
        self._reader = self._socket.makefile("rb")
        lines = "".join(f"{name}: {value}\r\n" for name, value in head.items())
        self._socket.sendall(f"GET {url.path}socket HTTP/1.1\r\n{lines}\r\n".encode())
        self.head = b"".join(iter(self._line, b"\r\n"))
        status = int(self.head.split()[1])
        if status != 101:
            self.close()
            raise Refused(status, self.head)

    def close(self):
        self._reader.close()
        self._socket.close()

    def send(self, data, kind=TEXT):
        data = data.encode() if isinstance(data, str) else data
        size = len(data)
        length = bytes([128 | size]) if size < 126 else struct.pack(">BH", 254, size) if size < 1 << 16 else None
        key = os.urandom(4)
        head = bytes([128 | kind]) + (length or struct.pack(">BQ", 255, size)) + key
        try:
            self._socket.sendall(head + masked(data, key))
        except ConnectionError as error:
            raise Closed from error

    def receive(self):
        """The kind and the bytes of the next message, of which the server may send fragments."""
        message, kind = b"", CONTINUATION
        while True:
            first, second = self._bytes(2)
            size = second & 127
            if size >= 126:
                size = int.from_bytes(self._bytes(2 if size == 126 else 8), "big")
            data = self._bytes(size)
            if first & 15 == CLOSE:
                self.send(data, CLOSE)
                raise Closed(int.from_bytes(data[:2], "big"))
            if first & 15 == PING:
                self.send(data, PONG)
            if first & 15 > BINARY:
                continue
            kind = kind or first & 15
            message += data
            if first & 128:
                return kind, message

    def _line(self):
        line = self._reader.readline()
        if not line:
            raise Closed
        return line

    def _bytes(self, size):
        try:
            data = self._reader.read(size)
        except ConnectionError as error:
            raise Closed from error
        if len(data) < size:
            raise Closed
        return data
