#include "record_faults.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

namespace boresight::faults {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using identification::RawChannel;
using identification::RawRecord;
using identification::TestKind;
using reference::RandomNumbers;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

using Change = std::function<void(RawRecord&, RandomNumbers&)>;

RawRecord& record_of(RecordedCampaign& campaign, TestKind test) {
  return *std::ranges::find(campaign.records, test, &RawRecord::test);
}

RecorderFault in_all(std::string kind, std::string name, std::vector<std::string> names,
                     Change change) {
  return {std::move(kind), std::move(name), std::move(names),
          [change = std::move(change)](RecordedCampaign& campaign, RandomNumbers& random) {
            for (RawRecord& record : campaign.records) change(record, random);
          },
          ""};
}

RecorderFault in_one(std::string kind, std::string name, std::vector<std::string> names,
                     TestKind test, Change change) {
  return {std::move(kind), std::move(name), std::move(names),
          [test, change = std::move(change)](RecordedCampaign& campaign, RandomNumbers& random) {
            change(record_of(campaign, test), random);
          },
          ""};
}

RecorderFault of_case(std::string name, std::vector<std::string> names,
                      std::function<void(RecordedCampaign&)> change) {
  return {"case", std::move(name), std::move(names),
          [change = std::move(change)](RecordedCampaign& campaign, RandomNumbers&) {
            change(campaign);
          },
          ""};
}

// The values of two columns, whose names and limits stay.
void exchange(RawChannel& one, RawChannel& other) {
  std::swap(one.values, other.values);
}

// All columns of the samples for which `keeps` holds.
void keep(RawRecord& record, const std::function<bool(Index)>& keeps) {
  std::vector<Index> kept;
  for (Index i = 0; i < record.time.size(); ++i) {
    if (keeps(i)) kept.push_back(i);
  }
  const auto take = [&kept](VectorXd& values) { values = VectorXd(values(kept)); };
  take(record.time);
  for (auto* side : {&record.inlet, &record.outlet}) {
    for (RawChannel& channel : *side) take(channel.values);
  }
  take(record.tachometer.values);
  for (auto* column : {&record.rate_command, &record.valve_command, &record.encoder}) {
    if (*column) take((*column)->values);
  }
}

void add_swaps(std::vector<RecorderFault>& faults) {
  const auto ports = [](RawRecord& one, RandomNumbers&) { exchange(one.inlet[0], one.outlet[0]); };
  faults.push_back(in_all("swap", "inlet 1 and outlet 1 exchanged",
                          {"inlet_pressure_1", "outlet_pressure_1"}, ports));
  faults.push_back(in_one("swap", "inlet 1 and outlet 1 exchanged, fast ramp only",
                          {"inlet_pressure_1", "outlet_pressure_1"}, TestKind::fast_ramp, ports));
  faults.push_back(
      in_all("swap", "inlets 1 and 2 exchanged", {},
             [](RawRecord& one, RandomNumbers&) { exchange(one.inlet[0], one.inlet[1]); }));
  faults.push_back(
      in_all("swap", "all inlets and outlets exchanged",
             {"inlet_pressure", "outlet_pressure", "tachometer"},
             [](RawRecord& one, RandomNumbers&) { std::swap(one.inlet, one.outlet); }));
  faults.push_back(
      in_all("swap", "inlet 1 is inlet 2 recorded twice", {},
             [](RawRecord& one, RandomNumbers&) { one.inlet[0].values = one.inlet[1].values; }));
  faults.push_back(
      in_all("swap", "tachometer and rate command exchanged", {"tachometer", "rate_command"},
             [](RawRecord& one, RandomNumbers&) { exchange(one.tachometer, *one.rate_command); }));
  faults.push_back(
      in_all("swap", "tachometer and valve command exchanged", {"tachometer", "valve_command"},
             [](RawRecord& one, RandomNumbers&) { exchange(one.tachometer, *one.valve_command); }));
  faults.push_back(
      in_one("swap", "tachometer and valve command exchanged, valve chirp only",
             {"tachometer", "valve_command"}, TestKind::valve_chirp,
             [](RawRecord& one, RandomNumbers&) { exchange(one.tachometer, *one.valve_command); }));
  faults.push_back(in_all(
      "swap", "rate command and valve command exchanged", {"rate_command", "valve_command"},
      [](RawRecord& one, RandomNumbers&) { exchange(*one.rate_command, *one.valve_command); }));
}

void add_times(std::vector<RecorderFault>& faults) {
  const auto scaled = [](double factor) {
    return [factor](RawRecord& one, RandomNumbers&) { one.time *= factor; };
  };
  faults.push_back(
      in_all("time base", "clock 5 % slow, all records", {"tachometer", "time"}, scaled(0.95)));
  faults.push_back(
      in_all("time base", "clock 1 % slow, all records", {"tachometer", "time"}, scaled(0.99)));
  faults.push_back(in_one("time base", "clock 10 % fast, fast ramp only",
                          {"fast ramp", "tachometer", "time"}, TestKind::fast_ramp, scaled(1.1)));
  faults.push_back(in_all("time base", "ms read as s", {"tachometer", "time"}, scaled(1000.0)));
  faults.push_back(in_all("time base", "jitter of 0.2 sample times", {},
                          [](RawRecord& one, RandomNumbers& random) {
                            const double step = one.time[1] - one.time[0];
                            for (double& time : one.time) time += random.uniform(-0.2, 0.2) * step;
                          }));
  faults.push_back(
      in_all("time base", "times with 2 decimals", {}, [](RawRecord& one, RandomNumbers&) {
        one.time = 0.01 * (100.0 * one.time).array().round().matrix();
      }));
  faults.push_back(in_all("time base", "1 % of the samples lost, times as if none were",
                          {"tachometer", "time"}, [](RawRecord& one, RandomNumbers& random) {
                            const VectorXd times = one.time;
                            keep(one, [&](Index) { return random.uniform(0.0, 1.0) >= 0.01; });
                            one.time = times.head(one.time.size());
                          }));
  faults.push_back(
      in_all("gaps", "one of 0.5 s in each record", {}, [](RawRecord& one, RandomNumbers&) {
        const double middle = 0.5 * one.time[one.time.size() - 1];
        const VectorXd times = one.time;
        keep(one, [&](Index i) { return std::abs(times[i] - middle) > 0.25; });
      }));
  faults.push_back(in_all("gaps", "0.1 s in every 5 s", {}, [](RawRecord& one, RandomNumbers&) {
    const VectorXd times = one.time;
    keep(one, [&](Index i) { return std::fmod(times[i] + 2.0, 5.0) > 0.1; });
  }));
  faults.push_back(
      in_all("gaps", "5 % of the lines lost", {}, [](RawRecord& one, RandomNumbers& random) {
        keep(one, [&](Index) { return random.uniform(0.0, 1.0) >= 0.05; });
      }));
  faults.push_back(in_one("gaps", "fast ramp ends after a third", {}, TestKind::fast_ramp,
                          [](RawRecord& one, RandomNumbers&) {
                            const Index end = one.time.size() / 3;
                            keep(one, [end](Index i) { return i < end; });
                          }));
  faults.push_back(
      in_all("gaps", "a line of no numbers every second", {}, [](RawRecord& one, RandomNumbers&) {
        const double step = one.time[1] - one.time[0];
        const Index every = std::lround(1.0 / step);
        for (Index i = every; i < one.time.size(); i += every) {
          one.time[i] = no_number;
        }
      }));
}

void add_headers(std::vector<RecorderFault>& faults) {
  faults.push_back(in_one("wrong header", "slow ramp called a fast ramp", {"slow ramp"},
                          TestKind::slow_ramp,
                          [](RawRecord& one, RandomNumbers&) { one.test = TestKind::fast_ramp; }));
  faults.push_back(in_one(
      "wrong header", "fast ramp called a constant speed", {"fast ramp"}, TestKind::fast_ramp,
      [](RawRecord& one, RandomNumbers&) { one.test = TestKind::constant_speed; }));
  faults.push_back(in_one("wrong header", "valve steps called a slosh test", {"valve steps"},
                          TestKind::valve_steps,
                          [](RawRecord& one, RandomNumbers&) { one.test = TestKind::slosh; }));
  faults.push_back(
      in_one("wrong header", "slosh test called valve steps", {"slosh"}, TestKind::slosh,
             [](RawRecord& one, RandomNumbers&) { one.test = TestKind::valve_steps; }));
  faults.push_back(in_one("wrong header", "valve chirp called closed-loop", {"valve chirp"},
                          TestKind::valve_chirp,
                          [](RawRecord& one, RandomNumbers&) { one.rate_loop_closed = true; }));
  faults.push_back({"wrong header",
                    "a record of another antenna",
                    {"fast ramp"},
                    [](RecordedCampaign& campaign, RandomNumbers&) {
                      // As one with 1.4 times the supply, friction and inertia records it.
                      RawRecord& one = record_of(campaign, TestKind::fast_ramp);
                      for (auto* side : {&one.inlet, &one.outlet}) {
                        for (RawChannel& channel : *side) channel.values *= 1.4;
                      }
                    },
                    ""});
}

void add_case(std::vector<RecorderFault>& faults) {
  const std::vector<std::string> torque{"displacement", "torque per pressure"};
  faults.push_back(of_case("displacement 5 % high", torque, [](RecordedCampaign& one) {
    one.knowledge.displacement.value *= 1.05;
  }));
  faults.push_back(of_case("torque efficiency 3 % low", torque, [](RecordedCampaign& one) {
    one.knowledge.torque_efficiency.value *= 0.97;
  }));
  faults.push_back(of_case("motor inertia 10 % high", {"motor inertia"}, [](RecordedCampaign& one) {
    one.knowledge.motor_inertia.value *= 1.1;
  }));
  faults.push_back(
      of_case("antenna inertia 30 % high", {"antenna inertia"},
              [](RecordedCampaign& one) { one.knowledge.antenna_inertia.value *= 1.3; }));
  faults.push_back(of_case("gear ratio 5 % high", {"tachometer", "encoder"},
                           [](RecordedCampaign& one) { one.knowledge.gear_ratio *= 1.05; }));
  faults.push_back(
      of_case("oil volumes 10 % high", {"volume", "bulk modulus"}, [](RecordedCampaign& one) {
        one.knowledge.volume_1.value *= 1.1;
        one.knowledge.volume_2.value *= 1.1;
      }));
  faults.push_back(of_case("supply pressure 10 % high", {"supply pressure"},
                           [](RecordedCampaign& one) { one.knowledge.supply_pressure *= 1.1; }));
  faults.push_back(of_case("line lengths 10 % high", {"bulk modulus"}, [](RecordedCampaign& one) {
    for (auto& length : one.knowledge.line_lengths) length.value *= 1.1;
  }));
  faults.push_back(of_case("no encoder recorded", {}, [](RecordedCampaign& one) {
    for (RawRecord& record : one.records) record.encoder.reset();
  }));
  faults.push_back(
      of_case("no encoder recorded, tachometer x 1.05", {"tachometer"}, [](RecordedCampaign& one) {
        for (RawRecord& record : one.records) {
          record.encoder.reset();
          record.tachometer.values *= 1.05;
          record.tachometer.upper_limit *= 1.05;
          record.tachometer.lower_limit *= 1.05;
        }
      }));
  faults.push_back(
      of_case("tachometer and encoder x 1.05", {"tachometer"}, [](RecordedCampaign& one) {
        for (RawRecord& record : one.records) {
          record.encoder->values *= 1.05;
          record.tachometer.values *= 1.05;
          record.tachometer.upper_limit *= 1.05;
          record.tachometer.lower_limit *= 1.05;
        }
      }));
}

}  // namespace

void add_record_faults(std::vector<RecorderFault>& faults) {
  add_swaps(faults);
  add_times(faults);
  add_headers(faults);
  add_case(faults);
}

}  // namespace boresight::faults
