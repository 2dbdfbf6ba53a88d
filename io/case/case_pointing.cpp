#include <algorithm>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <boresight/design/problem/pointing.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_pointing.hpp>
#include <boresight/io/case/case_sections.hpp>

namespace boresight::io {
namespace {

constexpr double millidegrees = 180e3 / std::numbers::pi;  // of a radian
// Of k (rad).
constexpr Range factor_range = Range::between(0.5, 2.0);

// k by a measured beamwidth.
Quantity factor_by_beamwidth(TableReader& entry, const Quantity& beamwidth, double per_factor) {
  Quantity factor = derived_quantity(beamwidth, Kind::angle, beamwidth.value / per_factor, "rad");
  factor.standard_uncertainty = beamwidth.standard_uncertainty / per_factor;
  if (factor.value < factor_range.minimum || factor.value > factor_range.maximum) {
    entry.refuse("beamwidth",
                 fmt::format("expected {:.3g} to {:.3g} mdeg, 0.5 to 2 wavelengths over the dish's "
                             "diameter, found {}",
                             factor_range.minimum * per_factor * millidegrees,
                             factor_range.maximum * per_factor * millidegrees, beamwidth.text));
  }
  return factor;
}

// The band of that name among those that are listed above.
const BandEntry& band_above(TableReader& entry, const std::vector<BandEntry>& above,
                            const std::string& name) {
  const auto band = std::ranges::find(above, name, &BandEntry::name);
  if (band == above.end()) {
    entry.refuse("beamwidth_like",
                 fmt::format("expected the name of a band listed above, found '{}'", name));
  }
  return *band;
}

// k as stated, by a measured beamwidth, as of another band, or by how the feed lights the dish.
void read_beamwidth_factor(TableReader& entry, const Case& antenna, BandEntry& band) {
  auto stated = entry.optional_quantity("beamwidth_factor", Kind::angle, factor_range);
  const auto measured =
      entry.optional_quantity("beamwidth", Kind::angle, Range::positive(std::numbers::pi));
  const auto like = entry.optional_text("beamwidth_like");
  const auto taper = entry.optional_quantity("edge_taper", Kind::level, Range::between(0.0, 60.0));
  // Beside a misspelt edge_taper they are no unknown keys.
  design::Illumination illumination;
  if (entry.has("illumination") || entry.optional_text("illumination")) {
    illumination.shape = entry.choice("illumination", {"parabola", "gaussian"}) == "gaussian"
                             ? design::IlluminationShape::gaussian
                             : design::IlluminationShape::parabola_on_pedestal;
  }
  const auto exponent =
      entry.optional_quantity("illumination_exponent", Kind::number, Range::between(0.5, 8.0));
  entry.finish();
  const int said = static_cast<int>(stated.has_value()) + static_cast<int>(measured.has_value()) +
                   static_cast<int>(like.has_value()) + static_cast<int>(taper.has_value());
  if (said != 1) {
    entry.refuse("beamwidth_factor",
                 fmt::format("expected either beamwidth, beamwidth_factor, beamwidth_like or "
                             "edge_taper, found {}",
                             said == 0 ? "none" : "several"));
  }
  if (measured) {
    stated =
        factor_by_beamwidth(entry, *measured,
                            design::half_power_beamwidth(1.0, band.frequency.value,
                                                         antenna.antenna->dish_diameter.value));
  }
  if (like) {
    const BandEntry& other = band_above(entry, antenna.bands, *like);
    stated = other.beamwidth_factor;
    band.illumination = other.illumination;
  }
  for (const auto* key : {"illumination", "illumination_exponent"}) {
    if (stated && entry.has(key)) {
      entry.refuse(key, "expected it beside edge_taper only, found it without");
    }
  }
  if (stated) {
    band.beamwidth_factor = *stated;
    return;
  }
  const bool gaussian = illumination.shape == design::IlluminationShape::gaussian;
  if (exponent && gaussian) {
    entry.refuse("illumination_exponent",
                 "expected it with the illumination 'parabola' only, found it with 'gaussian'");
  }
  if (exponent) illumination.exponent = exponent->value;
  illumination.edge_taper_db = taper ? taper->value : 0.0;
  band.beamwidth_factor.value = design::beamwidth_factor(illumination);
  band.beamwidth_factor.kind = Kind::angle;
  band.beamwidth_factor.key = entry.path("edge_taper");
  band.illumination =
      fmt::format("{} illumination, {:g} dB edge taper{}", design::to_string(illumination.shape),
                  illumination.edge_taper_db,
                  gaussian ? "" : fmt::format(", exponent {:g}", illumination.exponent));
}

}  // namespace

void read_pointing(TableReader& file, Case& antenna) {
  TableReader table = file.table("pointing");
  std::set<std::string> names;
  for (auto& entry : table.tables("band", true)) {
    BandEntry band;
    band.name = read_name(entry, names);
    band.frequency = entry.quantity("frequency", Kind::frequency, Range::between(1e8, 1e13));
    read_beamwidth_factor(entry, antenna, band);
    antenna.bands.push_back(std::move(band));
  }
  for (auto& entry : table.tables("budget", true)) {
    BudgetEntry budget;
    budget.name = entry.text("name");
    budget.band = entry.choice("band", {names.begin(), names.end()});
    budget.loss = entry.optional_quantity("loss", Kind::level, Range::positive(3.0));
    budget.rms = entry.optional_quantity("rms", Kind::angle, Range::positive(1.0));
    if (budget.loss && budget.rms) {
      entry.refuse("rms", "expected either loss (dB) or rms (angle), found both");
    }
    // Beside a misspelt loss it is no unknown key: the misspelt one is what to name.
    if (budget.loss || (!budget.rms && entry.has("convention"))) {
      budget.convention = entry.choice(
          "convention", {"mean_loss_two_axes", "mean_loss_one_axis", "loss_at_mean_radial_error"});
    }
    budget.wind_speed =
        entry.optional_quantity("wind_speed", Kind::speed, Range::between(0.1, 60.0));
    if (budget.wind_speed) {
      budget.wind_speed = at_dish_centre(*antenna.wind, *budget.wind_speed);
    }
    entry.finish();
    if (!budget.loss && !budget.rms) {
      entry.refuse("loss", "expected either loss (dB) or rms (angle), found neither");
    }
    antenna.budgets.push_back(std::move(budget));
  }
  table.finish();
}

}  // namespace boresight::io
