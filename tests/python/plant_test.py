"""The plant as matrices: against its own modes, SciPy, and the program's report."""

import numpy as np
import pytest
import scipy.linalg
import scipy.signal

import boresight


@pytest.fixture(scope="module")
def plant(antenna):
    return boresight.plant(antenna)


def test_matrices_have_the_shapes_of_the_names(plant):
    a, b, c, d = plant.abcd
    n, inputs, outputs = len(plant.states), len(plant.inputs), len(plant.outputs)
    assert (a.shape, b.shape, c.shape, d.shape) == ((n, n), (n, inputs), (outputs, n),
                                                    (outputs, inputs))
    assert plant.inputs == ["valve_command", "wind_torque"]
    assert plant.outputs == ["tachometer", "motor_torque", "encoder", "beam"]
    assert a.dtype == float and not np.shares_memory(a, plant.state_space.a)


def test_matrices_cannot_be_changed_behind_the_plants_back(plant):
    with pytest.raises(ValueError):
        plant.state_space.a[0, 0] = 1.0


def test_poles_are_the_eigenvalues_of_a(plant):
    poles = plant.state_space.poles()
    expected = np.linalg.eigvals(plant.abcd[0])
    assert len(poles) == len(expected)
    for pole in poles:
        assert np.min(np.abs(expected - pole)) < 1e-9 * max(1.0, abs(pole))
    for mode in plant.modes:
        assert np.min(np.abs(poles - mode.pole)) < 1e-6 * max(1.0, abs(mode.pole))


def test_response_is_that_of_scipy(plant):
    frequency = np.logspace(-1, 2, 40)
    found = plant.state_space.frequency_response(frequency)
    assert found.shape == (40, 4, 2)
    a, b, c, d = plant.abcd
    for i, w in enumerate(frequency):
        expected = c @ scipy.linalg.solve(1j * w * np.eye(len(a)) - a, b) + d
        np.testing.assert_allclose(found[i], expected, rtol=1e-7)


def test_scipy_takes_the_matrices(plant):
    system = scipy.signal.StateSpace(*plant.abcd)
    assert system.outputs == 4 and system.inputs == 2


def test_says_what_the_program_says(plant, program):
    report = program("model")
    assert plant.to_dict()["plant"] == report["plant"]
    assert plant.to_dict()["assumed_inputs"] == report["assumed_inputs"]
    assert plant.hydraulic_mode.frequency == pytest.approx(0.8482, abs=5e-5)  # README.md
    assert plant.reflected_inertia == pytest.approx(1.8170, abs=5e-5)


def test_other_numbers_make_another_plant(antenna, plant):
    bare = boresight.plant(antenna, flywheel_disks=0)
    # 24 disks of 0.012358 kg m2 on four motors.
    assert plant.reflected_inertia - bare.reflected_inertia == pytest.approx(4 * 24 * 0.012358)
    assert bare.motor_to_load_ratio < 0.1 < plant.motor_to_load_ratio
    stiff = boresight.plant(antenna, oil_stiffness=2 * plant.oil_stiffness)
    assert stiff.oil_stiffness == 2 * plant.oil_stiffness
    assert stiff.hydraulic_mode.frequency > plant.hydraulic_mode.frequency
    assert stiff.to_dict()["plant"] != plant.to_dict()["plant"]
    with pytest.raises(boresight.InvalidInput):
        boresight.plant(antenna, oil_stiffness=-1)


def test_closed_loop_is_plant_and_controller_connected(antenna, plant):
    loops = boresight.controller("PI-0", {"kr": 0.2, "wi": 0.5, "kp": 6.0, "wip": 0.1})
    assert loops.gains == {"kr": 0.2, "wi": 0.5, "kp": 6.0, "wip": 0.1}
    closed = boresight.closed_loop(plant, loops, antenna.controller_delay)
    assert closed.poles().real.max() == pytest.approx(-0.0938, abs=5e-5)  # tests/examples
    # Next to no dead time: the connection can be made by hand.
    controller = loops.state_space()
    wire = boresight.StateSpace(np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((1, 0)), [[1.0]],
                                ["valve_demand"], ["valve_command"])
    by_hand = boresight.connect([plant.state_space, controller, wire],
                                ["wind_torque", "rate_disturbance"], ["beam"])
    at_once = boresight.closed_loop(plant, loops, 1e-6)
    w = np.logspace(-1, 1.5, 20)
    row, column = at_once.outputs.index("beam"), at_once.inputs.index("wind_torque")
    np.testing.assert_allclose(by_hand.frequency_response(w)[:, 0, 0],
                               at_once.frequency_response(w)[:, row, column], rtol=1e-3)


def test_sampled_controller_is_the_continuous_one_at_low_frequencies():
    loops = boresight.controller("PI", {"kr": 0.2, "wi": 0.5, "wp": 6.0, "kp": 6.0, "wip": 0.1})
    sampled = loops.sampled_controller(0.02)
    assert sampled.sample_time == 0.02
    w = np.array([0.1, 1.0, 3.0])
    rate = [system.frequency_response(w)[:, system.outputs.index("valve_demand"),
                                         system.inputs.index("tachometer")]
            for system in (loops.state_space(), sampled)]
    np.testing.assert_allclose(rate[1], rate[0], rtol=2e-3)


def test_a_state_space_that_does_not_fit_is_refused():
    with pytest.raises(boresight.InvalidInput):
        boresight.StateSpace([[0.0]], [[1.0]], [[1.0]], [[0.0]], ["u", "v"], ["y"])
