"""Draws what docs/identification.md shows, from the paper-like test campaign.

usage: draw_identification.py PROGRAM SOURCE_FOLDER CASE

Runs `boresight identify CASE` (build the target `campaigns`: BUILD/campaigns/paper-like/case.toml)
and writes docs/figures/identified-*.svg.
"""

import json
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({
    "svg.hashsalt": "boresight", "svg.fonttype": "none", "font.size": 9, "axes.grid": True,
    "grid.alpha": 0.3, "axes.spines.top": False, "axes.spines.right": False, "lines.linewidth": 0.9,
})
from matplotlib import pyplot  # noqa: E402  (after the choice of backend)

PROGRAM, SOURCE, CASE = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]


def save(figure, name):
    figure.tight_layout()
    figure.savefig(SOURCE / f"docs/figures/{name}.svg", metadata={"Date": None})
    pyplot.close(figure)


def draw_friction(campaign):
    plot, tests = campaign["plots"]["friction"], campaign["friction"]
    figure, axes = pyplot.subplots(figsize=(7.0, 3.6))
    windows = plot["windows"]
    axes.plot([abs(rate) for rate in windows["rate_rad_per_s"]],
              [abs(torque) for torque in windows["torque_N_m"]], ".", color="0.75", markersize=3,
              label="windows of all tests")
    axes.fill_between(plot["rate_rad_per_s"], plot["combined_lower_95_N_m"],
                      plot["combined_upper_95_N_m"], color="0.6", linewidth=0)
    axes.plot(plot["rate_rad_per_s"], plot["combined_N_m"], color="0.0",
              label="combined, 95 % band")
    line = tests["constant_speed_line"]
    if line:
        coulomb, slope = line["coulomb"]["value_si"], line["slope"]["value_si"]
        axes.plot(plot["rate_rad_per_s"],
                  [coulomb + slope * rate for rate in plot["rate_rad_per_s"]], "--", color="0.0",
                  label="straight line of the constant-speed tests")
    measured = [row for row in tests["rows"] if row["constant_speed"]]
    axes.plot([row["rate_rad_per_s"] for row in measured],
              [row["constant_speed"]["value_si"] for row in measured], "o", color="0.0",
              markerfacecolor="none", label="constant-speed tests")
    if tests["slow_ramp"]:
        axes.axhline(tests["slow_ramp"]["coulomb"]["value_si"], color="0.0", linestyle=":",
                     label="slow ramp, just after breakaway")
    axes.set_xlabel("motor rate (rad/s)")
    axes.set_ylabel("friction (N.m)")
    axes.legend(frameon=False)
    save(figure, "identified-friction")


def draw_spectrum(campaign):
    spectrum = campaign["plots"]["torque_spectra"][0]
    figure, axes = pyplot.subplots(figsize=(7.0, 3.2))
    shown = [i for i, f in enumerate(spectrum["frequency_Hz"]) if 0.05 < f < 3.0]
    axes.semilogy([spectrum["frequency_Hz"][i] for i in shown],
                  [spectrum["amplitude_N_m"][i] for i in shown], color="0.0")
    for peak in spectrum["peaks"]:
        if not peak["harmonic"] or not 0.05 < peak["frequency_Hz"] < 3.0:
            continue
        axes.annotate(str(peak["harmonic"]), (peak["frequency_Hz"], peak["amplitude_N_m"]),
                      textcoords="offset points", xytext=(0, 3), ha="center", fontsize=7)
    if spectrum["chosen_Hz"]:
        axes.axvline(spectrum["chosen_Hz"], color="0.0", linestyle=":", label="taken for the mode")
        axes.legend(frameon=False)
    axes.set_ylim(1e-2, None)
    axes.set_xlabel("frequency (Hz); numbers: harmonic of the triangle")
    axes.set_ylabel("total torque (N.m)")
    save(figure, "identified-spectrum")


shown = subprocess.run([PROGRAM, "identify", CASE, "--json", "-"], check=True, capture_output=True)
found = json.loads(shown.stdout)["campaign"]
draw_friction(found)
draw_spectrum(found)
