#include <algorithm>
#include <set>

#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_computer.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/case_goals.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_pointing.hpp>
#include <boresight/io/case/case_sections.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/case_statements.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/case/table_reader.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {
namespace {

void read_stated(TableReader& file, Case& antenna) {
  for (auto& entry : file.tables("stated")) {
    StatedEntry stated;
    stated.quantity = entry.text("quantity");
    const auto kind = stated_kind(stated.quantity, antenna);
    if (!kind) {
      entry.refuse("quantity",
                   "expected the id of a derived quantity or input (docs/case-file.md "
                   "lists them), found " +
                       in_quotes(stated.quantity));
    }
    stated.value = entry.quantity("value", *kind);
    entry.finish();
    antenna.stated.push_back(std::move(stated));
  }
  for (auto& entry : file.tables("remark")) {
    antenna.remarks.push_back({entry.text("place"), entry.text("text")});
    entry.finish();
  }
}

// "line.longest.slosh_frequency" is a line's name between prefix and suffix.
template <typename Entries>
bool names_one_of(const std::string& id, std::string_view prefix, std::string_view suffix,
                  const Entries& entries) {
  return std::any_of(entries.begin(), entries.end(), [&](const auto& entry) {
    return id == std::string(prefix) + entry.name + std::string(suffix);
  });
}

Case case_of(TableReader file, const std::string& path) {
  Case antenna;
  antenna.path = path;
  antenna.title = file.text("title");
  antenna.axis = file.choice("axis", {"elevation", "azimuth", "X", "Y"});
  read_antenna(file, antenna);
  read_gear_train(file, antenna);
  read_motor(file, antenna);
  read_oil(file, antenna);
  read_tests(file, antenna);
  read_drive(file, antenna);
  read_structure(file, antenna);
  read_simulation(file, antenna);
  read_sensors(file, antenna);
  read_computer(file, antenna);
  read_wind(file, antenna);
  read_pointing(file, antenna);
  read_goals(file, antenna);
  read_loops(file, antenna);
  read_ensemble(file, antenna);
  read_campaign(file, antenna);
  read_stated(file, antenna);
  antenna.quantities = file.quantities_read();
  file.finish();
  return antenna;
}

}  // namespace

std::string read_name(TableReader& entry, std::set<std::string>& names) {
  std::string name = entry.text("name");
  if (name.empty()) entry.refuse("name", "expected a name, found an empty text");
  if (!names.insert(name).second) {
    entry.refuse("name", "expected a name of its own, found " + in_quotes(name) + " again");
  }
  return name;
}

Case::Case() = default;
Case::Case(const Case& other) = default;
Case::Case(Case&& other) noexcept = default;
Case& Case::operator=(const Case& other) = default;
Case& Case::operator=(Case&& other) noexcept = default;
Case::~Case() = default;

Case read_case(const std::string& path) {
  return case_of(TableReader::open(path), path);
}

Case parse_case(std::string_view text, const std::string& path) {
  return case_of(TableReader::parse(text, path), path);
}

std::optional<Kind> stated_kind(const std::string& id, const Case& antenna) {
  static const std::set<std::string> inertias{"load_inertia",
                                              "load_inertia.antenna",
                                              "reflected_inertia",
                                              "reflected_inertia.one_train",
                                              "resonance.reflected_inertia",
                                              "motor_inertia"};
  static const std::set<std::string> numbers{"motor_to_load_ratio", "resonance.motor_to_load_ratio",
                                             "gear_ratio"};
  if (inertias.contains(id)) return Kind::inertia;
  if (numbers.contains(id)) return Kind::number;
  if (id == "oil_stiffness") return Kind::stiffness;
  if (id == "bulk_modulus") return Kind::pressure;
  if (id == "resonance.frequency") return Kind::frequency;
  if (id == "tachometer.scale") return Kind::tachometer_scale;
  if (id == "friction.slow_ramp.coulomb" || id == "friction.slow_ramp.offset") return Kind::torque;
  if (id.starts_with("load_inertia.") &&
      names_one_of(id, "load_inertia.", "", antenna.gear_train->assemblies)) {
    return Kind::inertia;
  }
  if (names_one_of(id, "line.", ".bulk_modulus", antenna.oil->lines)) return Kind::pressure;
  if (names_one_of(id, "line.", ".slosh_frequency", antenna.oil->lines)) return Kind::frequency;
  if (names_one_of(id, "line.", ".length", antenna.oil->lines)) return Kind::length;
  if (names_one_of(id, "band.", ".frequency", antenna.bands)) return Kind::frequency;
  if (names_one_of(id, "impulse.", ".reflected_inertia", antenna.impulse_results)) {
    return Kind::inertia;
  }
  if (names_one_of(id, "impulse.", ".motor_to_load_ratio", antenna.impulse_results)) {
    return Kind::number;
  }
  return std::nullopt;
}

}  // namespace boresight::io
