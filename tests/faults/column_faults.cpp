#include "column_faults.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace boresight::faults {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using identification::RawChannel;
using identification::RawRecord;
using identification::TestKind;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

double largest(const VectorXd& values) {
  return values.cwiseAbs().maxCoeff();
}

double range(const VectorXd& values) {
  return values.maxCoeff() - values.minCoeff();
}

double sample_time(const RawRecord& record) {
  const Index last = record.time.size() - 1;
  return (record.time[last] - record.time[0]) / static_cast<double>(last);
}

bool concerns(Records records, const RawRecord& record, std::size_t place, std::size_t count) {
  switch (records) {
    case Records::fast_ramp:
      return record.test == TestKind::fast_ramp;
    case Records::valve_chirp:
      return record.test == TestKind::valve_chirp;
    case Records::later_half:
      return 2 * place >= count;
    case Records::all:
      break;
  }
  return true;
}

const char* name_of(Columns::Signal signal) {
  switch (signal) {
    case Columns::Signal::inlet:
      return "inlet_pressure";
    case Columns::Signal::outlet:
      return "outlet_pressure";
    case Columns::Signal::tachometer:
      return "tachometer";
    case Columns::Signal::encoder:
      return "encoder";
    case Columns::Signal::rate_command:
      return "rate_command";
    case Columns::Signal::valve_command:
      break;
  }
  return "valve_command";
}

}  // namespace

std::vector<RawChannel*> columns_of(RawRecord& record, const Columns& columns) {
  using enum Columns::Signal;
  std::vector<RawChannel*> found;
  const auto add_ports = [&](std::vector<RawChannel>& side) {
    for (std::size_t motor = 0; motor < side.size(); ++motor) {
      if (!columns.motor || *columns.motor == motor) found.push_back(&side[motor]);
    }
  };
  const auto add = [&](std::optional<RawChannel>& column) {
    if (column) found.push_back(&*column);
  };
  for (const Columns::Signal signal : columns.signals) {
    if (signal == inlet) add_ports(record.inlet);
    if (signal == outlet) add_ports(record.outlet);
    if (signal == tachometer) found.push_back(&record.tachometer);
    if (signal == encoder) add(record.encoder);
    if (signal == rate_command) add(record.rate_command);
    if (signal == valve_command) add(record.valve_command);
  }
  return found;
}

std::vector<std::string> names_of(const Columns& columns) {
  std::vector<std::string> names;
  for (const Columns::Signal signal : columns.signals) {
    std::string name = name_of(signal);
    const bool pressure = signal == Columns::Signal::inlet || signal == Columns::Signal::outlet;
    if (pressure && columns.motor) name += "_" + std::to_string(*columns.motor + 1);
    names.push_back(std::move(name));
    // One against the other: their finding names the tachometer, and the encoder in its
    // explanation.
    if (signal == Columns::Signal::encoder) names.emplace_back("tachometer");
  }
  return names;
}

RecorderFault column_fault(std::string kind, std::string name, const Columns& columns,
                           Records records, const Spoil& spoil) {
  const auto apply = [=](RecordedCampaign& campaign, reference::RandomNumbers& random) {
    const std::size_t count = campaign.records.size();
    for (std::size_t place = 0; place < count; ++place) {
      RawRecord& record = campaign.records[place];
      if (!concerns(records, record, place, count)) continue;
      for (RawChannel* channel : columns_of(record, columns)) {
        spoil({record, *channel, place, count, random});
      }
    }
  };
  return {std::move(kind), std::move(name), names_of(columns), apply};
}

Spoil gain(double factor) {
  return [factor](const Spoiled& one) {
    RawChannel& channel = one.channel;
    channel.values *= factor;
    if (one.channel.name != "tachometer") return;  // a transducer's range is stated by itself
    channel.upper_limit *= std::abs(factor);
    channel.lower_limit *= std::abs(factor);
  };
}

Spoil gain_drift(double factor) {
  return [factor](const Spoiled& one) {
    const double into = static_cast<double>(one.place) / static_cast<double>(one.count - 1);
    gain(1.0 + (factor - 1.0) * into)(one);
  };
}

Spoil zero(double fraction) {
  return [fraction](const Spoiled& one) {
    one.channel.values.array() += fraction * largest(one.channel.values);
  };
}

Spoil zero_drift(double fraction) {
  return [fraction](const Spoiled& one) {
    VectorXd& values = one.channel.values;
    values += fraction * largest(values) * VectorXd::LinSpaced(values.size(), 0.0, 1.0);
  };
}

Spoil delay(double seconds) {
  return [seconds](const Spoiled& one) {
    const VectorXd before = one.channel.values;
    const double samples = seconds / sample_time(one.record);
    for (Index i = 0; i < before.size(); ++i) {
      const double at = std::max(0.0, static_cast<double>(i) - samples);
      const auto low = static_cast<Index>(at);
      const Index high = std::min(low + 1, before.size() - 1);
      const double part = at - static_cast<double>(low);
      one.channel.values[i] = (1.0 - part) * before[low] + part * before[high];
    }
  };
}

Spoil lag(double corner) {
  return [corner](const Spoiled& one) {
    const double keep = std::exp(-2.0 * std::numbers::pi * corner * sample_time(one.record));
    VectorXd& values = one.channel.values;
    for (Index i = 1; i < values.size(); ++i) {
      values[i] = keep * values[i - 1] + (1.0 - keep) * values[i];
    }
  };
}

Spoil stuck(double seconds) {
  return [seconds](const Spoiled& one) {
    VectorXd& values = one.channel.values;
    const bool throughout = std::isinf(seconds);
    const Index first = throughout ? 0 : values.size() / 3;
    const Index count = throughout ? values.size()
                                   : std::min<Index>(std::lround(seconds / sample_time(one.record)),
                                                     values.size() - first);
    values.segment(first, count).setConstant(values[first]);
  };
}

Spoil clipped(double fraction) {
  return [fraction](const Spoiled& one) {
    VectorXd& values = one.channel.values;
    const double middle = 0.5 * (values.maxCoeff() + values.minCoeff());
    const double half = 0.5 * fraction * range(values);
    values = values.cwiseMax(middle - half).cwiseMin(middle + half);
  };
}

Spoil missing(double fraction) {
  return missing_bursts(fraction, 1);
}

Spoil missing_bursts(double fraction, Index length) {
  return [fraction, length](const Spoiled& one) {
    VectorXd& values = one.channel.values;
    const double chance = fraction / static_cast<double>(length);
    for (Index i = 0; i < values.size(); ++i) {
      if (one.random.uniform(0.0, 1.0) >= chance) continue;
      const Index count = std::min(length, values.size() - i);
      values.segment(i, count).setConstant(no_number);
      i += count - 1;
    }
  };
}

Spoil spikes(double fraction) {
  return [fraction](const Spoiled& one) {
    VectorXd& values = one.channel.values;
    const double low = values.minCoeff(), high = values.maxCoeff();
    for (double& value : values) {
      if (one.random.uniform(0.0, 1.0) < fraction) value = one.random.uniform(low, high);
    }
  };
}

Spoil noise(double fraction) {
  return [fraction](const Spoiled& one) {
    // Of a sum of twelve uniform numbers the variance is 1.
    const double rms = fraction * range(one.channel.values);
    for (double& value : one.channel.values) {
      double normal = -6.0;
      for (int i = 0; i < 12; ++i) normal += one.random.uniform(0.0, 1.0);
      value += rms * normal;
    }
  };
}

Spoil hum(double fraction, double frequency) {
  return [fraction, frequency](const Spoiled& one) {
    const double amplitude = fraction * range(one.channel.values);
    one.channel.values.array() +=
        amplitude * (2.0 * std::numbers::pi * frequency * one.record.time.array()).sin();
  };
}

Spoil quantised(double steps) {
  return [steps](const Spoiled& one) {
    const double step = range(one.channel.values) / steps;
    if (!(step > 0.0)) return;
    one.channel.values = step * (one.channel.values / step).array().round().matrix();
  };
}

}  // namespace boresight::faults
