"""Long calls: other threads go on, Ctrl-C and progress functions end them, two run at once."""

import functools
import signal
import threading
import time

import numpy as np
import pytest
import remesh


@functools.lru_cache
def fine():
    return remesh.examples.sphere(8)


def long_calls(V, F):
    """By name: what takes several seconds."""
    sites = remesh.sample_sites(V, F, 3000, init="random")
    return {
        "remesh": lambda **more: remesh.remesh(V, F, 100_000, threads=1, **more),
        "voronoi": lambda **more: remesh.voronoi(*fine(), [5, 9], 0, **more),
        "geodesic_distance": lambda **more: remesh.geodesic_distance(*fine(), [5], 0, **more),
        "evaluate": lambda **more: remesh.evaluate(V, F, V, F, samples=10**8, **more),
        "sample_sites": lambda **more: remesh.sample_sites(V, F, 300_000, init="farthest", **more),
        "relax_sites": lambda **more: remesh.relax_sites(V, F, sites, steps=10**6, tolerance=0,
                                                         **more),
    }


NAMES = ["remesh", "voronoi", "geodesic_distance", "evaluate", "sample_sites", "relax_sites"]


@pytest.mark.parametrize("name", NAMES)
def test_ctrl_c_ends_a_call(organic, name):
    call = long_calls(*organic)[name]
    fine()  # Not part of the call.
    signal.signal(signal.SIGALRM, signal.getsignal(signal.SIGINT))
    signal.setitimer(signal.ITIMER_REAL, 0.3)
    with pytest.raises(KeyboardInterrupt):
        call()


@pytest.mark.parametrize("name", NAMES)
def test_a_progress_function_ends_a_call(organic, name):
    seen = []

    def progress(fraction, stage):
        seen.append((fraction, stage))
        return len(seen) < 5

    with pytest.raises(remesh.Cancelled, match="stopped by the progress callback"):
        long_calls(*organic)[name](progress=progress)
    assert len(seen) == 5
    assert all(isinstance(stage, str) and 0 <= fraction <= 1 for fraction, stage in seen)


def test_exceptions_of_a_progress_function_pass_through(organic):
    class Mine(Exception):
        pass

    def progress(fraction, stage):
        raise Mine(stage)

    with pytest.raises(Mine, match="clean"):
        remesh.remesh(*organic, progress=progress)


def test_a_progress_function_that_returns_nothing_changes_nothing(torus):
    stages = []
    told = remesh.remesh(*torus, 500, progress=lambda fraction, stage: stages.append(stage))
    assert {"clean", "relax", "dual", "place", "transfer"} <= set(stages)
    assert told.V.tobytes() == remesh.remesh(*torus, 500).V.tobytes()


def test_other_threads_run_during_a_call(organic):
    counted, is_over = [0], threading.Event()

    def count():
        while not is_over.is_set():
            counted[0] += 1
            time.sleep(1e-4)

    thread = threading.Thread(target=count)
    thread.start()
    try:
        before = counted[0]
        remesh.remesh(*organic, 2000)
        assert counted[0] - before > 20
    finally:
        is_over.set()
        thread.join()


def test_calls_in_two_threads_at_once_equal_calls_in_turn(organic, torus):
    jobs = [(organic, 1500, 1), (torus, 900, 2), (organic, 1500, 3), (torus, 700, 4)]

    def run(mesh, n, seed):
        result = remesh.remesh(*mesh, n, seed=seed)
        diagram = remesh.voronoi(*mesh, np.arange(50), 1e-3)
        return [result.V.tobytes(), result.F.tobytes(), diagram.labels.tobytes(),
                diagram.points.tobytes()]

    expected = [run(*job) for job in jobs]
    found = [None] * len(jobs)

    def take(numbers):
        for i in numbers:
            found[i] = run(*jobs[i])

    threads = [threading.Thread(target=take, args=(numbers,)) for numbers in ((0, 1), (2, 3))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == expected


def test_a_failed_call_leaves_the_next_one_as_it_was(torus):
    expected = remesh.remesh(*torus, 300).V.tobytes()
    for _ in range(3):
        with pytest.raises(remesh.Cancelled):
            remesh.remesh(*torus, 300, progress=lambda fraction, stage: False)
    assert remesh.remesh(*torus, 300).V.tobytes() == expected
