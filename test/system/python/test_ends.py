"""Calls of the Python package while the process ends or forks."""

import json
import os
import sys
import textwrap
import threading
import time
import unittest

import shelfbeam as sb
from harness import ProgramTest, output, run
from support import QUICK, ROOM

# Two daemon threads repeat a call. What is printed at the end proves that they were inside calls.
DAEMONS = """
    import atexit, sys, threading, time
    import numpy as np
    import shelfbeam as sb

    store, matrix, begun, ended = sb.Store({room}), np.ones((4, 3)), [], []
    def run():
        while True:
            begun.append(1)
            {call}
            ended.append(1)
    for _ in range(2):
        threading.Thread(target=run, daemon=True).start()
    while len(begun) < 2:
        time.sleep(0.01)
    time.sleep(0.1)
    {last}
    print(len(begun) - len(ended))
"""


class Ends(ProgramTest):
    TIMES = 1  # test_more_slow.py repeats the calls

    def ended(self, call, last="pass"):
        script = textwrap.dedent(DAEMONS).format(room=json.dumps(ROOM), call=call, last=last)
        return run("-c", script, program=sys.executable, cwd=self.folder, timeout=120)

    def test_daemon_threads_inside_calls(self):
        for call in (
            "sb.evaluate(matrix, [0, 1], requirement=1)",
            "sb.simulate(store, samples=2000)",
            "sb.simulate(store, samples=10**9)",
            "sb.simulate(store, samples=10**9, progress=lambda state: sum(range(10**5)))",
            "sb.simulate(store, samples=10**9, progress=lambda state: time.sleep(1000))",
            "sb.LightOperator(store, coarse=True).column([2, 2, 2])",
            "sb.simulate(store, samples=256).save(f'{threading.get_ident()}.h5')",
        ):
            for _ in range(self.TIMES):
                end = self.ended(call)
                self.assertEqual((end.status, end.err), (0, ""), call)
                if "10**9" in call:
                    self.assertEqual(end.out, "2\n", "the control: both are inside")

    def test_calls_at_the_end_of_the_main_thread(self):
        end = self.ended(
            "sb.simulate(store, samples=10**9)",
            "atexit.register(lambda: print(sb.evaluate(matrix, [0], requirement=1).feasible))",
        )
        self.assertEqual((end.status, end.out.split()), (0, ["2", "True"]), end.err)


def in_child(call):
    """The exit status of a fork that makes a call: 0, or 42 for the RuntimeError that advises to spawn."""
    child = os.fork()
    if child == 0:
        status = 1
        try:
            call()
            status = 0
        except RuntimeError as error:
            status = 42 if "spawn" in str(error) else 43
        finally:
            os._exit(status)
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        pid, status = os.waitpid(child, os.WNOHANG)
        if pid:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.005)
    os.kill(child, 9)
    os.waitpid(child, 0)
    return "hangs"


class Forks(unittest.TestCase):
    def setUp(self):
        self.store = sb.Store(ROOM)
        self.mean = sb.simulate(self.store, **QUICK).mean

    def same(self):
        if (sb.simulate(self.store, **QUICK).mean != self.mean).any():
            raise ValueError("other signals")

    def test_a_child_works_if_no_call_was_running(self):
        for _ in range(3):
            sb.simulate(self.store, **QUICK)
            self.assertEqual(in_child(self.same), 0)

    def test_a_child_forked_during_a_call_is_refused(self):
        is_inside, is_over = threading.Event(), threading.Event()

        def show(state):
            is_inside.set()
            if is_over.is_set():
                raise KeyboardInterrupt

        def run():
            with self.assertRaises(KeyboardInterrupt):
                sb.simulate(self.store, samples=10**9, progress=show)

        thread = threading.Thread(target=run)
        thread.start()
        is_inside.wait(60)
        try:
            self.assertEqual(in_child(self.same), 42)
            simulate = f"sb.simulate(sb.Store({json.dumps(ROOM)}), samples=256, estimator='uniform')"
            script = f"import shelfbeam as sb; print({simulate}.mean.sum())"
            found = output("-c", script, program=sys.executable)
            self.assertEqual(found, str(self.mean.sum()) + "\n", "new processes work")
            self.same()
        finally:
            is_over.set()
            thread.join()
        self.assertEqual(in_child(self.same), 0, "the control: without the call")

    def test_a_callable_that_forks(self):
        found = []

        def show(state):
            child = os.fork()
            if child != 0:
                found.append(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
                raise KeyboardInterrupt

        parent = os.getpid()
        try:
            with self.assertRaises(KeyboardInterrupt):
                sb.simulate(self.store, samples=10**9, progress=show)
        except RuntimeError as error:
            if os.getpid() != parent:
                os._exit(42 if "spawn" in str(error) else 43)
            raise
        finally:
            if os.getpid() != parent:
                os._exit(1)
        self.assertEqual(found, [42])
