#include <algorithm>
#include <iterator>

#include <boresight/app/figures/campaign_figures.hpp>
#include <boresight/app/figures/error_budget_figures.hpp>
#include <boresight/app/figures/evaluate_figures.hpp>
#include <boresight/app/figures/inertia_figures.hpp>
#include <boresight/app/figures/match_figures.hpp>
#include <boresight/app/figures/plant_figures.hpp>
#include <boresight/app/figures/report_figures.hpp>
#include <boresight/app/figures/time_domain_figures.hpp>
#include <boresight/app/figures/tune_figures.hpp>
#include <boresight/app/figures/tuning_figures.hpp>

namespace boresight::app {

namespace {

// Mass properties alone are among the campaign's methods already.
bool rests_on_tests(const IdentificationSection& section) {
  return std::ranges::any_of(section.inertia.methods, [](const auto& method) {
    return method.kind != identification::MethodKind::mass_properties;
  });
}

}  // namespace

std::vector<Figure> report_figures(const Report& report) {
  std::vector<Figure> figures;
  const auto add = [&](std::vector<Figure> some) {
    figures.insert(figures.end(), std::make_move_iterator(some.begin()),
                   std::make_move_iterator(some.end()));
  };
  if (report.campaign) add(campaign_figures(*report.campaign));
  if (report.identification && (!report.campaign || rests_on_tests(*report.identification))) {
    add(inertia_figures(*report.identification));
    add(uncertainty_figures(*report.identification));
  }
  if (report.plant) add(plant_figures(*report.plant));
  if (report.tuning) add(tuning_figures(*report.tuning, report.time_domain));
  if (report.tuned) add(tune_figures(*report.tuned, report.time_domain));
  if (report.time_domain) {
    add(time_domain_figures(*report.time_domain, "In the time domain, on the nonlinear antenna: " +
                                                     report.time_domain->controller));
  }
  if (report.limit) add(limit_figures(*report.limit));
  if (!report.interpretations.empty()) add(interpretations_figures(report.interpretations));
  if (report.matching) add(matching_figures(*report.matching));
  if (report.matched) add(match_figures(*report.matched));
  if (report.evaluated) add(evaluate_figures(*report.evaluated));
  return figures;
}

}  // namespace boresight::app
