#include <array>
#include <utility>

#include <boresight/app/page/section_methods.hpp>

namespace boresight::app {
namespace {

struct Entry {
  std::string_view heading_begins;
  SectionMethod method;
};

constexpr std::array entries = std::to_array<Entry>({
    // Records
    {"Drive parameters from the records",
     {"one nonlinear model of the drive fitted to all records at once, 95 % intervals with sensor "
      "and model errors",
      "docs/identification.md"}},
    {"Inertia at the motor shaft",
     {"each method by itself, input uncertainties propagated; and the combined estimate",
      "docs/identification.md"}},
    {"Inertia and motor-to-load ratio",
     {"each method by itself, input uncertainties propagated", "docs/identification.md"}},
    {"Other quantities, by method",
     {"each method by itself, and the combined estimate", "docs/identification.md"}},
    {"Oil lines and bulk modulus",
     {"waves in the lines: damped cosines fitted to the pressures",
      "identification/lines/slosh.hpp"}},
    {"Friction at the motor shaft",
     {"friction curve of the model of all records; fitted to steady speeds; each test's own mean",
      "docs/identification.md"}},
    {"Stated numbers that the records contradict",
     {"stated value minus the records' estimate, over both standard uncertainties",
      "docs/identification.md"}},
    {"Fraction of each interval left",
     {"expected information gain of a simulated test of each kind", "docs/identification.md"}},
    {"Channels against one another",
     {"tachometer against encoder, motors' pressures and torques against one another",
      "identification/records/channel_consistency.hpp"}},
    {"Fit of one model to all records",
     {"residuals of the fit, and of a held-out record", "docs/identification.md"}},
    {"What the resonance alone shows",
     {"damped cosines about a moving operating point", "docs/identification.md"}},
    {"What impulse and friction tests alone show",
     {"impulse and momentum over matched windows, friction curve of the constant-speed tests",
      "docs/identification.md"}},
    {"Inputs of the methods", {"the assumptions of each method", "docs/identification.md"}},
    {"Records", {"import and detection of defects", "docs/records.md"}},
    // The case
    {"Audit",
     {"every derived value recomputed from the stated ones", "design/audit/misprint_search.hpp"}},
    {"Plant, at the motor shaft",
     {"linear model at the operating point; eigenvalues, modes named by energy",
      "plant/antenna/antenna_plant.hpp"}},
    {"Contradictory inputs",
     {"the loop re-tuned on the plant of each alternative", "design/tuning/design_study.hpp"}},
    {"Open inputs",
     {"the loop re-tuned on the plant of each alternative", "design/tuning/design_study.hpp"}},
    {"Inputs taken from the records",
     {"identified numbers in place of stated ones, with intervals of the posterior's samples",
      "io/campaign/identified_case.hpp"}},
    {"Assumed inputs", {"basis and source of each quantity in the case file", "docs/case-file.md"}},
    // Loops
    {"Tuned loops",
     {"least boresight rms under constraints, on exact frequency responses with gradients; "
      "verified by eigenvalues and Lyapunov equations",
      "design/tuning/tuner.hpp"}},
    {"Gains, SI", {"the tuned controller's parameters", "control/controllers/controller.hpp"}},
    // Also "Gains, before and after", where there are present ones.
    {"Gains",
     {"the tuned controller's parameters in the case's units",
      "control/controllers/controller.hpp"}},
    {"Active constraints",
     {"shadow prices of the active constraints, from the optimum's first-order conditions",
      "design/tuning/active_multipliers.hpp"}},
    {"Distance from the best",
     {"lower bound over all linear sampled controllers of equal control effort; LQG designs",
      "design/limits/pointing_limit.hpp"}},
    {"A state-space controller",
     {"fixed-order synthesis by gradient over the plants, from the recommended loops or the robust "
      "LQG",
      "design/limits/controller_refinement.hpp"}},
    {"In the time domain",
     {"nonlinear simulation with synthesised wind; each effect switched off in turn",
      "design/verification/nonlinear_verification.hpp"}},
    {"Basis of the verdicts", {"confidence of the measured response", "docs/measured-tuning.md"}},
    {"Loops tuned on the measured response",
     {"constraints on the measured frequency response, without a model",
      "docs/measured-tuning.md"}},
    // Studies
    {"Inertia matching: re-tuned",
     {"the loop re-tuned at each motor inertia", "design/tuning/design_study.hpp"}},
    {"Inertia matching",
     {"every structure tuned robustly at every motor inertia, with warm starts along the curve",
      "docs/matching.md"}},
    {"Proposals, re-tuned",
     {"each proposal re-tuned robustly over the ensemble", "docs/proposals.md"}},
    {"Probabilities over",
     {"sampled plants common to all candidates, fixed gains; Sobol' indices; value of tests",
      "docs/proposals.md"}},
    {"Changes of each proposal", {"derived quantities of the changed inputs", "docs/proposals.md"}},
    {"Loops of each proposal", {"the selected controllers, verified", "docs/proposals.md"}},
    {"Controller and plants",
     {"fixed gains, and the distribution of the plants", "docs/monte-carlo.md"}},
    {"Distribution over the stable plants",
     {"sample quantiles with sampling intervals", "docs/monte-carlo.md"}},
    {"Probabilities", {"sample fractions with sampling intervals", "docs/monte-carlo.md"}},
    {"Stability", {"Nyquist criterion, eigenvalues close to instability", "docs/monte-carlo.md"}},
    {"Plants that are not stable", {"eigenvalues of the closed loop", "docs/monte-carlo.md"}},
    {"Worst stable plants", {"the samples of largest rms", "docs/monte-carlo.md"}},
    {"Correlation of inputs with the rms",
     {"rank correlations over the samples", "docs/monte-carlo.md"}},
    {"Disturbance rejection",
     {"a fixed protocol, comparable between antennas", "docs/benchmark-protocol.md"}},
    {"Torque at the dish",
     {"closed-loop responses to a step and an impulse of torque", "docs/benchmark-protocol.md"}},
    {"Margins",
     {"loop broken at three points, every crossover located", "docs/benchmark-protocol.md"}},
    {"Wind",
     {"integral over the wind's spectrum, checked by Lyapunov equations",
      "docs/benchmark-protocol.md"}},
    {"Perturbed plants", {"fixed gains on each ensemble member", "docs/benchmark-protocol.md"}},
    {"Nonlinear antenna",
     {"nonlinear simulation with synthesised wind", "docs/benchmark-protocol.md"}},
    {"Comparison with another score sheet",
     {"the same protocol, another report", "docs/benchmark-protocol.md"}},
    {"Commissioning plan",
     {"log-linear gain paths, every stage stable on every plant", "docs/commissioning.md"}},
    {"Stages",
     {"expected values as prediction intervals over the plants", "docs/commissioning.md"}},
    {"Before and after", {"spectra of the two records, with intervals", "docs/commissioning.md"}},
    {"What was run", {"simulation of the nonlinear antenna", "docs/simulated-tests.md"}},
    {"Tests of the drive",
     {"simulation of the nonlinear antenna and its recorder", "docs/simulated-tests.md"}},
    {"Position loop",
     {"the sampled controller on the nonlinear antenna", "docs/simulated-tests.md"}},
    {"Breakaway", {"events located in the simulation", "docs/simulated-tests.md"}},
    {"Limits reached", {"events located in the simulation", "docs/simulated-tests.md"}},
    {"What the numbers mean", {"derived from the results above", "README.md"}},
    {"Conclusions", {"derived from the results above", "docs/commissioning.md"}},
});

}  // namespace

SectionMethod method_of(std::string_view heading) {
  for (const auto& entry : entries) {
    if (heading.starts_with(entry.heading_begins)) return entry.method;
  }
  return {};
}

}  // namespace boresight::app
