#include "recorder_fault.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "column_faults.hpp"
#include "record_faults.hpp"
#include "stated_number_faults.hpp"
#include <boresight/numerics/error.hpp>

namespace boresight::faults {
namespace {

using enum Columns::Signal;

constexpr double throughout = std::numeric_limits<double>::infinity();

const Columns tacho{{tachometer}, {}};
const Columns angle{{encoder}, {}};
const Columns inlet_1{{inlet}, 0};
const Columns outlet_1{{outlet}, 0};
const Columns motor_1{{inlet, outlet}, 0};
const Columns all_inlets{{inlet}, {}};
const Columns all_pressures{{inlet, outlet}, {}};
const Columns rate_order{{rate_command}, {}};
const Columns valve_order{{valve_command}, {}};
const Columns everything{{inlet, outlet, tachometer, encoder, rate_command, valve_command}, {}};

struct NamedColumns {
  const char* name;
  Columns columns;
};

struct Listed {
  NamedColumns columns;
  Records records;
  std::vector<double> sizes;
};

const NamedColumns t{"tachometer", tacho}, e{"encoder", angle}, p{"inlet 1", inlet_1},
    o{"outlet 1", outlet_1}, m{"both ports of motor 1", motor_1}, i{"all inlets", all_inlets},
    a{"all pressures", all_pressures}, r{"rate command", rate_order},
    v{"valve command", valve_order}, x{"all columns", everything};

const char* where(Records records) {
  switch (records) {
    case Records::fast_ramp:
      return ", fast ramp only";
    case Records::valve_chirp:
      return ", valve chirp only";
    case Records::later_half:
      return ", later half of the records";
    case Records::all:
      break;
  }
  return "";
}

// One fault a size; `text` has a place for it.
void add(std::vector<RecorderFault>& faults, const std::string& kind, const char* text,
         const std::vector<Listed>& list, const std::function<Spoil(double)>& spoil) {
  for (const Listed& one : list) {
    for (const double size : one.sizes) {
      faults.push_back(
          column_fault(kind,
                       fmt::format("{} {}{}", one.columns.name,
                                   fmt::format(fmt::runtime(text), size), where(one.records)),
                       one.columns.columns, one.records, spoil(size)));
    }
  }
}

void add_scales(std::vector<RecorderFault>& faults) {
  add(faults, "gain", "x {:g}",
      {{t, Records::all, {0.9, 1.05, 10.0, 0.1}},
       {t, Records::fast_ramp, {0.9, 1.05, 10.0}},
       {t, Records::valve_chirp, {1.05}},
       {t, Records::later_half, {1.05}},
       {e, Records::all, {1.05, 10.0}},
       {p, Records::all, {0.9, 1.05, 10.0, 0.1}},
       {p, Records::fast_ramp, {0.9, 10.0}},
       {p, Records::later_half, {0.9}},
       {o, Records::all, {0.9, 1.05}},
       {m, Records::all, {0.9, 1.05, 10.0}},
       {i, Records::all, {0.9, 1.05}},
       {a, Records::all, {0.9, 1.05, 10.0, 0.1}},
       {a, Records::fast_ramp, {0.9}},
       {a, Records::later_half, {0.9}},
       {r, Records::all, {1.05, 10.0}},
       {v, Records::all, {1.05, 10.0}},
       {v, Records::valve_chirp, {1.2}}},
      gain);
  add(faults, "unit", "in psi read as kPa ({:g})",
      {{a, Records::all, {1.0 / 6.894757}}, {p, Records::all, {1.0 / 6.894757}}}, gain);
  add(faults, "unit", "in psi read as bar ({:g})",
      {{a, Records::all, {14.503774}}, {m, Records::fast_ramp, {14.503774}}}, gain);
  add(faults, "unit", "in rpm read as rad/s ({:.4g})", {{t, Records::all, {9.5492966}}}, gain);
  add(faults, "unit", "in degrees read as rad ({:.4g})",
      {{t, Records::all, {57.29578}},
       {t, Records::fast_ramp, {57.29578}},
       {e, Records::all, {57.29578}}},
      gain);
  add(faults, "sign", "reversed ({:g})",
      {{t, Records::all, {-1.0}},
       {t, Records::fast_ramp, {-1.0}},
       {e, Records::all, {-1.0}},
       {p, Records::all, {-1.0}},
       {m, Records::all, {-1.0}},
       {a, Records::all, {-1.0}},
       {r, Records::all, {-1.0}},
       {v, Records::all, {-1.0}}},
      gain);
  add(faults, "zero", "{:+g} of its largest value",
      {{t, Records::all, {0.03}},
       {t, Records::fast_ramp, {0.03}},
       {p, Records::all, {0.03}},
       {p, Records::fast_ramp, {0.03}},
       {o, Records::all, {-0.03}},
       {i, Records::all, {0.03}}},
      zero);
  add(faults, "drift", "gain 1 to {:g} over the campaign",
      {{t, Records::all, {1.05}}, {p, Records::all, {0.9}}, {a, Records::all, {0.9}}}, gain_drift);
  add(faults, "drift", "zero 0 to {:g} of its largest value in each record",
      {{t, Records::all, {0.03}}, {p, Records::all, {0.05}}}, zero_drift);
}

void add_shapes(std::vector<RecorderFault>& faults) {
  add(faults, "delay", "{:g} s late",
      {{t, Records::all, {0.02, 0.1}},
       {p, Records::all, {0.1}},
       {a, Records::all, {0.02, 0.1}},
       {e, Records::all, {0.1}},
       {v, Records::all, {0.05}}},
      delay);
  add(faults, "delay", "through a low-pass of {:g} Hz",
      {{t, Records::all, {2.0}}, {p, Records::all, {2.0}}}, lag);
  add(faults, "stuck", "for {:g} s in each record",
      {{t, Records::all, {3.0}}, {p, Records::all, {3.0}}, {a, Records::all, {3.0}}}, stuck);
  add(faults, "stuck", "throughout ({:g} s)",
      {{t, Records::fast_ramp, {throughout}},
       {t, Records::all, {throughout}},
       {p, Records::all, {throughout}},
       {e, Records::all, {throughout}}},
      stuck);
  add(faults, "clipping", "at {:g} of its range",
      {{t, Records::all, {0.6}}, {p, Records::all, {0.6}}, {a, Records::all, {0.6}}}, clipped);
  add(faults, "missing samples", "{:g} at random",
      {{t, Records::all, {0.001, 0.01, 0.05}},
       {p, Records::all, {0.01, 0.05}},
       {x, Records::all, {0.001, 0.01, 0.05}}},
      missing);
  add(faults, "missing samples", "{:g} in bursts of 40",
      {{t, Records::all, {0.05}}, {p, Records::all, {0.05}}, {x, Records::all, {0.01, 0.05}}},
      [](double fraction) { return missing_bursts(fraction, 40); });
  add(faults, "noise", "spikes in {:g} of the samples",
      {{t, Records::all, {0.002}}, {p, Records::all, {0.002}}}, spikes);
  add(faults, "noise", "with white noise of {:g} of its range",
      {{t, Records::all, {0.01}}, {p, Records::all, {0.02}}}, noise);
  add(faults, "noise", "with hum of {:g} of its range at 50 Hz",
      {{t, Records::all, {0.01}}, {a, Records::all, {0.02}}},
      [](double fraction) { return hum(fraction, 50.0); });
  add(faults, "noise", "in {:g} steps over its range",
      {{t, Records::all, {256.0}}, {a, Records::all, {256.0}}}, quantised);
}

}  // namespace

std::vector<RecorderFault> recorder_faults() {
  std::vector<RecorderFault> faults;
  faults.push_back({"none", "none", {}, [](RecordedCampaign&, reference::RandomNumbers&) {}});
  add_scales(faults);
  add_shapes(faults);
  add_record_faults(faults);
  add_stated_numbers(faults);
  return faults;
}

std::vector<RecorderFault> recorder_faults(const std::vector<std::string>& words) {
  std::vector<RecorderFault> all = recorder_faults();
  if (words.empty()) return all;
  const auto begins = [](const RecorderFault& fault, const std::string& word) {
    return fault.kind.starts_with(word) || fault.name.starts_with(word);
  };
  for (const std::string& word : words) {
    if (std::ranges::none_of(all, [&](const auto& one) { return begins(one, word); })) {
      throw InvalidInput(fmt::format("expected the kind or name of a fault, found '{}'", word));
    }
  }
  std::erase_if(all, [&](const RecorderFault& one) {
    return std::ranges::none_of(words, [&](const auto& word) { return begins(one, word); });
  });
  return all;
}

}  // namespace boresight::faults
