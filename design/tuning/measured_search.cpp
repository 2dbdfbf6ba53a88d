#include <algorithm>
#include <cmath>
#include <random>

#include <boresight/control/measured/measured_confidence.hpp>
#include <boresight/design/tuning/controller_search.hpp>
#include <boresight/design/tuning/measured_search.hpp>

namespace boresight::design {
namespace {

using control::LoopEvaluation;

constexpr std::size_t breaks = control::loop_breaks.size();
constexpr std::size_t max_peaks = control::PeakList::maximum;
// ln of a peak or an effort over its limit is kept below minus this, so that what is recorded
// meets the goals by other code too.
constexpr double reserve = 1e-4;

// The members' rms and peaks as FeasibleSearch wants them. The first member is the measured
// response itself: rms and effort are its.
ConstrainedProblem search_problem(std::vector<MeasuredMember>& members,
                                  const control::LoopStructure& structure,
                                  const MeasuredConstraints& goals) {
  ConstrainedProblem search;
  for (const auto& gain : control::gain_descriptions(structure)) {
    search.lower.push_back(std::log(gain.lower));
    search.upper.push_back(std::log(gain.upper));
  }
  search.constraints = 1 + members.size() * breaks * max_peaks;
  search.evaluate = [&members, structure, goals](const std::vector<double>& point,
                                                 ConstrainedValues& values) {
    const control::Controller controller = controller_at(structure, point);
    const std::size_t size = point.size();
    std::ranges::fill(values.constraints, -1.0);
    std::ranges::fill(values.constraint_gradients, 0.0);
    for (std::size_t m = 0; m < members.size(); ++m) {
      const LoopEvaluation evaluation = members[m].evaluator.evaluate(controller, true);
      if (!evaluation.stable()) return false;
      if (m == 0) {
        const double variance = evaluation.boresight_variance();
        values.objectives[0] = 0.5 * std::log(variance);
        const double effort = evaluation.effort_variance;
        if (effort > 0.0) {
          values.constraints[0] = 0.5 * std::log(effort) - std::log(goals.control_effort) + reserve;
        }
        for (std::size_t k = 0; k < size; ++k) {
          values.objective_gradients[k] =
              0.5 * (evaluation.wind_log_gradient[k] + evaluation.noise_log_gradient[k]) / variance;
          if (effort > 0.0) {
            values.constraint_gradients[k] = 0.5 * evaluation.effort_log_gradient[k] / effort;
          }
        }
      }
      for (std::size_t b = 0; b < breaks; ++b) {
        if (!members[m].looked_at[b]) continue;
        const auto& peaks = evaluation.peaks[b];
        for (std::size_t j = 0; j < peaks.size(); ++j) {
          const std::size_t row = 1 + (m * breaks + b) * max_peaks + j;
          values.constraints[row] =
              std::log(peaks[j].magnitude / goals.sensitivity_peak[b]) + reserve;
          for (std::size_t k = 0; k < size; ++k) {
            values.constraint_gradients[row * size + k] = peaks[j].log_gradient[k];
          }
        }
      }
    }
    return true;
  };
  return search;
}

void count(const FeasibleSearch& search, MeasuredTuningResult& result) {
  result.evaluations += search.evaluations();
  result.stopped = result.stopped || search.stopped();
}

}  // namespace

control::LoopEvaluator measured_evaluator(const MeasuredProblem& problem,
                                          const control::LoopChannels& channels,
                                          control::FrequencyBand band) {
  return {channels,
          {.delay = problem.delay,
           .noise = problem.noise,
           .wind_spectrum =
               motor_wind_spectrum(problem.wind, problem.gear_ratio, channels.response.frequency),
           .band = band}};
}

MeasuredSearch::MeasuredSearch(const MeasuredProblem& problem,
                               const control::LoopStructure& structure,
                               const MeasuredConstraints& goals,
                               const MeasuredTuningOptions& options)
    : problem_(problem), structure_(structure), goals_(goals), options_(options) {
  search_options_.evaluations_per_run = options.evaluations_per_run;
  search_options_.stop = options.stop;
}

std::vector<SearchPoint> MeasuredSearch::from_everywhere(MeasuredTuningResult& result) {
  std::vector<MeasuredMember> members{
      measured(measured_grid(problem_, options_.search_points_per_decade, false))};
  FeasibleSearch search(search_problem(members, structure_, goals_), search_options_);
  std::mt19937_64 generator(options_.seed);
  std::vector<double> anchor;
  for (int trial = 0; trial < 2000 && anchor.empty() && !search.stopped(); ++trial) {
    const auto point = search.random_point(generator);
    if (search.evaluate(point) != nullptr) anchor = point;
  }
  std::vector<SearchPoint> found;
  for (int start = 0; start < options_.starts && !anchor.empty() && !search.stopped(); ++start) {
    const auto from = search.backtrack(search.random_point(generator), anchor);
    if (auto best = search.search_from(from)) found.push_back(std::move(*best));
    ++result.starts;
  }
  count(search, result);
  std::ranges::stable_sort(found, {}, &SearchPoint::cost);
  result.starts_at_optimum = static_cast<int>(std::ranges::count_if(
      found, [&](const auto& one) { return one.cost < found.front().cost + std::log(1.01); }));
  std::vector<SearchPoint> distinct;
  for (const auto& one : found) {
    constexpr std::size_t maximum = 3;
    const bool copy = !distinct.empty() && one.cost < distinct.back().cost + 1e-4;
    if (!copy && distinct.size() < maximum) distinct.push_back(one);
  }
  if (const auto& nearest = search.nearest(); distinct.empty() && nearest) {
    distinct.push_back(*nearest);
  }
  return distinct;
}

std::optional<SearchPoint> MeasuredSearch::refine(std::vector<MeasuredMember>& members,
                                                  const std::vector<std::vector<double>>& starts,
                                                  MeasuredTuningResult& result) {
  FeasibleSearch search(search_problem(members, structure_, goals_), search_options_);
  // A start that is unstable with one of the members is pulled back to the first.
  for (const auto& start : starts) search.search_from(search.backtrack(start, starts.front()));
  count(search, result);
  return search.best() ? search.best() : search.nearest();
}

MeasuredMember MeasuredSearch::measured(const Eigen::ArrayXd& grid) const {
  return {measured_evaluator(problem_, problem_.channels.on(grid), problem_.rms_band),
          {true, true, true}};
}

MeasuredMember MeasuredSearch::least_favourable(const control::Controller& controller,
                                                std::size_t b, double radius,
                                                const Eigen::ArrayXd& grid) const {
  MeasuredMember member{
      measured_evaluator(problem_,
                         control::least_favourable(problem_.channels, controller, problem_.delay,
                                                   control::loop_breaks[b], radius, grid),
                         problem_.rms_band),
      {}};
  member.looked_at[b] = true;
  member.evaluator.look_at(member.looked_at);
  return member;
}

control::Controller MeasuredSearch::controller_of(const SearchPoint& point) const {
  return controller_at(structure_, point.point);
}

}  // namespace boresight::design
