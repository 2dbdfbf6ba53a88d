#include <algorithm>
#include <map>

#include <fmt/format.h>

#include <boresight/app/benchmark/benchmark_report.hpp>
#include <boresight/app/report/json_writer.hpp>
#include <boresight/io/files/renamed_keys.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using Json = nlohmann::ordered_json;

// Every number of a score by its place; things of a list by the first text they hold.
void flatten(const Json& json, const std::string& place, std::vector<std::string>& order,
             std::map<std::string, double>& numbers) {
  if (json.is_number()) {
    if (numbers.emplace(place, json.get<double>()).second) order.push_back(place);
  } else if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      flatten(value, place.empty() ? key : fmt::format("{}.{}", place, key), order, numbers);
    }
  } else if (json.is_array()) {
    std::size_t index = 0;
    for (const auto& value : json) {
      std::string name = fmt::format("{}", ++index);
      if (value.is_object()) {
        for (const auto& [key, inner] : value.items()) {
          if (!inner.is_string()) continue;
          name = inner.get<std::string>();
          break;
        }
      }
      flatten(value, fmt::format("{}[{}]", place, name), order, numbers);
    }
  }
}

ComparedSheet sheet_of(const Json& score, std::string_view wind_model) {
  ComparedSheet sheet;
  for (const auto& point : score.value("compliance_curve", Json::array())) {
    if (!point.at("compliance_mdeg_per_MN_m").is_number()) continue;
    sheet.frequency.push_back(point.at("frequency_Hz").get<double>());
    sheet.compliance.push_back(point.at("compliance_mdeg_per_MN_m").get<double>());
  }
  for (const auto& wind : score.value("winds", Json::array())) {
    const double speed = wind.at("mean_speed_m_per_s").get<double>();
    // The case's own coefficient: conditions of an attitude say more behind the speed.
    const bool own = wind.at("condition") == fmt::format("{}, {:g} m/s", wind_model, speed);
    if (!own || !wind.at("boresight_rms_mdeg").is_number()) continue;
    sheet.wind_speed.push_back(speed);
    sheet.boresight_rms.push_back(wind.at("boresight_rms_mdeg").get<double>());
  }
  return sheet;
}

}  // namespace

void compare_with(BenchmarkReport& report, const std::string& other_json, const std::string& name) {
  Json other;
  try {
    other = Json::parse(other_json);
    io::use_present_keys(other, name);
    if (other.at("command") != "benchmark") throw InvalidInput("another command");
    const auto protocol = other.at("protocol_version").get<long long>();
    if (protocol != design::rejection_protocol) {
      throw InvalidInput(fmt::format(
          "{}: expected a score sheet of protocol {}, found protocol {}: scores of different "
          "protocols do not compare",
          name, design::rejection_protocol, protocol));
    }
    if (!other.at("score").is_object()) {
      throw InvalidInput(
          fmt::format("{}: expected a score, found none: its loop is unstable", name));
    }
    report.compared_with =
        fmt::format("{}: {}, {}", name, other.at("case").at("title").get<std::string>(),
                    other.at("controller").at("description").get<std::string>());
    if (other.at("conditions").at("plant_from_records").get<bool>() != report.from_records) {
      report.compared_with += report.from_records
                                  ? "; its plant is the one that its case states"
                                  : "; its plant is the one that its case's records show";
    }
    report.compared_sheet = sheet_of(other.at("score"), plant::to_string(report.wind.model));
  } catch (const Json::exception&) {
    throw InvalidInput(
        fmt::format("{}: expected a score sheet (JSON of boresight benchmark), found none", name));
  } catch (const InvalidInput& error) {
    if (std::string(error.what()) != "another command") throw;
    throw InvalidInput(fmt::format(
        "{}: expected a score sheet (JSON of boresight benchmark), found a report of another "
        "command",
        name));
  }
  JsonWriter own_score;
  if (report.score.stable) describe_score(own_score, report);
  std::vector<std::string> order;
  std::map<std::string, double> own, theirs;
  flatten(own_score.take(), "", order, own);
  flatten(other.at("score"), "", order, theirs);
  report.comparison.clear();
  const auto value = [](const std::map<std::string, double>& from, const std::string& place) {
    const auto found = from.find(place);
    return found == from.end() ? std::nullopt : std::optional(found->second);
  };
  for (const auto& place : order) {
    const bool seen = std::ranges::find(report.comparison, place, &ComparedQuantity::quantity) !=
                      report.comparison.end();
    if (seen || place.starts_with("compliance_curve") || place.starts_with("ensemble.members")) {
      continue;
    }
    report.comparison.push_back({place, value(own, place), value(theirs, place)});
  }
}

}  // namespace boresight::app
