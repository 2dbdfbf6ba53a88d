#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/control/controllers/loop_structure.hpp>
#include <boresight/control/controllers/sensor_response.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {

struct LoopStructure::Definition {
  std::string name;
  std::vector<LoopBlock> blocks;
  std::vector<GainDescription> gains;
  std::optional<plant::StateSpace> state_space;
  std::optional<SensorResponse> response;
};

namespace {

LoopBlock block(LoopPath path, BlockKind kind, std::vector<GainDescription> gains) {
  return {path, kind, std::move(gains)};
}

LoopBlock rate_gain() {
  return block(LoopPath::rate, BlockKind::gain, {{"rate gain", "kr", "1", 0.01, 30.0}});
}
LoopBlock rate_integral() {
  return block(LoopPath::rate, BlockKind::integral,
               {{"rate integral corner", "wi", "rad/s", 0.01, 30.0}});
}
LoopBlock rate_lead() {
  return block(LoopPath::rate, BlockKind::lead, {{"rate lead corner", "wz", "rad/s", 0.3, 300.0}});
}
LoopBlock rate_lag() {
  return block(LoopPath::rate, BlockKind::lag, {{"rate lag corner", "wp", "rad/s", 0.3, 300.0}});
}
LoopBlock rate_notch() {
  return block(LoopPath::rate, BlockKind::notch,
               {{"notch frequency", "wn", "rad/s", 3.0, 100.0},
                {"notch numerator damping", "zz", "1", 1e-3, 1.0},
                {"notch denominator damping", "zp", "1", 0.05, 2.0}});
}
LoopBlock pressure_gain() {
  return block(LoopPath::pressure, BlockKind::gain,
               {{"pressure feedback gain", "kT", "rad/(s.N.m)", 1e-4, 10.0}});
}
LoopBlock pressure_washout() {
  return block(LoopPath::pressure, BlockKind::washout,
               {{"pressure washout corner", "wd", "rad/s", 0.1, 60.0}});
}
LoopBlock position_gain() {
  return block(LoopPath::position, BlockKind::gain, {{"position gain", "kp", "1/s", 0.03, 30.0}});
}
LoopBlock position_integral() {
  return block(LoopPath::position, BlockKind::integral,
               {{"position integral corner", "wip", "rad/s", 1e-4, 3.0}});
}
LoopBlock position_condition(BlockKind kind) {
  const bool freeze = kind == BlockKind::freeze;
  return block(LoopPath::position, kind,
               {{freeze ? "position integral freeze" : "position integral dead zone",
                 freeze ? "fzp" : "dzp", "rad", 0.001, 10.0}});
}
LoopBlock position_lag() {
  return block(LoopPath::position, BlockKind::lag,
               {{"position lag corner", "wpp", "rad/s", 0.03, 30.0}});
}
LoopBlock position_lead() {
  return block(LoopPath::position, BlockKind::lead,
               {{"position lead corner", "wzp", "rad/s", 0.3, 300.0}});
}
LoopBlock compliance_gain() {
  return block(LoopPath::compliance, BlockKind::gain,
               {{"compliance", "cs", "rad/(N.m)", 1e-4, 0.1}});
}
LoopBlock compliance_lag() {
  return block(LoopPath::compliance, BlockKind::lag,
               {{"compliance corner", "wcs", "rad/s", 0.1, 60.0}});
}

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw InvalidInput(fmt::format("loop structure '{}': {}", name, why));
}

int count_of(const std::vector<LoopBlock>& blocks, LoopPath path, BlockKind kind) {
  return static_cast<int>(std::ranges::count_if(blocks, [&](const LoopBlock& candidate) {
    return candidate.path == path && candidate.kind == kind;
  }));
}

void check_conditions(const std::string& name, const std::vector<LoopBlock>& blocks) {
  const auto conditions = std::ranges::count_if(
      blocks, [](const LoopBlock& candidate) { return is_integral_condition(candidate.kind); });
  if (conditions == 0) return;
  const int own = count_of(blocks, LoopPath::position, BlockKind::dead_zone) +
                  count_of(blocks, LoopPath::position, BlockKind::freeze);
  const int integrals = count_of(blocks, LoopPath::position, BlockKind::integral);
  if (conditions != 1 || own != 1 || integrals != 1) {
    refuse(name, fmt::format("expected a dead zone or freeze alone, with one integral in the "
                             "position path, found {} in all, {} and {} integrals in that path",
                             conditions, own, integrals));
  }
}

void check_paths(const std::string& name, const std::vector<LoopBlock>& blocks) {
  for (const LoopPath path :
       {LoopPath::rate, LoopPath::pressure, LoopPath::position, LoopPath::compliance}) {
    const bool used = std::ranges::any_of(
        blocks, [&](const LoopBlock& candidate) { return candidate.path == path; });
    const bool needed = path == LoopPath::rate || path == LoopPath::position;
    if ((used || needed) && count_of(blocks, path, BlockKind::gain) != 1) {
      refuse(name, fmt::format("expected one gain block in the {} path, found {}", to_string(path),
                               count_of(blocks, path, BlockKind::gain)));
    }
    if (count_of(blocks, path, BlockKind::lead) > count_of(blocks, path, BlockKind::lag)) {
      refuse(name, fmt::format("expected a lag for every lead in the {} path", to_string(path)));
    }
    if (!needed && count_of(blocks, path, BlockKind::integral) > 0) {
      refuse(name, fmt::format("expected no integral in the {} path", to_string(path)));
    }
  }
  if (count_of(blocks, LoopPath::pressure, BlockKind::gain) > 0 &&
      count_of(blocks, LoopPath::pressure, BlockKind::washout) == 0) {
    refuse(name, "expected a washout in the pressure path: a static one makes the drive yield");
  }
  check_conditions(name, blocks);
}

void check_gains(const std::string& name, const std::vector<LoopBlock>& blocks,
                 const std::vector<GainDescription>& gains) {
  for (const LoopBlock& candidate : blocks) {
    if (candidate.gains.size() != gain_count(candidate.kind)) {
      refuse(name, fmt::format("expected {} gains for a {}, found {}", gain_count(candidate.kind),
                               to_string(candidate.kind), candidate.gains.size()));
    }
  }
  if (gains.size() > max_gains) {
    refuse(name, fmt::format("expected at most {} gains, found {}", max_gains, gains.size()));
  }
  std::set<std::string> symbols;
  for (const GainDescription& gain : gains) {
    if (!(gain.lower > 0.0) || !(gain.upper > gain.lower) || !(gain.upper < 1e12)) {
      refuse(name, fmt::format("expected bounds 0 < lower < upper for {}, found {} and {}",
                               gain.symbol, gain.lower, gain.upper));
    }
    if (!symbols.insert(gain.symbol).second) {
      refuse(name, fmt::format("expected each symbol once, found '{}' twice", gain.symbol));
    }
  }
}

double nearest_power_of_ten(double factor) {
  return std::pow(10.0, std::clamp(std::round(std::log10(factor)), -6.0, 6.0));
}

// By which gain `k` of a block changes with a load that is so much faster and of so much more
// inertia.
double gain_factor(const LoopBlock& block, std::size_t k, double faster, double inertia) {
  if ((block.kind == BlockKind::notch && k > 0) || is_integral_condition(block.kind)) return 1.0;
  if (block.kind != BlockKind::gain) return faster;
  switch (block.path) {
    case LoopPath::rate:
      break;
    case LoopPath::pressure:
      return 1.0 / (inertia * faster);
    case LoopPath::position:
      return faster;
    case LoopPath::compliance:
      return 1.0 / (inertia * faster * faster);
  }
  return 1.0;
}

}  // namespace

std::string_view to_string(LoopPath path) {
  static constexpr std::array names{"rate", "pressure", "position", "compliance"};
  return names.at(static_cast<std::size_t>(path));
}

std::string_view to_string(BlockKind kind) {
  static constexpr std::array names{"gain",    "integral", "lag",       "lead",
                                    "washout", "notch",    "dead_zone", "freeze"};
  return names.at(static_cast<std::size_t>(kind));
}

std::size_t gain_count(BlockKind kind) {
  return kind == BlockKind::notch ? 3 : 1;
}

bool is_integral_condition(BlockKind kind) {
  return kind == BlockKind::dead_zone || kind == BlockKind::freeze;
}

LoopStructure::LoopStructure() : LoopStructure(pi_with_lag()) {}

LoopStructure::LoopStructure(std::string name, std::vector<LoopBlock> blocks) {
  std::vector<GainDescription> gains;
  for (const LoopBlock& one : blocks) gains.insert(gains.end(), one.gains.begin(), one.gains.end());
  check_gains(name, blocks, gains);
  check_paths(name, blocks);
  definition_ = std::make_shared<const Definition>(
      Definition{std::move(name), std::move(blocks), std::move(gains), {}, {}});
}

LoopStructure LoopStructure::of_state_space(std::string name, const plant::StateSpace& controller) {
  plant::validate(controller);
  if (!(controller.sample_time > 0.0)) refuse(name, "expected a sampled state space");
  const auto read = [&](std::size_t sensor) {
    return std::ranges::count(controller.inputs, sensor_names.at(sensor)) == 1;
  };
  const auto known = [](const std::string& input) {
    return std::ranges::find(sensor_names, input) != sensor_names.end();
  };
  if (!read(0) || !read(1) || !std::ranges::all_of(controller.inputs, known) ||
      controller.outputs != std::vector<std::string>{"valve_demand"}) {
    refuse(name,
           fmt::format("expected the inputs tachometer, encoder and, if read, motor_torque, "
                       "and the output valve_demand, found {} -> {}",
                       fmt::join(controller.inputs, ", "), fmt::join(controller.outputs, ", ")));
  }
  const Eigen::Index tachometer = plant::input_index(controller, sensor_names[0]);
  if (controller.b.col(tachometer).isZero(0.0) && controller.d.col(tachometer).isZero(0.0)) {
    refuse(name, "expected a controller that answers the tachometer, found a zero column");
  }
  LoopStructure structure;
  structure.definition_ = std::make_shared<const Definition>(
      Definition{std::move(name), {}, {}, controller, SensorResponse(controller)});
  return structure;
}

const LoopStructure& LoopStructure::pi() {
  static const LoopStructure structure(
      "PI without lag", {rate_gain(), rate_integral(), position_gain(), position_integral()});
  return structure;
}

const LoopStructure& LoopStructure::pi_with_lag() {
  static const LoopStructure structure("PI with lag", {rate_gain(), rate_integral(), rate_lag(),
                                                       position_gain(), position_integral()});
  return structure;
}

const LoopStructure& LoopStructure::pressure_feedback() {
  static const LoopStructure structure("PI with lag and pressure feedback",
                                       {rate_gain(), rate_integral(), rate_lag(), pressure_gain(),
                                        pressure_washout(), position_gain(), position_integral()});
  return structure;
}

const LoopStructure& LoopStructure::lead_lag() {
  static const LoopStructure structure("PI with lead and lag",
                                       {rate_gain(), rate_integral(), rate_lead(), rate_lag(),
                                        position_gain(), position_integral()});
  return structure;
}

const LoopStructure& LoopStructure::full() {
  static const LoopStructure structure(
      "PI with lead, lag and pressure feedback",
      {rate_gain(), rate_integral(), rate_lead(), rate_lag(), pressure_gain(), pressure_washout(),
       position_gain(), position_integral()});
  return structure;
}

LoopStructure LoopStructure::with_compliance_compensation() const {
  std::vector<LoopBlock> blocks = this->blocks();
  blocks.push_back(compliance_gain());
  blocks.push_back(compliance_lag());
  return {name() + ", compliance compensation", std::move(blocks)};
}

LoopStructure LoopStructure::with_position_lag() const {
  if (count(LoopPath::position, BlockKind::integral) == 0 || !name().starts_with("PI")) {
    refuse(name(), "expected a usual PI structure, whose integrals a position lag can replace");
  }
  std::vector<LoopBlock> blocks = this->blocks();
  std::erase_if(blocks,
                [](const LoopBlock& candidate) { return candidate.kind == BlockKind::integral; });
  const auto gain = std::ranges::find_if(blocks, [](const LoopBlock& candidate) {
    return candidate.path == LoopPath::position && candidate.kind == BlockKind::gain;
  });
  blocks.insert(std::next(gain), {position_lag(), position_lead()});
  return {fmt::format("P{}, position lag", name().substr(2)), std::move(blocks)};
}

namespace {

// In place of the integrals, the position path's with a condition.
std::vector<LoopBlock> with_condition(const LoopStructure& structure, BlockKind kind) {
  if (structure.has_conditional_integral() || !structure.name().starts_with("P")) {
    refuse(structure.name(), "expected a usual structure without a dead zone or freeze");
  }
  std::vector<LoopBlock> blocks = structure.blocks();
  std::erase_if(blocks,
                [](const LoopBlock& candidate) { return candidate.kind == BlockKind::integral; });
  const auto gain = std::ranges::find_if(blocks, [](const LoopBlock& candidate) {
    return candidate.path == LoopPath::position && candidate.kind == BlockKind::gain;
  });
  blocks.insert(std::next(gain), {position_integral(), position_condition(kind)});
  return blocks;
}

}  // namespace

LoopStructure LoopStructure::with_dead_zone() const {
  return {name() + ", dead zone", with_condition(*this, BlockKind::dead_zone)};
}

LoopStructure LoopStructure::with_freeze() const {
  return {name() + ", freeze", with_condition(*this, BlockKind::freeze)};
}

LoopStructure LoopStructure::with_integral_width(double width) const {
  if (!(width > 0.0) || !std::isfinite(width)) {
    refuse(name(), fmt::format("expected a width of the integral above 0, found {} rad", width));
  }
  if (!has_conditional_integral()) return *this;
  constexpr double about = 4.0;
  std::vector<LoopBlock> blocks = this->blocks();
  for (LoopBlock& one : blocks) {
    if (!is_integral_condition(one.kind)) continue;
    one.gains.front().lower = width / about;
    one.gains.front().upper = width * about;
  }
  return {name(), std::move(blocks)};
}

LoopStructure LoopStructure::with_notch() const {
  std::vector<LoopBlock> blocks = this->blocks();
  blocks.push_back(rate_notch());
  return {name() + ", notch", std::move(blocks)};
}

LoopStructure LoopStructure::named(std::string_view short_name) {
  std::string_view base = short_name;
  const bool compliance = base.ends_with("+C");
  if (compliance) base.remove_suffix(2);
  const bool notch = base.ends_with("+N");
  if (notch) base.remove_suffix(2);
  const bool dead_zone = base.ends_with("+D"), freeze = base.ends_with("+F");
  if (dead_zone || freeze) base.remove_suffix(2);
  const bool lag = base.ends_with("+L");
  if (lag) base.remove_suffix(2);
  const std::array<std::pair<std::string_view, const LoopStructure*>, 5> list{
      {{"PI-0", &pi()},
       {"PI", &pi_with_lag()},
       {"DPF", &pressure_feedback()},
       {"LL", &lead_lag()},
       {"FULL", &full()}}};
  const auto* found =
      std::ranges::find_if(list, [&](const auto& one) { return one.first == base; });
  if (found == list.end()) {
    throw InvalidInput(
        fmt::format("loop structure: expected PI-0, PI, DPF, LL or FULL, with +L (position lag "
                    "instead of integrals), +D or +F (dead zone or freeze of the integral), +N "
                    "(notch) and +C (compliance compensation) behind it as wanted, found '{}'",
                    short_name));
  }
  LoopStructure structure = *found->second;
  if (lag) structure = structure.with_position_lag();
  if (dead_zone) structure = structure.with_dead_zone();
  if (freeze) structure = structure.with_freeze();
  if (notch) structure = structure.with_notch();
  return compliance ? structure.with_compliance_compensation() : structure;
}

LoopStructure LoopStructure::with_bounds_for(const DrivenLoad& load) const {
  for (const double number : {load.frequency, load.inertia}) {
    if (!(number > 0.0) || !std::isfinite(number)) {
      throw InvalidInput(
          fmt::format("driven load: expected frequency and inertia above 0 and "
                      "finite, found {:g} Hz and {:g} kg.m2",
                      load.frequency, load.inertia));
    }
  }
  const DrivenLoad usual;
  const double faster = load.frequency / usual.frequency;
  const double inertia = load.inertia / usual.inertia;
  std::vector<LoopBlock> blocks = this->blocks();
  for (LoopBlock& one : blocks) {
    for (std::size_t k = 0; k < one.gains.size(); ++k) {
      const double moved = nearest_power_of_ten(gain_factor(one, k, faster, inertia));
      one.gains[k].lower *= moved;
      one.gains[k].upper *= moved;
    }
  }
  return {name(), std::move(blocks)};
}

const std::string& LoopStructure::name() const {
  return definition_->name;
}

const std::vector<LoopBlock>& LoopStructure::blocks() const {
  return definition_->blocks;
}

const std::vector<GainDescription>& LoopStructure::gains() const {
  return definition_->gains;
}

const plant::StateSpace* LoopStructure::state_space() const {
  return definition_->state_space ? &*definition_->state_space : nullptr;
}

const SensorResponse* LoopStructure::sensor_response() const {
  return definition_->response ? &*definition_->response : nullptr;
}

std::size_t LoopStructure::parts() const {
  const plant::StateSpace* system = state_space();
  return system != nullptr ? static_cast<std::size_t>(system->a.rows()) : gains().size();
}

bool LoopStructure::has_integral_action() const {
  return count(LoopPath::rate, BlockKind::integral) > 0 ||
         (count(LoopPath::position, BlockKind::integral) > 0 && !has_conditional_integral());
}

bool LoopStructure::has_conditional_integral() const {
  return std::ranges::any_of(blocks(),
                             [](const LoopBlock& one) { return is_integral_condition(one.kind); });
}

bool LoopStructure::feeds_torque_back() const {
  if (const plant::StateSpace* system = state_space()) {
    return std::ranges::count(system->inputs, "motor_torque") > 0;
  }
  return has(LoopPath::pressure) || has(LoopPath::compliance);
}

bool LoopStructure::has(LoopPath path) const {
  return std::ranges::any_of(blocks(), [&](const LoopBlock& one) { return one.path == path; });
}

int LoopStructure::count(LoopPath path, BlockKind kind) const {
  return count_of(blocks(), path, kind);
}

bool LoopStructure::operator==(const LoopStructure& other) const {
  if (definition_ == other.definition_) return true;
  const plant::StateSpace* one = state_space();
  const plant::StateSpace* another = other.state_space();
  if (one == nullptr || another == nullptr) return one == another && name() == other.name();
  return one->sample_time == another->sample_time && one->inputs == another->inputs &&
         one->a.rows() == another->a.rows() && one->a == another->a && one->b == another->b &&
         one->c == another->c && one->d == another->d;
}

std::string_view to_string(const LoopStructure& structure) {
  return structure.name();
}

const std::vector<GainDescription>& gain_descriptions(const LoopStructure& structure) {
  return structure.gains();
}

}  // namespace boresight::control
