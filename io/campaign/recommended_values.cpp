#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <boresight/io/campaign/campaign_comparison.hpp>
#include <boresight/io/campaign/channel_findings.hpp>
#include <boresight/io/campaign/recommended_values.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::io {
namespace {

using identification::DefectHandling;
using identification::DefectKind;
using identification::RecordDefect;
using identification::StatedNumberCheck;

constexpr double many_samples = 0.005;  // of a record
constexpr double mostly = 0.5;
constexpr double badly_predicted = 5.0;  // times the median
constexpr double beyond_stated = 3.0;    // standard uncertainties

double fraction_of(const RecordNotes& record, const RecordDefect& defect) {
  return record.rows > 0 ? static_cast<double>(defect.count) / static_cast<double>(record.rows)
                         : 1.0;
}

bool is_suspicious(const RecordNotes& record, const RecordDefect& defect) {
  switch (defect.kind) {
    case DefectKind::dead_channel:
    case DefectKind::swapped_ports:
    case DefectKind::reversed_sign:
    case DefectKind::wrong_scale:
    case DefectKind::different_length:
    case DefectKind::too_short:
      return true;
    case DefectKind::clipped:
      return fraction_of(record, defect) > mostly;
    case DefectKind::missing_samples:
    case DefectKind::stuck:
    case DefectKind::spike:
      return fraction_of(record, defect) > many_samples;
    default:
      return defect.handling == DefectHandling::refused;
  }
}

// The more a finding invalidates, the earlier it is listed.
int rank(const ChannelSuspicion& one) {
  if (one.record_refused) return 0;
  const bool counted = one.finding == to_string(DefectKind::missing_samples) ||
                       one.finding == to_string(DefectKind::stuck) ||
                       one.finding == to_string(DefectKind::spike) ||
                       one.finding == to_string(DefectKind::clipped);
  return counted ? 2 : 1;
}

void add_once(std::vector<std::string>& names, const std::string& name) {
  if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
}

// One a kind of defect and way it was handled.
std::vector<ChannelSuspicion> by_defects(const CampaignNotes& notes) {
  std::vector<ChannelSuspicion> found;
  std::map<std::pair<DefectKind, bool>, std::size_t> places;
  for (const RecordNotes& record : notes.records) {
    for (const RecordDefect& defect : record.defects) {
      if (!is_suspicious(record, defect)) continue;
      const bool refused = defect.handling == DefectHandling::refused;
      const auto [place, is_new] = places.emplace(std::pair(defect.kind, refused), found.size());
      if (is_new) {
        ChannelSuspicion first;
        first.finding = identification::to_string(defect.kind);
        first.record_refused = refused;
        first.explanation = defect.explanation;
        found.push_back(std::move(first));
      }
      ChannelSuspicion& one = found[place->second];
      add_once(one.records, record.name);
      add_once(one.channels, defect.channel);
      one.fraction = std::max(one.fraction, fraction_of(record, defect));
    }
  }
  return found;
}

// A column of a record as the file calls it.
std::string column_of(const CampaignNotes& notes, std::string_view signal) {
  for (const RecordNotes& record : notes.records) {
    for (const SignalSource& source : record.sources) {
      if (source.signal.starts_with(signal)) return source.column;
    }
  }
  return std::string(signal);
}

// A slosh test's rate rings with the lines, which the fit does not model.
bool is_slosh(const CampaignSection& section, const std::string& name) {
  const auto found = std::ranges::find(section.notes.records, name, &RecordNotes::name);
  return found != section.notes.records.end() && found->test == identification::TestKind::slosh;
}

void add_unexplained(const CampaignSection& section, std::vector<ChannelSuspicion>& found) {
  std::vector<double> all;
  for (const auto& residual : section.grey_box->residuals) {
    if (!residual.pressures) all.push_back(residual.rms);
  }
  if (all.size() < 3) return;
  const double usual = numerics::median(std::move(all));
  for (const auto& residual : section.grey_box->residuals) {
    if (residual.pressures || !(residual.rms > badly_predicted * usual)) continue;
    if (is_slosh(section, residual.record)) continue;
    ChannelSuspicion one;
    one.finding = "not explained";
    one.records = {residual.record};
    one.channels = {column_of(section.notes, "tachometer")};
    one.fraction = 1.0;
    one.explanation = fmt::format(
        "the fit predicts its rate to {:.2g} rad/s rms, that of the median record to "
        "{:.2g}",
        residual.rms, usual);
    found.push_back(std::move(one));
  }
}

// Scales of the recorder's channels among what the fit varies, and the signals that have them.
struct ChannelScale {
  std::string_view parameter;
  std::vector<std::string_view> signals;
};
const std::vector<ChannelScale>& channel_scales() {
  static const std::vector<ChannelScale> scales{
      {"tachometer scale", {"tachometer"}},
      {"pressure gain", {"inlet pressure", "outlet pressure"}},
      {"torque per pressure", {"inlet pressure", "outlet pressure"}},
      {"unlike gains of inlets and outlets", {"inlet pressure", "outlet pressure"}},
      {"flow per rate", {"tachometer"}},
      {"displacement", {"inlet pressure", "outlet pressure", "tachometer"}},
      {"supply pressure as torque", {"inlet pressure", "outlet pressure"}},
      {"valve scale", {"valve command"}}};
  return scales;
}

// The columns of all motors that have these signals.
std::vector<std::string> columns_of(const CampaignNotes& notes,
                                    const std::vector<std::string_view>& signals) {
  std::vector<std::string> columns;
  for (const RecordNotes& record : notes.records) {
    for (const SignalSource& source : record.sources) {
      const bool counts = std::ranges::any_of(
          signals, [&](std::string_view signal) { return source.signal.starts_with(signal); });
      if (counts) add_once(columns, source.column);
    }
  }
  if (columns.empty()) columns.assign(signals.begin(), signals.end());
  return columns;
}

// The numbers that all else contradicts, those that move the inertia first; then scales of channels
// that the fit itself moved away from what is stated.
std::vector<StatedNumberCheck> contradicted_numbers(const identification::GreyBoxResult& fit) {
  using identification::StatedNumbers;
  const auto& checks = fit.stated_numbers;
  auto numbers = identification::departing_numbers(checks, beyond_stated);
  const auto append = [&](const StatedNumberCheck& one) {
    if (std::ranges::find(numbers, one.name, &StatedNumberCheck::name) == numbers.end()) {
      numbers.push_back(one);
    }
  };
  for (const auto& one :
       identification::departing_numbers(checks, beyond_stated, StatedNumbers::all)) {
    append(one);
  }
  for (const auto& parameter : fit.parameters) {
    if (std::abs(parameter.departure) < beyond_stated) continue;
    const auto one = std::ranges::find(checks, parameter.parameter.name, &StatedNumberCheck::name);
    const bool is_scale = std::ranges::any_of(channel_scales(), [&](const ChannelScale& scale) {
      return scale.parameter == parameter.parameter.name;
    });
    if (is_scale && one != checks.end()) append(*one);
  }
  if (numbers.empty()) numbers = identification::departing_numbers(checks, 0.0, StatedNumbers::all);
  return numbers;
}

void add_contradicted(const CampaignSection& section, std::vector<ChannelSuspicion>& found) {
  const auto numbers = contradicted_numbers(*section.grey_box);
  if (numbers.empty()) return;
  ChannelSuspicion one;
  one.finding = "contradicts the case";
  one.records = section.grey_box->records;
  one.fraction = 1.0;
  one.explanation = departures_of(numbers);
  for (const auto& number : numbers) {
    one.stated_numbers.push_back(number.name);
    const auto& scales = channel_scales();
    const auto scale =
        std::ranges::find(scales, std::string_view(number.name), &ChannelScale::parameter);
    if (scale == scales.end()) continue;
    for (const auto& column : columns_of(section.notes, scale->signals)) {
      add_once(one.channels, column);
    }
  }
  found.push_back(std::move(one));
}

}  // namespace

Rejection rejection(const CampaignSection& section) {
  if (channels_contradict(section)) return Rejection::channels_contradict;
  if (!section.grey_box) return Rejection::fit_failed;
  return section.grey_box->estimate.contradicted || section.grey_box->conflict.widening > 1.0
             ? Rejection::contradicts_case
             : Rejection::none;
}

std::string to_string(Rejection why) {
  switch (why) {
    case Rejection::channels_contradict:
      return "channels contradict one another";
    case Rejection::contradicts_case:
      return "contradicts the case";
    case Rejection::fit_failed:
      return "fit failed";
    case Rejection::none:
      break;
  }
  return "";
}

std::optional<RecommendedValues> recommended(const CampaignSection& section) {
  if (rejection(section) != Rejection::none) return std::nullopt;
  return RecommendedValues{section.grey_box->quantity("inertia").posterior,
                           section.grey_box->quantity("motor to load ratio").posterior};
}

const StatedNumberCheck* weakest_check(const CampaignSection& section) {
  if (rejection(section) != Rejection::none) return nullptr;
  const auto& checks = section.grey_box->stated_numbers;
  const auto least = std::ranges::max_element(checks, {}, [](const StatedNumberCheck& one) {
    return std::abs(one.inertia_effect) * one.visible_error;
  });
  return least == checks.end() ? nullptr : &*least;
}

std::vector<SupersededInput> superseded_inputs(const Case& stated, const CampaignSection& section) {
  if (!recommended(section)) return {};
  const identification::GreyBoxResult& found = *section.grey_box;
  try {
    return superseded_inputs(stated, with_identified(stated, found.estimate, found.random_samples,
                                                     taken_parts(stated, found)));
  } catch (const NumericalFailure&) {
    return {};
  }
}

std::vector<ChannelSuspicion> suspicions(const CampaignSection& section) {
  std::vector<ChannelSuspicion> found = channel_suspicions(section);
  for (ChannelSuspicion& one : by_defects(section.notes)) found.push_back(std::move(one));
  if (section.grey_box) {
    add_unexplained(section, found);
    if (rejection(section) == Rejection::contradicts_case) add_contradicted(section, found);
  }
  std::ranges::stable_sort(found, {}, [](const ChannelSuspicion& one) { return rank(one); });
  return found;
}

}  // namespace boresight::io
