#include <algorithm>
#include <fstream>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <boresight/app/io/input_files.hpp>
#include <boresight/app/montecarlo/held_law.hpp>
#include <boresight/app/tune/engineer_units.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::app {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const std::string& path, const std::string& found) {
  throw InvalidInput(
      fmt::format("{}: expected a report of `boresight tune` or `redesign` in JSON with a law, "
                  "found {}",
                  path, found));
}

// The gains of a "design": numbers whose keys are the gains' names with blanks replaced and the
// unit behind.
control::ControlLaw read_law(const Case& antenna, const std::string& path, const Json& design,
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

control::LoopStructure structure_named(const Case& antenna, const std::string& name) {
  for (const auto& law : present_laws(antenna)) {
    if (law.structure.name() == name) return law.structure;
  }
  for (const auto* base : {"PI-0", "PI", "DPF", "LL", "FULL"}) {
    for (const auto* added : {"", "+N", "+C", "+N+C"}) {
      auto structure = loop_structure(antenna, std::string(base) + added);
      if (structure.name() == name) return structure;
    }
  }
  return loop_structure(antenna, name);
}

HeldLaw present_law(const Case& antenna, const std::string& structure) {
  for (const auto& law : present_laws(antenna)) {
    if (structure.empty() || law.structure == loop_structure(antenna, structure)) {
      return {law, structure.empty() ? law.structure.name() : structure,
              "the gains that the case says the antenna runs on"};
    }
  }
  throw InvalidInput(
      fmt::format("--gains case: expected [gains] in the case{}, found none",
                  structure.empty() ? "" : fmt::format(" of the structure {}", structure)));
}

HeldLaw law_of_report(const Case& antenna, const std::string& path, const std::string& structure) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) refuse(path, "no file that can be read");
  note_input(path, text);
  try {
    const Json report = Json::parse(text);
    if (report.contains("tuned")) {
      const Json* best = nullptr;
      const auto rank = [](const Json& row) {
        const Json& rms = row.at("beam_rms_mdeg");
        return std::tuple(
            row.value("recommended", false) ? 0 : 1, row.at("tuned_for") == "robust" ? 0 : 1,
            row.at("goals_met").get<bool>() ? 0 : 1, rms.is_number() ? rms.get<double>() : 1e300);
      };
      for (const auto& row : report.at("tuned").at("laws")) {
        if (row.at("design").is_null() || row.at("tuned_for") == "present") continue;
        if (!structure.empty() && row.at("structure") != structure) continue;
        if (best == nullptr || rank(row) < rank(*best)) best = &row;
      }
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
          loop_structure(antenna, structure) != structure_named(antenna, name)) {
        refuse(path, fmt::format("only one of {}", name));
      }
      return {read_law(antenna, path, design, name), structure.empty() ? name : structure, path};
    }
    refuse(path, "neither 'tuned' nor 'tuning'");
  } catch (const nlohmann::json::exception& error) {
    refuse(path, fmt::format("something else ({})", error.what()));
  }
}

std::optional<HeldLaw> named_law(const Case& antenna, const std::string& gains,
                                 const std::string& structure) {
  if (gains == "tuned") return std::nullopt;
  return gains == "case" ? present_law(antenna, structure)
                         : law_of_report(antenna, gains, structure);
}

HeldLaw tuned_law(const Case& antenna, const PlantEnsemble& ensemble, const std::string& structure,
                  std::uint64_t seed, unsigned threads, const std::function<bool()>& interrupted) {
  TuneOptions options;
  options.structures = {structure};
  options.wind_speeds = {antenna.wind.design_speed.value};
  options.seed = seed;
  options.threads = threads;
  options.interrupted = interrupted;
  const TuneSection section = tune_structures(antenna, ensemble, options);
  if (interrupted && interrupted()) throw Interrupted("interrupted while tuning the law to hold");
  const TunedLaw* best = nullptr;
  for (const auto& row : section.laws) {
    if (row.tuned_for == TunedFor::robust && row.stable() &&
        row.wind_speed == options.wind_speeds.front()) {
      best = &row;
    }
  }
  if (best == nullptr) {
    throw InfeasibleRequirement(
        fmt::format("montecarlo: no law of {} keeps every plant of the ensemble stable; name "
                    "another with --structure or gains with --gains",
                    structure));
  }
  return {best->design.tuning.law, structure,
          fmt::format("tuned now at {:g} m/s, robust over {} plants{}", best->wind_speed,
                      ensemble.members.size(),
                      best->goals_met ? "" : "; MISSES its goals on some of them")};
}

}  // namespace boresight::app
