#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include <boresight/identification/records/channel_defects.hpp>
#include <boresight/identification/records/even_time_base.hpp>
#include <boresight/identification/records/record_defects.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::identification {
namespace {

using Index = Eigen::Index;

Index finite_count(const Eigen::VectorXd& values) {
  return values.array().isFinite().count();
}

class Cleaner {
 public:
  Cleaner(RawRecord raw, DefectOptions options)
      : raw_(std::move(raw)), options_(std::move(options)) {
    // Lines ring as fast as a few samples.
    options_.fill_short_gaps = raw_.test != TestKind::slosh;
  }

  CleanRecord clean() {
    try {
      check_lengths();
      const EvenTimeBase base = even_time_base(raw_.time, options_, result_.defects);
      note_missing();
      leave_out_dead_commands();
      leave_out_commands();
      find_dead_pressures();
      find_dead_tachometer();
      report_suspicions();
      mask_sensors();
      replace(inlets());
      replace(outlets());
      assemble(base);
    } catch (const UnusableTimes& refusal) {
      refuse(refusal.kind, refusal.what());
    } catch (const InvalidInput& refusal) {
      refuse(refusal_kind_, refusal.what());
    }
    return std::move(result_);
  }

 private:
  struct Side {
    std::vector<RawChannel>& channels;
    std::vector<std::size_t>& replaced;
    const char* name;
  };
  Side inlets() { return {raw_.inlet, result_.replaced_inlets, "inlet"}; }
  Side outlets() { return {raw_.outlet, result_.replaced_outlets, "outlet"}; }

  void refuse(DefectKind kind, const std::string& reason) {
    result_.record.reset();
    result_.refusal = reason;
    result_.defects.push_back(
        {kind, DefectHandling::refused, "", 0, 0.0, raw_.time.size(), reason});
  }

  void add(DefectKind kind, DefectHandling handling, const std::string& channel, Index count,
           std::string explanation) {
    const double time = raw_.time.size() > 0 ? raw_.time[0] : 0.0;
    result_.defects.push_back({kind, handling, channel, 0, time, count, std::move(explanation)});
  }

  void add(std::vector<RecordDefect> defects) {
    for (auto& defect : defects) result_.defects.push_back(std::move(defect));
  }

  std::vector<RawChannel*> sensors() {
    std::vector<RawChannel*> all;
    for (auto* side : {&raw_.inlet, &raw_.outlet}) {
      for (auto& channel : *side) all.push_back(&channel);
    }
    all.push_back(&raw_.tachometer);
    return all;
  }

  void check_lengths() {
    for (const RawChannel* channel : sensors()) {
      if (channel->values.size() == raw_.time.size()) continue;
      refusal_kind_ = DefectKind::different_length;
      throw InvalidInput(fmt::format("expected as many samples of {} as of the time, {}, found {}",
                                     channel->name, raw_.time.size(), channel->values.size()));
    }
    for (auto* command : {&raw_.rate_command, &raw_.valve_command, &raw_.encoder}) {
      if (!*command || (*command)->values.size() == raw_.time.size()) continue;
      add(DefectKind::different_length, DefectHandling::left_out, (*command)->name,
          (*command)->values.size(),
          fmt::format("{} samples where there are {} times", (*command)->values.size(),
                      raw_.time.size()));
      command->reset();
    }
  }

  void note_missing() {
    const bool bridge = options_.fill_short_gaps;
    for (RawChannel* channel : sensors()) add(missing_samples(*channel, raw_.time, bridge));
    for (auto* command : {&raw_.rate_command, &raw_.valve_command}) {
      if (*command) add(missing_samples(**command, raw_.time, bridge));
    }
    if (raw_.encoder) add(missing_samples(*raw_.encoder, raw_.time, false));
  }

  // A rate command stands still where the valve is driven past an open rate loop.
  void leave_out_dead_commands() {
    if (raw_.test == TestKind::slosh || !(spread(raw_.tachometer.values) > 0.0)) return;
    const auto leave_out = [&](std::optional<RawChannel>& command) {
      if (!command || spread(command->values) > 0.0) return;
      add(DefectKind::dead_channel, DefectHandling::left_out, command->name, command->values.size(),
          "at one value throughout while the drive moves");
      command.reset();
    };
    leave_out(raw_.valve_command);
    leave_out(raw_.encoder);
    if (raw_.rate_loop_closed) leave_out(raw_.rate_command);
  }

  // Of the pressures, how much one moves in the middle.
  double usual_spread() const {
    std::vector<double> spreads;
    for (const auto* side : {&raw_.inlet, &raw_.outlet}) {
      for (const auto& channel : *side) spreads.push_back(spread(channel.values));
    }
    return numerics::median(std::move(spreads));
  }

  void leave_out_commands() {
    const auto leave_out = [&](std::optional<RawChannel>& command, bool against) {
      if (!against || !command) return;
      add(DefectKind::reversed_sign, DefectHandling::left_out, command->name,
          command->values.size(),
          "goes against the tachometer, which torque and motion agree with: not used; turn its "
          "sign (record_columns.reversed) if it is reversed");
      command.reset();
    };
    leave_out(raw_.rate_command, options_.leave_out_rate_command);
    leave_out(raw_.valve_command, options_.leave_out_valve_command);
  }

  // Far below: zero errors are some thousandths of what pressures come to.
  bool is_reversed(const RawChannel& channel) const {
    double largest = 0.0;
    for (const auto* side : {&raw_.inlet, &raw_.outlet}) {
      for (const auto& other : *side)
        largest = std::max(largest, std::abs(finite_median(other.values)));
    }
    return finite_median(channel.values) < -0.1 * largest;
  }

  // A recorder that clips shows no value beyond its range: that is another unit or scale.
  static bool is_beyond_range(const RawChannel& channel) {
    constexpr double clearly = 1.05;
    return finite_median(channel.values) > clearly * channel.upper_limit;
  }

  void find_dead_pressures() {
    const double usual = usual_spread();
    const auto& exchanged = options_.exchanged_motors;
    for (const Side& side : {inlets(), outlets()}) {
      for (std::size_t motor = 0; motor < side.channels.size(); ++motor) {
        const RawChannel& channel = side.channels[motor];
        const auto because = [&](DefectKind kind, const char* why, const char* remedy) {
          side.replaced.push_back(motor);
          add(kind, DefectHandling::replaced, channel.name, channel.values.size(),
              fmt::format(
                  "{}: replaced by the mean of the other {} pressures, on the same common line{}",
                  why, side.name, remedy));
        };
        if (2 * finite_count(channel.values) < channel.values.size()) {
          because(DefectKind::dead_channel, "more than half of it is missing", "");
        } else if (spread(channel.values) < options_.dead_fraction * usual) {
          because(DefectKind::dead_channel, "hardly moves while others do", "");
        } else if (is_beyond_range(channel)) {
          because(DefectKind::wrong_scale, "more than half of it is beyond the transducer's range",
                  "; check its unit and scale");
        } else if (is_reversed(channel)) {
          because(DefectKind::reversed_sign, "a pressure below zero most of the time",
                  "; if its sign is turned, record_columns.reversed turns it back");
        } else if (std::find(exchanged.begin(), exchanged.end(), motor) != exchanged.end()) {
          because(DefectKind::swapped_ports,
                  "the motor's pressure difference goes against that of the others",
                  "; if its inlet and outlet are exchanged, exchange them in record_columns");
        }
      }
      if (side.replaced.size() == side.channels.size()) {
        refusal_kind_ = DefectKind::dead_channel;
        throw InvalidInput(
            fmt::format("expected an {} pressure of one motor at least, found all "
                        "dead, missing or of the wrong sign",
                        side.name));
      }
      replace(side);
    }
  }

  void find_dead_tachometer() {
    const Eigen::VectorXd& rate = raw_.tachometer.values;
    const bool missing = 2 * finite_count(rate) < rate.size();
    if (!missing && (spread(rate) > 0.0 || usual_spread() == 0.0)) return;
    if (raw_.test != TestKind::slosh && raw_.test_known) {
      refusal_kind_ = DefectKind::dead_channel;
      throw InvalidInput(fmt::format(
          "expected a tachometer that moves, found {} {}", raw_.tachometer.name,
          missing ? "missing in more than half of the samples" : "at one value throughout"));
    }
    add(DefectKind::dead_channel, DefectHandling::left_out, raw_.tachometer.name, rate.size(),
        "the tachometer shows nothing; a slosh test does without");
    result_.without_rate = true;
    raw_.tachometer.values.setConstant(std::numeric_limits<double>::quiet_NaN());
  }

  void replace(const Side& side) const {
    for (const std::size_t motor : side.replaced) {
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(raw_.time.size());
      double count = 0.0;
      for (std::size_t other = 0; other < side.channels.size(); ++other) {
        if (std::find(side.replaced.begin(), side.replaced.end(), other) != side.replaced.end()) {
          continue;
        }
        sum += side.channels[other].values;
        count += 1.0;
      }
      side.channels[motor].values = sum / count;
    }
  }

  bool is_replaced(std::size_t motor) const {
    const auto in = [motor](const std::vector<std::size_t>& motors) {
      return std::find(motors.begin(), motors.end(), motor) != motors.end();
    };
    return in(result_.replaced_inlets) || in(result_.replaced_outlets);
  }

  // What speaks against the columns' names or signs. The engineer decides.
  void report_suspicions() {
    constexpr double against = -0.5;
    const std::size_t motors = raw_.inlet.size();
    std::vector<Eigen::VectorXd> differences;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(raw_.time.size());
    for (std::size_t motor = 0; motor < motors; ++motor) {
      differences.emplace_back(raw_.inlet[motor].values - raw_.outlet[motor].values);
      sum += differences.back();
    }
    for (std::size_t motor = 0; motor < motors && motors > 1; ++motor) {
      if (is_replaced(motor) ||
          correlation(differences[motor], sum - differences[motor]) > against) {
        continue;
      }
      result_.suspicions.exchanged_motors.push_back(motor);
      add(DefectKind::swapped_ports, DefectHandling::reported, raw_.inlet[motor].name,
          raw_.time.size(),
          fmt::format("the pressure difference of motor {} goes against that of the other{}: are "
                      "its inlet and outlet swapped{}?",
                      motor + 1, motors > 2 ? "s" : "", motors > 2 ? "" : ", or the other's"));
    }
    const Eigen::VectorXd& rate = raw_.tachometer.values;
    const auto against_rate = [&](const std::optional<RawChannel>& command) {
      if (!command || correlation(command->values, rate) > against) return false;
      add(DefectKind::reversed_sign, DefectHandling::reported, command->name, raw_.time.size(),
          "goes against the tachometer: is the sign of one of the two turned?");
      return true;
    };
    result_.suspicions.rate_command = against_rate(raw_.rate_command);
    result_.suspicions.valve_command = against_rate(raw_.valve_command);
    // Friction takes power: over a test the torque does work on the motion.
    double work = 0.0;
    double torque_square = 0.0;
    double rate_square = 0.0;
    for (Index i = 0; i < rate.size(); ++i) {
      if (!std::isfinite(rate[i]) || !std::isfinite(sum[i])) continue;
      work += rate[i] * sum[i];
      torque_square += sum[i] * sum[i];
      rate_square += rate[i] * rate[i];
    }
    if (work < -0.3 * std::sqrt(torque_square * rate_square)) {
      result_.suspicions.torque = true;
      add(DefectKind::reversed_sign, DefectHandling::reported, raw_.tachometer.name,
          raw_.time.size(),
          "inlet above outlet drives against the tachometer: is its sign turned, or are inlets "
          "and outlets swapped?");
    }
  }

  void mask_sensors() {
    const std::vector<RawChannel*> all = sensors();
    limit_ = std::min(raw_.tachometer.upper_limit, -raw_.tachometer.lower_limit);
    for (RawChannel* channel : all) {
      if (is_replaced_channel(*channel)) continue;  // its neighbours' defects are masked there
      const bool tachometer = channel == &raw_.tachometer;
      add(mask_clipped(*channel, raw_.time, options_, tachometer ? &limit_ : nullptr));
      const std::vector<const RawChannel*> others(all.begin(), all.end());
      add(mask_stuck(*channel, others, raw_.time));
      add(mask_spikes(*channel, raw_.time));
    }
  }

  bool is_replaced_channel(const RawChannel& channel) const {
    const auto among = [&](const std::vector<RawChannel>& side,
                           const std::vector<std::size_t>& motors) {
      return std::any_of(motors.begin(), motors.end(),
                         [&](std::size_t motor) { return &side[motor] == &channel; });
    };
    return among(raw_.inlet, result_.replaced_inlets) ||
           among(raw_.outlet, result_.replaced_outlets);
  }

  void assemble(const EvenTimeBase& base) {
    DriveRecord record;
    record.name = raw_.name;
    record.test = raw_.test;
    record.rate_loop_closed = raw_.rate_loop_closed;
    record.sample_time = base.sample_time;
    for (const auto& channel : raw_.inlet) {
      record.inlet_pressure.push_back(on_time_base(base, channel.values));
    }
    for (const auto& channel : raw_.outlet) {
      record.outlet_pressure.push_back(on_time_base(base, channel.values));
    }
    record.motor_rate = on_time_base(base, raw_.tachometer.values);
    record.motor_rate_limit = limit_;
    if (raw_.rate_command) record.rate_command = on_time_base(base, raw_.rate_command->values);
    if (raw_.valve_command) record.valve_command = on_time_base(base, raw_.valve_command->values);
    if (raw_.encoder) record.encoder = on_time_base(base, raw_.encoder->values);
    result_.record = std::move(record);
    if (raw_.test == TestKind::slosh) mask_replaced(result_);
  }

  RawRecord raw_;
  DefectOptions options_;
  CleanRecord result_;
  double limit_ = std::numeric_limits<double>::infinity();
  DefectKind refusal_kind_ = DefectKind::too_short;
};

}  // namespace

std::string to_string(DefectKind kind) {
  switch (kind) {
    case DefectKind::missing_samples:
      return "missing samples";
    case DefectKind::missing_times:
      return "missing times";
    case DefectKind::repeated_times:
      return "repeated times";
    case DefectKind::backward_times:
      return "times that run back";
    case DefectKind::jitter:
      return "jitter";
    case DefectKind::rate_change:
      return "change of sample rate";
    case DefectKind::gap:
      return "gap";
    case DefectKind::different_length:
      return "different length";
    case DefectKind::clipped:
      return "clipped";
    case DefectKind::spike:
      return "spikes";
    case DefectKind::stuck:
      return "stuck";
    case DefectKind::dead_channel:
      return "dead channel";
    case DefectKind::swapped_ports:
      return "swapped ports";
    case DefectKind::reversed_sign:
      return "reversed sign";
    case DefectKind::wrong_scale:
      return "scale unlike other records";
    case DefectKind::too_short:
      break;
  }
  return "too short";
}

std::string to_string(DefectHandling handling) {
  switch (handling) {
    case DefectHandling::reported:
      return "reported";
    case DefectHandling::left_out:
      return "left out";
    case DefectHandling::resampled:
      return "resampled";
    case DefectHandling::bridged:
      return "bridged";
    case DefectHandling::masked:
      return "masked";
    case DefectHandling::replaced:
      return "replaced";
    case DefectHandling::refused:
      break;
  }
  return "refused";
}

void mask_replaced(CleanRecord& clean) {
  if (!clean.record) return;
  const auto samples = static_cast<std::size_t>(clean.record->samples());
  for (const std::size_t motor : clean.replaced_inlets) {
    clean.record->inlet_pressure[motor].valid.assign(samples, false);
  }
  for (const std::size_t motor : clean.replaced_outlets) {
    clean.record->outlet_pressure[motor].valid.assign(samples, false);
  }
}

CleanRecord clean_record(const RawRecord& raw, const DefectOptions& options) {
  if (raw.inlet.empty() || raw.inlet.size() != raw.outlet.size()) {
    throw InvalidInput(
        fmt::format("clean_record: record '{}' must have an inlet and an outlet for "
                    "each motor, found {} and {}",
                    raw.name, raw.inlet.size(), raw.outlet.size()));
  }
  return Cleaner(raw, options).clean();
}

}  // namespace boresight::identification
