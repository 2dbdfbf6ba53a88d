"""Long work lets other Python threads run, and Ctrl-C ends it."""

import os
import signal
import subprocess
import sys
import threading
import time

import pytest

import boresight


def test_other_threads_run_meanwhile(antenna):
    begun, ended = threading.Event(), threading.Event()
    turns = []

    def count():
        begun.wait()
        while not ended.is_set():
            turns.append(None)
            time.sleep(1e-3)

    counter = threading.Thread(target=count)
    counter.start()
    try:
        begun.set()
        boresight.simulate(antenna, "slosh")
    finally:
        ended.set()
        counter.join()
    # With the interpreter's lock held there would be next to none.
    assert len(turns) > 3


# Stands in for a user who presses Ctrl-C once the work has begun.
INTERRUPTED = """
import os, signal, sys, threading
import boresight
antenna = boresight.read_case(sys.argv[1])
threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    boresight.tune(antenna, starts=100000)
except KeyboardInterrupt:
    print("stopped, and of use:", round(boresight.plant(antenna).gear_ratio))
"""


def test_control_c_ends_a_tuning_that_would_take_hours(case_path):
    environment = dict(os.environ, PYTHONPATH=os.environ["BORESIGHT_MODULE_FOLDER"])
    run = subprocess.run([sys.executable, "-c", INTERRUPTED, case_path], env=environment,
                         capture_output=True, text=True, check=False, timeout=240)
    assert run.stdout == "stopped, and of use: 28724\n", run.stderr
    assert run.returncode == 0


def test_an_interpreters_own_handler_decides(antenna):
    class Enough(Exception):
        pass

    def refuse(number, frame):
        raise Enough

    before = signal.signal(signal.SIGINT, refuse)
    threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
    try:
        with pytest.raises(Enough):
            boresight.tune(antenna, ["PI"], starts=100000)
    finally:
        signal.signal(signal.SIGINT, before)
