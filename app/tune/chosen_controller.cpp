#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <boresight/app/tune/chosen_controller.hpp>
#include <boresight/app/tune/tune_section.hpp>
#include <boresight/io/case/present_gains.hpp>
#include <boresight/io/exchange/reported_controller.hpp>
#include <boresight/io/files/input_files.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using Json = nlohmann::ordered_json;

// What is held on samples may miss its goals.
constexpr auto usable = design::Fitness::unverified;

[[noreturn]] void refuse(const std::string& path, const std::string& found) {
  throw InvalidInput(
      fmt::format("{}: expected a report of `boresight tune` or `redesign` in JSON with a law, "
                  "found {}",
                  path, found));
}

// The gains of a "design": numbers whose keys are the gains' names with blanks replaced and the
// unit behind.
control::ControlLaw read_law(const io::Case& antenna, const std::string& path, const Json& design,
                             const std::string& structure) {
  control::ControlLaw law{structure_named(antenna, structure), {}};
  const Json gains = design.value("gains", Json::object());
  for (const auto& description : law.structure.gains()) {
    std::string key = description.name;
    std::ranges::replace(key, ' ', '_');
    const auto found = std::ranges::find_if(
        gains.items(), [&](const auto& item) { return item.key().starts_with(key + "_"); });
    if (found == gains.items().end() || !found.value().is_number()) {
      refuse(path, fmt::format("no gain '{}' of {}", description.name, structure));
    }
    law.gains.push_back(found.value().template get<double>());
  }
  control::validate(law);
  return law;
}

}  // namespace

control::LoopStructure structure_named(const io::Case& antenna, const std::string& name) {
  for (const auto& [short_name, law] : present_controllers(antenna)) {
    if (law.structure.name() == name) return law.structure;
  }
  for (const auto* base : {"PI-0", "PI", "DPF", "LL", "FULL"}) {
    for (const auto* added : {"", "+N", "+C", "+N+C"}) {
      auto structure = io::loop_structure(antenna, std::string(base) + added);
      if (structure.name() == name) return structure;
    }
  }
  return io::loop_structure(antenna, name);
}

ChosenController present_controller(const io::Case& antenna, const std::string& structure) {
  for (const auto& [name, law] : present_controllers(antenna)) {
    if (structure.empty() || law.structure == io::loop_structure(antenna, structure)) {
      return {law, structure.empty() ? law.structure.name() : structure,
              "the gains that the case says the antenna runs on"};
    }
  }
  throw InvalidInput(
      fmt::format("--gains case: expected [gains] in the case{}, found none",
                  structure.empty() ? "" : fmt::format(" of the structure {}", structure)));
}

ChosenController controller_of_report(const io::Case& antenna, const std::string& path,
                                      const std::string& structure) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) refuse(path, "no file that can be read");
  io::note_input(path, text);
  try {
    const Json report = Json::parse(text);
    if (report.contains("tuned")) {
      const Json* best = io::recommended_row(report.at("tuned").at("laws"), structure, usable);
      if (best == nullptr) {
        refuse(path, structure.empty() ? "none" : fmt::format("none of {}", structure));
      }
      const auto name = best->at("structure").get<std::string>();
      return {read_law(antenna, path, best->at("design"), name), name,
              fmt::format("{}, tuned {}", path, best->at("tuned_for").get<std::string>())};
    }
    if (report.contains("tuning")) {
      const Json& design = report.at("tuning").at("design");
      const auto name = design.at("structure").get<std::string>();
      if (!structure.empty() &&
          io::loop_structure(antenna, structure) != structure_named(antenna, name)) {
        refuse(path, fmt::format("only one of {}", name));
      }
      return {read_law(antenna, path, design, name), structure.empty() ? name : structure, path};
    }
    refuse(path, "neither 'tuned' nor 'tuning'");
  } catch (const nlohmann::json::exception& error) {
    refuse(path, fmt::format("something else ({})", error.what()));
  }
}

std::optional<ChosenController> named_controller(const io::Case& antenna, const std::string& gains,
                                                 const std::string& structure) {
  if (gains == "tuned") return std::nullopt;
  return gains == "case" ? present_controller(antenna, structure)
                         : controller_of_report(antenna, gains, structure);
}

ChosenController recommended_controller(const io::DesignedAntenna& designed,
                                        const design::TuneOptions& options) {
  const auto study = study_controllers(designed.mission, designed.ensemble, options);
  if (options.interrupted && options.interrupted()) {
    throw Interrupted("interrupted while tuning the controller");
  }
  const TunedLaw* best = recommended_or(study, usable);
  if (best == nullptr) {
    throw InfeasibleRequirement(
        fmt::format("{}: no controller of {} keeps the antenna stable; name other structures with "
                    "--structure or gains with --gains",
                    designed.antenna.path, fmt::join(study.tuned.structures, ", ")));
  }
  return {best->design.tuning.law, best->structure,
          best->tuned_for == TunedFor::nominal
              ? fmt::format("tuned now at {:g} m/s, for the nominal plant: no robust design meets "
                            "its goals on all {} plants",
                            best->wind_speed, designed.ensemble.members.size())
              : fmt::format("tuned now at {:g} m/s, robust over {} plants{}", best->wind_speed,
                            designed.ensemble.members.size(),
                            best->goals_met ? "" : "; MISSES its goals on some of them")};
}

}  // namespace boresight::app
