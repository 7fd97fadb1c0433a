"""Other threads go on, Ctrl-C ends a call, and the example runs to its end."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import signorini

EXAMPLE = Path(__file__).parents[1] / "examples" / "heated_plate.py"


def test_other_threads_run_meanwhile(scenes):
    counted = [0]
    done = threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    signorini.solve(scenes / "levee.toml", max_error="3%")
    during = counted[0] - before
    done.set()
    thread.join()
    assert during > 3


def test_results_of_threads_are_those_of_one(scenes):
    names = ["levee", "slab", "strip", "levee"]
    alone = {name: signorini.solve(scenes / f"{name}.toml").u.tobytes() for name in set(names)}
    found = {}

    def solve(at, name):
        found[at] = (name, signorini.solve(scenes / f"{name}.toml").u.tobytes())

    threads = [threading.Thread(target=solve, args=of) for of in enumerate(names)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == len(names)
    assert all(alone[name] == u for name, u in found.values())


def test_an_interrupt_ends_a_call(scenes):
    program = (
        "import signal, signorini\n"
        # Who starts the tests in the background may have told their children to ignore it.
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "print('begun', flush=True)\n"
        "try:\n"
        f"    signorini.solve({str(scenes / 'levee.toml')!r}, max_error='0.01%', max_unknowns=100_000_000)\n"
        "except KeyboardInterrupt:\n"
        "    print('interrupted', flush=True)\n"
        "    import os; os._exit(0)\n"
    )
    child = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "begun\n"
    time.sleep(1.0)
    child.send_signal(signal.SIGINT)
    said, _ = child.communicate(timeout=60)
    assert said == "interrupted\n" and child.returncode == 0


def test_the_example_runs(tmp_path):
    environment = {**os.environ, "MPLBACKEND": "Agg"}
    said = subprocess.run(
        [sys.executable, str(EXAMPLE)], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert said.returncode == 0, said.stderr
    assert "guaranteed" in said.stdout
    assert (tmp_path / "heated_plate.png").stat().st_size > 10_000
    assert "pub type Controller" in (tmp_path / "heated_plate.rs").read_text()
