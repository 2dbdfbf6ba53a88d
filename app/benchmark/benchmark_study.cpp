#include <utility>

#include <fmt/format.h>

#include <boresight/app/benchmark/benchmark_report.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {
namespace {

using design::NoTimeDomain;

std::string attitudes_text(const design::BenchmarkStudy& study) {
  if (study.attitudes == 0) {
    return fmt::format(
        "one torque coefficient of {:g} for every attitude: the case has no table over yaw and "
        "elevation",
        study.wind.site.torque_coefficient);
  }
  return fmt::format("{} attitudes of the case's table of torque coefficients, and the case's own",
                     study.attitudes);
}

std::string reason_text(NoTimeDomain reason) {
  switch (reason) {
    case NoTimeDomain::none:
      break;
    case NoTimeDomain::unstable:
      return "the linear loop is unstable";
    case NoTimeDomain::interrupted:
      return "interrupted";
    case NoTimeDomain::state_space:
      return "a given state space states no limits and anti-windup to simulate";
    case NoTimeDomain::linear_only:
      return "the case has no [simulation]";
  }
  return "";
}

}  // namespace

BenchmarkReport benchmark(const io::DesignedAntenna& designed,
                          const design::BenchmarkedController& controller,
                          const std::vector<std::string>& remarks,
                          const design::BenchmarkOptions& options) {
  const io::Case& antenna = designed.antenna;
  BenchmarkReport report;
  static_cast<design::BenchmarkStudy&>(report) =
      study_rejection(designed.mission, designed.ensemble.members, controller, options);
  report.case_path = antenna.path;
  report.title = antenna.title;
  report.axis = io::pointing_axis(antenna);
  report.seed = options.seed;
  report.remarks = remarks;
  report.from_records = designed.from_records;
  report.ensemble_source = to_string(designed.ensemble.source);
  if (report.samples_otherwise()) {
    report.remarks.push_back(fmt::format(
        "warning: the controller samples every {:g} s, the case's delay of {:g} s implies {:g} s "
        "(one and a half samples); the controller's own is used, with one sample of computation",
        controller.system.sample_time, designed.mission.antenna.dead_time,
        report.expected_sample_time));
  }
  report.attitudes_text = attitudes_text(report);
  report.no_time_domain = reason_text(report.no_nonlinear);
  report.time_domain = section_of(antenna, std::move(report.nonlinear));
  report.assumed = assumed_inputs(antenna, {.time_runs = report.time_domain.has_value()});
  return report;
}

}  // namespace boresight::app
