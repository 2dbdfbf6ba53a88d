#include <boresight/app/commission/commission_study.hpp>
#include <boresight/app/figures/figure_description.hpp>
#include <boresight/app/report/common_description.hpp>
#include <boresight/app/report/json_writer.hpp>
#include <boresight/io/description/state_space_description.hpp>

namespace boresight::app {
namespace {

namespace unit = io::key_units;

using design::StageKind;

// The key names the unit of what is in the band.
void describe_band(io::Visitor& v, std::string_view key, const design::PlantBand& band,
                   const io::KeyUnit& of, std::string_view meaning) {
  const io::KeyUnit unnamed = io::without_suffix(of);
  v.group(io::key_with_unit(key, of), meaning, [&] {
    v.defined_as("band", "A quantity over the plants, in the unit of the key that holds it.");
    v.number("nominal", band.nominal, unnamed, "on the nominal plant");
    v.number("minimum", band.minimum, unnamed, "over the plants");
    v.number("largest", band.largest, unnamed, "over the plants");
    v.number("lower", band.lower, unnamed, "of the prediction interval");
    v.number("upper", band.upper, unnamed, "of that interval");
  });
}

// `sky`: of an angle of the motor.
void describe_expected(io::Visitor& v, const design::StageExpectation& expected,
                       const io::KeyUnit& sky) {
  v.count("plants", expected.plants, "the nominal plant and the ensemble members");
  v.count("stable_plants", expected.stable, "by eigenvalues");
  describe_band(v, "sensitivity_peak", expected.peak, unit::ratio,
                "largest Ms of the closed loops");
  describe_band(v, "crossover", expected.crossover, unit::hertz_of_radians,
                "lowest gain crossover of the outer closed loop");
  describe_band(v, "rise_time", expected.rise_time, unit::second,
                "10 % to 90 % of the command's step");
  describe_band(v, "overshoot", expected.overshoot, unit::ratio, "fraction of the step");
  describe_band(v, "settling_time", expected.settling_time, unit::second, "into 5 %");
  describe_band(v, "calm_encoder_error", expected.calm_encoder, sky,
                "rms in still air as recorded, at the sky; null with the position loop open");
  describe_band(v, "calm_tachometer", expected.calm_tachometer, unit::radian_per_second,
                "rms in still air as recorded, at the motor");
  describe_band(v, "calm_torque", expected.calm_torque, unit::newton_metre, "the same");
  describe_band(v, "calm_valve_command", expected.calm_valve, unit::radian_per_second, "the same");
  describe_band(v, "windy_encoder_error", expected.windy_encoder, sky,
                "rms in the design wind as recorded, at the sky; null with the position loop "
                "open");
  describe_band(v, "windy_tachometer", expected.windy_tachometer, unit::radian_per_second,
                "rms in the design wind as recorded, at the motor");
  describe_band(v, "windy_torque", expected.windy_torque, unit::newton_metre, "the same");
  describe_band(v, "windy_valve_command", expected.windy_valve, unit::radian_per_second,
                "the same");
  describe_band(v, "boresight_rms", expected.boresight_rms, sky,
                "in the design wind, one axis; null with the position loop open");
  describe_band(v, "move_error", expected.move_error, sky,
                "largest encoder error of the move; null with the position loop open");
}

void describe_sheet(io::Visitor& v, const StageSheet& sheet, const io::KeyUnit& sky) {
  v.word("kind", to_string(sheet.stage.kind),
         {to_string(StageKind::as_found), to_string(StageKind::rate_loop),
          to_string(StageKind::pressure_feedback), to_string(StageKind::position_loop),
          to_string(StageKind::compliance), to_string(StageKind::output),
          to_string(StageKind::feedforward)},
         "what the stage changes");
  v.count("step", sheet.stage.step, "number among those of its kind, from 1");
  v.count("steps", sheet.stage.steps, "of its kind");
  v.word("position_loop", sheet.stage.controller.position_open ? "open" : "closed",
         {"open", "closed"}, "in this stage");
  v.flag("feedforward", sheet.stage.controller.feedforward,
         "of the commanded motion's own rate and acceleration");
  v.list("gains", sheet.gains, "those that act", [&](const StageGain& gain) {
    v.text("symbol", gain.symbol, "its symbol");
    v.text("name", gain.name, "its name");
    v.text("value", gain.text, "in the case's unit");
    v.number("value", gain.value, {.suffix = "SI"}, "the same");
    v.flag("changed", gain.changed, "from the previous stage");
  });
  io::KeyUnit command = unit::millidegree;
  command.suffix = "mdeg_or_mdeg_per_s";
  v.number("command_step", sheet.step, command,
           "of the position command, with the position loop open of the rate command, at the sky");
  io::KeyUnit rate_at_sky = sky;
  rate_at_sky.suffix = unit::millidegree_per_second.suffix;
  v.number("steady_motion",
           sheet.experiment ? std::optional(sheet.experiment->base_rate) : std::nullopt,
           rate_at_sky, "below the step or the move, at the sky; null without [simulation]");
  v.number("step_time",
           sheet.experiment ? std::optional(sheet.experiment->step_time) : std::nullopt,
           unit::second, "of each step");
  v.group("expected", "over the plants, linear",
          [&] { describe_expected(v, sheet.stage.expected, sky); });
  const auto& abort = sheet.stage.abort;
  v.group("abort", "beyond any of these: back to the previous stage", [&] {
    v.number("overshoot", abort.overshoot, unit::ratio, "fraction of the step");
    v.number("calm_valve_command", abort.calm_valve_rms, unit::radian_per_second,
             "rms in still air");
    v.number("calm_encoder_error", abort.calm_encoder_rms, sky,
             "rms in still air, at the sky; null with the position loop open");
    v.number(
        "gain_reserve", abort.gain_reserve, unit::ratio,
        "factor on the loop gain that brings the worst plant to the abort Ms; null if above 8");
    v.text("worst_plant", abort.worst_plant, "the one nearest to the abort peak");
  });
  v.list("checks", sheet.checks, "what to measure, in the units of the antenna's computer",
         [&](const StageCheck& check) {
           v.text("quantity", to_string(check.quantity), "what it is");
           v.text("unit", check.unit, "of the numbers beside it");
           v.number("expected", check.expected, unit::none, "on the nominal antenna");
           v.number("lower", check.lower, unit::none, "the stage passes from here");
           v.number("upper", check.upper, unit::none, "to here");
           v.number("abort_above", check.abort_above, unit::none,
                    "back to the previous stage; null: no limit of its own");
         });
  v.text("reserve", sheet.reserve, "what the abort limits leave of the loop gain");
  v.text("way_back", sheet.way_back, "how to go back");
}

void describe_trial(io::Visitor& v, const design::StageTrial& trial) {
  v.count("plants", trial.plants, "fresh ones of the uncertainty set");
  v.count("stable", trial.stable, "by eigenvalues");
  v.count("passing", trial.passing, "every check within its bracket");
  v.count("aborted", trial.aborted, "unstable or beyond an abort limit: a false alarm");
  v.text_or_null("worst", trial.worst ? to_string(*trial.worst) : std::string_view(),
                 "the quantity outside its bracket most often");
  v.count("worst_outside", trial.worst_outside, "plants on which it is");
}

void describe_fault(io::Visitor& v, const design::FaultTrial& trial) {
  v.text("fault", trial.fault, "what is wrong with the antenna");
  v.count("stage", trial.detected ? std::optional(*trial.detected + 1) : std::nullopt,
          "number of the first stage that shows it; null: none does");
  v.flag("stable", trial.detected ? std::optional(trial.evaluation.stable) : std::nullopt,
         "in that stage");
  v.text_or_null("quantity",
                 trial.evaluation.worst ? to_string(*trial.evaluation.worst) : std::string_view(),
                 "that shows it; null: the loop is unstable, or no stage shows it");
  v.number("value", trial.evaluation.worst ? std::optional(trial.measured) : std::nullopt,
           {.suffix = "SI"}, "of that quantity, at the motor");
}

void describe_estimate(io::Visitor& v, std::string_view key, const design::PlantEstimate& estimate,
                       const io::KeyUnit& of, std::string_view meaning) {
  const io::KeyUnit unnamed = io::without_suffix(of);
  v.group(io::key_with_unit(key, of), meaning, [&] {
    v.defined_as("estimate", "Mean and 95 % interval, in the unit of the key that holds it.");
    v.number("mean", estimate.mean, unnamed, "over the plants");
    v.number("lower", estimate.lower, unnamed, "2.5 % quantile");
    v.number("upper", estimate.upper, unnamed, "97.5 % quantile");
  });
}

void describe_record(io::Visitor& v, const RecordedStage& record, const PlantUnits& units) {
  v.count("stage", record.stage + 1, "its number");
  v.text("file", record.file, "as given");
  v.list("checks", record.evaluated, "what was measured, in the units of the antenna's computer",
         [&](const design::EvaluatedQuantity& one) {
           const auto [name, factor] = unit_of(one.measured.quantity, units);
           const io::KeyUnit as_shown{.multiplier = factor};
           v.text("quantity", to_string(one.measured.quantity), "what it is");
           v.text("unit", name, "of the numbers beside it");
           v.number("measured", one.measured.value, as_shown, "by the record");
           v.number("uncertainty", one.measured.uncertainty, as_shown, "standard");
           v.number("lower", one.expected.lower, as_shown, "passes from here");
           v.number("upper", one.expected.upper, as_shown, "to here");
           v.number("abort_above", one.abort, as_shown, "null: no limit of its own");
           v.word(
               "verdict", to_string(one.verdict),
               {to_string(design::StageVerdict::passes), to_string(design::StageVerdict::outside),
                to_string(design::StageVerdict::abort)},
               "of the stage, by this quantity");
         });
  v.texts("remarks", record.remarks, "of reading and measuring it");
}

void describe_update(io::Visitor& v, const design::PlantUpdate& update, const io::KeyUnit& sky) {
  v.count("plants", update.plants,
          "of the uncertainty set, each with the likelihood of the records");
  v.number("effective_plants", update.effective, unit::none, "equally likely ones that are left");
  v.count("quantities", update.quantities, "measured");
  v.number("mismatch", update.mismatch, unit::none,
           "chi-squared of the plant that fits best; null: every plant is unstable");
  v.flag("explained", update.explained, "whether the antenna can be one of the set");
  v.list("inputs", update.inputs, "the one that the records say most of first",
         [&](const design::InputUpdate& input) {
           v.text("input", to_string(input.input), "of the uncertainty set");
           describe_estimate(v, "before", input.before, unit::none, "the records");
           describe_estimate(v, "after", input.after, unit::none, "the records");
         });
  describe_estimate(v, "final_boresight_rms_before", update.final_rms_before, sky,
                    "of the last stage in the design wind");
  describe_estimate(v, "final_boresight_rms_after", update.final_rms_after, sky,
                    "of the last stage in the design wind");
  v.list("faults", update.faults, "that fit better than every plant, if it is not explained",
         [&](const design::FaultFit& fault) {
           v.text("fault", fault.fault, "what is wrong with the antenna");
           v.number("mismatch", fault.mismatch, unit::none, "as above");
         });
}

void describe_compared(io::Visitor& v, const design::BandComparison& band) {
  using enum design::Change;
  v.defined_as("compared", "Mean squares of two records in one band of frequencies.");
  v.number("lowest", band.lowest, unit::hertz, "where the band begins");
  v.number("highest", band.highest, unit::hertz, "where it ends");
  v.number("rms_before", band.rms_before, unit::none, "in the channel's unit");
  v.number("rms_after", band.rms_after, unit::none, "in the channel's unit");
  v.number("freedom_before", band.freedom_before, unit::ratio,
           "degrees of freedom of the mean square");
  v.number("freedom_after", band.freedom_after, unit::ratio,
           "degrees of freedom of the mean square");
  v.number("ratio", band.ratio, unit::ratio, "rms after over before");
  v.number("ratio_lower", band.lower, unit::ratio, "of its 95 % interval");
  v.number("ratio_upper", band.upper, unit::ratio, "of its 95 % interval");
  v.word("change", to_string(band.change), {to_string(none), to_string(better), to_string(worse)},
         "whether the interval holds 1");
}

void describe_comparison(io::Visitor& v, const ChannelComparison& channel) {
  const auto& comparison = channel.comparison;
  constexpr io::NumberForm known{.finite = true};
  v.text("channel", to_string(channel.quantity), "of both records");
  v.text("unit", unit_of(channel.quantity), "of the channel");
  v.text_or_null("not_compared", channel.not_compared,
                 "why it could not be compared; its numbers then mean nothing");
  v.group("whole", "over all frequencies compared",
          [&] { describe_compared(v, comparison.whole); });
  v.list("bands", comparison.bands, "by rising frequency",
         [&](const design::BandComparison& band) { describe_compared(v, band); });
  const auto& predicted = channel.predicted;
  v.number("predicted_ratio", predicted ? std::optional(predicted->value) : std::nullopt,
           unit::ratio, "by the plan's first and last stage in the design wind");
  v.number("predicted_ratio_lower", predicted ? std::optional(predicted->lower) : std::nullopt,
           unit::ratio, "over the plants");
  v.number("predicted_ratio_upper", predicted ? std::optional(predicted->upper) : std::nullopt,
           unit::ratio, "over the plants");
  v.flag("agrees", predicted ? std::optional(agrees(comparison, *predicted)) : std::nullopt,
         "whether the two intervals meet");
  v.numbers("frequency", comparison.frequency, unit::hertz, "of the densities", known);
  const io::KeyUnit density{.suffix = "per_Hz"};
  v.numbers("density_before", comparison.density_before, density,
            "one-sided, of the channel's unit squared", known);
  v.numbers("density_after", comparison.density_after, density,
            "one-sided, of the channel's unit squared", known);
}

}  // namespace

void describe(io::Visitor& v, const CommissionReport& report) {
  io::KeyUnit sky = unit::millidegree;
  sky.divisor = report.gear_ratio * unit::millidegree.divisor;
  const auto sky_per = [&](std::string_view suffix) { return io::KeyUnit{suffix, sky.divisor}; };
  v.constant("command", "commission", "the command");
  v.text("case", report.case_path, "the case file, as given");
  v.text("title", report.title, "its title");
  describe_axis(v, report.axis);
  v.count("seed", report.seed, "of all samples");
  v.text("structure", report.structure, "of the controller");
  v.word("gains_from", report.tuned ? "tuning" : "user", {"tuning", "user"}, "of the controller");
  v.group("ensemble", "plant ensemble", [&] {
    v.count("plants", report.ensemble_size, "how many");
    v.text("source", report.ensemble_source, "distribution that they are sampled from");
  });
  v.group("wind", "the design wind", [&] {
    v.text("model", report.wind_model, "of the wind torque");
    v.number("mean_speed", report.wind_speed, unit::metre_per_second, "of the design wind");
  });
  v.group("move", "the commanded move of the last stages, at the sky", [&] {
    v.number("rate", report.move.rate, sky_per("mdeg_per_s"), "largest");
    v.number("acceleration", report.move.acceleration, sky_per("mdeg_per_s2"), "largest");
  });
  v.number("largest_step",
           report.failure == nullptr ? std::optional(report.plan.largest_step) : std::nullopt,
           unit::ratio, "largest factor on a gain from stage to stage");
  v.number("sensitivity_limit", report.options.sensitivity_limit, unit::ratio,
           "Ms limit at every stage on every plant, unless the controller's own Ms is higher");
  v.number("abort_peak", report.options.abort_peak, unit::ratio, "Ms at which to abort");
  v.number("confidence", report.options.confidence, unit::ratio, "of the bands' lower and upper");
  v.number("assumed_detuning", report.plan.detuning, unit::ratio,
           "factor that the assumed start's gains are divided by; null where the gains found are "
           "used");
  v.text_or_null("no_plan", report.no_plan, "why there is no plan; null: there is one");
  const auto* system =
      report.plan.stages.empty()
          ? nullptr
          : report.plan.stages.back().controller.controller.structure.state_space();
  v.optional_members(system != nullptr ? std::optional(*system) : std::nullopt,
                     [&](const plant::StateSpace& controller) {
                       v.object("state_space_controller", controller,
                                "the controller at the end of a plan for a state space, sampled");
                     });
  v.texts("remarks", report.plan.remarks, "what the plan had to do otherwise than asked");
  v.list("stages", report.sheets, "in the order of the work",
         [&](const StageSheet& sheet) { describe_sheet(v, sheet, sky); });
  v.group_if("trials", !report.trials.stages.empty() || v.by_example(), "of the stages", [&] {
    v.count("plants", report.trials.plants, "fresh ones of the uncertainty set");
    v.count("stable", report.trials.stable, "in every stage");
    v.count("passing", report.trials.passing, "every check of every stage");
    v.count("aborted", report.trials.aborted, "at least one stage: false alarms");
    v.list("stages", report.trials.stages, "in the order of the work",
           [&](const design::StageTrial& trial) { describe_trial(v, trial); });
  });
  v.list("faults", report.faults, "an antenna with each of them, in the stages",
         [&](const design::FaultTrial& trial) { describe_fault(v, trial); });
  v.list("records", report.records, "of stages that are done",
         [&](const RecordedStage& record) { describe_record(v, record, report.units); });
  v.optional_group("update", report.update, "the uncertainty set by those records",
                   [&](const design::PlantUpdate& update) { describe_update(v, update, sky); });
  v.text_or_null("record_before", report.before, "record of the case");
  v.text_or_null("record_after", report.after, "record of the case");
  v.list("comparisons", report.comparisons, "of the two records, a channel each",
         [&](const ChannelComparison& channel) { describe_comparison(v, channel); });
  v.texts("conclusions", report.conclusions, "what the numbers mean");
  describe_figures(v, report.figures);
  v.list("assumed", report.assumed, "inputs of the case that are assumed",
         [&](const io::Quantity& quantity) {
           v.text("key", quantity.key, "in the case file");
           v.text("value", quantity.text, "as written");
         });
  describe_renamed_keys(v);
}

std::string to_json(const CommissionReport& report) {
  return json_of(report).dump(2) + "\n";
}

}  // namespace boresight::app
