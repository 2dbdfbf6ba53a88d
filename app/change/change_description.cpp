#include <cmath>

#include <boresight/app/change/change_report.hpp>
#include <boresight/app/figures/figure_description.hpp>
#include <boresight/app/report/common_description.hpp>
#include <boresight/app/report/json_writer.hpp>
#include <boresight/app/report/servo_record_wording.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::app {
namespace {

namespace unit = io::key_units;

void describe_band(io::Visitor& v, const design::RatioBand& ratio) {
  v.defined_as("ratio_of_rms", "Ratio of rms, after over before, with its interval.");
  v.number("value", ratio.value, unit::ratio, "Estimate.");
  v.number("lower", ratio.lower, unit::ratio, "Of its interval.");
  v.number("upper", ratio.upper, unit::ratio, "Of its interval.");
}

void describe_band(io::Visitor& v, const design::RmsBand& rms) {
  v.defined_as("rms", "An rms with its interval.");
  v.number("value", rms.value, unit::millidegree, "Estimate, at the sky.");
  v.number("lower", rms.lower, unit::millidegree, "Of its interval.");
  v.number("upper", rms.upper, unit::millidegree, "Of its interval.");
}

void describe_ratio(io::Visitor& v, const design::RatioAtSpeed& at) {
  using enum design::Change;
  v.defined_as("ratio_at_speed", "Both conditions at one wind speed.");
  v.number("wind_speed", at.speed, unit::metre_per_second, "Mean.");
  v.group("before", "Rms of the error.", [&] { describe_band(v, at.before); });
  v.group("after", "Rms of the error.", [&] { describe_band(v, at.after); });
  v.group("ratio", "After over before.", [&] { describe_band(v, at.ratio); });
  v.word("change", to_string(at.change), {to_string(none), to_string(better), to_string(worse)},
         "Whether the ratio's interval holds 1.");
  v.flag("before_extrapolated", at.before_extrapolated,
         "Whether the records before are all at weaker or all at stronger wind.");
  v.flag("after_extrapolated", at.after_extrapolated, "Likewise, of the records after.");
}

void describe_condition(io::Visitor& v, const design::ConditionInWind& condition,
                        const std::vector<io::ServoRecordNotes>& files) {
  v.defined_as("records_of_condition", "Records of one condition.");
  v.number("slowest_wind", condition.slowest, unit::metre_per_second, "Of the records' means.");
  v.number("fastest_wind", condition.fastest, unit::metre_per_second, "Of the records' means.");
  v.number("wind_direction", condition.wind_direction, unit::degree,
           "Circular mean; null if not recorded.");
  v.number("coherent_fraction", condition.explained, unit::ratio,
           "Fraction of the error's power that is coherent with the measured wind.");
  v.number("coherent_threshold", condition.explained_threshold, unit::ratio,
           "Fraction that incoherent records exceed with a probability of 5 %.");
  v.list("records", condition.records, "As given.", [&](const design::WindyRecordFigures& record) {
    v.text("name", record.name, "Of its file.");
    v.number("duration", record.duration, unit::second, "From the first sample to the last.");
    v.number("wind_speed", record.mean_speed, unit::metre_per_second, "Mean.");
    v.number("wind_intensity", record.wind_intensity, unit::ratio,
             "Standard deviation of the wind speed over its mean.");
    v.number("gust_factor", std::exp(0.5 * record.log_gusts), unit::ratio,
             "Amplitude of the gusts over that usual in these records at that speed.");
    v.number("rms", record.rms, unit::millidegree, "Of the error in the band.");
    v.number("freedom", record.freedom, unit::ratio, "Degrees of freedom of its square.");
  });
  v.list("files", files, "In the same order.", [&](const io::ServoRecordNotes& notes) {
    v.text("path", notes.path, "As given.");
    v.text("sha256", notes.sha256, "Of its bytes.");
    v.list("columns", notes.sources, "Signals and their columns.",
           [&](const io::SignalSource& one) {
             v.text("signal", one.signal, "Which.");
             v.text_or_null("column", one.column, "Null: computed.");
             v.text_or_null("column_unit", one.unit, "As taken.");
             v.text_or_null("remark", one.remark, "What was taken for granted.");
           });
    v.texts("remarks", reading_of(notes), "How its columns were read, and samples that were not.");
  });
}

void describe_controller(io::Visitor& v, const RecordedController& controller) {
  v.defined_as("recorded_controller", "A controller of the change.");
  v.text("structure", controller.structure, "As the user names it.");
  v.text("source", controller.source, "In words.");
  v.text_or_null("state_space", controller.state_space, "In words; null for gains.");
  v.list("gains", controller.gains, "In the structure's order.", [&](const RecordedGain& gain) {
    v.text("symbol", gain.symbol, "As in [gains].");
    v.text("name", gain.name, "In words.");
    v.text("value", gain.text, "With its unit.");
  });
}

std::string_view key_of(design::ChangeCheckKind kind) {
  using enum design::ChangeCheckKind;
  switch (kind) {
    case wind_overlap:
      return "wind_overlap";
    case wind_direction:
      return "wind_direction";
    case improvement:
      return "improvement";
    case prediction:
      return "prediction";
    case stability:
      return "stability";
    case design_wind_rms:
      return "design_wind_rms";
  }
  return "";
}

}  // namespace

void describe(io::Visitor& v, const ChangeReport& report) {
  using enum design::ChangeCheckKind;
  using enum design::WindComparisonKind;
  const auto& comparison = report.comparison;
  describe_origin(v, "benchmark");
  describe_case(v, report.case_path, report.title, report.axis);
  v.count("seed", report.seed, "Of the ensemble's samples and the tuning.");
  v.texts("decision", decision(report), "In sentences.");
  v.word("error", to_string(report.error),
         {to_string(design::RecordedError::boresight), to_string(design::RecordedError::position)},
         "By which the records are compared.");
  v.word("comparison", to_string(comparison.kind),
         {to_string(regression), to_string(equal_wind), to_string(no_overlap),
          to_string(too_few_records)},
         "How the records were compared, or why not.");
  v.number("confidence", report.confidence, unit::ratio, "Of all intervals.");
  v.number("band_lowest", comparison.lowest, unit::hertz, "Of the band of every rms.");
  v.number("band_highest", comparison.highest, unit::hertz, "Of the band of every rms.");
  v.optional_group("at_reference", comparison.at_reference,
                   "At the wind speed that both conditions have; null if not compared.",
                   [&](const design::RatioAtSpeed& at) { describe_ratio(v, at); });
  v.optional_group("at_design", comparison.at_design,
                   "At the case's design wind; null if not compared there.",
                   [&](const design::RatioAtSpeed& at) { describe_ratio(v, at); });
  v.optional_group("by_coherence", comparison.by_coherence,
                   "Of the parts of the error coherent with the measured wind, of slow gusts; null "
                   "where there is too little coherence.",
                   [&](const design::RatioBand& ratio) { describe_band(v, ratio); });
  const bool fitted = comparison.kind == regression;
  v.number("wind_exponent", fitted ? std::optional(comparison.exponent) : std::nullopt, unit::ratio,
           "Of the wind speed in the error's variance; null without regression.");
  v.number("gust_exponent", fitted ? std::optional(comparison.gust_exponent) : std::nullopt,
           unit::ratio, "Of the gusts' power in the error's variance; null without regression.");
  v.optional_group(
      "predicted", report.predicted,
      "By the linear model at the reference wind, in the band; null without the old controller, "
      "without a comparison or for an unstable loop.",
      [&](const design::PredictedChange& predicted) {
        v.number("rms_before", predicted.rms_before, unit::millidegree, "At the sky.");
        v.number("rms_after", predicted.rms_after, unit::millidegree, "At the sky.");
        v.group("ratio", "Its interval is over the plants.",
                [&] { describe_band(v, predicted.ratio); });
        v.count("plants", predicted.plants, "Ensemble members on which both loops are stable.");
        v.flag("held", predicted.held, "Whether it overlaps the measured interval.");
      });
  v.list("checks", report.checks, "For the change to stay.", [&](const design::ChangeCheck& check) {
    v.word("check", key_of(check.kind),
           {key_of(wind_overlap), key_of(wind_direction), key_of(improvement), key_of(prediction),
            key_of(stability), key_of(design_wind_rms)},
           "Which.");
    v.flag("passed", check.passed, "Null: it could not be checked.");
  });
  v.count("plants", report.plants, "Ensemble members.");
  v.flag("stable_nominal", report.stable_nominal, "The new controller on the nominal plant.");
  v.count("stable_plants", report.stable_plants, "With the new controller.");
  v.text("ensemble_source", report.ensemble_source, "Distribution that they are sampled from.");
  v.number("budget", report.budget, unit::millidegree, "The tightest; null without one.");
  v.optional_group("old_controller", report.old_controller, "Null: not known.",
                   [&](const RecordedController& one) { describe_controller(v, one); });
  v.group("new_controller", "The one of the records after.",
          [&] { describe_controller(v, report.new_controller); });
  v.group("before", "Records before the change.",
          [&] { describe_condition(v, comparison.before, report.before_files); });
  v.group("after", "Records after the change.",
          [&] { describe_condition(v, comparison.after, report.after_files); });
  v.texts("remarks", report.remarks, "What is to be known of the numbers.");
  describe_figures(v, report.figures);
  describe_assumed(v, report.assumed);
  describe_renamed_keys(v);
}

std::string to_json(const ChangeReport& report) {
  return json_of(report).dump(2) + "\n";
}

}  // namespace boresight::app
