#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

std::string ratio_text(double ratio) {
  return ratio > 0.0 && std::isfinite(ratio) ? fmt::format("{:.2f}", ratio) : "without meaning";
}

void conclude_masses(const IdentificationSection& section, std::vector<std::string>& sentences) {
  std::string text = "Mass properties give";
  bool first = true;
  for (const auto& method : section.inertia.methods) {
    if (method.kind != identification::MethodKind::mass_properties) continue;
    text += fmt::format("{} {:.3f} kg.m2 ({:.3f} lbf.ft.s2) and R = {} ({})", first ? "" : ";",
                        method.reflected_inertia.value,
                        method.reflected_inertia.value / pound_foot_second_squared,
                        ratio_text(method.motor_to_load_ratio.value), method.name);
    first = false;
  }
  sentences.push_back(text + ".");
}

// What the records say takes the place of the methods' own printed numbers.
void conclude_campaign(const CampaignSection& section, const identification::GreyBoxResult& found,
                       std::vector<std::string>& sentences) {
  const auto& inertia = found.quantity("inertia").posterior;
  const auto& ratio = found.quantity("motor to load ratio").posterior;
  const auto& leakage = found.quantity("leakage rate").posterior;
  sentences.push_back(fmt::format(
      "{} records together give a reflected inertia of {:.3f} kg.m2 (95 % interval {:.3f} .. "
      "{:.3f}), R = {:.2f} ({:.2f} .. {:.2f}), and leakage of {:.3g} 1/s ({:.3g} .. {:.3g}); the "
      "plant below is the one they show.",
      found.records.size(), inertia.value, inertia.lower, inertia.upper, ratio.value, ratio.lower,
      ratio.upper, leakage.value, leakage.lower, leakage.upper));
  if (!section.contradictions.empty()) {
    sentences.push_back(fmt::format("They contradict {} of the numbers that the case states.",
                                    section.contradictions.size()));
  }
}

void conclude_identification(const IdentificationSection& section,
                             std::vector<std::string>& sentences) {
  const auto& methods = section.inertia.methods;
  const bool tested =
      std::any_of(methods.begin(), methods.end(), [](const identification::InertiaMethod& method) {
        return method.kind != identification::MethodKind::mass_properties;
      });
  conclude_masses(section, sentences);
  if (!tested) {
    sentences.emplace_back("Only mass properties speak for the inertia; no test confirms it.");
    return;
  }
  const auto by_inertia = [](const identification::InertiaMethod& x,
                             const identification::InertiaMethod& y) {
    return x.reflected_inertia.value < y.reflected_inertia.value;
  };
  const auto [least, most] = std::minmax_element(methods.begin(), methods.end(), by_inertia);
  const double ratio = least->motor_to_load_ratio.value;
  std::string text = fmt::format(
      "The methods put the reflected inertia between {:.3f} kg.m2 ({}) and {:.3f} ({}), and the "
      "motor-to-load ratio between {} and {}.",
      least->reflected_inertia.value, least->name, most->reflected_inertia.value, most->name,
      ratio_text(most->motor_to_load_ratio.value), ratio_text(ratio));
  if (ratio > 2.0 && std::isfinite(ratio)) {
    // dR/R = -(1 + R) dJ/J
    text += fmt::format(
        " At R = {:.1f}, 1 % of inertia moves R by {:.1f} %: the ratio is the wrong number to "
        "argue over.",
        ratio, 1.0 + ratio);
  }
  sentences.push_back(std::move(text));
  for (const auto& method : methods) {
    const auto& left = method.antenna_remainder;
    const auto& needs = methods.front().antenna_remainder;
    if (method.kind != identification::MethodKind::resonance || left.upper >= needs.lower) continue;
    sentences.push_back(fmt::format(
        "The resonance leaves {:.3f} to {:.3f} kg.m2 for an antenna that the mass properties "
        "put at {:.3f} to {:.3f}: within their input uncertainties the two contradict each "
        "other. Oil stiffness (bulk modulus, volumes, the efficiencies in it), the masses, or "
        "the reading of the resonance must give way.",
        left.lower, left.upper, needs.lower, needs.upper));
  }
}

void conclude_tuning(const TuningSection& section, std::vector<std::string>& sentences) {
  const auto& design = section.design;
  if (design.tuning.status == design::TuningStatus::unstable) {
    sentences.push_back(fmt::format("No {} law of the search stabilises this antenna.",
                                    control::to_string(section.structure)));
    return;
  }
  if (design.tuning.status != design::TuningStatus::optimal) {
    sentences.push_back(fmt::format(
        "No {} law meets the hard goals; the nearest exceeds one by {:.1f} %.",
        control::to_string(section.structure), 100.0 * (design.tuning.worst_goal_ratio - 1.0)));
    return;
  }
  if (!design.verification.passed) {
    sentences.push_back(fmt::format(
        "The best {} law found fails its verification ({}): nothing is concluded from it.",
        control::to_string(section.structure), design.verification.failure));
    return;
  }
  const bool repeated = 2 * section.seeds_within_1_percent > static_cast<int>(section.seeds.size());
  std::string text = fmt::format(
      "As built, the best {} law found{} points within {:.3f} mdeg rms an axis in {:g} m/s of wind",
      control::to_string(section.structure),
      repeated ? "" : " (not repeated by most seeds: look further)", design.beam_rms / millidegree,
      section.design_speed);
  for (const auto& budget : section.budgets) {
    text +=
        fmt::format("; {} ({}: {:.3f} mdeg) is met up to {:.1f} m/s", budget.budget.name,
                    budget.budget.band, budget.budget.rms / millidegree, budget.wind_speed_limit);
  }
  sentences.push_back(text + ".");

  const auto by_rms = [](const TuningSection::WindAlternative& x,
                         const TuningSection::WindAlternative& y) {
    return x.beam_rms < y.beam_rms;
  };
  const auto [least, most] = std::minmax_element(section.wind_alternatives.begin(),
                                                 section.wind_alternatives.end(), by_rms);
  sentences.push_back(fmt::format(
      "These rms values stand on the wind model {}: the same gains give {:.3f} mdeg by the {} "
      "model and {:.3f} by the {} model. With the encoder held perfectly still, bending that it "
      "cannot see would leave {:.3f} mdeg.",
      plant::to_string(section.wind_model), least->beam_rms / millidegree,
      plant::to_string(least->model), most->beam_rms / millidegree, plant::to_string(most->model),
      section.encoder_held_rms / millidegree));
}

bool usable(const design::Design& design) {
  return design.tuning.status == design::TuningStatus::optimal && design.verification.passed;
}

// Change of rms from the last row (most disks) to the first, in percent.
double change(const MatchingSeries& series) {
  return 100.0 * (series.designs.front().beam_rms / series.designs.back().beam_rms - 1.0);
}

void conclude_matching(const MatchingSection& section, std::vector<std::string>& sentences) {
  if (section.rows.size() < 2) return;
  std::size_t unusable = 0;
  for (const auto& series : section.series) {
    unusable += static_cast<std::size_t>(
        std::count_if(series.designs.begin(), series.designs.end(),
                      [](const design::Design& design) { return !usable(design); }));
  }
  if (unusable > 0) {
    sentences.push_back(
        fmt::format("{} of {} points of the matching study are infeasible or not verified: nothing "
                    "is concluded from the study.",
                    unusable, section.series.size() * section.rows.size()));
    return;
  }
  std::string text = fmt::format(
      "Going from {} to {} (R from {:.2f} to {:.2f}), re-tuned at each point, changes the beam "
      "rms by",
      section.rows.back().label, section.rows.front().label,
      section.rows.back().motor_to_load_ratio, section.rows.front().motor_to_load_ratio);
  for (std::size_t i = 0; i < section.series.size(); ++i) {
    const MatchingSeries& series = section.series[i];
    text += fmt::format("{} {:+.1f} % ({}, {})", i == 0 ? "" : ",", change(series),
                        control::to_string(series.structure), series.friction);
  }
  sentences.push_back(text + ".");

  const MatchingSeries& series = section.series.front();
  for (std::size_t i = 0; i < section.rows.size(); ++i) {
    if (section.rows[i].label != "ratio 1") continue;
    const auto best = std::min_element(
        series.designs.begin(), series.designs.end(),
        [](const design::Design& x, const design::Design& y) { return x.beam_rms < y.beam_rms; });
    const auto at = static_cast<std::size_t>(best - series.designs.begin());
    const double best_ratio = section.rows[at].motor_to_load_ratio;
    const bool near_unit = best_ratio > 0.7 && best_ratio < 1.4;
    text = fmt::format(
        "With {}, ratio 1 ({:.1f} disks) gives {:.4f} mdeg; the least is {:.4f} at {} (R = "
        "{:.2f}). The one-to-one rule {} here.",
        control::to_string(series.structure), section.rows[i].disks,
        series.designs[i].beam_rms / millidegree, best->beam_rms / millidegree,
        section.rows[at].label, best_ratio, near_unit ? "happens to fit" : "marks nothing special");
  }
  // The first series is the linear plant's, the last has the friction slope of the tracking rate.
  if (std::abs(change(series)) > 5.0 && std::abs(change(section.series.back())) < 2.0) {
    text += fmt::format(
        " With the friction {}, {:.1f} N.m.s/rad, the motors' inertia hardly matters at all: "
        "measure that slope before touching a flywheel.",
        section.series.back().friction, section.series.back().viscous_friction);
  }
  sentences.push_back(std::move(text));
}

}  // namespace

std::vector<std::string> conclude(const Report& report) {
  std::vector<std::string> sentences;
  if (report.campaign && report.campaign->grey_box) {
    conclude_campaign(*report.campaign, *report.campaign->grey_box, sentences);
  } else if (report.identification) {
    conclude_identification(*report.identification, sentences);
  }
  if (report.tuning) conclude_tuning(*report.tuning, sentences);
  if (report.time_domain) sentences.push_back(conclude(*report.time_domain));
  if (report.matching) conclude_matching(*report.matching, sentences);
  if (report.tuning && !report.assumed.empty()) {
    sentences.push_back(
        fmt::format("{} inputs of this case are assumed, in value or in uncertainty (listed "
                    "above). Every rms here stands on them until they are measured.",
                    report.assumed.size()));
  }
  return sentences;
}

}  // namespace boresight::app
