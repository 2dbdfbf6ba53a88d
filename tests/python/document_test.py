"""What docs/python.md and README.md show runs and prints what they say; everything has a docstring."""

import contextlib
import inspect
import io
import os
import re
import subprocess

import pytest

import boresight
from conftest import SOURCE


def examples(document):
    """(code, what it prints) of each Python example."""
    text = (SOURCE / document).read_text(encoding="utf-8")
    return re.findall(r"```python\n(.*?)```\n(?:\n```text\n(.*?)```)?", text, re.S)


@pytest.mark.parametrize("document", ["README.md", "docs/python.md"])
def test_examples_run_and_print_what_is_shown(document, monkeypatch):
    monkeypatch.chdir(SOURCE)
    found = examples(document)
    assert found, f"{document} shows no Python"
    known = {}
    for code, shown in found:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(code, document, "exec"), known)
        assert printed.getvalue()
        if shown:
            assert printed.getvalue().split() == shown.split()


def test_the_readmes_example_has_eight_lines():
    [(code, _)] = examples("README.md")
    assert len([line for line in code.splitlines() if line.strip()]) <= 8


def members(thing):
    for name, member in inspect.getmembers(thing):
        if not name.startswith("_"):
            yield name, member


def test_everything_has_a_docstring():
    for name, member in members(boresight):
        if inspect.ismodule(member) or isinstance(member, float):
            continue
        assert member.__doc__, name
        if inspect.isclass(member) and not issubclass(member, BaseException):
            for attribute, value in members(member):
                if callable(value):
                    assert value.__doc__, f"{name}.{attribute}"


def test_version_is_the_programs():
    printed = subprocess.run([os.environ["BORESIGHT_PROGRAM"], "--version"], capture_output=True,
                             text=True, check=True).stdout
    assert boresight.__version__ in printed
