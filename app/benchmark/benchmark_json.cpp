#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include <boresight/app/benchmark/benchmark_report.hpp>
#include <boresight/app/figures/figure_json.hpp>
#include <boresight/app/report/json_design.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

constexpr double per_meganewton = 1e6 / millidegree;  // rad/(N m) to mdeg/(MN m)

Json optional_number(const std::optional<double>& value, double unit = 1.0) {
  return value ? number(*value / unit) : Json(nullptr);
}

Json course_json(const control::CourseScore& course, const std::string& unit, double torque) {
  return {{"peak_mdeg_per_" + unit, number(course.peak * per_meganewton)},
          {"time_of_peak_s", number(course.time_of_peak)},
          {"final_mdeg_per_" + unit, number(course.final_value * per_meganewton)},
          {"return_time_s", optional_number(course.return_time)},
          {"squared_error_integral_mdeg2_s_per_" + unit + "_squared",
           number(course.integral_squared_error * std::pow(per_meganewton, 2))},
          {"peak_at_design_torque_mdeg", number(course.peak * torque / millidegree)},
          {"watched_s", number(course.horizon)}};
}

Json break_json(const design::BreakScore& score) {
  Json json{{"loop_break", control::to_string(score.loop_break)},
            {"exists", score.margins.has_value()}};
  if (!score.margins) return json;
  const auto& margins = *score.margins;
  const auto decibel = [](double factor) { return number(20.0 * std::log10(factor)); };
  json["sensitivity_peak_1"] = number(margins.sensitivity.magnitude);
  json["sensitivity_peak_frequency_Hz"] = number(margins.sensitivity.frequency / two_pi);
  json["increasing_gain_margin_dB"] = decibel(margins.increasing_gain_margin);
  json["decreasing_gain_margin_dB"] = decibel(margins.decreasing_gain_margin);
  json["phase_margin_deg"] = number(margins.phase_margin_deg);
  json["delay_margin_s"] = number(margins.delay_margin);
  return json;
}

std::string condition_of(const design::WindScore& wind) {
  return fmt::format("{}, {:g} m/s{}{}", plant::to_string(wind.model), wind.mean_speed,
                     wind.attitude.empty() ? "" : ", ", wind.attitude);
}

Json wind_json(const design::WindScore& wind) {
  return {{"condition", condition_of(wind)},
          {"wind_model", plant::to_string(wind.model)},
          {"mean_speed_m_per_s", wind.mean_speed},
          {"torque_coefficient_1", number(wind.torque_coefficient)},
          {"torque_rms_N_m", number(wind.torque_rms)},
          {"wind_rms_mdeg", number(wind.wind_rms / millidegree)},
          {"beam_rms_mdeg", number(wind.beam_rms / millidegree)}};
}

Json time_json(const TimeDomainSection& section) {
  const auto& result = section.result;
  Json hunting = Json::array();
  for (const auto& one : result.hunting) {
    hunting.push_back({{"motion", one.rate == 0.0 ? "at rest" : "at the tracking rate"},
                       {"rate_mdeg_per_s", number(one.rate / millidegree)},
                       {"status", design::to_string(one.status)},
                       {"limit_cycle", one.limit_cycle},
                       {"beam_amplitude_mdeg", number(one.beam_amplitude / millidegree)},
                       {"frequency_Hz", optional_number(one.frequency)}});
  }
  Json json{{"simulated_beam_rms_mdeg", number(result.wind.beam_rms / millidegree)},
            {"linear_prediction_mdeg", number(result.wind.predicted_rms / millidegree)},
            {"hunting", std::move(hunting)},
            {"reversal_beam_error_mdeg", nullptr},
            {"reversal_encoder_error_mdeg", nullptr}};
  if (result.reversal) {
    json["reversal_beam_error_mdeg"] = number(result.reversal->beam_error / millidegree);
    json["reversal_encoder_error_mdeg"] = number(result.reversal->encoder_error / millidegree);
  }
  return json;
}

Json ensemble_json(const BenchmarkReport& report, const design::RejectionEnsemble& ensemble) {
  Json members = Json::array();
  for (const auto& member : ensemble.members) {
    Json peaks = Json::array();
    for (const double peak : member.sensitivity_peaks) peaks.push_back(number(peak));
    members.push_back({{"name", member.name},
                       {"stable", member.stable},
                       {"within_goals", member.within_goals},
                       {"beam_rms_mdeg", number(member.beam_rms / millidegree)},
                       {"valve_effort_rad_per_s", number(member.valve_effort)},
                       {"sensitivity_peaks_1", std::move(peaks)}});
  }
  const auto count = static_cast<double>(ensemble.members.size());
  return {{"source", report.ensemble_source},
          {"stable_share_1", number(ensemble.stable / count)},
          {"within_goals_share_1", number(ensemble.within_goals / count)},
          {"largest_beam_rms_mdeg", number(ensemble.largest_rms / millidegree)},
          {"members", std::move(members)}};
}

Json score_json(const BenchmarkReport& report) {
  const design::RejectionScore& score = report.score;
  if (!score.stable) return nullptr;
  const double torque = score.design_wind.torque_rms;
  Json json;
  json["torque_step"] = course_json(score.step, "MN_m", torque);
  json["torque_impulse"] = course_json(score.impulse, "MN_m_s", torque);
  json["compliance"] = {
      {"worst_at_least_mdeg_per_MN_m", number(score.worst.lower * per_meganewton)},
      {"worst_at_most_mdeg_per_MN_m", number(score.worst.upper * per_meganewton)},
      {"worst_frequency_Hz", number(score.worst.frequency / two_pi)},
      {"static_mdeg_per_MN_m", number(score.static_compliance * per_meganewton)},
      {"encoder_held_mdeg_per_MN_m", number(score.encoder_held_compliance * per_meganewton)},
      {"worst_to_encoder_held_1", number(score.worst.lower / score.encoder_held_compliance)},
      {"step_peak_to_encoder_held_1", number(score.step.peak / score.encoder_held_compliance)}};
  Json breaks = Json::array();
  for (const auto& one : score.breaks) breaks.push_back(break_json(one));
  json["loop_breaks"] = std::move(breaks);
  json["noise"] = {{"beam_rms_mdeg", number(score.noise_rms / millidegree)},
                   {"valve_effort_rad_per_s", number(score.valve_effort)}};
  json["design_wind"] = wind_json(score.design_wind);
  json["design_wind"]["lyapunov_beam_rms_mdeg"] = number(score.lyapunov_rms / millidegree);
  Json winds = Json::array();
  for (const auto& wind : score.winds) winds.push_back(wind_json(wind));
  json["winds"] = std::move(winds);
  Json budgets = Json::array();
  for (std::size_t i = 0; i < score.budget_speeds.size(); ++i) {
    budgets.push_back({{"name", report.budgets[i].name},
                       {"band", report.budgets[i].band},
                       {"rms_mdeg", number(report.budgets[i].rms / millidegree)},
                       {"convention", report.budgets[i].convention},
                       {"wind_speed_limit_m_per_s", number(score.budget_speeds[i])}});
  }
  json["budgets"] = std::move(budgets);
  json["reference"] = nullptr;
  if (score.reference) {
    const auto& reference = *score.reference;
    const double rms = score.design_wind.beam_rms;
    const auto ratio = [&](const std::optional<double>& to) {
      return to && *to > 0.0 ? number(rms / *to) : Json(nullptr);
    };
    json["reference"] = {
        {"encoder_held_rms_mdeg", number(reference.encoder_held_rms / millidegree)},
        {"least_rms_mdeg", optional_number(reference.least_rms, millidegree)},
        {"least_rms_at_own_effort_mdeg",
         optional_number(reference.least_rms_at_own_effort, millidegree)},
        {"to_encoder_held_1", ratio(reference.encoder_held_rms)},
        {"to_least_1", ratio(reference.least_rms)},
        {"to_least_at_own_effort_1", ratio(reference.least_rms_at_own_effort)}};
  }
  json["ensemble"] = score.ensemble ? ensemble_json(report, *score.ensemble) : Json(nullptr);
  json["nonlinear"] = report.time_domain ? time_json(*report.time_domain) : Json(nullptr);
  Json curve = Json::array();
  for (const auto& point : score.compliance) {
    curve.push_back({{"frequency_Hz", number(point.frequency)},
                     {"compliance_mdeg_per_MN_m", number(point.compliance * per_meganewton)}});
  }
  json["compliance_curve"] = std::move(curve);
  return json;
}

// Every number of a score by its place; things of a list by the first text they hold.
void flatten(const Json& json, const std::string& place, std::vector<std::string>& order,
             std::map<std::string, double>& numbers) {
  if (json.is_number()) {
    if (numbers.emplace(place, json.get<double>()).second) order.push_back(place);
  } else if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      flatten(value, place.empty() ? key : fmt::format("{}.{}", place, key), order, numbers);
    }
  } else if (json.is_array()) {
    std::size_t index = 0;
    for (const auto& value : json) {
      std::string name = fmt::format("{}", ++index);
      if (value.is_object()) {
        for (const auto& [key, inner] : value.items()) {
          if (!inner.is_string()) continue;
          name = inner.get<std::string>();
          break;
        }
      }
      flatten(value, fmt::format("{}[{}]", place, name), order, numbers);
    }
  }
}

Json comparison_json(const BenchmarkReport& report) {
  if (report.compared_with.empty()) return nullptr;
  Json rows = Json::array();
  for (const auto& row : report.comparison) {
    const bool both = row.own && row.other && *row.other != 0.0;
    rows.push_back({{"quantity", row.quantity},
                    {"this", optional_number(row.own)},
                    {"other", optional_number(row.other)},
                    {"ratio_1", both ? number(*row.own / *row.other) : Json(nullptr)}});
  }
  return {{"with", report.compared_with}, {"quantities", std::move(rows)}};
}

ComparedSheet sheet_of(const Json& score, std::string_view wind_model) {
  ComparedSheet sheet;
  for (const auto& point : score.value("compliance_curve", Json::array())) {
    if (!point.at("compliance_mdeg_per_MN_m").is_number()) continue;
    sheet.frequency.push_back(point.at("frequency_Hz").get<double>());
    sheet.compliance.push_back(point.at("compliance_mdeg_per_MN_m").get<double>());
  }
  for (const auto& wind : score.value("winds", Json::array())) {
    const double speed = wind.at("mean_speed_m_per_s").get<double>();
    // The case's own coefficient: conditions of an attitude say more behind the speed.
    const bool own = wind.at("condition") == fmt::format("{}, {:g} m/s", wind_model, speed);
    if (!own || !wind.at("beam_rms_mdeg").is_number()) continue;
    sheet.wind_speed.push_back(speed);
    sheet.beam_rms.push_back(wind.at("beam_rms_mdeg").get<double>());
  }
  return sheet;
}

}  // namespace

std::string to_json(const BenchmarkReport& report) {
  const auto& system = report.controller.system;
  const design::RejectionScore& score = report.score;
  Json assumed = Json::array();
  for (const auto& quantity : report.assumed) {
    assumed.push_back({{"key", quantity.key}, {"as_written", quantity.text}});
  }
  Json json;
  json["program"] = "boresight";
  json["version"] = BORESIGHT_VERSION;
  json["command"] = "benchmark";
  json["protocol_version"] = design::rejection_protocol;
  json["case"] = {{"path", report.case_path}, {"title", report.title}, {"axis", report.axis}};
  json["seed"] = report.seed;
  json["interrupted"] = report.interrupted;
  json["left_out"] = score.left_out;
  json["controller"] = {
      {"description", report.controller.description},
      {"form", system.sample_time > 0.0 ? "sampled" : "continuous"},
      {"sample_time_s", system.sample_time > 0.0 ? number(system.sample_time) : Json(nullptr)},
      {"dead_time_s", number(report.dead_time)},
      {"states", system.a.rows()},
      {"inputs", system.inputs},
      {"outputs", system.outputs},
      {"remarks", report.controller.remarks}};
  json["conditions"] = {{"plant_from_records", report.from_records},
                        {"wind_model", plant::to_string(report.wind.model)},
                        {"design_wind_speed_m_per_s", report.wind.mean_speed},
                        {"torque_coefficient_1", number(report.wind.site.torque_coefficient)},
                        {"design_torque_rms_N_m",
                         score.stable ? number(score.design_wind.torque_rms) : Json(nullptr)},
                        {"attitudes", report.attitudes},
                        {"gear_ratio_1", number(report.gear_ratio)},
                        {"band_lowest_Hz", number(report.rms_band.lowest)},
                        {"band_highest_Hz", number(report.rms_band.highest)},
                        {"return_share_1", control::CourseOptions{}.return_share}};
  json["stability"] = {{"stable", score.stable},
                       {"slowest_pole_per_s", number(score.abscissa)},
                       {"rate_loop_alone_stable",
                        score.rate_loop_stable ? Json(*score.rate_loop_stable) : Json(nullptr)}};
  json["score"] = score_json(report);
  json["no_nonlinear_score"] = text_or_null(report.no_time_domain);
  json["comparison"] = comparison_json(report);
  json["figures"] = figures_json(report.figures);
  json["assumed_inputs"] = std::move(assumed);
  return json.dump(2) + "\n";
}

void compare_with(BenchmarkReport& report, const std::string& other_json, const std::string& name) {
  Json other;
  try {
    other = Json::parse(other_json);
    if (other.at("command") != "benchmark") throw InvalidInput("another command");
    const auto protocol = other.at("protocol_version").get<long long>();
    if (protocol != design::rejection_protocol) {
      throw InvalidInput(fmt::format(
          "{}: expected a score sheet of protocol {}, found protocol {}: scores of different "
          "protocols do not compare",
          name, design::rejection_protocol, protocol));
    }
    if (!other.at("score").is_object()) {
      throw InvalidInput(
          fmt::format("{}: expected a score, found none: its loop is unstable", name));
    }
    report.compared_with =
        fmt::format("{}: {}, {}", name, other.at("case").at("title").get<std::string>(),
                    other.at("controller").at("description").get<std::string>());
    if (other.at("conditions").at("plant_from_records").get<bool>() != report.from_records) {
      report.compared_with += report.from_records
                                  ? "; its plant is the one that its case states"
                                  : "; its plant is the one that its case's records show";
    }
    report.compared_sheet = sheet_of(other.at("score"), plant::to_string(report.wind.model));
  } catch (const Json::exception&) {
    throw InvalidInput(
        fmt::format("{}: expected a score sheet (JSON of boresight benchmark), found none", name));
  } catch (const InvalidInput& error) {
    if (std::string(error.what()) != "another command") throw;
    throw InvalidInput(fmt::format(
        "{}: expected a score sheet (JSON of boresight benchmark), found a report of another "
        "command",
        name));
  }
  std::vector<std::string> order;
  std::map<std::string, double> own, theirs;
  flatten(score_json(report), "", order, own);
  flatten(other.at("score"), "", order, theirs);
  report.comparison.clear();
  const auto value = [](const std::map<std::string, double>& from, const std::string& place) {
    const auto found = from.find(place);
    return found == from.end() ? std::nullopt : std::optional(found->second);
  };
  for (const auto& place : order) {
    const bool seen = std::ranges::find(report.comparison, place, &ComparedQuantity::quantity) !=
                      report.comparison.end();
    if (seen || place.starts_with("compliance_curve") || place.starts_with("ensemble.members")) {
      continue;
    }
    report.comparison.push_back({place, value(own, place), value(theirs, place)});
  }
}

}  // namespace boresight::app
