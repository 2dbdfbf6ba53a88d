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

void conclude_identification(const IdentificationSection& section, const PlantSection& plant,
                             std::vector<std::string>& sentences) {
  const auto& methods = section.inertia.methods;
  const bool tested =
      std::any_of(methods.begin(), methods.end(), [](const identification::InertiaMethod& method) {
        return method.kind != identification::MethodKind::mass_properties;
      });
  if (!tested) {
    const auto& only = methods.front();
    sentences.push_back(fmt::format(
        "Only mass properties speak for the inertia: {:.3f} kg.m2, motor-to-load ratio {} (95 % "
        "interval {:.2f} to {:.2f}); no test confirms it.",
        only.reflected_inertia.value, ratio_text(only.motor_to_load_ratio.value),
        only.motor_to_load_ratio.lower, only.motor_to_load_ratio.upper));
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
        "argue "
        "over.",
        ratio, 1.0 + ratio);
  }
  if (const auto& left = least->antenna_remainder;
      left.value < 0.5 * plant::antenna_inertia(plant.plant.structure)) {
    text += fmt::format(
        " The smallest leaves {:.3f} kg.m2 for an antenna that needs {:.3f}: it cannot be the "
        "inertia, so the oil is stiffer than computed or the frequency read is not the rigid mode.",
        left.value, plant::antenna_inertia(plant.plant.structure));
  }
  sentences.push_back(std::move(text));
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
  std::string text = fmt::format(
      "As built, the best {} law points within {:.3f} mdeg rms an axis in {:g} m/s of wind",
      control::to_string(section.structure), design.beam_rms / millidegree, section.design_speed);
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
      "model "
      "and {:.3f} by the {} model. Bending that no encoder sees sets a floor of {:.3f} mdeg.",
      plant::to_string(section.wind_model), least->beam_rms / millidegree,
      plant::to_string(least->model), most->beam_rms / millidegree, plant::to_string(most->model),
      section.bending_floor / millidegree));
}

// Change of rms from the last row (most disks) to the first, in percent.
double change(const MatchingSeries& series) {
  return 100.0 * (series.designs.front().beam_rms / series.designs.back().beam_rms - 1.0);
}

void conclude_matching(const MatchingSection& section, std::vector<std::string>& sentences) {
  const auto finite = [](const design::Design& design) { return std::isfinite(design.beam_rms); };
  const bool whole =
      std::all_of(section.series.begin(), section.series.end(), [&](const MatchingSeries& series) {
        return std::all_of(series.designs.begin(), series.designs.end(), finite);
      });
  if (section.rows.size() < 2 || !whole) return;
  std::string text = fmt::format(
      "Going from {} to {} (R from {:.2f} to {:.2f}), re-tuned at each point, changes the beam rms "
      "by",
      section.rows.back().label, section.rows.front().label,
      section.rows.back().motor_to_load_ratio, section.rows.front().motor_to_load_ratio);
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (std::size_t i = 0; i < section.series.size(); ++i) {
    const MatchingSeries& series = section.series[i];
    const double percent = change(series);
    least = std::min(least, std::abs(percent));
    most = std::max(most, std::abs(percent));
    text += fmt::format("{} {:+.1f} % ({}, {})", i == 0 ? "" : ",", percent,
                        control::to_string(series.structure), series.friction);
  }
  text += ".";
  sentences.push_back(std::move(text));

  for (std::size_t i = 0; i < section.rows.size(); ++i) {
    if (section.rows[i].label != "ratio 1") continue;
    const MatchingSeries& series = section.series.front();
    const auto best = std::min_element(
        series.designs.begin(), series.designs.end(),
        [](const design::Design& x, const design::Design& y) { return x.beam_rms < y.beam_rms; });
    const auto at = static_cast<std::size_t>(best - series.designs.begin());
    const double best_ratio = section.rows[at].motor_to_load_ratio;
    const bool near_unit = best_ratio > 0.7 && best_ratio < 1.4;
    text = fmt::format(
        "With {}, ratio 1 ({:.1f} disks) gives {:.4f} mdeg; the least is {:.4f} at {} (R = "
        "{:.2f}). "
        "The one-to-one rule {} here.",
        control::to_string(series.structure), section.rows[i].disks,
        series.designs[i].beam_rms / millidegree, best->beam_rms / millidegree,
        section.rows[at].label, best_ratio, near_unit ? "happens to fit" : "marks nothing special");
    if (least < 2.0 && most > 5.0) {
      text +=
          " With the friction slope of the tracking rate the motors' inertia hardly matters at "
          "all: "
          "measure that slope before touching a flywheel.";
    }
    sentences.push_back(std::move(text));
  }
}

}  // namespace

std::vector<std::string> conclude(const Report& report) {
  std::vector<std::string> sentences;
  if (report.identification && report.plant) {
    conclude_identification(*report.identification, *report.plant, sentences);
  }
  if (report.tuning) conclude_tuning(*report.tuning, sentences);
  if (report.matching) conclude_matching(*report.matching, sentences);
  if (report.tuning && !report.assumed.empty()) {
    sentences.push_back(
        fmt::format("{} inputs of this case are assumed, in value or in uncertainty (listed "
                    "above). Every rms here "
                    "stands on them until they are measured.",
                    report.assumed.size()));
  }
  return sentences;
}

}  // namespace boresight::app
