#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/page/decision.hpp>
#include <boresight/app/page/study_decision.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

using Sentences = std::vector<std::string>;

double mdeg(double angle) {
  return angle / millidegree;
}

std::size_t as_built(const MatchSection& section) {
  for (std::size_t p = 0; p < section.points.size(); ++p) {
    if (section.points[p].label.find("as built") != std::string::npos) return p;
  }
  return section.points.size() - 1;
}

const TunedLaw* best_of(const TuneSection& section, TunedFor purpose) {
  const TunedLaw* best = nullptr;
  for (const auto& law : section.laws) {
    if (law.tuned_for != purpose || !law.usable()) continue;
    if (best == nullptr || law.beam_rms < best->beam_rms) best = &law;
  }
  return best;
}

}  // namespace

std::vector<std::string> decision(const MatchSection& section) {
  const MatchSeries* best = nullptr;
  std::size_t best_point = 0;
  double least = 0.0, least_built = 0.0, most_built = 0.0;
  const std::size_t built = as_built(section);
  for (const auto& series : section.series) {
    if (!series.best) continue;
    const std::size_t point = *series.best;
    const double rms = series.values[point].beam_rms;
    if (best == nullptr || rms < least) {
      best = &series;
      best_point = point;
      least = rms;
    }
    const MatchValue& present = series.values[built];
    if (!present.found) continue;
    if (least_built == 0.0 || present.beam_rms < least_built) least_built = present.beam_rms;
    most_built = std::max(most_built, present.beam_rms);
  }
  if (best == nullptr) return {"No structure meets the goals at any motor inertia."};
  const MatchPoint& point = section.points[best_point];
  Sentences sentences{fmt::format(
      "The least rms, {:.3f} mdeg in {:g} m/s, comes with {} loops and {:g} disks on each motor "
      "(ratio {:.2f}); from {:.1f} to {:.1f} disks it stays within 5 % of that.",
      mdeg(least), section.wind_speed, best->name, point.disks, point.motor_to_load_ratio,
      best->within_5_percent.lowest, best->within_5_percent.highest)};
  const MatchValue& present = best->values[built];
  if (present.found && least_built > 0.0) {
    const double by_disks = present.beam_rms / least, by_loops = most_built / least_built;
    sentences.push_back(fmt::format(
        "Leaving the motors as built costs {:+.0f} % with those loops, and the choice of loops as "
        "built up to {:.0f} %: change the {} first.",
        100.0 * (by_disks - 1.0), 100.0 * (by_loops - 1.0),
        by_loops > by_disks ? "loops" : "flywheels"));
  }
  const FrictionThreshold* threshold = nullptr;
  double slope = 0.0;
  for (const auto& one : section.thresholds) {
    if (!one.slope || (threshold != nullptr && *one.slope >= slope)) continue;
    threshold = &one;
    slope = *one.slope;
  }
  if (threshold != nullptr) {
    sentences.push_back(fmt::format(
        "Measure the friction slope at the tracking rate first: above {:.3g} N m s/rad the motors' "
        "inertia moves the rms of {} loops by less than {:.0f} %.",
        slope, threshold->structure, 100.0 * threshold->spread));
  }
  return sentences;
}

std::vector<std::string> decision(const EvaluateSection& section) {
  Sentences sentences;
  if (section.decision && !section.candidates.empty()) {
    const DecisionSection& draws = *section.decision;
    const auto& place = draws.candidates[draws.best];
    const Candidate& best = section.candidates[place.candidate];
    const auto& option = draws.statistics.options[draws.best];
    sentences.push_back(
        fmt::format("Choose {}: {:.3f} mdeg rms on average over {} draws in {:g} m/s, at {:g} {}.",
                    best.name, option.mean, draws.draws, section.wind_speed, best.cost,
                    section.currency.empty() ? "of cost" : section.currency));
    sentences.push_back(fmt::format(
        "It is the best of all with probability {:.2f}, and breaks a hard goal on a share of "
        "{:.3f} of the draws.",
        option.best.value, place.outside_goals.value));
  }
  std::string front;
  for (const std::size_t i : section.front) {
    const Candidate& candidate = section.candidates[i];
    const CandidateLaw* law = candidate.chosen_law();
    if (law == nullptr) continue;
    front += fmt::format("{}{} ({:g} {}, {:.3f} mdeg)", front.empty() ? "" : ", ", candidate.name,
                         candidate.cost, section.currency, mdeg(law->member_rms));
  }
  if (!front.empty()) {
    sentences.push_back(
        fmt::format("Worth their cost, each better than all that cost less: {}.", front));
  }
  return sentences;
}

std::vector<std::string> decision(const TuneSection& section,
                                  const std::optional<TimeDomainSection>& time_domain,
                                  const std::optional<design::PointingLimit>& limit) {
  const TunedLaw* robust = best_of(section, TunedFor::robust);
  const TunedLaw* best = robust != nullptr ? robust : best_of(section, TunedFor::nominal);
  if (best == nullptr) return {"No law that was tuned meets the hard goals of this case."};
  std::string text = fmt::format(
      "On the linear plant {} is best, with {:.3f} mdeg rms in {:g} m/s, {}", best->structure,
      mdeg(best->beam_rms), best->wind_speed,
      robust != nullptr ? fmt::format("its goals held on each of {} plants", section.ensemble_size)
                        : std::string("its goals held on the nominal plant only"));
  if (!section.budgets.empty() && !best->speed_limits.empty()) {
    text += fmt::format("; it meets {} ({}) up to {:.1f} m/s", section.budgets.front().name,
                        section.budgets.front().band, best->speed_limits.front());
  }
  Sentences sentences{text + "."};
  if (time_domain) {
    sentences.push_back(fmt::format(
        "On the nonlinear antenna {} comes first, with {:.3f} mdeg: commission that one.",
        time_domain->law, mdeg(time_domain->result.wind.beam_rms)));
  }
  if (limit && limit->least_rms > 0.0) {
    sentences.push_back(fmt::format(
        "No controller with these sensors, sampling and valve effort gets below {:.3f} mdeg on the "
        "nominal plant: what is beyond that takes other hardware.",
        mdeg(limit->least_rms)));
  }
  return sentences;
}

std::vector<std::string> decision(const MonteCarloSection& section) {
  Sentences sentences{fmt::format(
      "{} held on {} plants is unstable on a share of {:.4g} (95 %: at most {:.2g}) and keeps all "
      "hard goals on {:.1f} %.",
      section.structure, section.plants, section.instability.value, section.instability.upper,
      100.0 * section.all_goals_met.value)};
  if (!section.budgets.empty()) {
    const auto& one = section.budgets.front();
    sentences.push_back(fmt::format(
        "{} (band {}, {:.3f} mdeg) is met on {:.1f} % of the plants in {:g} m/s.", one.budget.name,
        one.budget.band, mdeg(one.budget.rms), 100.0 * one.met.value, section.wind_speed));
  }
  const auto most = std::ranges::max_element(
      section.correlations, {}, [](const auto& one) { return std::abs(one.with_rms.value); });
  if (most != section.correlations.end()) {
    sentences.push_back(
        fmt::format("To narrow that, measure the {} first (rank correlation "
                    "{:+.2f} with the rms).",
                    to_string(most->input), most->with_rms.value));
  }
  return sentences;
}

std::vector<std::string> decision(const BenchmarkReport& report) {
  if (!report.score.stable) {
    return {
        fmt::format("Do not run {} on this antenna: the closed loop is unstable, slowest pole "
                    "{:+.3g} 1/s.",
                    report.controller.description, report.score.abscissa)};
  }
  const auto& score = report.score;
  Sentences sentences{fmt::format("{} points within {:.3f} mdeg rms an axis in {:g} m/s of wind.",
                                  report.controller.description, mdeg(score.design_wind.beam_rms),
                                  score.design_wind.mean_speed)};
  if (score.ensemble) {
    sentences.push_back(fmt::format(
        "It is stable on {} of {} plants that may be the true one and "
        "keeps its goals on {}.",
        score.ensemble->stable, score.ensemble->members.size(), score.ensemble->within_goals));
  }
  if (score.reference && score.reference->least_rms) {
    sentences.push_back(fmt::format(
        "The least that any controller could reach with these sensors and the goals' effort is "
        "{:.3f} mdeg.",
        mdeg(*score.reference->least_rms)));
  }
  return sentences;
}

std::vector<std::string> decision(const CommissionReport& report) {
  Sentences sentences;
  for (const auto& sentence : report.conclusions) {
    if (sentences.size() < 3) sentences.push_back(sentence);
  }
  const bool known = !report.plan.stages.empty() &&
                     report.plan.stages.front().kind == design::StageKind::as_found;
  if (sentences.size() < 3 && report.plan.detuning && !known) {
    sentences.emplace_back(
        "The gains found are not known: the plan begins with the law's own, lowered until every "
        "plant keeps its margins.");
  }
  return sentences;
}

std::vector<std::string> decision(const SimulationReport& report) {
  Sentences sentences;
  for (const auto& run : report.position) {
    if (!run.beam_rms || !run.predicted_rms) continue;
    sentences.push_back(fmt::format(
        "Expect {:.3f} mdeg rms of the beam in {} on the nonlinear antenna, where the linear "
        "design predicts {:.3f}.",
        mdeg(*run.beam_rms), run.test, mdeg(*run.predicted_rms)));
    break;
  }
  if (!report.failure.empty()) {
    sentences.push_back(fmt::format("{} failed: {}.", report.failed_test, report.failure));
  }
  sentences.push_back(
      fmt::format("{} test{} ran; records are written as the antenna's recorder "
                  "would, to be identified like measured ones.",
                  report.drive.size() + report.position.size(),
                  report.drive.size() + report.position.size() == 1 ? "" : "s"));
  return sentences;
}

}  // namespace boresight::app
