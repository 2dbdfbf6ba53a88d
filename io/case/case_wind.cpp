#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_sections.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/units/unit_table.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::io {
namespace {

/// What the keys of a spectrum say, and the height of the dish's centre if it is stated.
struct Gusts {
  plant::GustSpectrum spectrum;
  std::optional<Quantity> height;
};

// Davenport's spectrum has its intensity by the drag: 6 surface_drag V^2 is the gusts' variance.
void refuse_intensity(TableReader& table) {
  const char* const key = "turbulence_intensity";
  const double intensity = table.quantity(key, Kind::number, Range::positive(1.0)).value;
  table.refuse(key, fmt::format("expected it with the spectrum kaimal or von_karman only, found it "
                                "with davenport (write surface_drag = \"{:.4g}\", its square over "
                                "6, in its place)",
                                intensity * intensity / 6.0));
}

// Each of the keys belongs to some of the spectra, the height beside a mast's to all.
Gusts read_gusts(TableReader& table) {
  const std::string spectrum =
      table.has("spectrum")
          ? table.choice("spectrum", {"davenport", "von_karman", "kaimal", "eurocode"})
          : (table.optional_text("spectrum"), "davenport");
  const auto takes = [&](const char* key, Kind kind, const Range& range,
                         const std::set<std::string>& spectra) -> std::optional<Quantity> {
    if (!spectra.contains(spectrum)) {
      if (table.has(key)) {
        table.refuse(key, fmt::format("expected it with the spectrum {} only, found it with {}",
                                      fmt::join(spectra, " or "), spectrum));
      }
      table.optional_text(key);  // a known key all the same
      return std::nullopt;
    }
    const bool is_height = std::string_view(key) == "height";
    const bool either =
        (spectrum == "von_karman" && (std::string_view(key) == "length_scale" || is_height)) ||
        (spectrum == "davenport" && is_height);
    return either ? table.optional_quantity(key, kind, range) : table.quantity(key, kind, range);
  };
  const Range length = Range::positive(1e4);
  const auto value = [](const std::optional<Quantity>& quantity) {
    return quantity ? quantity->value : 0.0;
  };
  if (spectrum == "davenport" && table.has("turbulence_intensity")) refuse_intensity(table);
  const double drag =
      value(takes("surface_drag", Kind::number, Range::positive(1.0), {"davenport"}));
  const double intensity = value(
      takes("turbulence_intensity", Kind::number, Range::positive(1.0), {"von_karman", "kaimal"}));
  const auto scale = takes("length_scale", Kind::length, length, {"von_karman"});
  std::set<std::string> with_height{"von_karman", "kaimal", "eurocode"};
  if (table.has("mast_height")) with_height.insert("davenport");
  const auto height = takes("height", Kind::length, length, with_height);
  const double roughness = value(takes("roughness_length", Kind::length, length, {"eurocode"}));
  const double lowest = value(takes("minimum_height", Kind::length, length, {"eurocode"}));
  if (spectrum == "davenport") return {plant::davenport_gusts(drag), height};
  if (spectrum == "von_karman") {
    const bool both = scale && height && !table.has("mast_height");
    if (both || (!scale && !height)) {
      table.refuse("length_scale", std::string("expected either length_scale or height, found ") +
                                       (scale ? "both" : "neither"));
    }
    return {plant::von_karman_gusts(
                intensity, scale ? scale->value : plant::von_karman_length_scale(value(height))),
            height};
  }
  if (spectrum == "kaimal") return {plant::kaimal_gusts(intensity, value(height)), height};
  if (std::min(value(height), lowest) <= roughness) {
    table.refuse("roughness_length", "expected a length below height and minimum_height");
  }
  return {plant::eurocode_gusts(value(height), roughness, lowest), height};
}

std::optional<plant::WindMast> read_mast(TableReader& table,
                                         const std::optional<Quantity>& height) {
  const auto mast_height =
      table.optional_quantity("mast_height", Kind::length, Range::positive(1e4));
  if (!mast_height) {
    if (table.has("shear_exponent")) {
      table.refuse("shear_exponent", "expected a mast_height beside it, found none");
    }
    table.optional_text("shear_exponent");
    return std::nullopt;
  }
  if (!height) {
    table.refuse("mast_height",
                 "expected the height of the dish's centre, height, beside it, found none");
  }
  const double exponent = table
                              .quantity_or("shear_exponent", Kind::number, Range::between(0.0, 1.0),
                                           0.14, "power law over open country")
                              .value;
  return plant::WindMast{mast_height->value, height->value, exponent,
                         std::pow(height->value / mast_height->value, exponent)};
}

// Gusts are as strong at either height, and the less of the mean speed where that is more.
void raise(plant::GustSpectrum& gusts, double speed_ratio) {
  gusts.surface_drag /= speed_ratio * speed_ratio;
  if (gusts.kind != plant::GustSpectrumKind::eurocode) gusts.turbulence_intensity /= speed_ratio;
}

// Sorted, without repetitions.
Eigen::VectorXd distinct(const Eigen::VectorXd& values) {
  const std::set<double> sorted(values.begin(), values.end());
  Eigen::VectorXd axis(static_cast<Eigen::Index>(sorted.size()));
  std::ranges::copy(sorted, axis.begin());
  return axis;
}

plant::TorqueCoefficientTable read_torque_table(const std::string& path) {
  const auto columns = read_unit_table(
      path, {{"yaw", Kind::angle}, {"elevation", Kind::angle}, {"coefficient", Kind::number}});
  const Eigen::VectorXd& yaw = columns.at("yaw");
  const Eigen::VectorXd& elevation = columns.at("elevation");
  const Eigen::VectorXd yaws = distinct(yaw);
  const Eigen::VectorXd elevations = distinct(elevation);
  Eigen::MatrixXd coefficients =
      Eigen::MatrixXd::Constant(yaws.size(), elevations.size(), std::nan(""));
  for (Eigen::Index row = 0; row < yaw.size(); ++row) {
    const auto i = std::ranges::lower_bound(yaws, yaw[row]) - yaws.begin();
    const auto j = std::ranges::lower_bound(elevations, elevation[row]) - elevations.begin();
    if (!std::isnan(coefficients(i, j))) {
      throw InvalidInput(
          fmt::format("{}: expected each pair of yaw and elevation once, found {:g} deg and {:g} "
                      "deg again",
                      path, yaw[row] / degree, elevation[row] / degree));
    }
    coefficients(i, j) = columns.at("coefficient")[row];
  }
  for (Eigen::Index i = 0; i < yaws.size(); ++i) {
    for (Eigen::Index j = 0; j < elevations.size(); ++j) {
      if (!std::isnan(coefficients(i, j))) continue;
      throw InvalidInput(
          fmt::format("{}: expected a row for each yaw at each elevation, found none for {:g} deg "
                      "and {:g} deg",
                      path, yaws[i] / degree, elevations[j] / degree));
    }
  }
  try {
    return {yaws, elevations, coefficients};
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("{}: {}", path, error.what()));
  }
}

void read_torque_coefficient(TableReader& table, Case& antenna) {
  WindEntry& wind = *antenna.wind;
  const auto file = table.optional_text("torque_table");
  if (!file) {
    if (table.has("direction")) {
      table.refuse("direction", "expected a torque_table beside it, found none");
    }
    table.optional_text("direction");
    wind.torque_coefficient =
        table.quantity("torque_coefficient", Kind::number, Range::not_negative(10.0));
    return;
  }
  if (table.has("torque_coefficient")) {
    table.refuse("torque_coefficient",
                 "expected either torque_coefficient or torque_table, found both");
  }
  table.optional_text("torque_coefficient");
  constexpr double turn = two_pi;
  const double direction =
      table.quantity("direction", Kind::angle, Range::between(-turn, turn)).value;
  if (!antenna.antenna->azimuth || !antenna.antenna->elevation) {
    table.refuse("torque_table",
                 "expected antenna.azimuth and antenna.elevation, where the dish points, beside "
                 "it, found not both");
  }
  const std::string path = beside_case(antenna.path, *file);
  wind.torque_table = read_torque_table(path);
  double yaw = std::remainder(direction - antenna.antenna->azimuth->value, turn);
  const double elevation = antenna.antenna->elevation->value;
  wind.attitude = {yaw, elevation};
  try {
    wind.torque_coefficient.value = wind.torque_table->at(yaw, elevation);
  } catch (const InvalidInput& error) {
    table.refuse("torque_table", fmt::format("{}: {}", path, error.what()));
  }
  wind.torque_coefficient.key = table.path("torque_table");
}

void read_wind_record(TableReader& table, WindEntry& wind, const std::string& case_path) {
  const auto file = table.optional_text("record");
  if (!file) return;
  wind.record_path = beside_case(case_path, *file);
  const auto columns = read_unit_table(
      wind.record_path,
      {{"time", Kind::time}, {"speed", Kind::speed}, {"direction", Kind::angle, false}});
  const Eigen::VectorXd& time = columns.at("time");
  const Eigen::Index samples = time.size();
  constexpr double longest = 7200.0;  // s: a record is simulated whole
  const double duration = time[samples - 1] - time[0];
  if (samples < 2 || !(duration > 0.0) || duration > longest) {
    throw InvalidInput(
        fmt::format("{}: expected a record of at least 2 samples and at most {:g} s, found {} "
                    "samples and {:g} s",
                    wind.record_path, longest, samples, duration));
  }
  const double step = duration / static_cast<double>(samples - 1);
  for (Eigen::Index i = 0; i < samples; ++i) {
    const double even = time[0] + step * static_cast<double>(i);
    if (std::abs(time[i] - even) > 0.1 * step) {
      throw InvalidInput(
          fmt::format("{}: expected samples evenly spaced, every {:g} s, found {:g} s for {:g} s",
                      wind.record_path, step, time[i], even));
    }
  }
  plant::WindRecord record;
  record.sample_time = step;
  record.speed = columns.at("speed");
  if (wind.mast) {
    const double more = (wind.mast->speed_ratio - 1.0) * record.speed.mean();
    record.speed = (record.speed.array() + more).max(0.0).matrix().eval();
  }
  if (const auto direction = columns.find("direction"); direction != columns.end()) {
    record.direction = direction->second;
  }
  try {
    plant::validate(record, "wind record");
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("{}: {}", wind.record_path, error.what()));
  }
  if (wind.torque_table && record.direction.size() == 0) {
    throw InvalidInput(
        fmt::format("{}: expected a column 'direction [rad]' for the torque_table, found none",
                    wind.record_path));
  }
  wind.record = std::move(record);
}

}  // namespace

Quantity at_dish_centre(const WindEntry& wind, const Quantity& stated) {
  if (!wind.mast) return stated;
  const double ratio = wind.mast->speed_ratio;
  Quantity speed = derived_quantity(stated, Kind::speed, ratio * stated.value, "m/s");
  speed.standard_uncertainty = ratio * stated.standard_uncertainty;
  return speed;
}

void read_wind(TableReader& file, Case& antenna) {
  TableReader table = file.table("wind");
  WindEntry& wind = *antenna.wind;
  wind.model = table.choice("model", {"uniform", "vickery", "coherence"});
  wind.design_speed = table.quantity("design_speed", Kind::speed, Range::between(0.1, 60.0));
  wind.air_density = table.quantity("air_density", Kind::density, Range::between(0.1, 2.0));
  const auto [gusts, height] = read_gusts(table);
  wind.gusts = gusts;
  wind.mast = read_mast(table, height);
  if (wind.mast) raise(wind.gusts, wind.mast->speed_ratio);
  wind.design_speed = at_dish_centre(wind, wind.design_speed);
  read_torque_coefficient(table, antenna);
  wind.gradient_coefficient =
      table.quantity("gradient_coefficient", Kind::number, Range::not_negative(10.0));
  wind.coherence_decay = table.quantity("coherence_decay", Kind::number, Range::positive(1000.0));
  const bool gradient = wind.model == "coherence" && wind.gradient_coefficient.value > 0.0;
  if (wind.torque_coefficient.value == 0.0 && !gradient) {
    table.refuse(wind.torque_table ? "torque_table" : "torque_coefficient",
                 "expected a wind model and coefficients that give some torque, found none");
  }
  read_climate(table, antenna);
  read_wind_record(table, wind, antenna.path);
  table.finish();
}

}  // namespace boresight::io
