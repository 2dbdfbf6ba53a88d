#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/control/controllers/usual_structures.hpp>
#include <boresight/design/decisions/recommend.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/present_gains.hpp>
#include <boresight/io/exchange/reported_controller.hpp>
#include <boresight/io/exchange/sampled_controller_file.hpp>
#include <boresight/io/files/renamed_keys.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using Json = nlohmann::ordered_json;

// One of the "controllers" of a report of `boresight tune` as design::recommend compares it.
design::Assessment reported_assessment(const Json& row) {
  const bool robust = row.at("tuned_for") == "robust";
  const auto& rms = row.at("boresight_rms_mdeg");
  design::Assessment result;
  result.structure = row.at("structure").get<std::string>();
  result.purpose = robust ? design::DesignPurpose::robust : design::DesignPurpose::nominal;
  result.stable = result.verified = rms.is_number();
  if (rms.is_number()) result.linear_rms = rms.get<double>() * millidegree;
  result.nominal_constraints_met = row.at("constraints_met").get<bool>();
  result.member_constraints_met = robust && result.nominal_constraints_met;
  // A state space, which has none, has more parts than any gains.
  if (row.contains("gains_as_written")) result.parts = row.at("gains_as_written").size();
  if (row.at("structure") == design::state_space_name) result.parts = control::max_gains + 1;
  if (row.contains("design") && row.at("design").is_object()) {
    result.verified = row.at("design").value("verified", true);
  }
  return result;
}

// Null if there is none.
const Json* recommended_row(const Json& rows, const std::string& structure,
                            design::Fitness accepted) {
  // A report that states no wind speed is of one.
  const auto wind_speed = [](const Json& row) {
    return row.value("design_wind_speed_m_per_s", 0.0);
  };
  std::vector<double> speeds;
  for (const auto& row : rows) {
    const double speed = wind_speed(row);
    if (std::ranges::find(speeds, speed) == speeds.end()) speeds.push_back(speed);
  }
  for (const double speed : speeds) {
    std::vector<const Json*> candidates;
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

[[noreturn]] void refuse(const std::string& path, const std::string& found) {
  throw InvalidInput(fmt::format(
      "{}: expected a report of `boresight tune` or `redesign` in JSON with a controller, "
      "found {}",
      path, found));
}

// The gains of a "design": numbers whose keys are the gains' names with blanks replaced and the
// unit behind.
control::Controller controller_from_design(const Case& antenna, const std::string& path,
                                           const Json& design, const std::string& structure) {
  control::Controller controller{structure_named(antenna, structure), {}};
  const Json gains = design.value("gains", Json::object());
  for (const auto& description : controller.structure.gains()) {
    std::string key = description.name;
    std::ranges::replace(key, ' ', '_');
    const auto found = std::ranges::find_if(
        gains.items(), [&](const auto& item) { return item.key().starts_with(key + "_"); });
    if (found == gains.items().end() || !found.value().is_number()) {
      refuse(path, fmt::format("no gain '{}' of {}", description.name, structure));
    }
    controller.gains.push_back(found.value().template get<double>());
  }
  control::validate(controller);
  return controller;
}

// The matrices of a state space are in the report's linear models.
bool has_state_space(const Json& report) {
  return report.value("linear_models", Json::object()).contains("state_space_controller");
}

control::Controller state_space_of(const Case& antenna, const std::string& path,
                                   const std::string& text) {
  ControllerNames names;
  names.part = "state_space_controller";
  const double sample_time = control::sample_time_of(make_problem(antenna).delay);
  return sampled_controller_of(parse_controller(text, path, gear_ratio(antenna), names), path,
                               sample_time)
      .controller;
}

}  // namespace

control::LoopStructure structure_named(const Case& antenna, const std::string& name) {
  for (const auto& [short_name, controller] : present_controllers(antenna)) {
    if (controller.structure.name() == name) return controller.structure;
  }
  for (const auto& usual : control::usual_structures()) {
    if (control::LoopStructure::named(usual).name() == name) return loop_structure(antenna, usual);
  }
  return loop_structure(antenna, name);
}

GainsOfFile controller_of_report(const Case& antenna, const std::string& text,
                                 const std::string& path, const std::string& structure,
                                 design::Fitness accepted) {
  try {
    Json report = Json::parse(text);
    use_present_keys(report, path);
    if (report.contains("tuned")) {
      const Json* best = recommended_row(report.at("tuned").at("controllers"), structure, accepted);
      if (best == nullptr) {
        refuse(path,
               fmt::format(
                   "none{}{}", structure.empty() ? "" : " of " + structure,
                   accepted < design::Fitness::unverified ? " that meets its constraints" : ""));
      }
      const auto name = best->at("structure").get<std::string>();
      const Json& design = best->at("design");
      return {name == design::state_space_name
                  ? state_space_of(antenna, path, text)
                  : controller_from_design(antenna, path, design, name),
              name, best->at("tuned_for").get<std::string>()};
    }
    if (report.contains("tuning")) {
      const Json& design = report.at("tuning").at("design");
      const auto name = design.at("structure").get<std::string>();
      const bool asked = structure == design::state_space_name;
      if (asked && !has_state_space(report)) refuse(path, fmt::format("only one of {}", name));
      if (has_state_space(report) && (structure.empty() || asked)) {
        return {state_space_of(antenna, path, text), std::string(design::state_space_name), ""};
      }
      if (!structure.empty() &&
          loop_structure(antenna, structure) != structure_named(antenna, name)) {
        refuse(path, fmt::format("only one of {}", name));
      }
      return {controller_from_design(antenna, path, design, name),
              structure.empty() ? name : structure, ""};
    }
    refuse(path, "neither 'tuned' nor 'tuning'");
  } catch (const nlohmann::json::exception& error) {
    refuse(path, fmt::format("something else ({})", error.what()));
  }
}

}  // namespace boresight::io
