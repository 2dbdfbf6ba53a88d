#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/io/campaign/campaign_comparison.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_statements.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/plant/antenna/friction.hpp>

namespace boresight::io {
namespace {

using numerics::Interval;

constexpr double contradicts = 2.0;  // standard uncertainties, both sides' together

/// Holds stated numbers against the records' and keeps those that are apart.
class Contradictions {
 public:
  void compare(const Quantity& quantity, const std::string& key, const char* unit,
               const std::optional<Interval>& records, const std::string& by) {
    if (!records) return;
    compare({key, quantity.text, quantity.basis == Basis::assumed, quantity.value,
             quantity.standard_uncertainty, unit, *records, by, 0.0});
  }
  void compare(const std::optional<Quantity>& quantity, const char* unit,
               const std::optional<Interval>& records, const std::string& by) {
    if (quantity) compare(*quantity, quantity->key, unit, records, by);
  }
  void compare(Contradiction one) {
    const double spread = std::hypot(one.stated_uncertainty, one.records.standard_uncertainty);
    const double apart = one.records.value - one.stated_value;
    if (!(std::abs(apart) > contradicts * spread)) return;
    one.normalised = spread > 0.0 ? apart / spread : std::copysign(1e9, apart);
    found_.push_back(std::move(one));
  }
  std::vector<Contradiction> take() {
    std::stable_sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) {
      return std::abs(a.normalised) > std::abs(b.normalised);
    });
    return std::move(found_);
  }

 private:
  std::vector<Contradiction> found_;
};

/// What the records say, where they say anything to speak of.
class Records {
 public:
  explicit Records(const CampaignSection& section) : section_(section) {}

  std::optional<Interval> quantity(const std::string& name) const {
    if (!section_.grey_box) return std::nullopt;
    const auto& found = section_.grey_box->quantity(name);
    return found.identified ? std::optional(found.posterior) : std::nullopt;
  }
  // Slosh frequencies say it, whatever the grey box adds; without them only the grey box may.
  std::optional<Interval> bulk_modulus() const {
    if (section_.bulk_modulus_stated) return quantity("bulk modulus");
    const auto best = combined(section_, "bulk modulus");
    return best ? *best : section_.bulk_modulus;
  }
  // Who says so.
  const char* by_bulk_modulus() const {
    return section_.bulk_modulus_stated ? "grey box" : "slosh";
  }
  // By the case's convention about efficiencies in it.
  std::optional<Interval> oil_stiffness(bool efficiency) const {
    auto found = quantity("oil stiffness");
    if (!found || efficiency) return found;
    const auto& knowledge = section_.knowledge;
    const double factor =
        1.0 / (knowledge.torque_efficiency.value * knowledge.volumetric_efficiency.value);
    return Interval{found->value * factor, found->standard_uncertainty * factor,
                    found->lower * factor, found->upper * factor};
  }
  std::optional<Interval> frequency() const {
    return section_.resonance ? section_.resonance->frequency : std::nullopt;
  }
  std::optional<Interval> load() const {
    const auto inertia = quantity("inertia");
    if (!inertia) return std::nullopt;
    const auto& knowledge = section_.knowledge;
    const double motors = knowledge.motor_count * knowledge.motor_inertia.value;
    return numerics::normal_interval(
        inertia->value - motors,
        std::hypot(inertia->standard_uncertainty,
                   knowledge.motor_count * knowledge.motor_inertia.standard_uncertainty));
  }
  std::optional<Interval> slow_ramp(bool offset) const {
    if (!section_.impulse || !section_.impulse->slow_ramp) return std::nullopt;
    const auto& tests = *section_.impulse->slow_ramp;
    return offset ? tests.offset : tests.coulomb;
  }
  // The line a motor depends on, the mean of its inlet and outlet where both rang.
  std::optional<Interval> line(std::size_t motor, bool modulus) const {
    std::vector<Interval> both;
    if (section_.slosh.empty()) return std::nullopt;
    for (const auto& line : section_.slosh.front().result.lines) {
      if (line.motor != motor) continue;
      if (!modulus) both.push_back(line.frequency);
      if (modulus && line.bulk_modulus) both.push_back(*line.bulk_modulus);
    }
    if (both.empty()) return std::nullopt;
    double mean = 0.0, worst = 0.0;
    for (const auto& one : both) {
      mean += one.value / static_cast<double>(both.size());
      worst = std::max(worst, one.standard_uncertainty);
    }
    return numerics::normal_interval(mean, worst);
  }

 private:
  const CampaignSection& section_;
};

void compare_friction(const CampaignSection& section, const Case& antenna,
                      Contradictions& contradictions) {
  const auto& tests = *antenna.friction_tests;
  if (section.impulse && section.impulse->constant_speed &&
      section.impulse->constant_speed->has_line) {
    const auto& found = *section.impulse->constant_speed;
    contradictions.compare(tests.constant_speed_coulomb, "N m", found.intercept,
                           "constant-speed tests");
    contradictions.compare(tests.constant_speed_slope, "N m s/rad", found.slope,
                           "constant-speed tests");
  }
  const auto& curve = *antenna.friction_curve;
  const bool assumed = curve.coulomb.basis == Basis::assumed;
  std::vector<const FrictionRow*> tested;
  for (const auto& row : section.friction) {
    if (!row.extrapolated && (row.combined || row.curve)) tested.push_back(&row);
  }
  // Lowest, middle, highest say all there is to say.
  if (tested.size() > 3) {
    tested = {tested.front(), tested[tested.size() / 2], tested.back()};
  }
  for (const auto* one : tested) {
    const FrictionRow& row = *one;
    const auto& records = row.combined ? row.combined : row.curve;
    if (!records) continue;
    const double stated = plant::friction_torque(friction_curve(antenna), row.rate);
    const double uncertainty =
        std::hypot(curve.coulomb.standard_uncertainty, curve.saturating.standard_uncertainty,
                   row.rate * curve.viscous.standard_uncertainty);
    contradictions.compare({fmt::format("friction_curve at {:.3g} rad/s", row.rate),
                            fmt::format("{:.4g} N.m", stated), assumed, stated, uncertainty, "N m",
                            *records, section.grey_box ? "grey box" : "friction curve", 0.0});
  }
}

// The numbers that a case states as derived ones.
void compare_stated(const Case& antenna, const Records& records, const CampaignSection& section,
                    Contradictions& contradictions) {
  for (const auto& stated : antenna.stated) {
    const std::string& id = stated.quantity;
    const auto compare = [&](const char* unit, const std::optional<Interval>& found,
                             const char* by) {
      contradictions.compare(stated.value, id, unit, found, by);
    };
    const auto inertia = records.quantity("inertia");
    if (id == "reflected_inertia" || id == "resonance.reflected_inertia") {
      compare("kg m2", inertia, "grey box");
    } else if (id == "load_inertia") {
      compare("kg m2", records.load(), "grey box, less motors");
    } else if (id == "motor_to_load_ratio" || id == "resonance.motor_to_load_ratio") {
      compare("1", records.quantity("motor to load ratio"), "grey box");
    } else if (id == "bulk_modulus") {
      compare("Pa", records.bulk_modulus(), records.by_bulk_modulus());
    } else if (id == "oil_stiffness") {
      compare("N m/rad", records.oil_stiffness(antenna.oil->efficiency_in_stiffness), "grey box");
    } else if (id == "resonance.frequency") {
      compare("Hz", records.frequency(), "rings after valve steps");
    } else if (id == "friction.slow_ramp.coulomb") {
      compare("N m", records.slow_ramp(false), "slow ramp");
    } else if (id == "friction.slow_ramp.offset") {
      compare("N m", records.slow_ramp(true), "slow ramp");
    }
    for (std::size_t i = 0; i < antenna.campaign->lines.size(); ++i) {
      // Lines and motors are one to one only where there are as many.
      if (antenna.campaign->lines.size() != static_cast<std::size_t>(antenna.motor->count)) break;
      const std::string line = "line." + antenna.campaign->lines[i].name;
      if (id == line + ".bulk_modulus") compare("Pa", records.line(i, true), "slosh");
      if (id == line + ".slosh_frequency") compare("Hz", records.line(i, false), "slosh");
    }
  }
  for (const auto& impulse : antenna.impulse_results) {
    contradictions.compare(impulse.reflected_inertia, fmt::format("impulse.{}", impulse.name),
                           "kg m2", combined(section, "inertia"), "combined inertia");
  }
}

// Drawings and data sheets, as far as the model that explains the records would have them other.
void compare_drawings(const CampaignSection& section, Contradictions& contradictions) {
  if (!section.grey_box) return;
  for (const auto& p : section.grey_box->parameters) {
    const auto& parameter = p.parameter;
    if (!parameter.from_drawings || !(parameter.spread > 0.0)) continue;
    const double scale = parameter.logarithmic ? parameter.prior : 1.0;
    const double spread = parameter.spread * scale;
    const std::string unit = parameter.unit.empty() ? "1" : parameter.unit;
    contradictions.compare(
        {"drawings: " + parameter.name,
         fmt::format("{:.4g}{}{}", parameter.prior, unit == "1" ? "" : " ",
                     unit == "1" ? "" : unit),
         false, parameter.prior, spread, unit,
         numerics::normal_interval(
             p.value, p.remaining * parameter.spread * (parameter.logarithmic ? p.value : 1.0)),
         "grey box", 0.0});
  }
}

}  // namespace

std::vector<Contradiction> contradictions(const CampaignSection& section, const Case& antenna) {
  Contradictions contradictions;
  const Records records(section);
  contradictions.compare(antenna.resonance->frequency, "Hz", records.frequency(),
                         "rings after valve steps");
  contradictions.compare(antenna.oil->bulk_modulus, "Pa", records.bulk_modulus(),
                         records.by_bulk_modulus());
  contradictions.compare(antenna.drive->leakage_rate, antenna.drive->leakage_rate.key, "1/s",
                         records.quantity("leakage rate"), "grey box");
  compare_stated(antenna, records, section, contradictions);
  compare_friction(section, antenna, contradictions);
  compare_drawings(section, contradictions);
  return contradictions.take();
}

}  // namespace boresight::io
