#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/redesign/matching_verdict.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/tune/position_gain_trade.hpp>

namespace boresight::app {
namespace {

// Of the rms: a change that flywheels may be worth.
constexpr double worth_flywheels = 0.05;

const design::Design& least_of(const MatchingSeries& series) {
  return *std::ranges::min_element(series.designs, {}, &design::Design::boresight_rms);
}

// What the rows between the ends of the study are.
std::string range_of(const MatchingSection& section) {
  return fmt::format("from {:g} to {:g} disks on each motor", section.rows.front().disks,
                     section.rows.back().disks);
}

// What the one-to-one rule is worth along the first series.
std::string evaluate_unit_ratio(const MatchingSection& section, std::size_t unit) {
  const MatchingSeries& series = section.series.front();
  const design::Design& best = least_of(series);
  const auto at = static_cast<std::size_t>(&best - series.designs.data());
  const double ratio = section.rows[at].motor_to_load_ratio;
  std::string text = fmt::format(
      "With {}, ratio 1 ({:.1f} disks) gives {:.4f} mdeg; the minimum is {:.4f} at {} (R = "
      "{:.2f}).",
      control::to_string(series.structure), section.rows[unit].disks,
      series.designs[unit].boresight_rms / millidegree, best.boresight_rms / millidegree,
      section.rows[at].label, ratio);
  const double span = MatchingVerdict::span(series);
  if (span < negligible_change) {
    return text +
           fmt::format(" The rms varies by {:.1f} %: no matching rule matters with this loop.",
                       100.0 * span);
  }
  const bool near_unit = ratio > 0.7 && ratio < 1.4;
  if (!near_unit) return text + " There is no optimum at an inertia ratio of 1.";
  const bool at_end = at == 0 || at + 1 == section.rows.size();
  return text +
         (at_end ? " That is an end of the range studied: an optimum at a ratio of 1 is not shown."
                 : " The optimum is near a ratio of 1.");
}

// Points of the study with a gain at its search limit; empty without one.
std::string at_bounds(const MatchingSection& section) {
  std::set<std::string> gains;
  std::size_t points = 0;
  bool position_gain = false;
  for (const auto& series : section.series) {
    for (const auto& design : series.designs) {
      const auto& names = design.tuning.gains_at_bound;
      gains.insert(names.begin(), names.end());
      if (!names.empty()) ++points;
      position_gain = position_gain || ends_at_position_gain(design.tuning);
    }
  }
  if (points == 0) return "";
  return fmt::format(
      "At {} of the {} points of the matching study a gain is at its search limit ({}): widen it "
      "with [[tuning.bound]].{}{}",
      points, section.series.size() * section.rows.size(), fmt::join(gains, ", "),
      position_gain ? " " : "", position_gain ? trade_not_looked_for() : "");
}

}  // namespace

MatchingVerdict::MatchingVerdict(const MatchingSection& section) : section_(section) {
  for (std::size_t i = 0; i < section.rows.size(); ++i) {
    if (section.rows[i].as_built) built_ = i;
  }
  for (const auto& series : section.series) {
    unusable_ += static_cast<std::size_t>(std::ranges::count_if(
        series.designs, [](const design::Design& design) { return !design.usable(); }));
  }
}

std::vector<std::size_t> MatchingVerdict::ends() const {
  std::vector<std::size_t> rows;
  for (const std::size_t row : {std::size_t{0}, section_.rows.size() - 1}) {
    if (row != built_) rows.push_back(row);
  }
  return rows;
}

std::size_t MatchingVerdict::better_end() const {
  const auto rows = ends();
  return *std::ranges::min_element(rows, {}, [&](std::size_t row) {
    return section_.series.front().designs[row].boresight_rms;
  });
}

double MatchingVerdict::change(const MatchingSeries& series, std::size_t row) const {
  return series.designs[row].boresight_rms / series.designs[built_].boresight_rms - 1.0;
}

double MatchingVerdict::span(const MatchingSeries& series) {
  const auto& largest =
      *std::ranges::max_element(series.designs, {}, &design::Design::boresight_rms);
  return largest.boresight_rms / least_of(series).boresight_rms - 1.0;
}

double MatchingVerdict::largest_span() const {
  double largest = 0.0;
  for (const auto& series : section_.series) largest = std::max(largest, span(series));
  return largest;
}

bool MatchingVerdict::flat() const {
  return largest_span() < negligible_change;
}

const MatchingSeries* MatchingVerdict::other_friction() const {
  const MatchingSeries& first = section_.series.front();
  for (const auto& series : section_.series) {
    if (series.structure == first.structure && series.viscous_friction != first.viscous_friction) {
      return &series;
    }
  }
  return nullptr;
}

bool MatchingVerdict::friction_decides() const {
  const MatchingSeries* other = other_friction();
  if (other == nullptr) return false;
  const double one = span(section_.series.front()), two = span(*other);
  return std::max(one, two) > worth_flywheels && std::min(one, two) < negligible_change;
}

std::string friction_text(const MatchingSeries& series) {
  if (!series.friction.empty()) return series.friction;
  return fmt::format("friction slope {:.3g} N.m.s/rad", series.viscous_friction);
}

std::string what_matters_more(const Report& report) {
  Influences influences;
  if (report.tuning && !report.tuning->wind_alternatives.empty()) {
    const auto [minimum, maximum] =
        std::ranges::minmax(report.tuning->wind_alternatives, {},
                            [](const auto& alternative) { return alternative.boresight_rms; });
    influences.add(maximum.boresight_rms / minimum.boresight_rms - 1.0, "the wind model");
  }
  for (const auto& choice : report.interpretations) {
    const auto& reference = report.interpretations.front().design;
    if (!choice.design || !reference || !choice.design->usable() || !reference->usable()) continue;
    if (choice.missed_resonance()) continue;
    influences.add(std::abs(choice.design->boresight_rms / reference->boresight_rms - 1.0),
                   fmt::format("'{}'", choice.name));
  }
  if (report.matching && report.matching->rows.size() > 1) {
    const MatchingVerdict verdict(*report.matching);
    const auto& first = report.matching->series.front();
    const auto rms = [&](const MatchingSeries& series) {
      return series.designs[verdict.built()].boresight_rms;
    };
    for (const auto& series : report.matching->series) {
      if (series.viscous_friction != first.viscous_friction || verdict.unusable() > 0) continue;
      influences.add(std::abs(rms(series) / rms(first) - 1.0),
                     fmt::format("{} instead of {}", control::to_string(series.structure),
                                 control::to_string(first.structure)));
    }
    if (const MatchingSeries* other = verdict.other_friction();
        other != nullptr && verdict.unusable() == 0) {
      influences.add(std::abs(rms(*other) / rms(first) - 1.0), "the friction slope");
    }
  }
  return influences.sentence();
}

void conclude_matching(const Report& report, const MatchingSection& section,
                       std::vector<std::string>& sentences) {
  if (section.rows.size() < 2) return;
  const MatchingVerdict verdict(section);
  if (verdict.unusable() > 0) {
    sentences.push_back(
        fmt::format("{} of {} points of the matching study are infeasible or not verified: no "
                    "conclusion from the study.",
                    verdict.unusable(), section.series.size() * section.rows.size()));
    return;
  }
  const MatchingRow& built = section.rows[verdict.built()];
  for (const std::size_t end : verdict.ends()) {
    std::string text = fmt::format(
        "Going from {} to {} (R from {:.2f} to {:.2f}), re-tuned at each point, changes the rms by",
        built.label, section.rows[end].label, built.motor_to_load_ratio,
        section.rows[end].motor_to_load_ratio);
    for (std::size_t i = 0; i < section.series.size(); ++i) {
      const MatchingSeries& series = section.series[i];
      text += fmt::format("{} {:+.1f} % ({}, {})", i == 0 ? "" : ",",
                          100.0 * verdict.change(series, end), control::to_string(series.structure),
                          friction_text(series));
    }
    sentences.push_back(text + ".");
  }
  if (std::string bounds = at_bounds(section); !bounds.empty()) {
    sentences.push_back(std::move(bounds));
  }
  if (verdict.flat()) {
    sentences.push_back(
        fmt::format("Over all inertias studied, {}, the rms of each loop changes by at most {:.1f} "
                    "%: neither the motors' inertia nor a matching rule matters here.{}",
                    range_of(section), 100.0 * verdict.largest_span(), what_matters_more(report)));
    return;
  }
  std::string text;
  for (std::size_t i = 0; i < section.rows.size(); ++i) {
    if (section.rows[i].label == "ratio 1") text = evaluate_unit_ratio(section, i);
  }
  const MatchingSeries* other = verdict.other_friction();
  if (other != nullptr && verdict.friction_decides() &&
      MatchingVerdict::span(*other) < negligible_change) {
    text += fmt::format(
        "{}With the friction {}, {:.1f} N.m.s/rad, the motors' inertia hardly matters: measure "
        "that slope before changing flywheels.",
        text.empty() ? "" : " ", other->friction, other->viscous_friction);
  }
  if (!text.empty()) sentences.push_back(std::move(text));
}

std::string decide_matching(const Report& report, const MatchingSection& section) {
  if (section.rows.size() < 2) return "";
  const MatchingVerdict verdict(section);
  if (verdict.unusable() > 0) return "";
  if (verdict.flat()) {
    return fmt::format(
        "Leave the motors' inertia as it is: {}, re-tuned, the rms changes by at most {:.1f} %.{}",
        range_of(section), 100.0 * verdict.largest_span(), what_matters_more(report));
  }
  const std::size_t end = verdict.better_end();
  const MatchingSeries& series = section.series.front();
  std::string text = fmt::format(
      "Going from {} as built to {}, re-tuned for the case's plant alone, changes the rms of "
      "linear loops by {:+.1f} % with {} ({})",
      section.rows[verdict.built()].label, section.rows[end].label,
      100.0 * verdict.change(series, end), control::to_string(series.structure),
      friction_text(series));
  const MatchingSeries* other = verdict.other_friction();
  if (other == nullptr) return text + ".";
  const double one = verdict.change(series, end), two = verdict.change(*other, end);
  text += std::abs(one - two) > negligible_change ? ", but by " : ", and by ";
  text += fmt::format("{:+.1f} % with the {}", 100.0 * two, other->friction);
  return text +
         (verdict.friction_decides() ? ": measure that slope before changing flywheels." : ".");
}

}  // namespace boresight::app
