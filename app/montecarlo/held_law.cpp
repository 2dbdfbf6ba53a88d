#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <boresight/app/montecarlo/held_law.hpp>
#include <boresight/app/tune/engineer_units.hpp>
#include <boresight/app/tune/tuned_assessment.hpp>
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
  for (const auto& law : present_laws(antenna)) {
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

HeldLaw present_law(const io::Case& antenna, const std::string& structure) {
  for (const auto& law : present_laws(antenna)) {
    if (structure.empty() || law.structure == io::loop_structure(antenna, structure)) {
      return {law, structure.empty() ? law.structure.name() : structure,
              "the gains that the case says the antenna runs on"};
    }
  }
  throw InvalidInput(
      fmt::format("--gains case: expected [gains] in the case{}, found none",
                  structure.empty() ? "" : fmt::format(" of the structure {}", structure)));
}

HeldLaw law_of_report(const io::Case& antenna, const std::string& path,
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

std::optional<HeldLaw> named_law(const io::Case& antenna, const std::string& gains,
                                 const std::string& structure) {
  if (gains == "tuned") return std::nullopt;
  return gains == "case" ? present_law(antenna, structure)
                         : law_of_report(antenna, gains, structure);
}

HeldLaw tuned_law(const io::Case& antenna, const PlantEnsemble& ensemble,
                  const std::string& structure, std::uint64_t seed, unsigned threads,
                  const std::function<bool()>& interrupted) {
  TuneOptions options;
  options.structures = {structure};
  options.wind_speeds = {antenna.wind.design_speed.value};
  options.seed = seed;
  options.threads = threads;
  options.interrupted = interrupted;
  const TuneSection section = tune_structures(antenna, ensemble, options);
  if (interrupted && interrupted()) throw Interrupted("interrupted while tuning the law to hold");
  const TunedLaw* best =
      recommended_at(section, options.wind_speeds.front(), true, {.accepted = usable});
  if (best == nullptr) {
    throw InfeasibleRequirement(
        fmt::format("montecarlo: no law of {} keeps the antenna stable; name "
                    "another with --structure or gains with --gains",
                    structure));
  }
  return {best->design.tuning.law, structure,
          best->tuned_for == TunedFor::nominal
              ? fmt::format("tuned now at {:g} m/s, for the nominal plant: no robust design meets "
                            "its goals on all {} plants",
                            best->wind_speed, ensemble.members.size())
              : fmt::format("tuned now at {:g} m/s, robust over {} plants{}", best->wind_speed,
                            ensemble.members.size(),
                            best->goals_met ? "" : "; MISSES its goals on some of them")};
}

}  // namespace boresight::app
