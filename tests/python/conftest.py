"""Where the tests of the Python module find what was built: set by tests/CMakeLists.txt."""

import json
import os
import pathlib
import subprocess
import sys

import pytest

sys.path.insert(0, os.environ["BORESIGHT_MODULE_FOLDER"])
PROGRAM = os.environ["BORESIGHT_PROGRAM"]
SOURCE = pathlib.Path(os.environ["BORESIGHT_SOURCE"])


@pytest.fixture(scope="session")
def case_path():
    return str(SOURCE / "cases/dss14-70m/case.toml")


@pytest.fixture(scope="session")
def antenna(case_path):
    import boresight
    return boresight.read_case(case_path)


@pytest.fixture(scope="session")
def program(case_path):
    """The program's JSON report of a command on the case."""
    def run(command, *arguments):
        return json.loads(subprocess.run([PROGRAM, command, case_path, *arguments, "--json", "-"],
                                         capture_output=True, check=True).stdout)
    return run
