"""Names of version 0.1 lead to the present ones, with a warning."""

import pytest

import boresight


@pytest.fixture(scope="module")
def controller():
    return boresight.controller("PI-0", {"kr": 0.2, "wi": 0.5, "kp": 6.0, "wip": 0.1})


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_old_names_are_the_present_ones(controller):
    assert boresight.ControlLaw is type(controller)
    assert controller.controller().outputs == controller.state_space().outputs


def test_old_names_warn(controller):
    with pytest.warns(DeprecationWarning, match="control_law is now"):
        getattr(boresight, "control_law")
    with pytest.warns(DeprecationWarning, match="controller is now state_space"):
        controller.controller()


def test_old_argument_warns(controller, antenna):
    plant = boresight.plant(antenna)
    with pytest.warns(DeprecationWarning, match="law is now controller"):
        old = boresight.closed_loop(plant, law=controller, delay=0.1)
    assert old.states == boresight.closed_loop(plant, controller, 0.1).states
    with pytest.raises(TypeError):
        boresight.closed_loop(1, law=controller, delay=0.1)


def test_unknown_names_are_refused():
    with pytest.raises(AttributeError, match="no attribute 'law'"):
        boresight.law
