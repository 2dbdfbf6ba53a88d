#include <algorithm>

#include <boresight/app/figures/figure_description.hpp>
#include <boresight/app/report/common_description.hpp>
#include <boresight/app/report/json_writer.hpp>
#include <boresight/app/simulate/simulation_report.hpp>

namespace boresight::app {
namespace {

namespace unit = io::key_units;

constexpr io::NumberForm known{.finite = true};
constexpr io::NumberForm known_positive{.minimum = 0.0, .finite = true};
constexpr io::NumberForm positive{.minimum = 0.0};

void describe_starts(io::Visitor& v, const std::vector<plant::SlidingStart>& all) {
  constexpr std::size_t listed = 1000;
  const std::vector<plant::SlidingStart> first(
      all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(listed, all.size())));
  v.count("sliding_start_count", all.size(), "Times the motor broke away from standstill.");
  v.list(
      "sliding_starts", first,
      "The first thousand of them, in order: after at least 0.1 s below a tenth of the friction "
      "curve's stribeck_rate, once the motor has turned by four times what the bristles bend at "
      "breakaway.",
      [&](const plant::SlidingStart& start) {
        v.number("time", start.time, unit::second, "When.", known_positive);
        v.word("direction", start.upward ? "up" : "down", {"up", "down"}, "Of the motion.");
        v.number("rate", start.rate, unit::radian_per_second, "Of the motor, in that direction.",
                 known_positive);
        v.number("friction", start.friction, unit::newton_metre,
                 "All motors, against the motion, without gravity's offset.", known);
        v.number("motor_torque", start.motor_torque, unit::newton_metre,
                 "All motors, signed, offset and inertia included, as pressures show it.", known);
        v.flag(
            "shows_breakaway", start.shows_breakaway,
            "The rate is at most the curve's stribeck_rate, so friction is still near breakaway.");
      },
      {.maximum = listed});
}

void describe_sampled(io::Visitor& v, std::string_view key, const plant::SampledEvent& event,
                      std::string_view meaning) {
  v.group(key, meaning, [&] {
    v.defined_as("sampled_event", "Samples at which the condition was true.");
    v.number("first", event.first, unit::second, "The first; null if there is none.", positive);
    v.count("samples", event.samples, "How many.");
    v.number("fraction", event.fraction, unit::ratio, "Of all.", known_positive);
  });
}

void describe_events(io::Visitor& v, const plant::RunEvents& events) {
  v.group("events", "What happened.", [&] {
    v.defined_as("events", "Events at the samples of the true motion; shorter ones are missed.");
    describe_starts(v, events.sliding_starts);
    describe_sampled(v, "command_limit", events.command_limit,
                     "Valve command at or beyond the stroke.");
    describe_sampled(v, "stroke_limit", events.stroke_limit, "The valve's port fully open.");
    describe_sampled(v, "slew_limit", events.slew_limit,
                     "The spool within 1 % of its largest speed from one sample to the next.");
    describe_sampled(v, "contact_lost", events.contact_lost,
                     "One half of the gear train off its flank.");
    v.count("contact_losses", events.contact_losses, "How often that began.");
    describe_sampled(v, "below_makeup", events.below_makeup,
                     "Pressure at some motor's port below that of the make-up valves.");
    describe_sampled(v, "below_zero", events.below_zero,
                     "The same below 0: oil would cavitate there, the model's does not.");
    v.number("lowest_pressure", events.lowest_pressure, unit::pascal,
             "At any motor's port; null without lines.");
    v.number("highest_pressure", events.highest_pressure, unit::pascal,
             "The same. The model has no relief valves.");
    const auto& work = events.integrator;
    v.group("integrator", "Work done.", [&] {
      v.count("steps", work.steps, "Accepted.");
      v.count("rejected", work.rejected, "Taken again shorter.");
      v.count("newton_iterations", work.newton_iterations, "Of the implicit steps.");
      v.count("halvings_of_interval", work.finest_rung,
              "The shortest step was the interval over 2 to this power.");
    });
  });
}

void describe_drive(io::Visitor& v, const DriveTestSection& record) {
  v.text("test", record.test, "Name, of its record too.");
  v.text("description", record.description, "What was done.");
  v.flag("complete", record.complete, "Not interrupted.");
  v.number("duration", record.duration, unit::second, "Simulated.", known_positive);
  v.number("sample_time", record.sample_time, unit::second, "Of the record.", known_positive);
  v.number("largest_rate", record.largest_rate, unit::radian_per_second, "Of the motor.",
           known_positive);
  v.number("largest_torque", record.largest_torque, unit::newton_metre, "All motors.",
           known_positive);
  v.number("friction_near_rest", record.static_friction, unit::newton_metre,
           "Largest friction without gravity's offset below 0.02 rad/s of motor.", known_positive);
  v.number("curve_breakaway", record.curve_breakaway, unit::newton_metre,
           "Breakaway torque of the case's friction curve.", known_positive);
  v.number("tachometer_at_limit", record.at_limit, unit::ratio,
           "Fraction of samples at the recorder's limit.", known_positive);
  v.list("clipped_channels", record.clipped, "Channels that left the recorder's range.",
         [&](const design::ClippedChannel& channel) {
           v.text("channel", channel.name, "Its name in the record.");
           v.count("samples", channel.samples, "At either end of the range.");
           v.number("first", channel.first, unit::second, "The first of them.", known_positive);
         });
  describe_events(v, record.events);
}

void describe_position(io::Visitor& v, const PositionTestSection& record) {
  v.text("test", record.test, "Name, of its record too.");
  v.text("description", record.description, "What was done.");
  v.flag("complete", record.complete, "Not interrupted.");
  v.number("duration", record.duration, unit::second, "Simulated.", known_positive);
  v.number("sample_time", record.sample_time, unit::second, "Of the record.", known_positive);
  v.number("boresight_rms", record.boresight_rms, unit::millidegree,
           "About the mean, once settled.", positive);
  v.number("boresight_mean", record.boresight_mean, unit::millidegree,
           "Static deflection in the mean wind.");
  v.number("encoder_rms", record.encoder_rms, unit::millidegree, "As boresight_rms_mdeg.",
           positive);
  v.number("predicted_rms", record.predicted_rms, unit::millidegree,
           "Linear prediction of the boresight rms in the same wind.", positive);
  v.number("settling_time", record.settling_time, unit::second,
           "From the end of a slew's command until the encoder stays within a millidegree.",
           positive);
  v.number("overshoot", record.overshoot, unit::millidegree,
           "Largest encoder error after that end.", positive);
  describe_events(v, record.events);
}

}  // namespace

void describe(io::Visitor& v, const SimulationReport& report) {
  describe_origin(v, "simulate");
  describe_case(v, report.case_path, report.title, report.axis);
  v.count("seed", report.seed, "Of all samples.");
  v.flag("interrupted", report.interrupted,
         "The user stopped the work: the last record ends where the run did.");
  v.optional_group("failure", report.failure.empty() ? std::nullopt : std::optional(report.failure),
                   "What ended the work; null if nothing did.", [&](const std::string& failure) {
                     v.text("test", report.failed_test, "In which it was.");
                     v.text("message", failure, "As on the terminal.");
                   });
  v.texts("not_run", report.not_run, "Tests that were asked for after that.");
  v.list("drive_tests", report.drive, "Tests of the drive, true values at the motor shaft.",
         [&](const DriveTestSection& record) { describe_drive(v, record); });
  v.list("position_tests", report.position, "Runs of the tuned position loop, at the sky.",
         [&](const PositionTestSection& record) { describe_position(v, record); });
  v.texts("records", report.written, "Files written.");
  describe_assumed(v, report.assumed);
  describe_figures(v, report.figures);
  describe_renamed_keys(v);
}

std::string to_json(const SimulationReport& report) {
  return json_of(report).dump(2) + "\n";
}

}  // namespace boresight::app
