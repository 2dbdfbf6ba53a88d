#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <boresight/app/benchmark/benchmark_report.hpp>
#include <boresight/app/change/change_report.hpp>
#include <boresight/app/commission/commission_study.hpp>
#include <boresight/app/montecarlo/montecarlo_study.hpp>
#include <boresight/app/report/common_description.hpp>
#include <boresight/app/report/report_description.hpp>
#include <boresight/app/report/report_schemas.hpp>
#include <boresight/app/report/schema_writer.hpp>
#include <boresight/app/simulate/simulation_report.hpp>
#include <boresight/io/case/field.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using Json = nlohmann::ordered_json;

// A plan has stages, what says why there is none has not.
Json stages_or_reason() {
  const auto stages = [](const char* bound, int count) {
    return Json{{"properties", {{"stages", {{bound, count}}}}}};
  };
  Json condition{{"if", {{"properties", {{"no_plan", {{"type", "null"}}}}}}}};
  condition["then"] = stages("minItems", 1);
  condition["else"] = stages("maxItems", 0);
  return Json::array({condition});
}

// Which sections the report of a command has: all of `required` if it ran to its end (any one of
// them where `any` is set), others of `possible`.
struct CommandSections {
  std::string_view command;
  std::vector<std::string_view> required;
  std::vector<std::string_view> possible;
  bool any = false;
};

const std::vector<CommandSections>& sections_of_commands() {
  static const std::vector<CommandSections> sections{
      {"redesign",
       {"identification", "audit", "plant", "tuning", "interpretations", "matching"},
       {"campaign", "time_domain", "linear_models", "card"}},
      {"audit", {"audit"}, {}},
      {"identify", {"identification"}, {"campaign"}},
      {"model", {"plant"}, {"linear_models"}},
      {"tune",
       {"tuned", "measured_tuning"},
       {"time_domain", "limit", "state_space", "linear_models"},
       true},
      {"match", {"matched"}, {}},
      {"evaluate", {"evaluated"}, {}}};
  return sections;
}

Json is_command(std::string_view command) {
  return {{"command", {{"const", command}}}};
}

Json report_conditions() {
  std::set<std::string_view> all;
  for (const auto& of : sections_of_commands()) {
    all.insert(of.required.begin(), of.required.end());
    all.insert(of.possible.begin(), of.possible.end());
  }
  Json conditions = Json::array();
  for (const auto& of : sections_of_commands()) {
    Json required{{"required", of.required}};
    if (of.any) {
      required = {{"anyOf", Json::array()}};
      for (const auto section : of.required) {
        required["anyOf"].push_back({{"required", Json::array({section})}});
      }
    }
    Json whole = is_command(of.command);
    whole["interrupted"] = {{"const", false}};
    conditions.push_back({{"if", {{"properties", whole}}}, {"then", required}});
    Json others;
    for (const auto section : all) {
      const auto listed = [&](const std::vector<std::string_view>& list) {
        return std::find(list.begin(), list.end(), section) != list.end();
      };
      if (!listed(of.required) && !listed(of.possible)) others[std::string(section)] = false;
    }
    conditions.push_back(
        {{"if", {{"properties", is_command(of.command)}}}, {"then", {{"properties", others}}}});
  }
  return conditions;
}

Json report_schema_with_conditions() {
  Json schema = schema_of<Report>(
      {"Boresight report", schema_comment, "Report of one command of Boresight (--json)."},
      report_conditions());
  // A controller's models are there together.
  schema["$defs"]["linear_models"]["dependentRequired"] = {
      {"controller_name", {"dead_time_s", "controller", "sampled_controller"}}};
  return schema;
}

Json schema_named(std::string_view name) {
  if (name == "benchmark") {
    return schema_of<BenchmarkReport>({"Boresight benchmark score sheet", schema_comment,
                                       "Score sheet of boresight benchmark (--json). Definitions: "
                                       "docs/benchmark-protocol.md."});
  }
  if (name == "change") {
    return schema_of<ChangeReport>({"Boresight comparison of records before and after a change",
                                    schema_comment,
                                    "Report of boresight benchmark --before --after (--json): "
                                    "docs/commissioning.md."});
  }
  if (name == "commission") {
    return schema_of<CommissionReport>(
        {"Report of boresight commission", schema_comment,
         "Report of boresight commission (--json): docs/commissioning.md."},
        stages_or_reason());
  }
  if (name == "montecarlo") {
    return schema_of<MonteCarloSection>(
        {"Report of boresight montecarlo", schema_comment,
         "Report of boresight montecarlo (--json): docs/monte-carlo.md."});
  }
  if (name == "report") return report_schema_with_conditions();
  if (name == "simulation") {
    return schema_of<SimulationReport>(
        {"Boresight simulation report", schema_comment, "Report of boresight simulate (--json)."});
  }
  throw InvalidInput(fmt::format("schema: expected one of {}, found {}{}",
                                 io::quoted_list(described_reports()), io::in_quotes(name),
                                 io::did_you_mean(name, described_reports())));
}

}  // namespace

const std::vector<std::string_view>& described_reports() {
  static const std::vector<std::string_view> names{"benchmark",  "change", "commission",
                                                   "montecarlo", "report", "simulation"};
  return names;
}

std::string report_schema(std::string_view name) {
  return schema_named(name).dump(1) + "\n";
}

}  // namespace boresight::app
