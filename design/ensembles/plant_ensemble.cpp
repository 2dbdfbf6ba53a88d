#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <fmt/format.h>

#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/tuning/plant_evaluator.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

MemberResult evaluate_member(TrackingProblem problem, const EnsembleMember& member,
                             const control::Controller& controller, const Constraints& goals,
                             const WindTable& wind) {
  problem.plant = member.plant;
  PlantEvaluator plant(member.name, problem, goals, wind);
  const PlantEvaluation& plant_evaluation = plant.evaluate(controller, false);
  MemberResult result;
  result.name = member.name;
  result.stable = plant_evaluation.stable && plant.stable_by_eigenvalues(controller);
  if (!result.stable) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    result.boresight_rms = result.control_effort = none;
    result.sensitivity_peaks.fill(none);
    result.worst_constraint = std::numeric_limits<double>::infinity();
    return result;
  }
  const control::LoopEvaluation& evaluation = plant_evaluation.evaluation;
  result.boresight_rms = std::sqrt(evaluation.boresight_variance()) / problem.gear_ratio;
  result.control_effort = std::sqrt(evaluation.effort_variance);
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    result.sensitivity_peaks[b] = evaluation.highest_peak(control::loop_breaks[b]);
  }
  result.worst_constraint = plant_evaluation.worst_ratio();
  return result;
}

// Every frequency of the structure by a factor, its damping ratios as they are.
void scale_frequencies(plant::Structure& structure, double factor) {
  const double square = factor * factor;
  structure.gear_stiffness *= square;
  structure.gear_damping *= factor;
  for (auto& mode : structure.modes) {
    mode.stiffness *= square;
    mode.damping *= factor;
  }
}

// One value in each of `count` equal parts of [0, 1], in random order.
std::vector<double> stratified(std::size_t count, std::mt19937_64& generator) {
  // 53 random bits, so that the sequence does not depend on the standard library.
  const auto uniform = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = (static_cast<double>(i) + uniform()) / static_cast<double>(count);
  }
  for (std::size_t i = count; i-- > 1;) std::swap(values[i], values[generator() % (i + 1)]);
  return values;
}

}  // namespace

std::vector<EnsembleMember> reference_ensemble(const TrackingProblem& problem, std::uint64_t seed) {
  const plant::AntennaPlant& nominal = problem.plant;
  if (!(nominal.drive.leakage_rate > 0.0)) {
    throw InvalidInput(
        fmt::format("reference_ensemble: expected a leakage rate above 0, found {:g}",
                    nominal.drive.leakage_rate));
  }
  constexpr double low_frequency = 0.95, high_frequency = 1.05;
  constexpr double soft = 0.8, stiff = 1.33;
  constexpr double low_leakage = 0.366 / 1.219;
  constexpr double max_friction = 12.0;  // N m s/rad
  std::vector<EnsembleMember> members{{"nominal", nominal}};
  const auto add = [&](std::string name, double frequency, double stiffness, double leakage,
                       double friction) {
    EnsembleMember member{std::move(name), nominal};
    scale_frequencies(member.plant.structure, frequency);
    member.plant.drive.oil_stiffness *= stiffness;
    member.plant.drive.leakage_rate *= leakage;
    member.plant.drive.viscous_friction = friction;
    members.push_back(std::move(member));
  };
  const double as_it_is = nominal.drive.viscous_friction;
  add("structure frequencies x 0.95", low_frequency, 1.0, 1.0, as_it_is);
  add("structure frequencies x 1.05", high_frequency, 1.0, 1.0, as_it_is);
  add("oil stiffness x 0.8", 1.0, soft, 1.0, as_it_is);
  add("oil stiffness x 1.33", 1.0, stiff, 1.0, as_it_is);
  add("low leakage", 1.0, 1.0, low_leakage, as_it_is);
  constexpr std::size_t random_samples = 24;
  std::mt19937_64 generator(seed);
  const auto frequency = stratified(random_samples, generator),
             stiffness = stratified(random_samples, generator),
             leakage = stratified(random_samples, generator),
             friction = stratified(random_samples, generator);
  for (std::size_t i = 0; i < random_samples; ++i) {
    const double f = low_frequency + (high_frequency - low_frequency) * frequency[i];
    const double k = soft + (stiff - soft) * stiffness[i];
    const double l = low_leakage + (1.0 - low_leakage) * leakage[i];
    const double b = max_friction * friction[i];
    add(fmt::format("f x {:.3f}, K x {:.3f}, leakage x {:.3f}, friction {:.2f}", f, k, l, b), f, k,
        l, b);
  }
  return members;
}

EnsembleResult evaluate(const TrackingProblem& problem, const std::vector<EnsembleMember>& members,
                        const control::Controller& controller, const Constraints& goals,
                        unsigned threads) {
  if (members.empty()) throw InvalidInput("evaluate: expected at least one member, found none");
  control::validate(controller);
  EnsembleResult result;
  result.members.resize(members.size());
  const WindTable wind(problem);
  numerics::for_each_index(members.size(), threads, [&](std::size_t i) {
    result.members[i] = evaluate_member(problem, members[i], controller, goals, wind);
  });

  // A goal met to the last digit by the tuner is met.
  constexpr double rounding = 1e-6;
  std::vector<double> rms;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const MemberResult& member = result.members[i];
    const double farthest = result.members[result.worst].worst_constraint;
    if (member.worst_constraint > farthest * (1.0 + rounding)) result.worst = i;
    if (member.worst_constraint <= 1.0 + rounding) ++result.within_constraints;
    if (member.stable) rms.push_back(member.boresight_rms);
  }
  result.stable = static_cast<int>(rms.size());
  result.min_rms = result.median_rms = result.high_rms = result.largest_rms =
      std::numeric_limits<double>::quiet_NaN();
  if (rms.empty()) return result;
  std::ranges::sort(rms);
  const auto quantile = [&](double fraction) {
    return rms[static_cast<std::size_t>(
        std::lround(fraction * static_cast<double>(rms.size() - 1)))];
  };
  result.min_rms = rms.front();
  result.median_rms = quantile(0.5);
  result.high_rms = quantile(0.95);
  result.largest_rms = rms.back();
  return result;
}

double rms_over_members(const EnsembleResult& ensemble) {
  double sum = 0.0;
  for (const auto& member : ensemble.members) {
    if (!member.stable) return std::numeric_limits<double>::infinity();
    sum += member.boresight_rms * member.boresight_rms;
  }
  return std::sqrt(sum / static_cast<double>(ensemble.members.size()));
}

}  // namespace boresight::design
