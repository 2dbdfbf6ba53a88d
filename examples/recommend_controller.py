"""The controller that every command recommends and its rivals, what the inertia is by each method, what
flywheels change, and whether a proposal of other hardware is worth its cost.

    recommend_controller.py CASE.toml [PROPOSAL.toml]
"""

import sys

import boresight

case = boresight.read_case(sys.argv[1])
for method in boresight.identify(case).methods:
    print(f"{method.name}: {method.reflected_inertia} kg.m2")
tuning = boresight.tune(case)
for controller in tuning.controllers:
    print(controller, "constraints met" if controller.constraints_met else "constraints missed")
# A state space has no gains: `boresight tune --mat` writes its matrices.
print("recommended:", tuning.best, tuning.best.gains if tuning.best else tuning.shortfalls)
matching = boresight.match(case, points=4)
for series in matching.series:
    if series.best is not None:
        print(f"{series.name}: least rms with {matching.disks[series.best]:g} disks")
if len(sys.argv) > 2:
    evaluation = boresight.evaluate(case, sys.argv[2:])
    print("worth its cost:", evaluation.worth_its_cost)
    for name, probability in evaluation.probabilities:
        print(f"{name}: least rms with probability {probability:.3f}")
