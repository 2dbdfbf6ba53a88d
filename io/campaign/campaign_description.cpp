#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <boresight/io/campaign/campaign_comparison.hpp>
#include <boresight/io/campaign/campaign_description.hpp>
#include <boresight/io/campaign/campaign_wording.hpp>
#include <boresight/io/campaign/recommended_values.hpp>
#include <boresight/io/description/interval_results.hpp>

namespace boresight::io {
namespace {

namespace unit = key_units;

constexpr KeyUnit as_named{.suffix = "si"};
constexpr std::array<std::string_view, 7> test_kinds{
    "slosh", "fast-ramp", "slow-ramp", "constant-speed", "valve-steps", "valve-chirp", "other"};

void describe_difference(Visitor& v, const std::optional<Difference>& difference,
                         std::string_view meaning) {
  v.optional_group("difference", difference, meaning, [&](const Difference& there) {
    v.defined_as("difference", "Another estimate against the combined one.");
    v.number("relative", there.relative, unit::ratio, "Difference over the combined value.");
    v.number("normalised", there.normalised, unit::ratio,
             "Difference over both standard uncertainties' root sum of squares.");
  });
}

void describe_record(Visitor& v, const RecordNotes& record) {
  v.defined_as("record", "What became of one recorder file.");
  v.text("name", record.name, "The record.");
  v.text("path", record.path, "The file.");
  v.text("description", record.description, "By the case.");
  v.text("format", record.format, "Of the file.");
  v.count("bytes", record.bytes, "Of the file.");
  v.text("sha256", record.sha256, "Digest of the file.", {.pattern = "^[0-9a-f]{64}$"});
  v.count("rows", record.rows, "Samples of the file.");
  v.number("sample_time", record.sample_time, unit::second, "Of the record as used.");
  v.number("duration", record.duration, unit::second, "Of the record as used.");
  v.word("test", to_string(record.test), test_kinds, "What was done.");
  v.flag("test_guessed", record.test_guessed, "The data told the test, not the case.");
  v.flag("rate_loop_closed", record.rate_loop_closed, "The rate loop was closed.");
  v.flag("rate_loop_guessed", record.rate_loop_guessed, "The data told so, not the case.");
  v.list("sources", record.sources, "Where each signal came from.", [&](const auto& source) {
    v.text("signal", source.signal, "The signal.");
    v.text("column", source.column, "Of the file.");
    v.text("unit", source.unit, "As taken.");
    v.flag("guessed", source.guessed, "The column was guessed by its name.");
    v.text_or_null("remark", source.remark, "What was taken for granted beside.");
  });
  v.texts("unused_columns", record.unused_columns, "Columns of the file that are no signal.");
  v.texts("remarks", record.remarks, "Of the reader: lines left out and the like.");
  v.list("defects", record.defects, "Defects of the data, all of them.", [&](const auto& defect) {
    v.text("kind", identification::to_string(defect.kind), "What is wrong.");
    v.text("handling", identification::to_string(defect.handling), "What was done about it.");
    v.text_or_null("channel", defect.channel, "The channel; null: the record as a whole.");
    v.count("first_sample", defect.first, "Of the file, from 0.");
    v.number("first_time", defect.first_time, unit::second, "As recorded.");
    v.count("samples", defect.count, "How many.");
    v.text("explanation", defect.explanation, "A sentence.");
  });
  v.text_or_null("refused_because", record.refusal, "Why the record is not used; null if it is.");
}

void describe_quantities(Visitor& v, const CampaignSection& section,
                         const identification::GreyBoxResult& fit) {
  v.list("quantities", fit.quantities, "What it says of the drive.", [&](const auto& q) {
    v.text("name", q.name, "The quantity.");
    describe_interval(v, "posterior", q.posterior, q.unit, "After the records.");
    describe_interval(v, "prior", q.prior, q.unit, "Before them.");
    v.flag("prior_from_drawings", q.prior_from_drawings,
           "The prior is that of drawings and data sheets, not a wide guess.");
    v.number("variance_learnt", q.learnt, unit::ratio,
             "Fraction of the prior's variance that the records took away.");
    v.flag("identified", q.identified, "The records took half of the variance or more.");
    v.word("verdict", v.by_example() ? "identified" : verdict(section, q),
           {"identified", "slosh", "drawings", "not identifiable", "contradicts slosh",
            "contradicts drawings", "contradicts the case"},
           "Where it comes from.");
  });
  std::vector<std::vector<double>> correlation;
  for (Eigen::Index i = 0; i < fit.correlation.rows(); ++i) {
    auto& row = correlation.emplace_back();
    for (const double value : fit.correlation.row(i)) row.push_back(value);
  }
  v.number_rows("correlation", correlation, unit::ratio, "Of the quantities, in their order.");
}

void describe_fit(Visitor& v, const CampaignSection& section,
                  const identification::GreyBoxResult& fit) {
  v.defined_as("grey_box", "One nonlinear model fitted to all records: the combined estimate.");
  describe_quantities(v, section, fit);
  v.list("parameters", fit.parameters, "At the optimum.", [&](const auto& p) {
    v.text("name", p.parameter.name, "The parameter.");
    v.text("unit", p.parameter.unit.empty() ? "1" : std::string_view(p.parameter.unit), "SI.");
    v.number("value", p.value, as_named, "At the optimum.");
    v.number("prior", p.parameter.prior, as_named, "The prior's median.");
    v.number("prior_spread", p.parameter.spread, unit::ratio,
             "Its standard deviation, of the logarithm if logarithmic, else in the unit.");
    v.flag("logarithmic", p.parameter.logarithmic, "Counted by its logarithm.");
    v.flag("from_drawings", p.parameter.from_drawings,
           "Its prior is from drawings, data sheets or instruments.");
    v.number("departure", p.departure, unit::ratio, "From the prior, in its spreads.");
    v.number("remaining", p.remaining, unit::ratio, "Standard uncertainty left, in its spreads.");
    v.flag("identified", p.identified, "Below 0.7 of a spread is left.");
  });
  v.list("stated_numbers", fit.stated_numbers,
         "Each stated number against the records and all other stated numbers.",
         [&](const identification::StatedNumberCheck& one) {
           v.text("name", one.name, "The number.");
           v.number("stated_uncertainty", one.stated_uncertainty, unit::ratio,
                    "Standard, relative.");
           describe_interval(v, "by_others", one.by_others, "1",
                             "Of the stated number, by records and all other stated numbers.");
           v.number("departure", one.departure, unit::ratio,
                    "Its logarithm, in standard uncertainties of both together.");
           v.number("visible_error", one.visible_error, unit::ratio,
                    "Relative error of the number with a departure of 3.5.");
           v.number("inertia_effect", one.inertia_effect, unit::ratio,
                    "Relative change of the inertia per relative change of the number.");
           describe_interval(v, "inertia", one.inertia, "kg m2", "Without the stated number.");
           v.flag("moves_inertia", one.moves_inertia,
                  "Without it the inertia is another by its standard uncertainty or more; also of "
                  "the supply pressure, which checks the pressure transducers.");
         });
  v.list("without_record", fit.influences,
         "The inertia without each record, by the first step of a fit without it.",
         [&](const identification::RecordInfluence& one) {
           v.text("record", one.record, "The record.");
           describe_interval(v, "inertia", one.inertia, "kg m2", "Without the record.");
           v.number("change", one.change, unit::ratio, "Of the inertia by the record, relative.");
           v.number("information", one.information, unit::ratio,
                    "Fraction of the information about the inertia as recorded that is the "
                    "record's alone.");
         });
  v.list("residuals", fit.residuals, "Prediction errors of each record and half.",
         [&](const auto& r) {
           v.text("record", r.record, "The record.");
           v.word("of", r.pressures ? "pressures" : "rate", {"pressures", "rate"},
                  "What is predicted.");
           v.text("unit", r.pressures ? "N m" : "rad/s", "Of the rms.");
           v.number("rms", r.rms, as_named, "Of those that count.");
           v.count("counted", r.counted, "Errors that count.");
           v.count("outliers", r.outliers, "Left out for their size.");
           v.number("neighbours_correlation", r.neighbours, unit::ratio, "At one sample.");
           v.number("effective", r.effective, unit::ratio,
                    "Independent errors that would say as much.");
           v.flag("white", r.white, "Ljung and Box's test at 5 %.");
         });
  v.list("starts", fit.starts, "Searches; the first is that from the priors.",
         [&](const auto& start) {
           v.number("sum_of_squares", start.cost, unit::ratio, "At its end.");
           v.count("iterations", start.iterations, "Taken.");
           v.flag("converged", start.converged, "It arrived.");
         });
  v.text("status", numerics::describe(fit.status), "Why the search ended.");
  v.count("rank", fit.rank, "Directions in which the records say more than the priors.");
  v.count("varied", fit.varied, "Parameters that are not known.");
  v.number("condition", fit.condition, unit::ratio, "Of the Jacobian with priors.");
  v.number("variance_inflation", fit.posterior.inflation, unit::ratio,
           "Covariance over that of a true model with white errors.");
  v.texts("records", fit.records, "Used.");
  v.texts("without_valve", fit.without_valve, "Of which only the mechanical half was used.");
  v.texts("left_out", fit.left_out, "Without motor rate or pressures.");
  v.texts("notes", fit.notes, "What the reader must know.");
}

void describe_mean(Visitor& v, const identification::CombinedInertia& mean) {
  const numerics::Interval inertia{mean.value, mean.standard_uncertainty, mean.lower, mean.upper};
  v.defined_as("mean_of_methods", "Random-effects mean of the methods.");
  describe_interval(v, "inertia", inertia, "kg m2", "The mean.");
  v.number("between_methods", mean.between_methods, {.suffix = "kg_m2"},
           "Standard deviation between methods.");
  v.number("cochran_q", mean.heterogeneity, unit::ratio, "Cochran's Q.");
  v.count("degrees_of_freedom", mean.degrees_of_freedom, "Of Q.");
  v.number("motor_to_load_ratio", mean.motor_to_load_ratio, unit::ratio, "With the mean.");
  v.number("motor_to_load_ratio_lower_95", mean.ratio_lower, unit::ratio, "Lower end.");
  v.number("motor_to_load_ratio_upper_95", mean.ratio_upper, unit::ratio,
           "Upper end; null: infinite.");
}

void describe_method(Visitor& v, const InertiaRow& row) {
  v.text("name", row.name, "The method.");
  v.flag("of_the_paper", row.of_the_paper, "One of the founding paper's procedures.");
  describe_interval(v, "inertia", row.inertia, "kg m2", "Motors and load at the motor shaft.");
  describe_interval(v, "motor_to_load_ratio", row.motor_to_load_ratio, "1",
                    "All motors against the load.");
  describe_difference(v, row.difference, "From the combined inertia.");
  v.text("assumes", row.assumes, "What it takes for granted.");
  v.text("why", row.why, "Why it differs, in words and numbers.");
}

void describe_slosh(Visitor& v, const SloshTest& test) {
  v.defined_as("slosh", "Oil lines by one slosh test.");
  v.text("record", test.record, "The record.");
  v.list("lines", test.result.lines, "Lines that rang.", [&](const auto& line) {
    v.count("motor", line.motor + 1, "From 1.", {.minimum = 1});
    v.word("side", line.side == identification::LineSide::inlet ? "inlet" : "outlet",
           {"inlet", "outlet"}, "The port.");
    v.number("length", line.length ? std::optional(line.length->value) : std::nullopt, as_named,
             "Of the drawings, m.");
    describe_interval(v, "frequency", line.frequency, "Hz", "Undamped natural.");
    describe_interval(v, "damping_ratio", line.damping_ratio, "1", "Of the ringing.");
    v.count("events", line.events, "That it rests on.");
    v.number("between_events", line.between_events, unit::hertz, "Scatter between them.");
    describe_interval(v, "wave_speed", line.wave_speed, "m/s", "2 L f.");
    describe_interval(v, "bulk_modulus", line.bulk_modulus, "Pa", "Of this line.");
  });
  v.optional_group(
      "extreme_lines", test.result.extreme_lines,
      "The paper's way: highest with shortest, lowest with longest.", [&](const auto& extreme) {
        v.number("highest_frequency", extreme.highest_frequency, unit::hertz, "Of all ports.");
        v.number("lowest_frequency", extreme.lowest_frequency, unit::hertz, "Of all ports.");
        describe_interval(v, "bulk_modulus_shortest", extreme.bulk_modulus_shortest, "Pa",
                          "Of the shortest line.");
        describe_interval(v, "bulk_modulus_longest", extreme.bulk_modulus_longest, "Pa",
                          "Of the longest line.");
        describe_interval(v, "mean", extreme.mean, "Pa", "Of the two.");
      });
  describe_interval(v, "bulk_modulus", test.result.bulk_modulus, "Pa", "All lines together.");
  describe_interval(v, "wave_speed", test.result.wave_speed, "m/s", "All lines together.");
  v.texts("notes", test.result.notes, "What was found or left out.");
}

void describe_friction(Visitor& v, const CampaignSection& section) {
  v.defined_as("campaign_friction", "Friction of the antenna at the motor shaft.");
  v.list("rows", section.friction, "By speed.", [&](const FrictionRow& row) {
    v.number("rate", row.rate, unit::radian_per_second, "Of the motor.");
    v.flag("tracking", row.tracking, "At which the antenna follows a star.");
    v.flag("extrapolated", row.extrapolated, "Outside the constant-speed tests.");
    describe_interval(v, "combined", row.combined, "N m", "Grey box.");
    describe_interval(v, "curve", row.curve, "N m", "Curve fitted to the windows of all tests.");
    describe_interval(v, "constant_speed", row.tested, "N m", "Test at this speed.");
  });
  const identification::ImpulseMomentum none;
  const auto& impulse = section.impulse ? *section.impulse : none;
  auto line = impulse.constant_speed;
  if (line && !line->has_line) line.reset();
  v.optional_group("constant_speed_line", line,
                   "The paper's straight line; null without two speeds.", [&](const auto& tests) {
                     describe_interval(v, "coulomb", tests.intercept, "N m", "Intercept.");
                     describe_interval(v, "slope", tests.slope, "N m s/rad", "Slope.");
                     describe_interval(v, "offset", tests.offset, "N m",
                                       "Half the sum of up and down.");
                     v.number("largest_misfit", tests.line_misfit, unit::newton_metre,
                              "Of a test from the line.");
                   });
  v.optional_group("slow_ramp", impulse.slow_ramp, "Null without slow ramps.",
                   [&](const auto& ramp) {
                     describe_interval(v, "breakaway", ramp.breakaway, "N m", "As motion begins.");
                     describe_interval(v, "coulomb", ramp.coulomb, "N m", "Just after.");
                     describe_interval(v, "offset", ramp.offset, "N m", "Half the sum.");
                   });
}

void describe_suspicion(Visitor& v, const ChannelSuspicion& one) {
  v.text("finding", one.finding, "What is wrong.");
  v.texts("records", one.records, "In which records.");
  v.texts("channels", one.channels, "As the files call them; empty: the records as a whole.");
  v.texts("stated_numbers", one.stated_numbers,
          "Of the case: one is wrong, or a channel that measures with it; the likeliest first.");
  v.flag("record_refused", one.record_refused, "The records are not used.");
  v.number("largest_fraction", one.fraction, unit::ratio, "Of a record's samples.");
  v.text("explanation", one.explanation, "Of the first.");
}

void describe_channel(Visitor& v, const identification::ChannelCheck& one) {
  using Channel = identification::ChannelCheck::Channel;
  v.text("channel", one.name, "As the files call it; of a torque the two pressures.");
  v.word("kind",
         one.channel == Channel::tachometer ? "tachometer"
         : one.channel == Channel::inlet    ? "inlet pressure"
         : one.channel == Channel::outlet   ? "outlet pressure"
                                            : "torque",
         {"tachometer", "inlet pressure", "outlet pressure", "torque"}, "What it measures.");
  v.text_or_null("record", one.record, "In which record; null: all of them.");
  v.word("quantity", to_string(one.quantity), {"gain", "sign", "zero", "delay"},
         "Recorded = gain true + zero, later by the delay. Sign: a negative gain.");
  describe_interval(v, "value", one.interval, one.unit.empty() ? "1" : one.unit,
                    "As it must be for the others to be right; null where not determined.");
  v.number("stated_uncertainty", one.stated_uncertainty, as_named,
           "1 sigma by the stated accuracy of the channel and of what it is compared with.");
  v.text("against", one.against, "Compared with.");
  v.word("verdict", to_string(one.verdict), {"right", "suspect", "undeterminable"},
         "Suspect: more than 3.5 standard uncertainties, estimate and stated accuracy together, "
         "from 1 (0 of a zero or delay).");
  v.optional_group("likely", one.likely, "The likely reason of a gain that is suspect; else null.",
                   [&](const identification::LikelyFactor& likely) {
                     v.number("factor", likely.factor, unit::ratio, "Recorded over true.");
                     v.text_or_null("name", likely.name,
                                    "Of the usual mistakes; null: the measured factor.");
                   });
  v.flag("used", one.is_used, "False: other motors' values stand for it.");
}

void describe_contradiction(Visitor& v, const Contradiction& one) {
  v.text("key", one.key, "Of the case, or the id of a stated number.");
  v.text("stated", one.stated, "As written.");
  v.flag("assumed", one.assumed, "The case says itself that it assumes it.");
  v.text("unit", one.unit, "SI.");
  v.number("stated", one.stated_value, as_named, "Stated.");
  v.number("stated_uncertainty", one.stated_uncertainty, as_named, "1 sigma.");
  describe_interval(v, "records", one.records, one.unit, "What the records say.");
  v.text("by", one.by, "Which method.");
  v.number("normalised", one.normalised, unit::ratio, "Difference over both uncertainties.");
}

// What is left of one quantity's interval after a test.
struct AdvisedTest {
  identification::GreyBoxInformationGain gain;
  double remaining = 0.0;
};
struct Advice {
  std::string quantity;
  std::vector<AdvisedTest> tests;
};

std::vector<Advice> advice_of(const CampaignSection& section) {
  std::vector<Advice> advice;
  if (!section.grey_box) return advice;
  const auto& quantities = section.grey_box->quantities;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    if (!advised_quantity(quantities[q].name)) continue;
    Advice& one = advice.emplace_back();
    one.quantity = quantities[q].name;
    for (const auto* gain : ranked(section.test_gains, q)) {
      one.tests.push_back({*gain, gain->remaining[q]});
    }
  }
  return advice;
}

void describe_advice(Visitor& v, const Advice& advice) {
  v.text("quantity", advice.quantity, "The quantity.");
  v.list("tests", advice.tests, "The best first.", [&](const AdvisedTest& test) {
    v.text("test", test.gain.test, "The test.");
    v.word("kind", to_string(test.gain.kind), test_kinds, "Its kind.");
    v.flag("done_before", test.gain.done_before, "A record of this kind is in the campaign.");
    v.number("interval_remaining", test.remaining, unit::ratio,
             "Standard uncertainty after over before.");
  });
}

void describe_methods(Visitor& v, const CampaignSection& section) {
  v.list("methods", section.inertia, "Reflected inertia by method.",
         [&](const InertiaRow& row) { describe_method(v, row); });
  v.list("methods_not_done", section.failures, "Methods that the campaign does not allow.",
         [&](const MethodFailure& failure) {
           v.text("method", failure.method, "The method.");
           v.text("reason", failure.reason, "Why.");
         });
  v.list("quantities", section.quantities, "Other estimates of the combined quantities.",
         [&](const QuantityRow& row) {
           v.text("quantity", row.quantity, "The quantity.");
           v.text("method", row.method, "The method.");
           describe_interval(v, "estimate", row.interval, row.unit, "What it gives.");
           describe_difference(v, row.difference, "From the combined one.");
         });
  describe_interval(v, "bulk_modulus", section.bulk_modulus, "Pa", "As the resonance used it.");
  v.flag("bulk_modulus_stated", section.bulk_modulus_stated,
         "It is the case's, no slosh test gave it.");
  v.list("slosh", section.slosh, "Slosh tests.",
         [&](const SloshTest& test) { describe_slosh(v, test); });
  v.optional_group(
      "resonance", section.resonance, "Hydraulic resonance; null where not done.",
      [&](const auto& found) {
        describe_interval(v, "stiffness", found.stiffness, "N m/rad", "By oil data.");
        v.number("expected_frequency", found.expected_frequency, unit::hertz,
                 "Drawings' inertia, rigid, on that stiffness.");
        describe_interval(v, "frequency", found.frequency, "Hz", "Of the mode in motion.");
        describe_interval(v, "damping_ratio", found.damping_ratio, "1", "Of the mode in motion.");
        v.number("coupled_over_rigid_frequency", found.coupled_over_rigid, unit::ratio,
                 "Flexible drive's lowest mode over the rigid one's.");
        v.texts("notes", found.notes, "What it shows.");
      });
}

}  // namespace

void describe(Visitor& v, const CampaignSection& section) {
  v.defined_as("campaign", "What the records of a campaign say of the drive.");
  v.texts("not_identifiable", section.not_identifiable, "What the records cannot tell, plainly.");
  v.list("records", section.notes.records, "In the case's order, refused ones too.",
         [&](const RecordNotes& record) { describe_record(v, record); });
  v.texts("assumptions", section.notes.assumptions, "What was taken for granted.");
  v.text_or_null(
      "rejected_because", to_string(rejection(section)),
      "Why no value is recommended: channels contradict one another, contradicts the case, fit "
      "failed; null if one is.");
  v.optional_group("recommended", recommended(section),
                   "What a design may take; null where no value is recommended.",
                   [&](const RecommendedValues& values) {
                     describe_interval(v, "inertia", values.inertia, "kg m2",
                                       "Motors and load at the motor shaft.");
                     describe_interval(v, "motor_to_load_ratio", values.motor_to_load_ratio, "1",
                                       "All motors against the load.");
                   });
  v.list("look_at", suspicions(section), "Records and channels to look at, the worst first.",
         [&](const ChannelSuspicion& one) { describe_suspicion(v, one); });
  v.list("channels", section.channels,
         "What each channel's gain, zero and delay must be for the others to be right.",
         [&](const identification::ChannelCheck& one) { describe_channel(v, one); });
  v.optional_group("combined", section.grey_box,
                   "Null where no model explains the records; recommended only where that is not "
                   "null.",
                   [&](const auto& fit) { describe_fit(v, section, fit); });
  v.optional_group("mean_of_methods", section.mean_of_methods,
                   "In place of the combined estimate; null beside one.",
                   [&](const auto& mean) { describe_mean(v, mean); });
  v.optional_group(
      "hold_out", section.hold_out,
      "A record predicted by the drive fitted to the others, by its valve command alone; null "
      "where none could be.",
      [&](const HoldOut& held) {
        v.text("record", held.record, "The record.");
        v.number("rate_error", held.result.error.rate_error, unit::ratio,
                 "Rms of what the rate is missed by over that of the record about its mean.");
        v.number("torque_error", held.result.error.torque_error, unit::ratio,
                 "The same of the torque.");
      });
  describe_methods(v, section);
  v.group("friction", "By speed.", [&] { describe_friction(v, section); });
  v.texts("impulse_notes", section.impulse ? section.impulse->notes : std::vector<std::string>(),
          "What impulse and friction tests show.");
  v.list("contradictions", section.contradictions,
         "Numbers of the case that the records contradict by more than two combined sigmas, the "
         "worst first.",
         [&](const Contradiction& one) { describe_contradiction(v, one); });
  v.list("advice", advice_of(section),
         "By quantity: which further test would shrink its interval most.",
         [&](const Advice& advice) { describe_advice(v, advice); });
  v.group("plots", "Data of plots, to six digits.", [&] { describe_campaign_plots(v, section); });
}

}  // namespace boresight::io
