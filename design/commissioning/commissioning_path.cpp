#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include <boresight/design/commissioning/commissioning_path.hpp>

namespace boresight::design {
namespace {

using control::BlockKind;
using control::Controller;
using control::LoopPath;
using control::LoopStructure;

// A path that comes in begins at this fraction of its gain.
constexpr double first_fraction = 0.25;

using GainMap = std::map<std::string, double>;

GainMap gains_of(const Controller& controller) {
  GainMap gains;
  for (std::size_t i = 0; i < controller.gains.size(); ++i) {
    gains[controller.structure.gains()[i].symbol] = controller.gains[i];
  }
  return gains;
}

// The structure without the paths named.
LoopStructure reduced(const LoopStructure& structure, bool pressure, bool compliance) {
  std::vector<control::LoopBlock> blocks;
  for (const auto& block : structure.blocks()) {
    const bool left_out = (block.path == LoopPath::pressure && !pressure) ||
                          (block.path == LoopPath::compliance && !compliance);
    if (!left_out) blocks.push_back(block);
  }
  return {structure.name(), std::move(blocks)};
}

Controller controller_of(const LoopStructure& structure, const GainMap& gains) {
  Controller controller{structure, {}};
  for (const auto& gain : structure.gains()) controller.gains.push_back(gains.at(gain.symbol));
  return controller;
}

// What a block that is not there would have in the target's structure.
void set_idle(const control::LoopBlock& block, const GainMap& target, GainMap& gains) {
  for (const auto& gain : block.gains) gains[gain.symbol] = target.at(gain.symbol);
  switch (block.kind) {
    case BlockKind::lag:
    case BlockKind::lead:
      gains[block.gains[0].symbol] =
          std::max(block.gains[0].upper, target.at(block.gains[0].symbol));
      break;
    case BlockKind::integral:
      gains[block.gains[0].symbol] =
          std::min(block.gains[0].lower, target.at(block.gains[0].symbol));
      break;
    case BlockKind::notch:
      gains[block.gains[1].symbol] = target.at(block.gains[2].symbol);
      break;
    case BlockKind::gain:
    case BlockKind::washout:
    case BlockKind::dead_zone:
    case BlockKind::freeze:
      break;
  }
}

// One group of gains on its way.
struct Group {
  std::vector<std::string> symbols;
  GainMap from, to;
  int steps = 0;
  int at = 0;

  // Straight in the logarithms; the ends exactly.
  void write(int step, GainMap& gains) const {
    for (const auto& symbol : symbols) {
      const double start = from.at(symbol);
      const double end = to.at(symbol);
      const double fraction = static_cast<double>(step) / static_cast<double>(std::max(steps, 1));
      gains[symbol] = step == steps ? end
                      : step == 0   ? start
                                    : start * std::exp(fraction * std::log(end / start));
    }
  }
};

// A path's gains on their way from one map to the other.
Group group_of(const LoopStructure& structure, LoopPath path, const GainMap& from,
               const GainMap& to, double largest_step) {
  Group group;
  double farthest = 0.0;
  for (const auto& block : structure.blocks()) {
    if (block.path != path) continue;
    for (const auto& gain : block.gains) {
      group.symbols.push_back(gain.symbol);
      group.from[gain.symbol] = from.at(gain.symbol);
      group.to[gain.symbol] = to.at(gain.symbol);
      farthest = std::max(farthest, std::abs(std::log(to.at(gain.symbol) / from.at(gain.symbol))));
    }
  }
  // A hair's breadth over a whole number of steps is rounding.
  group.steps = static_cast<int>(std::ceil(farthest / std::log(largest_step) - 1e-9));
  return group;
}

// Walks over the steps; keeps the gains as they are.
class Walk {
 public:
  Walk(const Controller& start, const Controller& target, double largest_step,
       const std::function<bool(const StageController&)>& allowed)
      : target_(target),
        largest_step_(largest_step),
        allowed_(allowed),
        to_(gains_of(target)),
        gains_(to_),
        pressure_(start.structure.has(LoopPath::pressure)),
        compliance_(start.structure.has(LoopPath::compliance)) {
    for (const auto& [symbol, value] : gains_of(start)) gains_[symbol] = value;
  }

  std::optional<std::vector<PathStage>> run(std::string& why_not) {
    if (!walk_rate_and_pressure(why_not) || !walk_position(why_not) || !walk_compliance(why_not)) {
      return std::nullopt;
    }
    add(StageKind::feedforward, {controller(), false, true});
    return stages_;
  }

 private:
  Controller controller() const {
    return controller_of(reduced(target_.structure, pressure_, compliance_), gains_);
  }
  void add(StageKind kind, const StageController& stage) { stages_.push_back({kind, stage}); }

  // Takes a step if every plant allows what comes of it; else nothing has changed.
  bool tries(StageKind kind, bool position_open, const std::function<void()>& step) {
    const GainMap gains = gains_;
    const bool pressure = pressure_;
    const bool compliance = compliance_;
    step();
    const StageController stage{controller(), position_open, false};
    if (allowed_(stage)) {
      add(kind, stage);
      return true;
    }
    gains_ = gains;
    pressure_ = pressure;
    compliance_ = compliance;
    return false;
  }

  // A path that is not there yet begins at a fraction of its gain.
  Group entering(LoopPath path, bool present) const {
    GainMap from = gains_;
    if (!present) {
      for (const auto& block : target_.structure.blocks()) {
        if (block.path != path) continue;
        for (const auto& gain : block.gains) from[gain.symbol] = to_.at(gain.symbol);
        if (block.kind == BlockKind::gain) {
          from[block.gains[0].symbol] = first_fraction * to_.at(block.gains[0].symbol);
        }
      }
    }
    Group group = group_of(target_.structure, path, from, to_, largest_step_);
    // Step 0 of a path that is there is where it stands.
    group.at = present ? 0 : -1;
    return group;
  }

  bool walk_rate_and_pressure(std::string& why_not) {
    Group rate = group_of(target_.structure, LoopPath::rate, gains_, to_, largest_step_);
    Group pressure = entering(LoopPath::pressure, pressure_);
    if (!target_.structure.has(LoopPath::pressure)) pressure.at = pressure.steps = 0;
    add(StageKind::rate_loop, {controller(), true, false});
    const auto raise_rate = [&] { rate.write(rate.at + 1, gains_); };
    const auto raise_pressure = [&] {
      pressure_ = true;
      pressure.write(pressure.at + 1, gains_);
    };
    while (rate.at < rate.steps || pressure.at < pressure.steps) {
      const bool rate_left = rate.at < rate.steps;
      const bool pressure_left = pressure.at < pressure.steps;
      if (rate_left && tries(StageKind::rate_loop, true, raise_rate)) {
        ++rate.at;
      } else if (pressure_left && tries(StageKind::pressure_feedback, true, raise_pressure)) {
        ++pressure.at;
      } else if (rate_left && pressure_left && tries(StageKind::pressure_feedback, true, [&] {
                   raise_rate();
                   raise_pressure();
                 })) {
        ++rate.at;
        ++pressure.at;
      } else {
        why_not = fmt::format(
            "with the position loop open no next step is allowed after {} of {} "
            "steps of the rate path and {} of {} of pressure feedback",
            rate.at, rate.steps, std::max(pressure.at, 0), pressure.steps);
        return false;
      }
    }
    return true;
  }

  bool walk_position(std::string& why_not) {
    constexpr int halvings = 6;
    const GainMap found = gains_;
    bool closed = false;
    for (int k = 0; k <= halvings && !closed; ++k) {
      closed = tries(StageKind::position_loop, false, [&] {
        for (const auto& block : target_.structure.blocks()) {
          const bool moves = block.kind == BlockKind::gain || block.kind == BlockKind::integral;
          if (block.path != LoopPath::position || !moves) continue;
          const std::string& symbol = block.gains[0].symbol;
          // No lower than needed where the target is the lower one.
          gains_[symbol] = std::min(found.at(symbol), to_.at(symbol)) * std::ldexp(1.0, -k);
          if (k == 0) gains_[symbol] = found.at(symbol);
        }
      });
    }
    if (!closed) {
      why_not = "the position loop can be closed at none of the gains found nor at a 64th of them";
      return false;
    }
    Group position = group_of(target_.structure, LoopPath::position, gains_, to_, largest_step_);
    while (position.at < position.steps) {
      if (!tries(StageKind::position_loop, false,
                 [&] { position.write(position.at + 1, gains_); })) {
        why_not = fmt::format("no next step of the position path is allowed after {} of {}",
                              position.at, position.steps);
        return false;
      }
      ++position.at;
    }
    return true;
  }

  bool walk_compliance(std::string& why_not) {
    if (!target_.structure.has(LoopPath::compliance)) return true;
    Group compliance = entering(LoopPath::compliance, compliance_);
    while (compliance.at < compliance.steps) {
      if (!tries(StageKind::compliance, false, [&] {
            compliance_ = true;
            compliance.write(compliance.at + 1, gains_);
          })) {
        why_not = fmt::format("no next step of the compliance path is allowed after {} of {}",
                              std::max(compliance.at, 0), compliance.steps);
        return false;
      }
      ++compliance.at;
    }
    return true;
  }

  const Controller& target_;
  double largest_step_;
  const std::function<bool(const StageController&)>& allowed_;
  GainMap to_, gains_;
  bool pressure_ = false, compliance_ = false;
  std::vector<PathStage> stages_;
};

}  // namespace

std::optional<Controller> controller_within(const Controller& found, const Controller& target) {
  const GainMap own = gains_of(found);
  const GainMap wanted = gains_of(target);
  for (const auto& [symbol, value] : own) {
    if (!wanted.contains(symbol)) return std::nullopt;
  }
  const LoopStructure structure = reduced(target.structure, found.structure.has(LoopPath::pressure),
                                          found.structure.has(LoopPath::compliance));
  GainMap gains;
  for (const auto& block : structure.blocks()) set_idle(block, wanted, gains);
  for (const auto& [symbol, value] : own) gains[symbol] = value;
  return controller_of(structure, gains);
}

Controller without_torque_paths(const Controller& controller) {
  return controller_of(reduced(controller.structure, false, false), gains_of(controller));
}

Controller detuned(const Controller& controller, double rate_factor, double position_factor) {
  Controller result = controller;
  std::size_t first = 0;
  for (const auto& block : controller.structure.blocks()) {
    const bool gain = block.kind == BlockKind::gain;
    if (block.path == LoopPath::rate && gain) result.gains[first] /= rate_factor;
    if (block.path == LoopPath::position && (gain || block.kind == BlockKind::integral)) {
      result.gains[first] /= position_factor;
    }
    first += block.gains.size();
  }
  return result;
}

std::optional<std::vector<PathStage>> commissioning_path(
    const Controller& start, const Controller& target, double largest_step,
    const std::function<bool(const StageController&)>& allowed, std::string& why_not) {
  return Walk(start, target, largest_step, allowed).run(why_not);
}

std::optional<std::vector<PathStage>> output_path(
    const Controller& target, double largest_step,
    const std::function<bool(const StageController&)>& allowed, std::string& why_not) {
  const auto stage = [&](double factor) {
    // Reads the commanded rate beside the tachometer: without it, it would hold against a motion.
    StageController controller{control::with_output_times(factor, target), false, true};
    controller.output_factor = factor;
    return controller;
  };
  std::vector<PathStage> stages;
  for (double factor = 1.0; factor > first_fraction;) {
    factor /= largest_step;
    const StageController lower = stage(factor);
    if (!allowed(lower)) break;
    stages.push_back({StageKind::output, lower});
  }
  if (stages.empty()) {
    why_not = fmt::format("{:.3g} of the output is not allowed on every plant", 1.0 / largest_step);
    return std::nullopt;
  }
  std::ranges::reverse(stages);
  // The target itself, not its output times 1.
  stages.push_back({StageKind::output, {target, false, true}});
  return stages;
}

}  // namespace boresight::design
