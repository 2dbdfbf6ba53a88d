#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <boresight/app/report/decision.hpp>
#include <boresight/app/report/present_gains.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using Sentences = std::vector<std::string>;

double mdeg(double angle) {
  return angle / millidegree;
}

}  // namespace

std::vector<std::string> decision(const MonteCarloSection& section) {
  Sentences sentences{fmt::format(
      "{}{} on {} plants is unstable on a fraction of {:.4g} (95 %: at most {:.2g}) and "
      "meets all constraints on {:.1f} %.",
      section.structure,
      section.controller.structure.state_space() == nullptr ? " with fixed gains" : "",
      section.plants, section.instability.value, section.instability.upper,
      100.0 * section.all_constraints_met.value)};
  if (!section.budgets.empty()) {
    const auto& one = section.budgets.front();
    sentences.push_back(
        fmt::format("{} (band {}, {:.3f} mdeg) is met on {:.1f} % of the plants in {:.3g} m/s, "
                    "{}.",
                    one.budget.name, one.budget.band, mdeg(one.budget.rms), 100.0 * one.met.value,
                    section.wind_speed, evaluated_by(section.effect)));
  }
  const auto maximum = std::ranges::max_element(
      section.correlations, {}, [](const auto& one) { return std::abs(one.with_rms.value); });
  if (maximum != section.correlations.end()) {
    sentences.push_back(
        fmt::format("To narrow that, measure the {} first (rank correlation "
                    "{:+.2f} with the rms).",
                    to_string(maximum->input), maximum->with_rms.value));
  }
  return sentences;
}

namespace {

// What a simulation says beside a linear rms.
std::string beside_linear(const std::optional<design::TimeDomainStudy>& simulated) {
  if (!simulated) return "linear plant, not simulated";
  const auto own = simulated->own();
  if (!std::isfinite(own.simulated_rms())) return "linear; its simulation was lost";
  std::string text =
      own.rms ? fmt::format("linear; {:.3f} simulated (95 % {:.3f} to {:.3f} over {} winds)",
                            mdeg(own.rms->rms.value), mdeg(own.rms->rms.lower),
                            mdeg(own.rms->rms.upper), own.rms->records)
              : fmt::format("linear; {:.3f} simulated in one record", mdeg(own.simulated_rms()));
  if (const double amplitude = own.effect().amplitude; amplitude > 0.0) {
    text += fmt::format(", limit cycle +-{:.2f}", mdeg(amplitude));
  }
  return text;
}

}  // namespace

std::vector<std::string> decision(const BenchmarkReport& report) {
  if (!report.score.stable && report.present_gains && report.controller.controller) {
    return {unstable_present_gains(report.controller.controller->structure.name())};
  }
  if (!report.score.stable) {
    return {
        fmt::format("Do not run {} on this antenna: the closed loop is unstable, slowest pole "
                    "{:+.3g} 1/s.",
                    report.controller.description, report.score.abscissa)};
  }
  const auto& score = report.score;
  Sentences sentences{fmt::format("{} has {:.3f} mdeg rms per axis in {:.3g} m/s of wind, {}.",
                                  report.controller.description,
                                  mdeg(score.design_wind.boresight_rms),
                                  score.design_wind.mean_speed, beside_linear(report.nonlinear))};
  if (score.ensemble) {
    sentences.push_back(
        fmt::format("It is stable on {} of {} ensemble members and meets the constraints on {}.",
                    score.ensemble->stable, score.ensemble->members.size(),
                    score.ensemble->within_constraints));
  }
  if (score.reference && score.reference->min_rms) {
    sentences.push_back(
        fmt::format("Lower bound with these sensors and this control effort: {:.3f} mdeg.",
                    mdeg(*score.reference->min_rms)));
  }
  return sentences;
}

std::vector<std::string> decision(const CommissionReport& report) {
  Sentences sentences;
  for (const auto& sentence : report.conclusions) {
    if (sentences.size() < 3) sentences.push_back(sentence);
  }
  const bool known =
      !report.plan.stages.empty() && report.plan.stages.front().kind == design::StageKind::as_found;
  if (sentences.size() < 3 && report.plan.detuning && !known) {
    sentences.emplace_back(
        "The present gains are unknown: the plan begins with the controller's own, lowered until "
        "every plant keeps its margins.");
  }
  return sentences;
}

std::vector<std::string> decision(const SimulationReport& report) {
  Sentences sentences;
  for (const auto& run : report.position) {
    if (!run.boresight_rms || !run.predicted_rms) continue;
    sentences.push_back(fmt::format(
        "Expect {:.3f} mdeg rms in {} on the nonlinear antenna; the linear design predicts {:.3f}.",
        mdeg(*run.boresight_rms), run.test, mdeg(*run.predicted_rms)));
    break;
  }
  if (!report.failure.empty()) {
    sentences.push_back(fmt::format("{} failed: {}.", report.failed_test, report.failure));
  }
  sentences.push_back(fmt::format("{} test{} ran; identify the records like measured ones.",
                                  report.drive.size() + report.position.size(),
                                  report.drive.size() + report.position.size() == 1 ? "" : "s"));
  return sentences;
}

}  // namespace boresight::app
