"""docs/identification.md shows what `boresight identify` prints of the three test campaigns, and
every interval in it holds the truth.

usage: identification_doc_test.py PROGRAM SOURCE CAMPAIGNS [--write]

--write renews the tables in the page instead of comparing them.
"""

import json
import math
import pathlib
import subprocess
import sys

from shown_output import same

program, source, campaigns = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
page = source / "docs/identification.md"
names = {"full": "full", "paper-like": "paper-like", "small-dish": "small dish"}
digits = 4
# The ends of an interval are of random samples, which another processor's rounding moves in the fourth.
end_digits = 3


def identify(name):
    shown = subprocess.run([program, "identify", str(campaigns / name / "case.toml"), "--json", "-"],
                           check=True, capture_output=True)
    return json.loads(shown.stdout)["campaign"]


def friction(truth, rate):
    curve = truth["friction"]
    return (curve["Fc"] + (curve["Fs"] - curve["Fc"]) * math.exp(-(rate / curve["vs"]) ** 2)
            + curve["A"] * (1.0 - math.exp(-rate / curve["v1"])) + curve["b"] * rate)


def interval(estimate, scale):
    return tuple(estimate[key] / scale for key in ("value_si", "lower_95_si", "upper_95_si"))


def estimates(found, truth):
    """Quantity, its value with interval, and its truth, by name."""
    posterior = {row["name"]: row["posterior"] for row in found["combined"]["quantities"]}
    curve = truth["friction"]
    rows = [("inertia, kg m²", "inertia", 1.0, truth["reflected_inertia"]),
            ("oil stiffness, N m/rad", "oil stiffness", 1.0, truth["hydraulic_stiffness"]),
            ("bulk modulus, MPa", "bulk modulus", 1e6, truth["bulk_modulus"] / 1e6),
            ("leakage rate, 1/s", "leakage rate", 1.0, truth["leakage_rate_1_per_s"]),
            ("offset torque as recorded, N m", "offset torque as recorded", 1.0,
             truth["offset_torque_as_recorded"]),
            ("Coulomb level, N m", "Coulomb level", 1.0, curve["Fc"] + curve["A"])]
    out = {title: (interval(posterior[key], scale), true) for title, key, scale, true in rows}
    tested = [row for row in found["friction"]["rows"]
              if not row["extrapolated"] and not row["tracking"]]
    for title, row in (("the lowest", tested[0]), ("a middle", tested[len(tested) // 2]),
                       ("the highest", tested[-1])):
        out[f"friction, N m, at {title} tested speed"] = (interval(row["combined"], 1.0),
                                                         friction(truth, row["rate_rad_per_s"]))
    return out


def number(value):
    return f"{value:.{digits}g}"


def ends(lower, upper):
    return " to ".join(f"{float(f'{end:.{end_digits}g}'):g}" for end in (lower, upper))


def truth_table(results):
    lines = ["| quantity | " + " | ".join(f"{title} | truth" for title in names.values()) + " |",
             "|---|" + "---|" * (2 * len(names))]
    for quantity in results["full"]:
        cells = []
        for name in names:
            (value, lower, upper), true = results[name][quantity]
            cells.append(f"{number(value)} ({ends(lower, upper)}) | {number(true)}")
        lines.append(f"| {quantity} | " + " | ".join(cells) + " |")
    return lines


def paper_table(found, truth):
    true = truth["reflected_inertia"]
    reconciled = estimates(found, truth)["inertia, kg m²"][0]
    lines = [f"| the paper's procedure | J, kg m² | 95 % interval | off the truth ({number(true)}) | "
             "off the combined |", "|---|---|---|---|---|"]
    for row in found["methods"]:
        if row["of_the_paper"]:
            value, lower, upper = interval(row["inertia"], 1.0)
            lines.append(f"| {row['name']} | {number(value)} | {ends(lower, upper)} | "
                         f"{100 * (value / true - 1):+.1f} % | "
                         f"{100 * row['difference']['relative_1']:+.1f} % |")
    value, lower, upper = reconciled
    lines.append(f"| *combined (grey box)* | {number(value)} | {ends(lower, upper)} | "
                 f"{100 * (value / true - 1):+.1f} % | |")
    return lines


def between(text, name, lines):
    """The page with other lines between <!-- NAME --> and <!-- end NAME -->."""
    head, rest = text.split(f"<!-- {name} -->\n")
    tail = rest.split(f"<!-- end {name} -->\n")[1]
    return head + f"<!-- {name} -->\n" + "\n".join(lines) + f"\n<!-- end {name} -->\n" + tail


found = {name: identify(name) for name in names}
truth = {name: json.loads((campaigns / name / "truth.json").read_text()) for name in names}
results = {name: estimates(found[name], truth[name]) for name in names}
missed = [f"{name}: {quantity} {values}" for name, rows in results.items()
          for quantity, (values, true) in rows.items() if not values[1] <= true <= values[2]]
assert sum(len(rows) for rows in results.values()) == 27
assert not missed, "intervals that miss the truth:\n" + "\n".join(missed)
written = page.read_text()
now = between(written, "truth table", truth_table(results))
now = between(now, "paper table", paper_table(found["paper-like"], truth["paper-like"]))
if "--write" in sys.argv:
    page.write_text(now)
else:
    assert same(written, now, whole=2, digits=end_digits), "docs/identification.md is not what the program prints: ./dev figures"
