#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/commissioning/commissioning.hpp>
#include <boresight/design/studies/change_study.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/linear/dense_response.hpp>

namespace boresight::design {
namespace {

using identification::ServoRecord;
using identification::Signal;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t fewest_plants = 3;  // of plant_band

bool is_stable(const TrackingProblem& problem, const control::Controller& controller) {
  return control::stability(problem.plant, controller, problem.delay, analysis_grid(problem))
      .stable();
}

Signal scaled(const Signal& signal, double factor) {
  return {factor * signal.values, signal.valid};
}

WindyRecord windy_record(const ServoRecord& record, RecordedError kind, double speed_ratio) {
  const auto& error =
      kind == RecordedError::boresight ? record.boresight_error : record.position_error;
  const auto refuse = [&](std::string_view missing) {
    throw InvalidInput(
        fmt::format("{}: expected a column of the {}, found none", record.name, missing));
  };
  if (!error) refuse(to_string(kind));
  if (!record.wind_speed) refuse("wind speed");
  return {record.name, record.sample_time, *error, scaled(*record.wind_speed, speed_ratio),
          record.wind_direction};
}

TrackingProblem on_plant(TrackingProblem problem, const plant::AntennaPlant& plant) {
  problem.plant = plant;
  return problem;
}

// Of one plant: both rms, or NaN.
struct RmsPair {
  double before = not_a_number, after = not_a_number;
  bool stable_after = false;
};

std::optional<PredictedChange> predicted_change(const RmsPair& nominal,
                                                const std::vector<RmsPair>& plants,
                                                const RatioAtSpeed& measured, double confidence) {
  if (!std::isfinite(nominal.before * nominal.after)) return std::nullopt;
  std::vector<double> ratios;
  for (const RmsPair& one : plants) {
    const double ratio = one.after / one.before;
    if (std::isfinite(ratio)) ratios.push_back(ratio);
  }
  PredictedChange result{nominal.before, nominal.after, {}, ratios.size(), false};
  const double ratio = nominal.after / nominal.before;
  result.ratio = {ratio, ratio, ratio};
  if (ratios.size() >= fewest_plants) {
    const PlantBand band = plant_band(ratio, ratios, confidence);
    result.ratio.lower = band.lower;
    result.ratio.upper = band.upper;
  }
  result.held =
      measured.ratio.lower <= result.ratio.upper && result.ratio.lower <= measured.ratio.upper;
  return result;
}

std::optional<bool> within_budget(const ChangeStudy& study) {
  const auto& at = study.comparison.at_design;
  // The encoder does not show the structure's flexure beyond it.
  if (study.error != RecordedError::boresight) return std::nullopt;
  if (!study.budget || !at || at->after_extrapolated) return std::nullopt;
  return at->after.upper <= *study.budget;
}

std::vector<ChangeCheck> checks_of(const ChangeStudy& study) {
  using enum ChangeCheckKind;
  const WindComparison& comparison = study.comparison;
  const auto& at = comparison.at_reference;
  const bool directions = comparison.before.wind_direction && comparison.after.wind_direction;
  return {
      {wind_overlap,
       std::max(comparison.before.slowest, comparison.after.slowest) <=
           equal_wind_range * std::min(comparison.before.fastest, comparison.after.fastest)},
      {wind_direction, directions ? std::optional(!comparison.directions_differ) : std::nullopt},
      {improvement, at ? std::optional(at->change == Change::better) : std::nullopt},
      {prediction, study.predicted ? std::optional(study.predicted->held) : std::nullopt},
      {stability, study.stable_nominal && study.stable_plants == study.plants},
      {design_wind_rms, within_budget(study)},
  };
}

}  // namespace

std::string_view to_string(RecordedError error) {
  return error == RecordedError::boresight ? "boresight error" : "position error";
}

ChangeRecords change_records(const std::vector<ServoRecord>& before,
                             const std::vector<ServoRecord>& after, double speed_ratio) {
  ChangeRecords result;
  const auto has_boresight = [](const ServoRecord& record) {
    return record.boresight_error.has_value();
  };
  const bool boresight =
      std::ranges::all_of(before, has_boresight) && std::ranges::all_of(after, has_boresight);
  result.error = boresight ? RecordedError::boresight : RecordedError::position;
  for (const auto& record : before) {
    result.before.push_back(windy_record(record, result.error, speed_ratio));
  }
  for (const auto& record : after) {
    result.after.push_back(windy_record(record, result.error, speed_ratio));
  }
  return result;
}

double predicted_rms(const TrackingProblem& problem, const control::Controller& controller,
                     RecordedError error, double speed, const control::FrequencyBand& band) {
  if (!is_stable(problem, controller)) return not_a_number;
  constexpr double points_per_decade = 300.0;
  const double decades = std::log10(band.highest / band.lowest);
  const auto points =
      std::max<Eigen::Index>(16, static_cast<Eigen::Index>(std::ceil(points_per_decade * decades)));
  const Eigen::ArrayXd log_hertz =
      Eigen::ArrayXd::LinSpaced(points, std::log(band.lowest), std::log(band.highest));
  const Eigen::ArrayXd hertz = log_hertz.exp();
  const plant::StateSpace loop = control::closed_loop(problem.plant, controller, problem.delay);
  const bool boresight = error == RecordedError::boresight;
  const auto output = plant::output_index(loop, boresight ? "beam" : "encoder");
  WindCondition wind = problem.wind;
  wind.mean_speed = speed;
  Eigen::ArrayXd density = Eigen::ArrayXd::Zero(points);
  plant::DenseResponse response(loop);
  Eigen::ArrayXcd gain(points);
  const auto add = [&](std::string_view input, const Eigen::ArrayXd& source, double direct) {
    response.evaluate(two_pi * hertz, gain, output, plant::input_index(loop, input));
    density += (gain + direct).abs2() * source;
  };
  add("wind_torque", motor_wind_spectrum(wind, problem.gear_ratio, two_pi * hertz), 0.0);
  const auto& noise = problem.noise;
  const auto white = [&](double rms) -> Eigen::ArrayXd {
    return (hertz <= noise.bandwidth)
        .select(Eigen::ArrayXd::Constant(points, rms * rms / noise.bandwidth), 0.0);
  };
  // The recorded position error is that of the angle as read.
  add("encoder_noise", white(noise.encoder_rms), boresight ? 0.0 : 1.0);
  add("tachometer_noise", white(noise.tachometer_rms), 0.0);
  if (std::ranges::find(loop.inputs, "torque_noise") != loop.inputs.end()) {
    add("torque_noise", white(noise.torque_rms), 0.0);
  }
  const Eigen::ArrayXd integrand = density * hertz;  // over ln f
  const double step = log_hertz[1] - log_hertz[0];
  const double variance = step * (integrand.sum() - 0.5 * (integrand[0] + integrand[points - 1]));
  return std::sqrt(variance) / problem.gear_ratio;
}

ChangeStudy study_change(const Mission& mission, const PlantEnsemble& ensemble,
                         const ChangeRecords& records,
                         const std::optional<control::Controller>& before,
                         const control::Controller& after, const ChangeOptions& options) {
  ChangeStudy study;
  study.error = records.error;
  study.design_speed = mission.wind.mean_speed;
  if (!mission.budgets.empty()) study.budget = tightest_budget(mission);
  study.comparison = compare_in_wind(records.before, records.after,
                                     {.confidence = options.confidence,
                                      .reference_speed = options.reference_speed,
                                      .design_speed = study.design_speed});
  const TrackingProblem problem = tracking_problem(mission);
  const auto& at = study.comparison.at_reference;
  const control::FrequencyBand band{study.comparison.lowest, study.comparison.highest};
  const auto rms_on = [&](const plant::AntennaPlant& plant) {
    const TrackingProblem here = on_plant(problem, plant);
    RmsPair pair;
    if (at && before) {
      pair.before = predicted_rms(here, *before, records.error, at->speed, band);
      pair.after = predicted_rms(here, after, records.error, at->speed, band);
      pair.stable_after = std::isfinite(pair.after);
    } else {
      pair.stable_after = is_stable(here, after);
    }
    return pair;
  };
  const RmsPair nominal = rms_on(problem.plant);
  std::vector<RmsPair> plants(ensemble.members.size());
  numerics::for_each_index(plants.size(), options.threads,
                           [&](std::size_t i) { plants[i] = rms_on(ensemble.members[i].plant); });
  study.stable_nominal = nominal.stable_after;
  study.plants = plants.size();
  study.stable_plants =
      static_cast<std::size_t>(std::ranges::count(plants, true, &RmsPair::stable_after));
  if (at) study.predicted = predicted_change(nominal, plants, *at, options.confidence);
  study.checks = checks_of(study);
  return study;
}

}  // namespace boresight::design
