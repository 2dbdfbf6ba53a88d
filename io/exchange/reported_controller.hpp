#pragma once

#include <limits>
#include <string>
#include <vector>

#include <boresight/design/decisions/recommend.hpp>

namespace boresight::io {

/// One of the "laws" of a report of `boresight tune` as design::recommend compares it. What the
/// report does not say (an older one, its verification) counts as good. Row: a nlohmann JSON type,
/// whose exceptions pass.
template <typename Row>
design::Assessment reported_assessment(const Row& row) {
  constexpr double rad_per_mdeg = 1.7453292519943295e-5;
  const bool robust = row.at("tuned_for") == "robust";
  const auto& rms = row.at("beam_rms_mdeg");
  design::Assessment result;
  result.structure = row.at("structure").template get<std::string>();
  result.purpose = robust ? design::DesignPurpose::robust : design::DesignPurpose::nominal;
  result.stable = result.verified = rms.is_number();
  if (rms.is_number()) result.linear_rms = rms.template get<double>() * rad_per_mdeg;
  result.nominal_constraints_met = row.at("goals_met").template get<bool>();
  result.member_constraints_met = robust && result.nominal_constraints_met;
  if (row.contains("gains_as_written")) result.parts = row.at("gains_as_written").size();
  if (row.contains("design") && row.at("design").is_object()) {
    result.verified = row.at("design").value("verified", true);
  }
  return result;
}

/// The controller to take from the "laws" of a report of `boresight tune`, of `structure` unless
/// that is empty: at the first wind speed that has any of accepted fitness the one that the report
/// recommends; where it recommends none of these, design::recommend by what the report says. Null
/// if there is none.
template <typename Rows>
const Rows* recommended_row(const Rows& rows, const std::string& structure,
                            design::Fitness accepted) {
  // A report that states no wind speed is of one.
  const auto wind_speed = [](const Rows& row) {
    return row.value("design_wind_speed_m_per_s", 0.0);
  };
  std::vector<double> speeds;
  for (const auto& row : rows) {
    const double speed = wind_speed(row);
    bool known = false;
    for (const double one : speeds) known = known || one == speed;
    if (!known) speeds.push_back(speed);
  }
  for (const double speed : speeds) {
    std::vector<const Rows*> candidates;
    std::vector<design::Assessment> assessments;
    for (const auto& row : rows) {
      if (wind_speed(row) != speed || row.at("tuned_for") == "present") continue;
      if (!structure.empty() && row.at("structure") != structure) continue;
      if (row.value("recommended", false)) return &row;
      candidates.push_back(&row);
      assessments.push_back(reported_assessment(row));
    }
    const auto winner = design::recommend(assessments, {.accepted = accepted}).winner;
    if (winner) return candidates[*winner];
  }
  return nullptr;
}

}  // namespace boresight::io
