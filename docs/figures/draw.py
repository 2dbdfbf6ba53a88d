"""Draws the simulated counterparts of the founding paper's Figs. 3, 5, 6 and 9.

usage: draw.py PROGRAM SOURCE_FOLDER     (./dev figures)

Runs `boresight simulate` on the 70-m case and writes docs/figures/*.svg.
"""

import csv
import math
import pathlib
import subprocess
import sys
import tempfile
import tomllib

import matplotlib
import numpy

matplotlib.use("svg")
matplotlib.rcParams.update({
    "svg.hashsalt": "boresight", "svg.fonttype": "none", "font.size": 9, "axes.grid": True,
    "grid.alpha": 0.3, "axes.spines.top": False, "axes.spines.right": False, "lines.linewidth": 0.9,
})
from matplotlib import pyplot  # noqa: E402  (after the choice of backend)

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
CASE = SOURCE / "cases/dss14-70m/case.toml"
GREYS = ("0.0", "0.35", "0.55", "0.7")  # readable in print
DASHES = ("-", "--", "-.", ":")


def read_record(path):
    with open(path, encoding="utf-8", newline="") as file:
        rows = csv.reader(file)
        names = [name.split(" [")[0] for name in next(rows)]
        values = numpy.array([[float(cell) for cell in row] for row in rows])
    return dict(zip(names, values.T))


def torque_per_megapascal():
    """Of one motor, e_t d/(2 pi) (N.m/MPa): Sommerville eq. 9."""
    motor = tomllib.loads(CASE.read_text(encoding="utf-8"))["motor"]
    volume, unit = motor["displacement"]["value"].split()
    if unit != "cm3/rev":
        raise ValueError(f"expected a displacement in cm3/rev, found {unit}")
    return float(motor["torque_efficiency"]["value"]) * float(volume) / (2.0 * math.pi)


def motor_torques(record):
    scale = torque_per_megapascal()
    motors = sum(1 for name in record if name.endswith("_in"))
    return [scale * (record[f"p{k}_in"] - record[f"p{k}_out"]) for k in range(1, motors + 1)]


def save(figure, name):
    figure.tight_layout()
    figure.savefig(SOURCE / f"docs/figures/{name}.svg", metadata={"Date": None})
    pyplot.close(figure)


def draw_slosh(record):
    figure, (upper, lower) = pyplot.subplots(2, 1, sharex=True, figsize=(7.0, 4.2))
    shown = (record["time"] >= 1.95) & (record["time"] <= 2.35)
    # Over two periods of the slosh: what is left is the ringing.
    width = 45
    for k in range(1, 5):
        pressure = record[f"p{k}_in"]
        slow = numpy.convolve(pressure, numpy.ones(width) / width, "same")
        style = {"color": GREYS[k - 1], "linestyle": DASHES[k - 1], "label": f"motor {k}"}
        upper.plot(record["time"][shown], pressure[shown], **style)
        lower.plot(record["time"][shown], 1e3 * (pressure - slow)[shown], **style)
    upper.set_ylabel("inlet pressure (MPa)")
    upper.legend(ncols=4, frameon=False)
    lower.set_ylim(-45.0, 45.0)
    lower.set_ylabel("less its mean over 45 ms (kPa)")
    lower.set_xlabel("time (s); the valve closes at 2 s")
    save(figure, "slosh")


def draw_ramp(record, name, first, last):
    figure, (upper, lower) = pyplot.subplots(2, 1, sharex=True, figsize=(7.0, 4.2))
    shown = slice(*numpy.searchsorted(record["time"], [first, last]), 10)
    torques = motor_torques(record)
    for k, torque in enumerate(torques):
        upper.plot(record["time"][shown], torque[shown], color=GREYS[k], linestyle=DASHES[k])
    upper.plot(record["time"][shown], sum(torques)[shown], color="0.0", linewidth=1.4)
    upper.set_ylabel("torque (N.m): motors, total")
    lower.plot(record["time"][shown], record["tach"][shown], color="0.0")
    lower.set_ylabel("tachometer (V)")
    lower.set_xlabel("time (s)")
    save(figure, name)


def draw_spectrum(record):
    torque = sum(motor_torques(record))
    step = record["time"][1] - record["time"][0]
    window = numpy.hanning(len(torque))
    spectrum = numpy.abs(numpy.fft.rfft((torque - torque.mean()) * window)) * 2.0 / window.sum()
    frequency = numpy.fft.rfftfreq(len(torque), step)
    shown = (frequency > 0.03) & (frequency < 5.0)
    figure, axes = pyplot.subplots(figsize=(7.0, 3.0))
    axes.semilogy(frequency[shown], spectrum[shown], color="0.0")
    axes.set_ylim(1e-3, None)
    axes.set_xlabel("frequency (Hz)")
    axes.set_ylabel("total torque (N.m)")
    save(figure, "torque-spectrum")


with tempfile.TemporaryDirectory() as folder:
    subprocess.run([PROGRAM, "simulate", str(CASE), "slosh", "fast-ramp", "slow-ramp", "--folder",
                    folder], check=True, stdout=subprocess.DEVNULL)
    records = {name: read_record(pathlib.Path(folder) / f"{name}.csv")
               for name in ("slosh", "fast-ramp", "slow-ramp")}
draw_slosh(records["slosh"])
draw_ramp(records["fast-ramp"], "fast-ramp", 0.0, 34.0)
draw_ramp(records["slow-ramp"], "slow-ramp", 0.0, 62.0)
draw_spectrum(records["fast-ramp"])
