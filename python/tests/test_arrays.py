"""Arrays in, arrays out: shapes, broadcasting, ``out``, threads, and the words in which arguments are refused."""

import sys
import threading
import time

import numpy as np
import pytest

import ulna

from conftest import TABLE, load, parts_of, states


def shape(axes, n):
    return tuple(n if axis == "n" else int(axis) for axis in axes)


@pytest.mark.parametrize("method", TABLE)
def test_results_have_the_shapes_that_the_docs_state(arm, method):
    _, parts = TABLE[method]
    for batch in [(), (1,), (5,), (2, 3), (0,)]:
        count = int(np.prod(batch))
        arguments = [x.reshape(*batch, -1) if count else x[:0] for x in states(arm, count or 1).of(method)]
        result = getattr(arm, method)(*arguments)
        assert isinstance(result, tuple) == (len(parts) > 1)
        for array, axes in zip(parts_of(result), parts, strict=True):
            assert array.dtype == np.float64 and array.shape == batch + shape(axes, arm.n)
    documentation = getattr(ulna.Arm, method).__doc__
    for axes in parts:
        assert not axes or f"(..., {', '.join(axes)})" in documentation


@pytest.mark.parametrize("method", TABLE)
def test_a_batch_is_its_states_one_by_one(arm, method):
    """On the same code, and so to the bit; on as many threads as there are blocks."""
    many = states(arm, 300)
    batch = parts_of(getattr(arm, method)(*many.of(method)))
    threaded = parts_of(getattr(arm, method)(*many.of(method), threads=3))
    for one, other in zip(batch, threaded, strict=True):
        assert np.array_equal(one, other)
    for at in [0, 1, 7, 150, 255, 256, 299]:
        alone = parts_of(getattr(arm, method)(*many.of(method, at)))
        for one, all_ in zip(alone, batch, strict=True):
            np.testing.assert_allclose(all_[at], one, rtol=1e-13, atol=1e-13 * np.abs(one).max(initial=0.0))


@pytest.mark.parametrize("method", TABLE)
def test_out_is_written_whatever_its_layout(arm, method):
    many = states(arm, 40).of(method)
    call = getattr(arm, method)
    expected = parts_of(call(*many))
    layouts = [
        np.empty_like,
        lambda x: np.empty(x.shape),
        lambda x: np.empty((2, *x.shape))[1],
        lambda x: np.empty((2 * x.shape[0], *x.shape[1:]))[::2],
        lambda x: np.empty(x.shape[::-1]).T,
    ]
    for layout in layouts:
        out = tuple(layout(x) for x in expected)
        for array in out:
            array.fill(np.nan)
        given = out if len(out) > 1 else out[0]
        assert call(*many, out=given) is given
        for one, other in zip(out, expected, strict=True):
            assert np.array_equal(one, other)
    alone = tuple(np.empty(x.shape[1:]) for x in expected)
    call(*(x[3] for x in many), out=alone if len(alone) > 1 else alone[0])
    for one, other in zip(alone, expected, strict=True):
        np.testing.assert_allclose(one, other[3], rtol=1e-13, atol=1e-13 * np.abs(one).max(initial=0.0))


def test_arguments_are_broadcast_against_each_other(arm):
    q, qd, qdd, *_ = states(arm, 12)
    whole = arm.inverse_dynamics(q, np.tile(qd[0], (12, 1)), qdd)
    assert np.array_equal(arm.inverse_dynamics(q, qd[0], qdd), whole)
    assert np.array_equal(arm.inverse_dynamics(q, qd[:1], qdd, threads=2), whole)
    grid = arm.bias_force(q[:3, None], qd[None, :4])
    assert grid.shape == (3, 4, arm.n)
    for i, j in np.ndindex(3, 4):
        np.testing.assert_allclose(grid[i, j], arm.bias_force(q[i], qd[j]), rtol=1e-12)
    with pytest.raises(ValueError, match=r"q, qd: the shapes \(3, \d\), \(4, \d\) cannot be broadcast together"):
        arm.bias_force(q[:3], qd[:4])


def test_whatever_float64_can_hold_is_taken(small):
    expected = small.mass_matrix(np.array([1.0, 2.0]))
    unaligned = np.zeros(17, np.uint8)[1:].view(np.float64)
    unaligned[:] = [1.0, 2.0]
    swapped = np.array([1.0, 2.0]).astype(">f8")
    kinds = [[1, 2], (1.0, 2.0), np.array([1, 2]), np.float32([1, 2]), np.array([1.0, 0.0, 2.0])[::2], unaligned, swapped]
    for q in kinds:
        assert np.array_equal(small.mass_matrix(q), expected)
    columns = np.asfortranarray(states(small, 30).q)
    assert np.array_equal(small.mass_matrix(columns), small.mass_matrix(np.ascontiguousarray(columns)))
    reversed_ = columns[::-1, ::-1]
    assert np.array_equal(small.mass_matrix(reversed_), small.mass_matrix(reversed_.copy()))


def test_what_is_given_is_left_alone(arm):
    q = states(arm, 20).q
    before = q.copy()
    q.flags.writeable = False
    arm.dynamic_manipulability_gradient(q, threads=2)
    assert np.array_equal(q, before)


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        (([1.0, 2.0, 3.0],), ValueError, r"q: expected shape \(2,\) or \(\.\.\., 2\), found \(3,\)"),
        ((np.zeros((2, 3)),), ValueError, r"q: expected shape \(2,\) or \(\.\.\., 2\), found \(2, 3\)"),
        ((1.0,), ValueError, "q: expected an array, found a single number"),
        (([1j, 2.0],), TypeError, "q: expected numbers that float64 can hold, found an array of complex128"),
        ((["a", "b"],), TypeError, "q: expected numbers that float64 can hold, found an array of <U1"),
        (([[1.0], [1.0, 2.0]],), ValueError, "q: .*inhomogeneous"),
        ((None,), TypeError, "q: expected numbers that float64 can hold, found an array of object"),
    ],
)
def test_arguments_are_refused_by_name(small, arguments, error, words):
    with pytest.raises(error, match=words):
        small.mass_matrix(*arguments)


def test_arguments_are_counted_by_python(small):
    with pytest.raises(TypeError, match="missing 1 required positional argument: 'qd'"):
        small.bias_force([1.0, 2.0])
    with pytest.raises(ValueError, match=r"wrench: expected shape \(6,\)"):
        small.inverse_dynamics_with_wrench([0, 0], [0, 0], [0, 0], [0, 0])


@pytest.mark.parametrize(
    ("out", "error", "words"),
    [
        (np.zeros((2, 2)), ValueError, r"out: expected shape \(3, 2, 2\), found \(2, 2\)"),
        (np.zeros((3, 2, 2), np.float32), TypeError, "out: expected an array of float64, found an array of float32"),
        ([0.0], TypeError, "out: expected an array of float64, found <class 'list'>"),
    ],
)
def test_an_out_that_does_not_fit_is_refused(small, out, error, words):
    with pytest.raises(error, match=words):
        small.mass_matrix(np.zeros((3, 2)), out=out)


def test_an_out_that_cannot_be_written_is_refused(small):
    q = np.zeros((3, 2))
    sealed = np.zeros((3, 2))
    sealed.flags.writeable = False
    for out in [sealed, q]:
        with pytest.raises(ValueError, match="out: cannot be written to"):
            small.gravity_torque(q, out=out)
    with pytest.raises(TypeError, match="out: expected a tuple of 2 arrays, found one of 1"):
        small.dynamic_manipulability_gradient(q, out=(np.zeros(3),))
    with pytest.raises(TypeError, match="out: expected a tuple of 2 arrays, found <class 'numpy.ndarray'>"):
        small.dynamic_manipulability_gradient(q, out=np.zeros(3))
    w = np.zeros((3, 2))
    with pytest.raises(ValueError, match=r"out\[0\]: expected shape \(3,\), found \(3, 2\)"):
        small.dynamic_manipulability_gradient(q, out=(w, w))


def test_what_is_not_finite_goes_through_and_harms_no_neighbour(small):
    q = states(small, 20).q
    expected = small.mass_matrix(q)
    q[7, 1] = np.nan
    found = small.mass_matrix(q)
    assert np.isnan(found[7]).any()
    assert np.array_equal(np.delete(found, 7, 0), np.delete(expected, 7, 0))


def test_threads_are_set_once_or_by_call(small):
    assert ulna.threads() == 1
    ulna.set_threads(0)
    try:
        assert ulna.threads() >= 1
        q = states(small, 1000).q
        assert np.array_equal(small.mass_matrix(q), small.mass_matrix(q, threads=1))
    finally:
        ulna.set_threads(1)
    with pytest.raises(OverflowError):
        small.mass_matrix(q, threads=-1)


def test_pythons_lock_is_released():
    """While one thread is in a long call, another one counts on: it could not, were the lock held."""
    arm = load("ssrms")
    q = states(arm, 4000).q
    arm.mass_matrix(q[0])
    seconds = time.perf_counter()
    arm.link_jacobians(q)
    seconds = time.perf_counter() - seconds
    q = np.tile(q, (int(np.ceil(0.5 / seconds)), 1))
    out = np.empty((len(q), arm.n, 6, arm.n))
    began, ended, counted = threading.Event(), threading.Event(), []

    def count():
        began.wait()
        while not ended.is_set():
            counted.append(time.perf_counter())
            time.sleep(0.001)

    other = threading.Thread(target=count)
    other.start()
    began.set()
    sys.setswitchinterval(1e-4)
    begin = time.perf_counter()
    arm.link_jacobians(q, out=out)
    end = time.perf_counter()
    ended.set()
    other.join()
    middle = [t for t in counted if begin + 0.1 * (end - begin) < t < end - 0.1 * (end - begin)]
    assert len(middle) > 20, f"{len(middle)} steps in {end - begin} s"


def test_calls_from_many_threads_are_right():
    """The first ones compile the arm at the same time."""
    arm = ulna.load(load("planar_2r").file)
    q = states(arm, 2000).q
    found = [None] * 4

    def call(i):
        found[i] = arm.mass_matrix(q, threads=1 + i % 2)

    threads = [threading.Thread(target=call, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    expected = load("planar_2r").mass_matrix(q)
    assert all(np.array_equal(one, expected) for one in found)
