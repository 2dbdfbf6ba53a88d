#include <array>
#include <optional>
#include <string_view>

#include <boresight/app/figures/figure_description.hpp>
#include <boresight/app/report/audit_description.hpp>
#include <boresight/app/report/common_description.hpp>
#include <boresight/app/report/evaluate_report.hpp>
#include <boresight/app/report/identification_description.hpp>
#include <boresight/app/report/linear_models_description.hpp>
#include <boresight/app/report/match_report.hpp>
#include <boresight/app/report/measured_report.hpp>
#include <boresight/app/report/redesign_card.hpp>
#include <boresight/app/report/redesign_description.hpp>
#include <boresight/app/report/report_description.hpp>
#include <boresight/app/report/tune_description.hpp>
#include <boresight/io/campaign/campaign_description.hpp>
#include <boresight/io/description/pointing_limit_results.hpp>
#include <boresight/io/description/state_space_results.hpp>
#include <boresight/io/description/time_domain_results.hpp>

namespace boresight::app {
namespace {

constexpr std::array<std::string_view, 7> commands{"redesign", "audit", "identify", "model",
                                                   "tune",     "match", "evaluate"};

// A section that not every report has.
template <typename Section>
void describe_section(io::Visitor& v, std::string_view key, const std::optional<Section>& section,
                      std::string_view meaning) {
  v.optional_members(section, [&](const Section& there) { v.object(key, there, meaning); });
}

}  // namespace

void describe(io::Visitor& v, const Report& report) {
  describe_origin(v, report.command, commands);
  describe_case(v, report.case_path, report.title, report.axis);
  v.count("seed", report.seed, "First seed of searches and samples.");
  v.flag("interrupted", report.interrupted,
         "The user stopped the work: the sections here are whole, others are missing.");
  const auto card = redesign_card(report);
  v.members_if(!card.empty(), [&] {
    v.list("card", card,
           "The result of a redesign on one screen; its figures are those of the "
           "sections.",
           [&](const CardLine& line) {
             v.text("label", line.label, "What the line is about.");
             v.text("text", line.text, "The line.");
             v.text("evidence", line.evidence, "How the heading of its section begins.");
           });
  });
  describe_section(v, "campaign", report.campaign, "What the records of the case say.");
  describe_section(v, "identification", report.identification, "Inertia by several methods.");
  describe_section(v, "audit", report.audit, "Numbers of the case against one another.");
  describe_section(v, "plant", report.plant, "The linear plant.");
  describe_section(v, "tuning", report.tuning, "The controller recommended, at depth.");
  describe_section(v, "measured_tuning", report.measured, "On measured responses.");
  describe_section(v, "tuned", report.tuned, "The structures compared.");
  describe_section(v, "time_domain", report.time_domain, "On the nonlinear antenna.");
  describe_section(v, "limit", report.limit, "What no controller can point better than.");
  describe_section(v, "state_space", report.state_space, "A controller without loops.");
  v.members_if(!report.interpretations.empty(),
               [&] { describe_interpretations(v, report.interpretations); });
  v.optional_members(report.matching,
                     [&](const MatchingSection& matching) { describe_matching(v, matching); });
  describe_section(v, "matched", report.matched, "Motor inertias compared.");
  describe_section(v, "evaluated", report.evaluated, "Proposals compared.");
  describe_section(v, "linear_models", linear_models(report), "State spaces.");
  describe_superseded(v, report.superseded);
  describe_assumed(v, report.assumed);
  v.texts("conclusions", report.conclusions, "What the numbers mean, in sentences.");
  v.members_if(!report.figures.empty(), [&] { describe_figures(v, report.figures); });
  describe_renamed_keys(v);
}

}  // namespace boresight::app
