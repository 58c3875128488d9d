"""The exceptions of the package. Their text is the sentence of the command line, with keywords instead of flags."""


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


_KINDS: dict[str, type[Error]] = {
    "input": InputError,
    "output": OutputError,
    "memory": OutOfMemory,
    "interrupted": Interrupted,
}
_OUT_OF_MEMORY = 5


def make(kind: str, message: str, code: int, where: str, setting: str) -> Error:
    """The exception for an error of the compiled part."""
    keyword = setting.replace("-", "_")
    if keyword:
        message = f"{message} ({keyword})"
    return _KINDS["memory" if code == _OUT_OF_MEMORY else kind](message, code, where, keyword)
