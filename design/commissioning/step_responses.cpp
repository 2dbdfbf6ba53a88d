#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <boresight/design/commissioning/step_responses.hpp>
#include <boresight/identification/signals/spectrum.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using identification::Signal;

// Changes of the command over so many samples at most are a step, which interpolation may have
// split.
constexpr Index samples_of_step = 10;
// A step is above this part of the largest one, and so many times the command's usual change.
constexpr double step_part = 0.5;
constexpr double step_over_motion = 20.0;
// A command this many of its smallest changes off a straight line is at rest or in steady motion.
constexpr double steady_changes = 3.0;
struct Line {
  double start = 0.0, slope = 0.0;

  double at(double sample) const { return start + slope * sample; }
};

Line line_through(const Eigen::Ref<const VectorXd>& values) {
  const Index n = values.size();
  const double middle = 0.5 * static_cast<double>(n - 1);
  const VectorXd from_middle = VectorXd::LinSpaced(n, -middle, middle);
  const double slope = n > 1 ? from_middle.dot(values) / from_middle.squaredNorm() : 0.0;
  return {values.mean() - slope * middle, slope};
}

}  // namespace

bool all_valid(const Signal& signal, Index first, Index count) {
  for (Index k = first; k < first + count; ++k) {
    if (!signal.is_valid(k)) return false;
  }
  return true;
}

bool is_steady(const VectorXd& command) {
  constexpr double rounding = 1e-9;
  VectorXd from_line = command;
  identification::remove_trend(from_line, identification::Detrend::line);
  const double off = from_line.cwiseAbs().maxCoeff();
  if (off <= rounding * command.cwiseAbs().maxCoeff()) return true;
  // A slow motion in the steps of its resolution, all in one direction.
  constexpr int fewest_changes = 20;
  constexpr double one_way = 0.9;
  double smallest = std::numeric_limits<double>::infinity();
  double sum = 0.0;
  int changes = 0;
  for (Index k = 1; k < command.size(); ++k) {
    const double change = std::abs(command[k] - command[k - 1]);
    if (change == 0.0) continue;
    smallest = std::min(smallest, change);
    sum += change;
    ++changes;
  }
  return changes >= fewest_changes && off <= steady_changes * smallest &&
         std::abs(command[command.size() - 1] - command[0]) >= one_way * sum;
}

std::vector<CommandStep> steps_of(const VectorXd& command) {
  const VectorXd change = command.tail(command.size() - 1) - command.head(command.size() - 1);
  VectorXd sorted = change;
  std::ranges::nth_element(sorted, sorted.begin() + sorted.size() / 2);
  const double usual = sorted[sorted.size() / 2];
  const VectorXd beyond = (change.array() - usual).abs();
  const double largest = beyond.maxCoeff();
  if (!(largest > step_over_motion * std::abs(usual))) return {};
  // Of a step split into two samples the smaller part is still far above a motion's changes.
  constexpr double part_of_split = 0.1;
  std::vector<CommandStep> runs;
  for (Index k = 0; k < beyond.size(); ++k) {
    if (beyond[k] <= part_of_split * largest) continue;
    if (!runs.empty() && k < runs.back().behind + 2) {
      runs.back().behind = k + 1;
    } else {
      runs.push_back({k, k + 1});
    }
  }
  // A longer run is a motion.
  std::erase_if(runs,
                [](const CommandStep& run) { return run.behind - run.first > samples_of_step; });
  const auto size_of = [&](const CommandStep& run) {
    return std::abs(change.segment(run.first, run.behind - run.first).sum());
  };
  double largest_step = 0.0;
  for (const CommandStep& run : runs) largest_step = std::max(largest_step, size_of(run));
  std::erase_if(runs,
                [&](const CommandStep& run) { return size_of(run) <= step_part * largest_step; });
  return runs;
}

StepResponses step_responses(const Signal& command, const Signal& response,
                             const std::vector<CommandStep>& steps, Index min_length) {
  StepResponses found;
  const Index samples = command.values.size();
  const auto length_of = [&](std::size_t i) {
    return (i + 1 < steps.size() ? steps[i + 1].first : samples) - steps[i].behind;
  };
  Index shortest = samples;
  std::vector<CommandStep> usable;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Index before = steps[i].first - (i == 0 ? 0 : steps[i - 1].behind);
    const Index needed = std::max(min_length, std::min(length_of(i), min_length * 4));
    if (length_of(i) < min_length || before < needed / 4) {
      ++found.hurried;
      continue;
    }
    usable.push_back(steps[i]);
    shortest = std::min(shortest, length_of(i));
  }
  for (const CommandStep& change : usable) {
    const Index step = change.behind;
    const Index before = std::min(change.first, shortest);
    // What the step before left decays in the first half.
    const Index fitted = std::max<Index>(2, before / 2);
    const Index from = change.first + 1 - fitted;
    if (!all_valid(response, from, step + shortest - from) ||
        !all_valid(command, from, step + shortest - from)) {
      ++found.masked;
      continue;
    }
    // The motion is the command's: the response's own slope is known less well.
    const Line motion = line_through(command.values.segment(from, fitted));
    const auto moved = [&](Index sample) {
      return motion.slope * static_cast<double>(sample - from);
    };
    double start = 0.0;
    for (Index k = from; k < from + fitted; ++k) start += response.values[k] - moved(k);
    start /= static_cast<double>(fitted);
    double size = 0.0;
    for (Index k = step; k < step + shortest; ++k) {
      size += command.values[k] - motion.start - moved(k);
    }
    size /= static_cast<double>(shortest);
    if (size == 0.0) continue;
    VectorXd over(shortest), noise(fitted);
    for (Index k = 0; k < shortest; ++k) {
      over[k] = (response.values[step + k] - start - moved(step + k)) / size;
    }
    for (Index k = 0; k < fitted; ++k) {
      noise[k] = response.values[from + k] - start - moved(from + k);
    }
    // Of a sample, and of the start that is taken off.
    found.noise += noise.norm() / std::sqrt(static_cast<double>(fitted)) / std::abs(size) *
                   std::sqrt(1.0 + 1.0 / static_cast<double>(fitted));
    found.size += std::abs(size);
    found.single.push_back(std::move(over));
  }
  if (found.single.empty()) return found;
  found.noise /= static_cast<double>(found.single.size());
  found.size /= static_cast<double>(found.single.size());
  return found;
}

}  // namespace boresight::design
