#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <boresight/app/identify/campaign_comparison.hpp>
#include <boresight/app/report/campaign_wording.hpp>
#include <boresight/app/report/json_campaign.hpp>
#include <boresight/app/report/json_number.hpp>

namespace boresight::app {
namespace {

using numerics::Interval;
Json optional_json(const std::optional<Interval>& interval, const std::string& unit) {
  return interval ? interval_json(*interval, unit) : Json(nullptr);
}

std::string unit_or_one(const std::string& unit) {
  return unit.empty() ? "1" : unit;
}

Json difference_json(const std::optional<Difference>& difference) {
  if (!difference) return nullptr;
  return {{"relative_1", number(difference->relative)},
          {"normalised_1", number(difference->normalised)}};
}

Json record_json(const RecordNotes& record) {
  Json sources = Json::array();
  for (const auto& source : record.sources) {
    sources.push_back({{"signal", source.signal},
                       {"column", source.column},
                       {"unit", source.unit},
                       {"guessed", source.guessed},
                       {"remark", text_or_null(source.remark)}});
  }
  Json defects = Json::array();
  for (const auto& defect : record.defects) {
    defects.push_back({{"kind", identification::to_string(defect.kind)},
                       {"handling", identification::to_string(defect.handling)},
                       {"channel", text_or_null(defect.channel)},
                       {"first_sample", defect.first},
                       {"first_time_s", number(defect.first_time)},
                       {"samples", defect.count},
                       {"explanation", defect.explanation}});
  }
  return {{"name", record.name},
          {"path", record.path},
          {"description", record.description},
          {"format", record.format},
          {"bytes", record.bytes},
          {"sha256", record.sha256},
          {"rows", record.rows},
          {"sample_time_s", number(record.sample_time)},
          {"duration_s", number(record.duration)},
          {"test", to_string(record.test)},
          {"test_guessed", record.test_guessed},
          {"rate_loop_closed", record.rate_loop_closed},
          {"rate_loop_guessed", record.rate_loop_guessed},
          {"sources", std::move(sources)},
          {"unused_columns", record.unused_columns},
          {"remarks", record.remarks},
          {"defects", std::move(defects)},
          {"refused_because", text_or_null(record.refusal)}};
}

Json reconciled_json(const CampaignSection& section) {
  if (!section.grey_box) return nullptr;
  const auto& fit = *section.grey_box;
  Json quantities = Json::array();
  for (const auto& q : fit.quantities) {
    quantities.push_back({{"name", q.name},
                          {"posterior", interval_json(q.posterior, unit_or_one(q.unit))},
                          {"prior", interval_json(q.prior, unit_or_one(q.unit))},
                          {"prior_from_drawings", q.prior_from_drawings},
                          {"variance_learnt_1", number(q.learnt)},
                          {"identified", q.identified},
                          {"verdict", verdict(section, q)}});
  }
  Json correlation = Json::array();
  for (Eigen::Index i = 0; i < fit.correlation.rows(); ++i) {
    Json row = Json::array();
    for (const double value : fit.correlation.row(i)) row.push_back(number(value));
    correlation.push_back(std::move(row));
  }
  Json parameters = Json::array();
  for (const auto& p : fit.parameters) {
    parameters.push_back({{"name", p.parameter.name},
                          {"unit", unit_or_one(p.parameter.unit)},
                          {"value_si", number(p.value)},
                          {"prior_si", number(p.parameter.prior)},
                          {"prior_spread_1", number(p.parameter.spread)},
                          {"logarithmic", p.parameter.logarithmic},
                          {"from_drawings", p.parameter.from_drawings},
                          {"departure_1", number(p.departure)},
                          {"remaining_1", number(p.remaining)},
                          {"identified", p.identified}});
  }
  Json residuals = Json::array();
  for (const auto& r : fit.residuals) {
    residuals.push_back({{"record", r.record},
                         {"of", r.pressures ? "pressures" : "rate"},
                         {"unit", r.pressures ? "N m" : "rad/s"},
                         {"rms_si", number(r.rms)},
                         {"counted", r.counted},
                         {"outliers", r.outliers},
                         {"neighbours_correlation_1", number(r.neighbours)},
                         {"effective_1", number(r.effective)},
                         {"white", r.white}});
  }
  Json starts = Json::array();
  for (const auto& start : fit.starts) {
    starts.push_back({{"sum_of_squares_1", number(start.cost)},
                      {"iterations", start.iterations},
                      {"converged", start.converged}});
  }
  return {{"quantities", std::move(quantities)},
          {"correlation_1", std::move(correlation)},
          {"parameters", std::move(parameters)},
          {"residuals", std::move(residuals)},
          {"starts", std::move(starts)},
          {"status", std::string(numerics::describe(fit.status))},
          {"rank", fit.rank},
          {"varied", fit.varied},
          {"condition_1", number(fit.condition)},
          {"variance_inflation_1", number(fit.posterior.inflation)},
          {"records", fit.records},
          {"without_valve", fit.without_valve},
          {"left_out", fit.left_out},
          {"notes", fit.notes}};
}

Json mean_json(const std::optional<identification::ReconciledInertia>& mean) {
  if (!mean) return nullptr;
  const Interval inertia{mean->value, mean->standard_uncertainty, mean->lower, mean->upper};
  return {{"inertia", interval_json(inertia, "kg m2")},
          {"between_methods_kg_m2", number(mean->between_methods)},
          {"cochran_q_1", number(mean->heterogeneity)},
          {"degrees_of_freedom", mean->degrees_of_freedom},
          {"motor_to_load_ratio_1", number(mean->motor_to_load_ratio)},
          {"motor_to_load_ratio_lower_95_1", number(mean->ratio_lower)},
          {"motor_to_load_ratio_upper_95_1", number(mean->ratio_upper)}};
}

Json methods_json(const std::vector<InertiaRow>& rows) {
  Json json = Json::array();
  for (const auto& row : rows) {
    json.push_back({{"name", row.name},
                    {"of_the_paper", row.of_the_paper},
                    {"inertia", interval_json(row.inertia, "kg m2")},
                    {"motor_to_load_ratio", interval_json(row.motor_to_load_ratio, "1")},
                    {"difference", difference_json(row.difference)},
                    {"assumes", row.assumes},
                    {"why", row.why}});
  }
  return json;
}

Json lines_json(const SloshTest& test) {
  Json lines = Json::array();
  for (const auto& line : test.result.lines) {
    lines.push_back({{"motor", line.motor + 1},
                     {"side", line.side == identification::LineSide::inlet ? "inlet" : "outlet"},
                     {"length_si", line.length ? number(line.length->value) : Json(nullptr)},
                     {"frequency", interval_json(line.frequency, "Hz")},
                     {"damping_ratio", interval_json(line.damping_ratio, "1")},
                     {"events", line.events},
                     {"between_events_Hz", number(line.between_events)},
                     {"wave_speed", optional_json(line.wave_speed, "m/s")},
                     {"bulk_modulus", optional_json(line.bulk_modulus, "Pa")}});
  }
  Json extremes = nullptr;
  if (const auto& extreme = test.result.extreme_lines) {
    extremes = {{"highest_frequency_Hz", number(extreme->highest_frequency)},
                {"lowest_frequency_Hz", number(extreme->lowest_frequency)},
                {"bulk_modulus_shortest", interval_json(extreme->bulk_modulus_shortest, "Pa")},
                {"bulk_modulus_longest", interval_json(extreme->bulk_modulus_longest, "Pa")},
                {"mean", interval_json(extreme->mean, "Pa")}};
  }
  return {{"record", test.record},
          {"lines", std::move(lines)},
          {"extreme_lines", std::move(extremes)},
          {"bulk_modulus", optional_json(test.result.bulk_modulus, "Pa")},
          {"wave_speed", optional_json(test.result.wave_speed, "m/s")},
          {"notes", test.result.notes}};
}

Json friction_json(const CampaignSection& section) {
  Json rows = Json::array();
  for (const auto& row : section.friction) {
    rows.push_back({{"rate_rad_per_s", number(row.rate)},
                    {"tracking", row.tracking},
                    {"extrapolated", row.extrapolated},
                    {"reconciled", optional_json(row.reconciled, "N m")},
                    {"curve", optional_json(row.curve, "N m")},
                    {"constant_speed", optional_json(row.tested, "N m")}});
  }
  Json json{{"rows", std::move(rows)}, {"constant_speed_line", nullptr}, {"slow_ramp", nullptr}};
  if (!section.impulse) return json;
  if (const auto& tests = section.impulse->constant_speed; tests && tests->has_line) {
    json["constant_speed_line"] = {{"coulomb", interval_json(tests->intercept, "N m")},
                                   {"slope", interval_json(tests->slope, "N m s/rad")},
                                   {"offset", interval_json(tests->offset, "N m")},
                                   {"largest_misfit_N_m", number(tests->line_misfit)}};
  }
  if (const auto& ramp = section.impulse->slow_ramp) {
    json["slow_ramp"] = {{"breakaway", interval_json(ramp->breakaway, "N m")},
                         {"coulomb", interval_json(ramp->coulomb, "N m")},
                         {"offset", interval_json(ramp->offset, "N m")}};
  }
  return json;
}

Json advice_json(const CampaignSection& section) {
  Json json = Json::array();
  if (!section.grey_box) return json;
  const auto& quantities = section.grey_box->quantities;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    if (!advised_quantity(quantities[q].name)) continue;
    Json tests = Json::array();
    for (const auto* gain : ranked(section.test_gains, q)) {
      tests.push_back({{"test", gain->test},
                       {"kind", to_string(gain->kind)},
                       {"done_before", gain->done_before},
                       {"interval_remaining_1", number(gain->remaining[q])}});
    }
    json.push_back({{"quantity", quantities[q].name}, {"tests", std::move(tests)}});
  }
  return json;
}

}  // namespace

Json interval_json(const Interval& interval, const std::string& unit) {
  return {{"unit", unit},
          {"value_si", number(interval.value)},
          {"standard_uncertainty_si", number(interval.standard_uncertainty)},
          {"lower_95_si", number(interval.lower)},
          {"upper_95_si", number(interval.upper)}};
}

Json campaign_json(const CampaignSection& section) {
  Json records = Json::array();
  for (const auto& record : section.notes.records) records.push_back(record_json(record));
  Json failures = Json::array();
  for (const auto& failure : section.failures) {
    failures.push_back({{"method", failure.method}, {"reason", failure.reason}});
  }
  Json quantities = Json::array();
  for (const auto& row : section.quantities) {
    quantities.push_back({{"quantity", row.quantity},
                          {"method", row.method},
                          {"estimate", interval_json(row.interval, unit_or_one(row.unit))},
                          {"difference", difference_json(row.difference)}});
  }
  Json slosh = Json::array();
  for (const auto& test : section.slosh) slosh.push_back(lines_json(test));
  Json contradicted = Json::array();
  for (const auto& one : section.contradictions) {
    contradicted.push_back({{"key", one.key},
                            {"stated", one.stated},
                            {"assumed", one.assumed},
                            {"unit", one.unit},
                            {"stated_si", number(one.stated_value)},
                            {"stated_uncertainty_si", number(one.stated_uncertainty)},
                            {"records", interval_json(one.records, one.unit)},
                            {"by", one.by},
                            {"normalised_1", number(one.normalised)}});
  }
  Json resonance = nullptr;
  if (section.resonance) {
    const auto& found = *section.resonance;
    resonance = {{"stiffness", interval_json(found.stiffness, "N m/rad")},
                 {"expected_frequency_Hz", number(found.expected_frequency)},
                 {"frequency", optional_json(found.frequency, "Hz")},
                 {"damping_ratio", optional_json(found.damping_ratio, "1")},
                 {"coupled_over_rigid_frequency_1", number(found.coupled_over_rigid)},
                 {"notes", found.notes}};
  }
  Json held = nullptr;
  if (section.hold_out) {
    held = {{"record", section.hold_out->record},
            {"rate_error_1", number(section.hold_out->result.error.rate_error)},
            {"torque_error_1", number(section.hold_out->result.error.torque_error)}};
  }
  return {{"not_identifiable", section.not_identifiable},
          {"records", std::move(records)},
          {"assumptions", section.notes.assumptions},
          {"reconciled", reconciled_json(section)},
          {"mean_of_methods", mean_json(section.mean_of_methods)},
          {"hold_out", std::move(held)},
          {"methods", methods_json(section.inertia)},
          {"methods_not_done", std::move(failures)},
          {"quantities", std::move(quantities)},
          {"bulk_modulus", interval_json(section.bulk_modulus, "Pa")},
          {"bulk_modulus_stated", section.bulk_modulus_stated},
          {"slosh", std::move(slosh)},
          {"resonance", std::move(resonance)},
          {"friction", friction_json(section)},
          {"impulse_notes", section.impulse ? Json(section.impulse->notes) : Json(Json::array())},
          {"contradictions", std::move(contradicted)},
          {"advice", advice_json(section)},
          {"plots", campaign_plots_json(section)}};
}

}  // namespace boresight::app
