#include <fmt/format.h>

#include <boresight/app/simulate/simulated_tests.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/tested_drive_of.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

std::string description_of(const design::DriveTestRecord& record) {
  switch (record.kind) {
    case design::DriveTestKind::slosh:
      return "the valve opens and closes suddenly";
    case design::DriveTestKind::fast_ramp:
      return "triangle to the valve, fast enough to leave the recorder's range";
    case design::DriveTestKind::slow_ramp:
      return "slow triangle into the rate loop, through breakaway";
    case design::DriveTestKind::constant_speed:
      return fmt::format("square wave of +-{:g} V of tachometer into the rate loop",
                         record.tachometer_volts);
    case design::DriveTestKind::valve_steps:
      return "small valve steps about a constant speed";
    case design::DriveTestKind::valve_chirp:
      return "valve sine, 0.1 to 8 Hz, on a bias";
  }
  return "";
}

std::string wind_of(const design::TrackingCourse& course, const io::Case& antenna) {
  const auto model = plant::to_string(course.wind_model);
  const auto spectrum = plant::to_string(course.spectrum);
  if (!course.measured) {
    return fmt::format("wind of {:.3g} m/s ({} model, {} spectrum)", course.mean_wind_speed, model,
                       spectrum);
  }
  return fmt::format(
      "the measured wind {}, mean {:.3g} m/s, gusts {:.3g} m/s rms, sampled every "
      "{:.3g} s ({} model; the linear prediction takes its mean speed and the {} "
      "spectrum)",
      antenna.wind->record_path, course.mean_wind_speed, course.measured->rms,
      course.measured->sample_time, model, spectrum);
}

std::string slew_description(const design::SlewCourse& course, const std::string& controller) {
  std::string text =
      fmt::format("{:.3g} deg {} at up to {:.3g} deg/s and {:.2g} deg/s2", course.distance / degree,
                  controller, course.largest_rate / degree, course.acceleration / degree);
  if (course.attainable < course.wanted_rate) {
    text += fmt::format(
        "; the case's slew rate of {:.3g} deg/s is out of reach: against this friction the supply "
        "sustains at most {:.3g} deg/s",
        course.wanted_rate / degree, course.attainable / degree);
  }
  return text;
}

}  // namespace

DriveTestSection section_of(design::DriveTestRecord record) {
  std::string description = description_of(record);
  return {std::move(record), std::move(description)};
}

PositionTestSection section_of(design::PositionTestRecord record, const io::Case& antenna,
                               const std::string& source) {
  const std::string controller =
      fmt::format("by {}, {}", record.controller.structure.name(), source);
  std::string description;
  if (record.tracking) {
    description =
        fmt::format("tracking at {:.3g} mdeg/s {} in {}", record.tracking->rate / millidegree,
                    controller, wind_of(*record.tracking, antenna));
  }
  if (record.slew) description = slew_description(*record.slew, controller);
  return {std::move(record), std::move(description)};
}

design::PositionTestRecord run_position_test(const io::Case& antenna, const std::string& test,
                                             const control::Controller& controller,
                                             std::uint64_t seed,
                                             const design::RunProgress& progress) {
  io::require_simulation(antenna);
  const design::Mission mission = io::mission_of(antenna);
  if (test != "slew") return design::run_tracking(mission, controller, seed, progress);
  try {
    return design::run_slew(mission, controller, seed, progress);
  } catch (const InfeasibleRequirement& error) {
    throw InfeasibleRequirement(fmt::format("{}: {}", antenna.path, error.what()));
  }
}

}  // namespace boresight::app
