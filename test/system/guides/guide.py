"""Runs the commands of a page of documentation.

Every fenced block of the page has one of these kinds:
  sh, python, octave   runs in the order of the page, in one folder; `sh needs=PROGRAM` runs only if PROGRAM is
                       installed, octave only if octave is. A block whose last line ends with `# exit code N` must
                       exit with N, any other block with 0
  sh serves            a server: it is interrupted (Ctrl-C) once the page at the address that it prints has arrived
  text                 whole lines that the output of the block before it contains, in this order; `...` matches any
                       text within a line, and is ignored on a separate line
"""

import gzip
import os
import pathlib
import re
import shutil
import signal
import subprocess
import urllib.request

DOCS = pathlib.Path(__file__).resolve().parents[3] / "docs"

FENCE = re.compile(r"^```(?P<kind>[^\n]*)\n(?P<body>.*?)^```$", re.DOTALL | re.MULTILINE)
ADDRESS = re.compile(r"http://\S+")
EXIT_CODE = re.compile(r"# exit code (\d+)\s*$")
INTERPRETERS = {
    "sh": ["bash", "-euo", "pipefail", "-c"],
    "python": ["/usr/bin/python3", "-c"],
    "octave": ["octave-cli", "--quiet", "--no-init-file", "--eval"],
}


class Wrong(Exception):
    """The commands of a page do not behave as the page states."""


def blocks(page):
    """(line number, kind, needed program or None, body) of every block."""
    for match in FENCE.finditer(page):
        kind, *words = match["kind"].split() or [""]
        needs = "octave-cli" if kind == "octave" else None
        if kind == "sh" and words == ["serves"]:
            kind, words = "sh serves", []
        for word in words:
            if not word.startswith("needs="):
                raise Wrong(f"'{match['kind']}' is no kind of block")
            needs = word.removeprefix("needs=")
        yield page.count("\n", 0, match.start()) + 1, kind, needs, match["body"]


def holds(output, expected):
    """The first line of `expected` that `output` lacks, or None."""
    lines = iter(output.splitlines())
    for wanted in filter(None, map(str.strip, expected.splitlines())):
        pattern = re.compile(".*".join(map(re.escape, wanted.split("..."))))
        if wanted != "..." and not any(pattern.fullmatch(line.strip()) for line in lines):
            return wanted
    return None


def links(page):
    """(file, anchor) of each link of a page to a file, pictures included; the anchor is empty if the link has none."""
    text = re.sub(r'<img src="([^"]*)"', r"](\1)", page.read_text(encoding="utf-8"))
    for target, anchor in re.findall(r"\]\((?!http)([^)#]*)(?:#([^)]*))?\)", text):
        yield (page.parent / target).resolve() if target else page.resolve(), anchor


def anchors(page):
    """The anchors of the headings of a page, as GitHub forms them."""
    found = []
    for heading in re.findall(r"^#+ (.*)$", FENCE.sub("", page), re.MULTILINE):
        found.append(re.sub(r"[^\w -]", "", re.sub(r"\]\([^)]*\)", "]", heading).lower()).strip().replace(" ", "-"))
    earlier = [found[:i].count(anchor) for i, anchor in enumerate(found)]
    return [f"{anchor}-{count}" if count else anchor for anchor, count in zip(found, earlier)]


def named_options(page):
    """The options of shelfbeam that the sentences of a page name, as inline code."""
    for code in re.findall(r"`([^`\n]+)`", FENCE.sub("", page)):
        if code.startswith(("--", "shelfbeam ")):
            yield from re.findall(r"(?<!\S)--[a-z-]+", code)


# All output of a program without input.
STREAMS = {"text": True, "stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}


def run(kind, body, folder, environment):
    """The exit code of a block, and its output."""
    done = subprocess.run([*INTERPRETERS[kind], body], cwd=folder, env=environment, check=False, **STREAMS)
    return done.returncode, done.stdout


def serve(body, folder, environment):
    """The exit code of a server, and its output. It opens no browser, because there is no desktop."""
    without_desktop = {key: environment[key] for key in environment if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
    output, is_page = "", False
    with subprocess.Popen(
        [*INTERPRETERS["sh"], body], cwd=folder, env=without_desktop, start_new_session=True, **STREAMS
    ) as server:
        for line in server.stdout:
            output += line
            if address := ADDRESS.search(line):
                try:
                    with urllib.request.urlopen(address[0], timeout=60) as page:
                        is_gzip = page.headers["Content-Encoding"] == "gzip"
                        content = gzip.decompress(page.read()) if is_gzip else page.read()
                        is_page = content.startswith(b"<!doctype html>")
                finally:
                    os.killpg(server.pid, signal.SIGINT)
    if not is_page:
        raise Wrong(f"no page was served:\n{body}\n{output}")
    return server.returncode, output


def run_page(path, folder, environment):
    """Runs the page in `folder`; returns the number of blocks that ran and the missing programs."""
    ran, missing, output = 0, set(), None
    for line, kind, needs, body in blocks(pathlib.Path(path).read_text(encoding="utf-8")):
        place = f"{path}:{line}"
        if kind == "text":
            if output is not None and (lacking := holds(output, body)) is not None:
                raise Wrong(f"{place}: the output has no line '{lacking}':\n{output}")
            continue
        if kind not in (*INTERPRETERS, "sh serves"):
            raise Wrong(f"{place}: '{kind}' is no kind of block that is run")
        output = None
        if needs and not shutil.which(needs, path=environment["PATH"]):
            missing.add(needs)
            continue
        code, output = serve(body, folder, environment) if kind == "sh serves" else run(kind, body, folder, environment)
        ran += 1
        asked = EXIT_CODE.search(body)
        if code != (int(asked[1]) if asked else 0):
            raise Wrong(f"{place}: exit code {code}:\n{body}\n{output}")
    return ran, missing


def environment(program):
    """The environment with the folders of the program and of scripts/build-highs's solver on the path."""
    solvers = pathlib.Path.home().glob(".cache/shelfbeam/prefix/highs-*/bin")
    folders = [pathlib.Path(program).resolve().parent, *solvers, os.environ["PATH"]]
    return {**os.environ, "PATH": os.pathsep.join(map(str, folders))}
