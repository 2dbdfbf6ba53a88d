"""SciPy on the peers' rate loop with valve and friction: scipy_drive.py FOLDER MODES ITEM, FOLDER
being unused. One JSON line: CPU time of one thread (s), and at the end of 60 s angle, speed and load
torque, then the speed's rms and peak. LSODA, as it is the fastest of solve_ivp here."""

import json
import math
import sys
import time

import numpy
from scipy.integrate import solve_ivp

INERTIA, RATE_GAIN, RATE_INTEGRAL = 1.45, 0.30, 1.8
HYDRAULIC = 2.0 * math.pi * 0.97
STIFFNESS, LEAKAGE = INERTIA * HYDRAULIC**2, 2.0 * 0.25 * HYDRAULIC
VISCOUS = INERTIA * 2.0 * 0.05 * HYDRAULIC
VALVE, VALVE_DAMPING, TACHOMETER = 2.0 * math.pi * 60.0, 0.7, 2.0 * math.pi * 20.0


def command(t):
    place = t / 20.0 - 0.25
    return 0.5 * (4.0 * abs(place - math.floor(place) - 0.5) - 1.0)


def drive(friction, modes):
    """dx/dt, and the row that takes the motor's speed from x."""
    place = numpy.arange(modes) / (modes - 1.0)
    hertz = 1.75 * (50.0 / 1.75) ** place
    squared, damping = (2.0 * math.pi * hertz) ** 2, 0.01 * (1.0 + place) * 2.0 * math.pi * hertz
    shape = 0.35 * numpy.sqrt(5.0 / modes * 1.75 / hertz / INERTIA)
    shape *= 1.0 + 0.5 * numpy.cos(1.7 * numpy.arange(modes))

    def rate(t, x):
        valve, valve_rate, torque, speed, _, tachometer, integral, bristle = x[:8].tolist()
        bend, bend_rate = x[8 : 8 + modes], x[8 + modes :]
        motor = speed + float(shape @ bend_rate)
        error = command(t) - tachometer
        pressure = 1.0 - math.tanh(valve / 0.02) * torque / 150.0
        flow = valve * math.sqrt(0.5 * (pressure + math.sqrt(pressure**2 + 1e-6)))
        level = 8.0 + 6.0 * math.exp(-min((motor / 0.05) ** 2, 700.0))
        bristle_rate = rubbing = 0.0
        if friction == "tanh":
            rubbing = level * math.tanh(motor / 0.005)
        elif friction == "lugre":
            bristle_rate = motor - 5000.0 * abs(motor) * bristle / level
            rubbing = 5000.0 * bristle + 40.0 * bristle_rate
        net = torque - VISCOUS * motor - rubbing
        wanted = RATE_GAIN * error + RATE_INTEGRAL * integral
        result = numpy.empty_like(x)
        result[0] = valve_rate
        result[1] = VALVE**2 * (wanted - valve) - 2.0 * VALVE_DAMPING * VALVE * valve_rate
        result[2] = STIFFNESS * (flow - motor) - LEAKAGE * torque
        result[3] = net / INERTIA
        result[4] = speed
        result[5] = TACHOMETER * (motor - tachometer)
        result[6] = error
        result[7] = bristle_rate
        result[8 : 8 + modes] = bend_rate
        result[8 + modes :] = shape * net - squared * bend - damping * bend_rate
        return result

    seen = numpy.zeros(8 + 2 * modes)
    seen[3], seen[8 + modes :] = 1.0, shape
    return rate, seen


def main():
    modes, item = int(sys.argv[2]), sys.argv[3]
    if not item.startswith("nl_"):
        return
    rate, seen = drive(item.removeprefix("nl_"), modes)
    start = time.process_time()
    times = numpy.arange(6001) * 0.01
    found = solve_ivp(rate, (0.0, 60.0), numpy.zeros(len(seen)), "LSODA", times, rtol=1e-6, atol=1e-8).y
    spent = time.process_time() - start
    speed = seen @ found
    values = [found[4, -1], speed[-1], found[2, -1], math.sqrt(numpy.mean(speed**2)), abs(speed).max()]
    line = {"item": item, "peer": "SciPy solve_ivp LSODA", "m": modes, "min": spent, "med": spent}
    print(json.dumps(line | {"val": [float(value) for value in values]}))


main()
