"""Sessions of linkwork, a command language for planar mechanisms, over a pipe.

    >>> from linkwork import Session
    >>> with Session() as session:
    ...     session.run("point A = (0, 0), B = (3, 4)").lines
    ...     session.evaluate("distance(A, B)")
    []
    5.0

The program does the work: it is in the wheel, and says what it does as JSON (docs/json.md).
"""

import json
import os
import shutil
import subprocess
import sysconfig
from dataclasses import dataclass, field
from pathlib import Path

__all__ = ["Answer", "LinkworkError", "Session"]

VERSION = 1


class LinkworkError(Exception):
    """A statement that could not be carried out."""

    def __init__(self, error):
        place = next((it for it in error.get("places", ()) if it.get("primary")), {})
        self.code = error.get("code")
        self.message = error["message"]
        self.line, self.column = place.get("line"), place.get("column")
        self.helps = error.get("helps", [])
        self.error = error
        says = f": {place['text']}" if place.get("text") else ""
        where = f"line {self.line}, column {self.column}: " if place else ""
        super().__init__("\n".join([f"{where}{self.message}{says}", *self.helps]))


@dataclass
class Answer:
    """What some statements said."""

    lines: list = field(default_factory=list)
    values: list = field(default_factory=list)
    results: dict = field(default_factory=dict)
    fits: list = field(default_factory=list)
    notes: list = field(default_factory=list)
    warnings: list = field(default_factory=list)
    files: list = field(default_factory=list)
    receipts: list = field(default_factory=list)
    objects: list = field(default_factory=list)

    def _take(self, it):
        self.objects.append(it)
        kind = it["type"]
        if kind == "print":
            self.lines.append(it["text"])
            self.values.extend(it.get("values", ()))
        elif kind == "result":
            self.results[it["name"]] = it["value"]
        elif kind == "fit":
            self.fits.append(it)
        elif kind in ("note", "warning"):
            (self.notes if kind == "note" else self.warnings).append(it["message"])
        elif kind == "file":
            self.files.append(it["path"])
        elif kind == "receipt":
            self.receipts.append(it)


def _program():
    """The program of this installation, or that on the path; LINKWORK names another."""
    beside = Path(sysconfig.get_path("scripts")) / "linkwork"
    named = os.environ.get("LINKWORK")
    found = named or (str(beside) if beside.exists() else shutil.which("linkwork"))
    if not found:
        raise FileNotFoundError("no program `linkwork`: it is in the wheel, or set LINKWORK")
    return found


class Session:
    """A session of the program; `with Session() as session:` ends it in order."""

    def __init__(self, out=".", set=None, arguments=()):
        values = [f"--set={name}={value}" for name, value in (set or {}).items()]
        self._process = subprocess.Popen(
            [_program(), "--json", "--out", str(out), *values, *arguments],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            bufsize=0,
        )
        self._read_ahead = bytearray()
        self._n_asked = 0
        self._is_torn = False
        version = self._read()["version"]
        if version != VERSION:
            self.close()
            raise RuntimeError(f"the program speaks version {version}, not {VERSION}")

    def run(self, text):
        """Carries out statements, up to the first mistake; gives what they said."""
        return self._ask({"run": text})

    def evaluate(self, expression):
        """The value of an expression: a number, or a vector as [x, y]."""
        return _first(self.run(f"print {expression}").values, f"`{expression}` has no value")

    def ask(self, question):
        """The object that `list`, `show`, `check` or `limits` answers, as a dict."""
        kinds = ("list", "show", "check", "limits", "effects")
        found = (it for it in self.run(question).objects if it["type"] in kinds)
        return _first(found, f"`{question}` is none of {', '.join(kinds)}")

    def traces(self):
        """The traced paths by name or point: columns x and y, as arrays if there is NumPy."""
        traces = self._get("traces")
        return {it.get("label", it["point"]): (_array(it["x"]), _array(it["y"])) for it in traces}

    def measures(self):
        """What was measured by name: columns time and value, as arrays if there is NumPy."""
        measures = self._get("measures")
        return {it["name"]: (_array(it["time"]), _array(it["value"])) for it in measures}

    def svg(self):
        """A picture of what is now."""
        return self._get("svg")

    _repr_svg_ = svg

    def script(self):
        """The script that brings the session back."""
        return self._get("script")

    def close(self):
        """Ends the session: recordings are written."""
        if self._process.poll() is None:
            self._process.stdin.close()
            self._process.stdout.read()
            self._process.wait()
        self._process.stdout.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _get(self, what):
        found = (it for it in self._ask({"get": what}).objects if it["type"] == what)
        return _first(found, f"there is no `{what}`")[what]

    def _ask(self, request):
        number = self._send(request)
        answer, error = Answer(), None
        while True:
            it = self._read()
            if it["type"] == "done":
                if it["id"] == number:
                    break
                # That was the answer to a question whose asker was interrupted.
                answer, error = Answer(), None
                continue
            if it["type"] == "error" and error is None:
                error = it
            answer._take(it)
        if error is None and not it["ok"]:
            error = {"message": "it was stopped"}
        if error is not None:
            raise LinkworkError(error)
        return answer

    def _send(self, request):
        """Sends a request; gives the number that its answer will have."""
        self._n_asked += 1
        line = json.dumps({**request, "id": self._n_asked}) + "\n"
        # What an interrupted sender left of a line ends here: it is answered as no request.
        left = memoryview((b"\n" if self._is_torn else b"") + line.encode())
        self._is_torn = True
        while left:
            left = left[self._process.stdin.write(left) :]
        self._is_torn = False
        return self._n_asked

    def _read(self):
        """The next object. What was read of it stays read where the reader is interrupted."""
        seen = 0
        while (end := self._read_ahead.find(b"\n", seen)) < 0:
            seen = len(self._read_ahead)
            piece = self._process.stdout.read(1 << 16)
            if not piece:
                raise EOFError(f"the program ended with status {self._process.wait()}")
            self._read_ahead += piece
        line = self._read_ahead[:end]
        del self._read_ahead[: end + 1]
        return json.loads(line)


def _first(found, otherwise):
    for it in found:
        return it
    raise LookupError(otherwise)


def _array(column):
    try:
        from numpy import array
    except ImportError:
        return column
    return array(column)
