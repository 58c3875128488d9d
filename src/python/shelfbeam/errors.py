"""Exceptions and warnings. Their text is the sentence of the command line, with keywords instead of flags."""

import sys
import warnings
from types import FrameType


class Error(Exception):
    """An error of shelfbeam.

    `code` is the exit code of the command line, `where` the file and the place in it ("store.json: labels[3]"), and
    `setting` the keyword that the error is about; both may be empty.
    """

    def __init__(self, message: str = "", code: int = 4, where: str = "", setting: str = "") -> None:
        super().__init__(message)
        self.code = code
        self.where = where
        self.setting = setting


class InputError(Error, ValueError):
    """Wrong input; nothing was written."""


class OutputError(InputError, OSError):
    """An output cannot be written; an older file of that name is unchanged."""


class OutOfMemory(Error, MemoryError):
    """The work needs more memory than the process may use."""


class Interrupted(Error):
    """The work was stopped before it had a result. Ctrl-C raises KeyboardInterrupt instead."""


class ShelfbeamWarning(UserWarning):
    """Implausible values of a store, ids that a spreadsheet has changed, or a precision that was not reached."""


def warn(sentence: str) -> None:
    """Warns at the line of the caller of the package."""
    level = 2
    frame: FrameType | None = sys._getframe(1)
    while frame is not None and frame.f_globals.get("__name__", "").startswith(f"{__package__}."):
        level, frame = level + 1, frame.f_back
    warnings.warn(sentence, ShelfbeamWarning, stacklevel=level)


def expect(condition: bool, problem: str, keyword: str) -> None:
    """Raises InputError about a keyword unless the condition holds."""
    if not condition:
        raise InputError(f"{keyword}: {problem}", _WRONG_INPUT, keyword, keyword)


_KINDS: dict[str, type[Error]] = {
    "input": InputError,
    "output": OutputError,
    "memory": OutOfMemory,
    "interrupted": Interrupted,
    "internal": Error,
}
_WRONG_INPUT, _OUT_OF_MEMORY = 2, 5


#: Keywords by the keys of a job, which errors of the compiled part name (options.py).
KEYWORDS: dict[str, str] = {}


def make(kind: str, message: str, code: int, where: str, setting: str) -> Error:
    """The exception for an error of the compiled part."""
    keyword = setting.replace("-", "_")
    place, _, problem = message.removeprefix("options: ").partition(": ")
    if message.startswith("options: ") and place in KEYWORDS:
        keyword = KEYWORDS[place]
        message = f"{keyword}: {problem}"
    elif keyword:
        message = f"{message} ({keyword})"
    return _KINDS["memory" if code == _OUT_OF_MEMORY else kind](message, code, where, keyword)
