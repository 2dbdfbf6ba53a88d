#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <numbers>
#include <optional>
#include <random>

#include <fmt/format.h>
#include <nlopt.hpp>

#include <boresight/control/closed_loop.hpp>
#include <boresight/design/tuner.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::design {
namespace {

using control::LoopEvaluation;
constexpr unsigned peaks_per_break = 3;
constexpr unsigned constraint_count = 3 * peaks_per_break + 1;
// What an unstable loop counts as: finite, far above any stable loop's, so a line search backs off.
constexpr double unstable_penalty = 5.0;
// Peaks are read off a parabola through grid points; what it can miss is kept in hand, so that the
// exact peak meets the goal.
constexpr double peak_reserve = 5e-5;

struct Candidate {
  control::ControlLaw law;
  LoopEvaluation evaluation;
};

// A search is started again from where it stopped, at most so often and while it gains so much.
constexpr int most_restarts = 4;
constexpr double worthwhile = 0.998;

// Keeps the record of one tuning and answers the optimiser's callbacks.
class Search {
 public:
  Search(control::LoopEvaluator& evaluator, const control::LoopStructure& structure,
         const HardGoals& goals)
      : evaluator_(evaluator),
        goals_(goals),
        descriptions_(control::gain_descriptions(structure)),
        size_(static_cast<unsigned>(descriptions_.size())) {
    law_.structure = structure;
    law_.gains.resize(size_);
    for (const auto& description : descriptions_) {
      lower_.push_back(std::log(description.lower));
      upper_.push_back(std::log(description.upper));
    }
  }

  std::vector<double> random_point(std::mt19937_64& generator) const {
    std::vector<double> point(size_);
    for (unsigned k = 0; k < size_; ++k) {
      // 53 random bits, so that the sequence does not depend on the standard library.
      const double share = static_cast<double>(generator() >> 11) * 0x1p-53;
      point[k] = lower_[k] + share * (upper_[k] - lower_[k]);
    }
    return point;
  }

  const LoopEvaluation& evaluate(const std::vector<double>& point) {
    if (point == point_) return evaluation_;
    point_ = point;
    for (unsigned k = 0; k < size_; ++k) {
      law_.gains[k] = std::exp(std::clamp(point[k], lower_[k], upper_[k]));
    }
    evaluation_ = evaluator_.evaluate(law_, true);
    ++evaluations_;
    if (evaluation_.stable()) consider();
    return evaluation_;
  }

  // Walks from an unstable point towards a stable one, to the first stable place.
  std::vector<double> pull_back(const std::vector<double>& from, const std::vector<double>& to) {
    for (int step = 0; step < 12; ++step) {
      std::vector<double> point(size_);
      for (unsigned k = 0; k < size_; ++k) point[k] = from[k] + (to[k] - from[k]) * step / 12.0;
      if (evaluate(point).stable()) return point;
    }
    return to;
  }

  void minimise(std::vector<double> start, int evaluations) {
    nlopt::opt optimiser(nlopt::LD_SLSQP, size_);
    optimiser.set_lower_bounds(lower_);
    optimiser.set_upper_bounds(upper_);
    optimiser.set_maxeval(evaluations);
    optimiser.set_xtol_rel(1e-7);
    optimiser.set_ftol_abs(1e-9);
    optimiser_ = &optimiser;
    failure_ = nullptr;
    optimiser.set_min_objective(objective, this);
    optimiser.add_inequality_mconstraint(constraints, this,
                                         std::vector<double>(constraint_count, 0.0));
    try {
      double value = 0.0;
      optimiser.optimize(start, value);
    } catch (const std::runtime_error&) {
      // A failed line search, rounding, or our own stop: the record stands all the same.
      ++failures_;
    }
    optimiser_ = nullptr;
    if (failure_) std::rethrow_exception(failure_);
  }

  // Takes the best feasible candidate since the last call.
  std::optional<Candidate> take_best() {
    auto best = std::move(best_);
    best_.reset();
    best_log_rms_ = std::numeric_limits<double>::infinity();
    return best;
  }
  const std::optional<Candidate>& nearest() const { return nearest_; }
  int evaluations() const { return evaluations_; }
  int failures() const { return failures_; }
  const std::vector<control::GainDescription>& descriptions() const { return descriptions_; }

 private:
  void consider() {
    const double ratio = worst_goal_ratio(evaluation_, goals_);
    const double log_rms = 0.5 * std::log(evaluation_.beam_variance());
    // The reserve is the constraints' too: what is recorded must hold on the exact response.
    if (ratio <= std::exp(-peak_reserve) * (1.0 + 1e-7) && log_rms < best_log_rms_) {
      best_log_rms_ = log_rms;
      best_ = Candidate{law_, evaluation_};
    }
    if (ratio < nearest_ratio_) {
      nearest_ratio_ = ratio;
      nearest_ = Candidate{law_, evaluation_};
    }
  }

  template <typename Function>
  void guarded(Function function) {
    try {
      function();
    } catch (...) {
      failure_ = std::current_exception();
      optimiser_->force_stop();
    }
  }

  static double objective(const std::vector<double>& point, std::vector<double>& gradient,
                          void* data) {
    auto& self = *static_cast<Search*>(data);
    double value = unstable_penalty;
    self.guarded([&] {
      const LoopEvaluation& evaluation = self.evaluate(point);
      const double variance = evaluation.beam_variance();
      value = 0.5 * std::log(variance);
      for (std::size_t k = 0; k < gradient.size(); ++k) {
        gradient[k] =
            0.5 * (evaluation.wind_log_gradient[k] + evaluation.noise_log_gradient[k]) / variance;
      }
      if (!evaluation.stable()) value += unstable_penalty;
    });
    return value;
  }

  static void constraints(unsigned count, double* values, unsigned size, const double* point,
                          double* gradients, void* data) {
    auto& self = *static_cast<Search*>(data);
    std::fill(values, values + count, -1.0);
    if (gradients != nullptr) std::fill(gradients, gradients + count * size, 0.0);
    self.guarded([&] {
      const LoopEvaluation& evaluation = self.evaluate(std::vector<double>(point, point + size));
      for (unsigned b = 0; b < 3; ++b) {
        const auto& peaks = evaluation.peaks[b];
        for (unsigned j = 0; j < peaks.size(); ++j) {
          const unsigned row = b * peaks_per_break + j;
          values[row] =
              std::log(peaks[j].magnitude / self.goals_.sensitivity_peak[b]) + peak_reserve;
          if (gradients != nullptr) {
            std::copy_n(peaks[j].log_gradient.begin(), size, gradients + row * size);
          }
        }
        if (!evaluation.stable()) values[b * peaks_per_break] = unstable_penalty;
      }
      const unsigned row = constraint_count - 1;
      const double limit = self.goals_.valve_effort;
      if (evaluation.effort_variance > 0.0) {
        values[row] = 0.5 * std::log(evaluation.effort_variance / (limit * limit)) + peak_reserve;
        for (unsigned k = 0; gradients != nullptr && k < size; ++k) {
          gradients[row * size + k] =
              0.5 * evaluation.effort_log_gradient[k] / evaluation.effort_variance;
        }
      }
    });
  }

  control::LoopEvaluator& evaluator_;
  HardGoals goals_;
  const std::vector<control::GainDescription>& descriptions_;
  unsigned size_;
  std::vector<double> lower_, upper_;
  control::ControlLaw law_;
  std::vector<double> point_;
  LoopEvaluation evaluation_;
  int evaluations_ = 0;
  int failures_ = 0;
  double best_log_rms_ = std::numeric_limits<double>::infinity();
  double nearest_ratio_ = std::numeric_limits<double>::infinity();
  std::optional<Candidate> best_, nearest_;
  nlopt::opt* optimiser_ = nullptr;
  std::exception_ptr failure_;
};

std::vector<double> logarithms(const std::vector<double>& gains) {
  std::vector<double> logarithm(gains.size());
  std::transform(gains.begin(), gains.end(), logarithm.begin(),
                 [](double gain) { return std::log(gain); });
  return logarithm;
}

// The first `count` laws of a list sorted by rms that are not copies of one another; the law
// nearest to the goals where the list is empty.
std::vector<Candidate> distinct(const std::vector<Candidate>& sorted,
                                const std::optional<Candidate>& nearest, std::size_t count) {
  std::vector<Candidate> chosen;
  for (const auto& candidate : sorted) {
    const bool copy = std::any_of(chosen.begin(), chosen.end(), [&](const Candidate& other) {
      return candidate.evaluation.beam_variance() < other.evaluation.beam_variance() * (1.0 + 1e-4);
    });
    if (!copy && chosen.size() < count) chosen.push_back(candidate);
  }
  if (chosen.empty() && nearest) chosen.push_back(*nearest);
  return chosen;
}

bool less(const Candidate& x, const Candidate& y) {
  return x.evaluation.beam_variance() < y.evaluation.beam_variance();
}

// Random starts on the coarse grid: the best three laws, the nearest to the goals where none is
// feasible, nothing where none is stable.
std::vector<Candidate> global_search(const TrackingProblem& problem,
                                     const control::LoopStructure& structure,
                                     const HardGoals& goals, const TuningOptions& options,
                                     TuningResult& result) {
  TrackingProblem coarse_problem = problem;
  coarse_problem.points_per_decade = options.search_points_per_decade;
  control::LoopEvaluator coarse = make_evaluator(coarse_problem);
  Search search(coarse, structure, goals);
  std::mt19937_64 generator(options.seed);
  std::vector<double> anchor;
  for (int trial = 0; trial < 2000 && anchor.empty(); ++trial) {
    const auto point = search.random_point(generator);
    if (search.evaluate(point).stable()) anchor = point;
  }
  std::vector<Candidate> found;
  for (int start = 0; start < options.starts && !anchor.empty(); ++start) {
    auto point = search.pull_back(search.random_point(generator), anchor);
    std::optional<Candidate> best;
    // SLSQP stops where two peaks change places; from there it often goes on with the new pair.
    for (int restart = 0; restart < most_restarts; ++restart) {
      search.minimise(point, options.evaluations_per_start);
      auto next = search.take_best();
      if (!next || (best && next->evaluation.beam_variance() >
                                worthwhile * best->evaluation.beam_variance())) {
        break;
      }
      best = std::move(next);
      point = logarithms(best->law.gains);
    }
    if (best) found.push_back(std::move(*best));
  }
  std::stable_sort(found.begin(), found.end(), less);
  result.starts_at_optimum =
      static_cast<int>(std::count_if(found.begin(), found.end(), [&](const Candidate& candidate) {
        return candidate.evaluation.beam_variance() <
               1.01 * 1.01 * found.front().evaluation.beam_variance();
      }));
  result.evaluations += search.evaluations();
  result.optimiser_failures += search.failures();
  return distinct(found, search.nearest(), 3);
}

void describe_limits(TuningResult& result, const HardGoals& goals,
                     const std::vector<control::GainDescription>& descriptions) {
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    for (const auto& peak : result.evaluation.peaks[b]) {
      if (peak.magnitude > 0.999 * goals.sensitivity_peak[b]) {
        result.active_goals.push_back(fmt::format("sensitivity peak at {}, {:.2f} Hz",
                                                  control::to_string(control::loop_breaks[b]),
                                                  peak.frequency / (2.0 * std::numbers::pi)));
      }
    }
  }
  if (std::sqrt(result.evaluation.effort_variance) > 0.999 * goals.valve_effort) {
    result.active_goals.emplace_back("noise-driven valve effort");
  }
  for (std::size_t k = 0; k < descriptions.size(); ++k) {
    const double value = result.law.gains[k];
    if (value < 1.001 * descriptions[k].lower || value > 0.999 * descriptions[k].upper) {
      result.gains_at_bound.emplace_back(descriptions[k].name);
    }
  }
}

}  // namespace

double worst_goal_ratio(const control::LoopEvaluation& evaluation, const HardGoals& goals) {
  if (!evaluation.stable()) return std::numeric_limits<double>::infinity();
  double worst = std::sqrt(evaluation.effort_variance) / goals.valve_effort;
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    worst = std::max(worst,
                     evaluation.highest_peak(control::loop_breaks[b]) / goals.sensitivity_peak[b]);
  }
  return worst;
}

TuningResult tune(const TrackingProblem& problem, const control::LoopStructure& structure,
                  const HardGoals& goals, const TuningOptions& options) {
  const int least_starts = options.warm_starts.empty() ? 1 : 0;
  if (options.starts < least_starts || options.evaluations_per_start < 1 ||
      options.search_points_per_decade < 1) {
    throw InvalidInput(fmt::format(
        "tune: expected at least {} starts, 1 evaluation and 1 point a decade, found {}, {}, {}",
        least_starts, options.starts, options.evaluations_per_start,
        options.search_points_per_decade));
  }
  TuningResult result;
  result.starts = options.starts;
  result.law.structure = structure;
  std::vector<std::vector<double>> promising = options.warm_starts;
  if (options.starts > 0) {
    for (auto& candidate : global_search(problem, structure, goals, options, result)) {
      promising.push_back(std::move(candidate.law.gains));
    }
  }
  if (promising.empty()) {
    result.status = TuningStatus::unstable;
    result.worst_goal_ratio = std::numeric_limits<double>::infinity();
    return result;
  }
  control::LoopEvaluator fine = make_evaluator(problem);
  Search refine(fine, structure, goals);
  std::optional<Candidate> chosen;
  for (const auto& gains : promising) {
    refine.minimise(logarithms(gains), options.evaluations_per_start);
    auto best = refine.take_best();
    if (best && (!chosen || less(*best, *chosen)) &&
        control::stability(problem.plant, best->law, problem.delay, fine.response().frequency)
            .stable()) {
      chosen = std::move(best);
    }
  }
  result.evaluations += refine.evaluations();
  result.optimiser_failures += refine.failures();
  result.status = TuningStatus::optimal;
  if (!chosen) {
    // No law with the reserve in hand; the nearest may still meet the goals as they stand.
    chosen = refine.nearest();
    if (!chosen) {
      throw NumericalFailure(
          "tune: a law that is stable on the search's frequency grid is not on the problem's own");
    }
    if (worst_goal_ratio(chosen->evaluation, goals) > 1.0 + 1e-9) {
      result.status = TuningStatus::infeasible;
    }
  }
  result.law = chosen->law;
  result.evaluation = chosen->evaluation;
  result.worst_goal_ratio = worst_goal_ratio(result.evaluation, goals);
  describe_limits(result, goals, refine.descriptions());
  return result;
}

}  // namespace boresight::design
