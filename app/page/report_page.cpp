#include <optional>
#include <utility>

#include <boresight/app/montecarlo/montecarlo_study.hpp>
#include <boresight/app/page/gains_to_load.hpp>
#include <boresight/app/page/report_page.hpp>
#include <boresight/app/report/axis_wording.hpp>
#include <boresight/app/report/decision.hpp>
#include <boresight/app/report/json_writer.hpp>
#include <boresight/app/report/redesign_card.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/design/studies/adjustable_loop.hpp>
#include <boresight/design/studies/controller_study.hpp>
#include <boresight/io/description/adjustable_loop_description.hpp>
#include <boresight/io/description/what_if_description.hpp>

namespace boresight::app {
namespace {

// What all reports have.
template <class AnyReport>
Page common(const AnyReport& report, std::string command) {
  Page page;
  page.command = std::move(command);
  page.title = report.title;
  page.axis = words_beside(report.title, report.axis);
  page.seed = report.seed;
  page.decision = decision(report);
  page.document = document_of(report);
  page.figures = report.figures;
  return page;
}

// Of tune the controller it shows, of redesign the recommended one.
std::optional<design::AdjustableLoop> adjustable_loop_of(const Report& report) {
  if (report.tuning) return design::adjustable_loop(*report.tuning);
  if (!report.tuned) return std::nullopt;
  const auto* shown =
      design::shown_controller(*report.tuned, report.time_domain ? &*report.time_domain : nullptr);
  return shown != nullptr ? design::adjustable_loop(*report.tuned, *shown) : std::nullopt;
}

}  // namespace

Page page_of(const Report& report) {
  Page page = common(report, report.command);
  page.interrupted = report.interrupted;
  page.card = redesign_card(report);
  page.gains = gains_to_load(report);
  page.reservations = reservations(report);
  if (report.matched && report.matched->what_if) {
    page.what_if = json_of(*report.matched->what_if).dump();
  }
  if (const auto loop = adjustable_loop_of(report)) page.adjustable_loop = json_of(*loop).dump();
  return page;
}

Page page_of(const BenchmarkReport& report) {
  Page page = common(report, "benchmark");
  page.interrupted = report.interrupted;
  return page;
}

Page page_of(const ChangeReport& report) {
  return common(report, "benchmark");
}

Page page_of(const MonteCarloSection& section) {
  Page page = common(section, "montecarlo");
  page.interrupted = section.interrupted;
  return page;
}

Page page_of(const CommissionReport& report) {
  return common(report, "commission");
}

Page page_of(const SimulationReport& report) {
  Page page = common(report, "simulate");
  page.interrupted = report.interrupted;
  return page;
}

}  // namespace boresight::app
