#include <fmt/format.h>

#include <boresight/app/benchmark/benchmark_report.hpp>
#include <boresight/app/commission/commission_study.hpp>
#include <boresight/app/figures/figure_description.hpp>
#include <boresight/app/montecarlo/montecarlo_study.hpp>
#include <boresight/app/report/audit_description.hpp>
#include <boresight/app/report/common_description.hpp>
#include <boresight/app/report/identification_description.hpp>
#include <boresight/app/report/linear_models_description.hpp>
#include <boresight/app/report/match_report.hpp>
#include <boresight/app/report/measured_report.hpp>
#include <boresight/app/report/redesign_description.hpp>
#include <boresight/app/report/report_schemas.hpp>
#include <boresight/app/report/schema_writer.hpp>
#include <boresight/app/report/tune_description.hpp>
#include <boresight/app/simulate/simulation_report.hpp>
#include <boresight/io/campaign/campaign_description.hpp>
#include <boresight/io/case/field.hpp>
#include <boresight/io/description/design_results.hpp>
#include <boresight/io/description/pointing_limit_results.hpp>
#include <boresight/io/description/time_domain_results.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/report_schema_base.hpp>

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

// The parts of the report of redesign and its parts that are described, each defined by its name.
struct DescribedParts {};

void describe(io::Visitor& v, const DescribedParts& /*parts*/) {
  v.object("design", design::Design{}, "");
  v.object("ensemble", design::EnsembleResult{}, "");
  v.object("audit", AuditReport{}, "");
  v.object("campaign", io::CampaignSection{}, "");
  v.object("identification", IdentificationSection{}, "");
  v.object("plant", PlantSection{}, "");
  v.object("measured_tuning", MeasuredTuneSection{}, "");
  v.object("limit", design::PointingLimit{}, "");
  v.object("matched", MatchSection{}, "");
  v.object("tuning", TuningSection{}, "");
  v.object("tuned", TuneSection{}, "");
  v.object("time_domain", design::TimeDomainStudy{}, "");
  v.object("compared_run", design::NonlinearVerification{}, "");
  v.object("linear_models", LinearModels{}, "");
  describe_figures(v, {});
}

// Members of the report itself; what they refer to is among the parts.
Json described_members() {
  SchemaWriter writer;
  describe_case(writer, {}, {}, {});
  describe_choices(writer, {});
  describe_matching(writer, {});
  describe_assumed(writer, {});
  return writer.take().at("properties");
}

Json report_schema_with_parts() {
  SchemaWriter writer;
  describe(writer, DescribedParts{});
  Json schema = Json::parse(report_schema_base);
  schema["properties"].update(described_members());
  schema["$defs"].update(writer.take().at("$defs"));
  // A law's models are there together.
  schema["$defs"]["linear_models"]["dependentRequired"] = {
      {"law", {"dead_time_s", "controller", "sampled_controller"}}};
  return schema;
}

Json schema_named(std::string_view name) {
  if (name == "benchmark") {
    return schema_of<BenchmarkReport>({"Boresight benchmark score sheet", schema_comment,
                                       "Score sheet of boresight benchmark (--json). Definitions: "
                                       "docs/benchmark-protocol.md."});
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
  if (name == "report") return report_schema_with_parts();
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
  static const std::vector<std::string_view> names{"benchmark", "commission", "montecarlo",
                                                   "report", "simulation"};
  return names;
}

std::string report_schema(std::string_view name) {
  return schema_named(name).dump(1) + "\n";
}

}  // namespace boresight::app
