#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include <boresight/design/matching/matching_column.hpp>
#include <boresight/design/matching/matching_curves.hpp>
#include <boresight/design/tuning/structure_parts.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

using control::LoopStructure;

void check(const MatchingTask& task, const MatchingOptions& options) {
  if (task.motor_inertia.empty() || task.structures.empty()) {
    throw InvalidInput("match_motors: expected at least one motor inertia and one structure");
  }
  double last = 0.0;
  for (const double inertia : task.motor_inertia) {
    if (!(inertia > last) || !std::isfinite(inertia)) {
      throw InvalidInput(fmt::format(
          "match_motors: expected positive motor inertias that rise, found {:g} after {:g} kg.m2",
          inertia, last));
    }
    last = inertia;
  }
  for (const auto& structure : task.structures) {
    if (std::ranges::count(task.structures, structure) != 1) {
      throw InvalidInput(fmt::format("match_motors: expected each structure once, found '{}' again",
                                     structure.name()));
    }
  }
  if (options.starts < 1) {
    throw InvalidInput(
        fmt::format("match_motors: expected at least 1 start, found {}", options.starts));
  }
  if (!(options.tolerance > 0.0) || !(options.tolerance < 0.1)) {
    throw InvalidInput(fmt::format("match_motors: expected a tolerance within (0, 0.1), found {:g}",
                                   options.tolerance));
  }
  validate(task.goals);
}

}  // namespace

MatchingCurves match_motors(const MatchingTask& task, const MatchingOptions& options) {
  check(task, options);
  const std::size_t columns = task.motor_inertia.size();
  const std::size_t structures = task.structures.size();
  const WindTable wind(task.problem);
  const auto parts = parts_of(task.structures);
  std::vector<std::unique_ptr<MatchingColumn>> made(columns);

  // Certain steps: making and starting, one round, finishing.
  numerics::StepCounter counter(3 * columns * structures, options.progress);
  numerics::for_each_index(columns, options.threads, [&](std::size_t i) {
    made[i] = std::make_unique<MatchingColumn>(task, options, wind, parts, i);
    for (std::size_t s = 0; s < structures; ++s) {
      made[i]->start(s, options.starts);
      counter.step();
    }
  });

  MatchingCurves result;
  result.tolerance = options.tolerance;
  const std::size_t max_rounds = columns + 10;
  std::vector<std::vector<SeenCell>> seen(columns, std::vector<SeenCell>(structures));
  for (std::size_t round = 0; round < max_rounds && !result.settled; ++round) {
    if (options.stop && options.stop()) break;
    for (std::size_t i = 0; i < columns; ++i) {
      for (std::size_t s = 0; s < structures; ++s) seen[i][s] = made[i]->seen(s);
    }
    if (round > 0) counter.expect(columns * structures);
    std::vector<char> changed(columns, 0);
    numerics::for_each_index(columns, options.threads, [&](std::size_t i) {
      for (std::size_t s = 0; s < structures; ++s) {
        const SeenCell* left = i > 0 ? &seen[i - 1][s] : nullptr;
        const SeenCell* right = i + 1 < columns ? &seen[i + 1][s] : nullptr;
        if (made[i]->improve(s, left, right)) changed[i] = 1;
        counter.step();
      }
    });
    ++result.rounds;
    result.settled = std::ranges::none_of(changed, [](char one) { return one != 0; });
  }
  result.interrupted = options.stop && options.stop();
  if (result.interrupted) result.settled = false;

  for (const auto& structure : task.structures) {
    result.curves.push_back({structure, std::vector<MatchedController>(columns)});
  }
  numerics::for_each_index(columns, options.threads, [&](std::size_t i) {
    for (std::size_t s = 0; s < structures; ++s) {
      result.curves[s].controllers[i] = made[i]->finish(s);
      counter.step();
    }
  });
  for (const auto& column : made) result.evaluations += column->evaluations();
  return result;
}

}  // namespace boresight::design
