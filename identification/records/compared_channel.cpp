#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string_view>

#include <boresight/identification/records/compared_channel.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::identification {
namespace {

using Index = Eigen::Index;
using Quantities = std::vector<ComparedQuantity>;

struct NamedFactor {
  double factor;
  std::string_view name;
  bool pressures_only;
};
constexpr double kilopascals_per_psi = 6.894757;
constexpr double psi_per_bar = 14.503774;
constexpr std::array factors = std::to_array<NamedFactor>({
    {10.0, "10", false},
    {0.1, "0.1", false},
    {0.9, "0.9", false},
    {1.0 / 0.9, "1/0.9", false},
    {kilopascals_per_psi, "kPa read as psi", true},
    {1.0 / kilopascals_per_psi, "psi read as kPa", true},
    {psi_per_bar, "psi read as bar", true},
    {1.0 / psi_per_bar, "bar read as psi", true},
    {-1.0, "reversed sign", false},
});

double expected(ChannelQuantity quantity) {
  return quantity == ChannelQuantity::gain || quantity == ChannelQuantity::sign ? 1.0 : 0.0;
}

bool is_pressure(ChannelCheck::Channel channel) {
  return channel == ChannelCheck::Channel::inlet || channel == ChannelCheck::Channel::outlet;
}

LikelyFactor likely_factor(const ComparedQuantity& gain, bool pressure) {
  const double uncertainty = std::hypot(gain.standard_error, gain.stated);
  LikelyFactor found{gain.value, ""};
  double nearest = std::max(0.01 * std::abs(gain.value), 2.0 * uncertainty);
  for (const NamedFactor& one : factors) {
    const double distance = std::abs(gain.value - one.factor);
    if (distance > nearest || (one.pressures_only && !pressure)) continue;
    nearest = distance;
    found = {one.factor, std::string(one.name)};
  }
  return found;
}

// Where the others' zeros lie the channel shows what the other port of its motor does.
bool shows_the_other_port(const Quantities& found, const ChannelConsistencyOptions& options) {
  constexpr double certain = 10.0;
  const auto zero = std::ranges::find(found, ChannelQuantity::zero, &ComparedQuantity::quantity);
  return found.front().value < 0.0 && zero != found.end() && zero->value > 0.0 &&
         zero->departure(options.suspect_beyond) > certain;
}

ChannelCheck row_of(const ChannelCheck& common, const Quantities& all, const ComparedQuantity& one,
                    const ChannelConsistencyOptions& options) {
  ChannelCheck row = common;
  row.quantity = one.quantity;
  row.unit = one.unit;
  row.stated_uncertainty = one.stated;
  if (!std::isfinite(one.standard_error)) return row;
  const double half =
      numerics::student_quantile(0.975, one.degrees_of_freedom) * one.standard_error;
  row.interval = {one.value, one.standard_error, one.value - half, one.value + half};
  const bool is_gain = one.quantity == ChannelQuantity::gain;
  if (is_gain && row.interval->upper < 0.0) row.quantity = ChannelQuantity::sign;
  const double target = expected(one.quantity);
  const bool excluded = target < row.interval->lower || target > row.interval->upper;
  if (excluded && one.departure(options.suspect_beyond) > options.suspect_beyond) {
    row.verdict = ChannelVerdict::suspect;
    if (is_gain) {
      row.likely = likely_factor(one, is_pressure(row.channel));
      if (is_pressure(row.channel) && shows_the_other_port(all, options)) {
        row.likely = LikelyFactor{-1.0, "exchanged ports"};
      }
    }
  } else if (one.is_determined()) {
    row.verdict = ChannelVerdict::right;
  }
  return row;
}

// Records whose gain or zero is unlike the median record's by more than the instrument's accuracy.
std::vector<std::size_t> unlike_others(const std::vector<std::size_t>& places,
                                       const ComparedFit& fit,
                                       const ChannelConsistencyOptions& options) {
  constexpr std::size_t fewest = 3;
  std::vector<std::pair<std::size_t, Quantities>> own;
  for (const std::size_t place : places) {
    Quantities found = fit({place});
    if (!found.empty() && found.front().is_determined()) own.emplace_back(place, std::move(found));
  }
  std::vector<std::size_t> unlike;
  if (own.size() < fewest) return unlike;
  for (std::size_t q = 0; q < own.front().second.size(); ++q) {
    std::vector<double> values;
    for (const auto& [place, found] : own) {
      if (found[q].is_determined()) values.push_back(found[q].value);
    }
    if (values.size() < fewest) continue;
    const double usual = numerics::median(std::move(values));
    for (const auto& [place, found] : own) {
      const ComparedQuantity& one = found[q];
      if (!one.is_determined() ||
          std::abs(one.value - usual) <=
              options.suspect_beyond *
                  std::hypot(one.normal_error(options.suspect_beyond), one.own_stated)) {
        continue;
      }
      if (std::ranges::find(unlike, place) == unlike.end()) unlike.push_back(place);
    }
  }
  if (2 * unlike.size() >= own.size()) unlike.clear();
  std::ranges::sort(unlike);
  return unlike;
}

}  // namespace

std::string to_string(ChannelQuantity quantity) {
  switch (quantity) {
    case ChannelQuantity::gain:
      return "gain";
    case ChannelQuantity::sign:
      return "sign";
    case ChannelQuantity::zero:
      return "zero";
    case ChannelQuantity::delay:
      break;
  }
  return "delay";
}

std::string to_string(ChannelVerdict verdict) {
  switch (verdict) {
    case ChannelVerdict::right:
      return "right";
    case ChannelVerdict::suspect:
      return "suspect";
    case ChannelVerdict::undeterminable:
      break;
  }
  return "undeterminable";
}

bool ComparedQuantity::is_determined() const {
  return std::isfinite(standard_error) &&
         numerics::student_quantile(0.975, degrees_of_freedom) * standard_error <= widest;
}

double ComparedQuantity::normal_error(double sigmas) const {
  const double tail = 0.5 * std::erfc(sigmas / std::numbers::sqrt2);
  return standard_error * numerics::student_quantile(1.0 - tail, degrees_of_freedom) / sigmas;
}

double ComparedQuantity::departure(double sigmas) const {
  return std::abs(value - expected(quantity)) / std::hypot(normal_error(sigmas), stated);
}

std::vector<ChannelCheck> checked_channel(const ChannelCheck& row,
                                          const std::vector<EvaluatedRecord>& records,
                                          const ComparedFit& fit,
                                          const ChannelConsistencyOptions& options) {
  std::vector<std::size_t> places(records.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  const std::vector<std::size_t> unlike = unlike_others(places, fit, options);
  std::erase_if(places, [&](std::size_t place) { return std::ranges::count(unlike, place) > 0; });
  std::vector<ChannelCheck> rows;
  const auto add = [&](const Quantities& found, const std::string& record) {
    ChannelCheck common = row;
    common.record = record;
    for (const ComparedQuantity& one : found) {
      rows.push_back(row_of(common, found, one, options));
    }
  };
  add(fit(places), "");
  for (const std::size_t place : unlike) add(fit({place}), records[place].raw->name);
  if (rows.empty()) rows.push_back(row);
  return rows;
}

std::vector<Index> row_groups(Index rows) {
  constexpr Index fewest = 10, most = 40, smallest = 4;
  const Index count = std::min(most, rows / smallest);
  std::vector<Index> groups;
  if (count < fewest) return groups;
  for (Index row = 0; row < rows; ++row) groups.push_back(row * count / rows);
  return groups;
}

}  // namespace boresight::identification
