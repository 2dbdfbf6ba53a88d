"""SciPy on the peers' antenna family: scipy_peer.py FOLDER MODES ITEM, FOLDER being what
write_systems wrote. One JSON line a route: CPU time of one thread (s) and the values found."""

import json
import sys
import time
import warnings

import numpy
from numpy.linalg import norm
from scipy import linalg, signal

warnings.simplefilter("ignore")


def report(item, peer, modes, work, longest=0.3):
    times = []
    try:
        while not times or (sum(times) < longest and len(times) < 1001):
            start = time.process_time()
            values = work()
            times.append(time.process_time() - start)
    except Exception as error:  # what a peer cannot do is a result
        print(json.dumps({"item": item, "peer": f"SciPy {peer}", "m": modes, "error": str(error)}))
        return
    line = {"item": item, "peer": f"SciPy {peer}", "m": modes, "min": min(times)}
    line |= {"med": sorted(times)[len(times) // 2], "val": [float(value) for value in values]}
    print(json.dumps(line))


def read_system(folder, name):
    return tuple(numpy.loadtxt(f"{folder}/{name}_{part}", ndmin=2) for part in "abcd")


def summary(response):
    return abs(response).max(), response.sum().real, response.sum().imag


def response_by_solving(system, frequencies):
    a, b, c, d = system
    identity = numpy.eye(len(a))
    gains = [(c @ linalg.solve(1j * w * identity - a, b) + d)[0, 0] for w in frequencies]
    return summary(numpy.array(gains))


def covariance(system):
    a, b, _, _ = system
    return linalg.solve_continuous_lyapunov(a, -b @ b.T)


def rms(system):
    c = system[2]
    return [numpy.sqrt((c @ covariance(system) @ c.T)[0, 0])]


def simulation(system, noise):
    step = 1e-3
    times = step * numpy.arange(len(noise))
    output = signal.lsim(system, noise / numpy.sqrt(step), times, interp=False)[1]
    return numpy.sqrt(numpy.mean(output**2)), output[-1], abs(output).max()


def sampling(system):
    held = signal.cont2discrete(system, 1e-3, "zoh")
    return norm(held[0]), norm(held[1])


def riccati(system, solve):
    a, b, c, _ = system
    return [numpy.trace(solve(a, b, c.T @ c, numpy.eye(1)))]


def main():
    folder, modes, item = sys.argv[1], int(sys.argv[2]), sys.argv[3]
    place = f"{folder}/{modes}"
    if item == "response":
        system, frequencies = read_system(place, "wind"), numpy.loadtxt(f"{folder}/frequencies")
        report(item, "signal.freqresp", modes, lambda: summary(signal.freqresp(system, frequencies)[1]))
        report(item, "linalg.solve", modes, lambda: response_by_solving(system, frequencies))
    elif item == "rms":
        system = read_system(place, "rms")
        report(item, "solve_continuous_lyapunov", modes, lambda: rms(system))
    elif item == "simulation":
        system, noise = read_system(place, "rms"), numpy.loadtxt(f"{folder}/noise")
        report(item, "signal.lsim", modes, lambda: simulation(system, noise))
    elif item == "sampling":
        system = read_system(place, "rms")
        report(item, "signal.cont2discrete", modes, lambda: sampling(system))
    elif item == "lyapunov":
        system = read_system(place, "rms")
        report(item, "solve_continuous_lyapunov", modes, lambda: [numpy.trace(covariance(system))])
    elif item == "riccati":
        system = read_system(place, "regulator")
        report(item, "solve_continuous_are", modes, lambda: riccati(system, linalg.solve_continuous_are))
    elif item == "discrete_riccati":
        system = read_system(place, "sampled")
        report(item, "solve_discrete_are", modes, lambda: riccati(system, linalg.solve_discrete_are))


main()
