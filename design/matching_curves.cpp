#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include <fmt/format.h>

#include <boresight/design/matching_column.hpp>
#include <boresight/design/matching_curves.hpp>
#include <boresight/design/parallel_loop.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::design {
namespace {

using control::ControlLaw;
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

bool is_part_of(const LoopStructure& part, const LoopStructure& whole) {
  return part.gains().size() < whole.gains().size() &&
         std::ranges::all_of(part.gains(), [&](const auto& gain) {
           return std::ranges::find(whole.gains(), gain.symbol,
                                    &control::GainDescription::symbol) != whole.gains().end();
         });
}

// Of each structure those of the others that it extends, without those that these extend.
std::vector<std::vector<std::size_t>> parts_of(const std::vector<LoopStructure>& structures) {
  std::vector<std::vector<std::size_t>> parts(structures.size());
  for (std::size_t s = 0; s < structures.size(); ++s) {
    for (std::size_t part = 0; part < structures.size(); ++part) {
      if (!is_part_of(structures[part], structures[s])) continue;
      const bool between = std::ranges::any_of(structures, [&](const auto& one) {
        return is_part_of(structures[part], one) && is_part_of(one, structures[s]);
      });
      if (!between) parts[s].push_back(part);
    }
  }
  return parts;
}

}  // namespace

std::vector<double> transferred_gains(const ControlLaw& law, const LoopStructure& structure) {
  std::vector<double> gains;
  for (const auto& block : structure.blocks()) {
    for (std::size_t k = 0; k < block.gains.size(); ++k) {
      const auto& gain = block.gains[k];
      const auto& own = law.structure.gains();
      const auto same = std::ranges::find(own, gain.symbol, &control::GainDescription::symbol);
      if (same != own.end()) {
        const double value = law.gains[static_cast<std::size_t>(same - own.begin())];
        gains.push_back(std::clamp(value, gain.lower, gain.upper));
        continue;
      }
      switch (block.kind) {
        case control::BlockKind::gain:
        case control::BlockKind::integral:
          gains.push_back(gain.lower);
          break;
        case control::BlockKind::lag:
        case control::BlockKind::lead:
          // A lag where the other has none, a compliance's corner.
          gains.push_back(block.path == control::LoopPath::compliance
                              ? std::sqrt(gain.lower * gain.upper)
                              : gain.upper);
          break;
        case control::BlockKind::washout:
        case control::BlockKind::notch:
          gains.push_back(std::sqrt(gain.lower * gain.upper));
          break;
      }
    }
  }
  return gains;
}

MatchingCurves match_motors(const MatchingTask& task, const MatchingOptions& options) {
  check(task, options);
  const std::size_t columns = task.motor_inertia.size();
  const std::size_t structures = task.structures.size();
  const WindTable wind(task.problem);
  const auto parts = parts_of(task.structures);
  std::vector<std::unique_ptr<MatchingColumn>> made(columns);

  // Certain steps: making and starting, one round, finishing.
  std::size_t done = 0, all = 3 * columns * structures;
  std::mutex mutex;
  const auto step = [&] {
    const std::lock_guard lock(mutex);
    ++done;
    if (options.progress) options.progress(done, all);
  };
  for_each_index(columns, options.threads, [&](std::size_t i) {
    made[i] = std::make_unique<MatchingColumn>(task, options, wind, parts, i);
    for (std::size_t s = 0; s < structures; ++s) {
      made[i]->start(s, options.starts);
      step();
    }
  });

  MatchingCurves result;
  result.tolerance = options.tolerance;
  const std::size_t most_rounds = columns + 10;
  std::vector<std::vector<SeenCell>> seen(columns, std::vector<SeenCell>(structures));
  for (std::size_t round = 0; round < most_rounds && !result.settled; ++round) {
    if (options.stop && options.stop()) break;
    for (std::size_t i = 0; i < columns; ++i) {
      for (std::size_t s = 0; s < structures; ++s) seen[i][s] = made[i]->seen(s);
    }
    if (round > 0) all += columns * structures;
    std::vector<char> changed(columns, 0);
    for_each_index(columns, options.threads, [&](std::size_t i) {
      for (std::size_t s = 0; s < structures; ++s) {
        const SeenCell* left = i > 0 ? &seen[i - 1][s] : nullptr;
        const SeenCell* right = i + 1 < columns ? &seen[i + 1][s] : nullptr;
        if (made[i]->improve(s, left, right)) changed[i] = 1;
        step();
      }
    });
    ++result.rounds;
    result.settled = std::ranges::none_of(changed, [](char one) { return one != 0; });
  }
  result.interrupted = options.stop && options.stop();
  if (result.interrupted) result.settled = false;

  for (const auto& structure : task.structures) {
    result.curves.push_back({structure, std::vector<MatchedLaw>(columns)});
  }
  for_each_index(columns, options.threads, [&](std::size_t i) {
    for (std::size_t s = 0; s < structures; ++s) {
      result.curves[s].laws[i] = made[i]->finish(s);
      step();
    }
  });
  for (const auto& column : made) result.evaluations += column->evaluations();
  return result;
}

}  // namespace boresight::design
