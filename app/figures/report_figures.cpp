#include <iterator>

#include <boresight/app/figures/evaluate_figures.hpp>
#include <boresight/app/figures/match_figures.hpp>
#include <boresight/app/figures/plant_figures.hpp>
#include <boresight/app/figures/report_figures.hpp>
#include <boresight/app/figures/tune_figures.hpp>
#include <boresight/app/figures/tuning_figures.hpp>

namespace boresight::app {

std::vector<Figure> report_figures(const Report& report) {
  std::vector<Figure> figures;
  const auto add = [&](std::vector<Figure> some) {
    figures.insert(figures.end(), std::make_move_iterator(some.begin()),
                   std::make_move_iterator(some.end()));
  };
  if (report.plant) add(plant_figures(*report.plant));
  if (report.tuning) add(tuning_figures(*report.tuning));
  if (report.tuned) add(tune_figures(*report.tuned, report.time_domain));
  if (report.limit) add(limit_figures(*report.limit));
  if (!report.choices.empty()) add(choices_figures(report.choices));
  if (report.matching) add(matching_figures(*report.matching));
  if (report.matched) add(match_figures(*report.matched));
  if (report.evaluated) add(evaluate_figures(*report.evaluated));
  return figures;
}

}  // namespace boresight::app
