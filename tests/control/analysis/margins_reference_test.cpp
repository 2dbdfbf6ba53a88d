#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "control/exact_response.hpp"
#include "random_numbers.hpp"
#include "reference_values.hpp"
#include <boresight/control/analysis/crossovers.hpp>
#include <boresight/control/analysis/margins.hpp>
#include <boresight/plant/linear/response_grid.hpp>

// Margins that others found (values/margins.json, values/margins_statespace.json), by three routes:
// scan and eigenvalues of the state space, and a plain function on a grid. Where the reference does
// not hold to its digits, an extended-precision computation says so.
namespace boresight::control {
namespace {

using nlohmann::json;
using reference::Long;
using reference::PrintedNumber;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double degrees = 180.0 / std::numbers::pi;

// To 1e-9, or to half a unit of the last digit where the reference has fewer.
void expect_printed(double found, const json& number, const std::string& what) {
  const PrintedNumber printed = reference::printed_number(number);
  EXPECT_NEAR(found, printed.value, std::max(1e-9 * std::abs(printed.value), printed.half_unit))
      << what;
}

struct Case {
  std::string id;
  plant::StateSpace loop;
  json verified;
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  const json transfer = reference::reference_values("margins").at("cases");
  for (const auto& entry : transfer) {
    cases.push_back(
        {entry.at("id"), reference::system_of(entry.at("system")), entry.at("verified")});
  }
  const json state_space = reference::reference_values("margins_statespace").at("cases");
  for (const auto& entry : state_space) {
    // The same quantities by other names.
    json verified;
    const std::array<std::array<const char*, 2>, 6> names{{{"gm", "gain_margin_abs"},
                                                           {"wg", "phase_crossover_rad_s"},
                                                           {"pm", "phase_margin_deg"},
                                                           {"wp", "gain_crossover_rad_s"},
                                                           {"min_dist", "min_dist_to_minus1"},
                                                           {"disk_alpha", "disk_alpha_balanced"}}};
    for (const auto& [from, to] : names) {
      if (entry.at("verified").contains(from)) verified[to] = entry.at("verified").at(from);
    }
    cases.push_back({entry.at("id"), reference::matrices_of(entry.at("ss")), verified});
  }
  return cases;
}

// The reference of this case was computed from a sampled system of about eight digits; see
// MarginsReference.OfTheSampledResonance.
bool is_inexact(const std::string& id) {
  return id == "pc_disc_gh523a_T0.05";
}

// Values of L at frequency 0 and at the Nyquist frequency that are negative, in closed form. The
// reference lists no crossovers there.
std::vector<PhaseCrossover> ends(const std::string& id, const plant::StateSpace& loop) {
  const double nyquist = std::numbers::pi / loop.sample_time;
  if (id == "pc_example21_K1000") {
    return {{0.0, (0.0005 * 0.0001 * 0.01 * 0.2 * 1e4) / (2.0 * 0.02 * 0.05 * 5.0 * 10.0)}};
  }
  if (id == "matlab_answers_disc_unstable_T0.04") {
    return {{0.0, 0.001 * (1.0 - 0.9619) / (0.00074321 * 1.9875)},
            {nyquist, 2.001 * 1.9619 / (0.00074321 * 0.0125)}};
  }
  if (id == "issue_cs1045_negative_frequency") {
    // Series of a second-order system and the double pole pair 1/(s^2 - 1/2): the controller at
    // rest in closed form, by Cramer's rule.
    const Long a = 1.42119805189796L, b = 1.5105265612217906L, c = 1.4146551592967844L,
               e = 1.009901951359278L;
    const Long determinant = a * c + b;  // of [a -1; b c] x = [a; e]
    const Long x1 = (a * c + e) / determinant, x2 = (a * e - b * a) / determinant;
    const Long gain = (10.006246098625127L * x1 + 14.146551592967842L * x2) * 0.1L / -0.5L;
    return {{0.0, static_cast<double>(-1.0L / gain)}};
  }
  if (id == "pc_disc_gh523a_T0.05") {
    return {{nyquist, static_cast<double>(
                          -1.0L / reference::long_loop(loop)(reference::long_pi / 0.05L).real())}};
  }
  return {};
}

void compare_crossovers(const Case& entry, const std::vector<GainCrossover>& gain,
                        const std::vector<PhaseCrossover>& phase) {
  const json& verified = entry.verified;
  const auto& gain_frequency = verified.at("gain_crossover_rad_s");
  ASSERT_EQ(gain.size(), gain_frequency.size());
  for (std::size_t i = 0; i < gain.size(); ++i) {
    expect_printed(gain[i].frequency, gain_frequency.at(i), "gain crossover");
    expect_printed(gain[i].phase_margin_deg, verified.at("phase_margin_deg").at(i), "phase margin");
    if (verified.contains("delay_margin_s")) {
      expect_printed(gain[i].delay_margin, verified.at("delay_margin_s").at(i), "delay margin");
    }
  }
  const auto& phase_frequency = verified.at("phase_crossover_rad_s");
  ASSERT_EQ(phase.size(), phase_frequency.size());
  for (std::size_t i = 0; i < phase.size(); ++i) {
    expect_printed(phase[i].frequency, phase_frequency.at(i), "phase crossover");
    expect_printed(phase[i].gain_margin, verified.at("gain_margin_abs").at(i), "gain margin");
  }
}

// Takes the crossovers at the ends off the list, after comparing them with the closed forms.
std::vector<PhaseCrossover> without_ends(const Case& entry, std::vector<PhaseCrossover> found) {
  for (const auto& end : ends(entry.id, entry.loop)) {
    const auto at = end.frequency == 0.0 ? found.begin() : found.end() - 1;
    EXPECT_EQ(at->frequency, end.frequency);
    EXPECT_LT(reference::relative_error(at->gain_margin, end.gain_margin), 1e-9);
    found.erase(at);
  }
  return found;
}

TEST(MarginsReference, HasEveryCrossoverByTheScan) {
  for (const auto& entry : all_cases()) {
    SCOPED_TRACE(entry.id);
    const Margins found = margins(entry.loop);
    const auto inner = without_ends(entry, found.phase_crossovers);
    if (!is_inexact(entry.id)) compare_crossovers(entry, found.gain_crossovers, inner);
  }
}

TEST(MarginsReference, HasEveryCrossoverByEigenvalues) {
  for (const auto& entry : all_cases()) {
    SCOPED_TRACE(entry.id);
    const Crossovers found = crossovers(entry.loop);
    const auto inner = without_ends(entry, found.phase);
    if (!is_inexact(entry.id)) compare_crossovers(entry, found.gain, inner);
  }
}

TEST(MarginsReference, HasEveryCrossoverOfAPlainFunction) {
  for (const auto& entry : all_cases()) {
    if (is_inexact(entry.id)) continue;
    SCOPED_TRACE(entry.id);
    const auto loop = reference::long_loop(entry.loop);
    Eigen::ArrayXd grid = plant::response_grid(entry.loop, {.decades_beyond = 4.0});
    // At the Nyquist frequency itself L is real, and a function does not tell which way it came.
    if (entry.loop.sample_time > 0.0) grid = grid.head(grid.size() - 1).eval();
    const Margins found = margins([&](double w) { return std::complex<double>(loop(w)); }, grid);
    compare_crossovers(entry, found.gain_crossovers, found.phase_crossovers);
  }
}

TEST(MarginsReference, IsThatOfExtendedPrecision) {
  for (const auto& entry : all_cases()) {
    SCOPED_TRACE(entry.id);
    const auto loop = reference::long_loop(entry.loop);
    // Sections of poles from 1e-4 to 100 rad/s whose zeros cancel four digits.
    const double tolerance = entry.id == "pc_example21_K1000" ? 1e-9 : 1e-12;
    const Margins found = margins(entry.loop);
    for (const auto& crossover : found.gain_crossovers) {
      const Long w = reference::gain_crossover_near(loop, crossover.frequency);
      const double margin = static_cast<double>(std::arg(-loop(w))) * degrees;
      EXPECT_NEAR(crossover.frequency, static_cast<double>(w), tolerance * crossover.frequency);
      EXPECT_NEAR(crossover.phase_margin_deg, margin, 100.0 * tolerance);
    }
    for (const auto& crossover : without_ends(entry, found.phase_crossovers)) {
      const Long w = reference::phase_crossover_near(loop, crossover.frequency);
      EXPECT_NEAR(crossover.frequency, static_cast<double>(w), tolerance * crossover.frequency);
      EXPECT_NEAR(crossover.gain_margin * static_cast<double>(std::abs(loop(w))), 1.0, tolerance);
    }
    if (found.sensitivity.frequency > 0.0 && std::isfinite(found.sensitivity.frequency)) {
      const auto distance = [&](Long w) { return std::log(std::abs(1.0L + loop(w))); };
      const Long w = reference::extremum_near(distance, found.sensitivity.frequency);
      // The place of an extremum is flat: rounding of the loop gain leaves it open to sqrt(eps).
      EXPECT_NEAR(found.sensitivity.frequency / static_cast<double>(w), 1.0, 1e-8);
      EXPECT_NEAR(found.distance_to_minus_one() / static_cast<double>(std::exp(distance(w))), 1.0,
                  tolerance);
    }
    if (found.disk.frequency > 0.0 && std::isfinite(found.disk.frequency)) {
      const auto alpha = [&](Long w) {
        return std::log(std::abs(2.0L * (1.0L + loop(w)) / (1.0L - loop(w))));
      };
      const Long w = reference::extremum_near(alpha, found.disk.frequency);
      EXPECT_NEAR(found.disk.frequency / static_cast<double>(w), 1.0, 1e-9);
      EXPECT_NEAR(found.disk.alpha / static_cast<double>(std::exp(alpha(w))), 1.0, tolerance);
    }
  }
}

TEST(MarginsReference, HasTheDistancesToInstability) {
  for (const auto& entry : all_cases()) {
    if (is_inexact(entry.id)) continue;
    SCOPED_TRACE(entry.id);
    const Margins found = margins(entry.loop);
    const json& verified = entry.verified;
    const auto compare = [&](double value, double frequency, const char* name,
                             const char* frequency_name, double limit) {
      if (!verified.contains(name)) return;
      if (frequency == 0.0 || frequency == infinity) {
        // The reference holds the value where its scan ended instead of the limit.
        EXPECT_NEAR(value, limit, 1e-12);
        EXPECT_NEAR(verified.at(name).get<double>(), limit, 1e-8);
        return;
      }
      expect_printed(value, verified.at(name), name);
      // Found there by comparing values, which are flat to half the digits; extended precision
      // (above) has ours to 1e-9.
      if (verified.contains(frequency_name)) {
        EXPECT_LT(reference::relative_error(frequency, verified.at(frequency_name).get<double>()),
                  3e-7)
            << frequency_name;
      }
    };
    compare(found.distance_to_minus_one(), found.sensitivity.frequency, "min_dist_to_minus1",
            "min_dist_freq", 1.0);
    compare(found.disk.alpha, found.disk.frequency, "disk_alpha_balanced", "disk_freq", 2.0);
  }
}

TEST(MarginsReference, OfTheSampledResonance) {
  // python-control issue 523. The zero-order hold of k/(s^2 + 2 d s + d^2 + q^2) in closed form
  // differs from the reference in the eighth digit; ours has it.
  const Long k = 43.42624593L, d = 2.51327412L / 2.0L, square = 39.4784176L, time = 0.05L;
  const Long q = std::sqrt(square - d * d);
  const Long decay = std::exp(-d * time), c = std::cos(q * time), s = std::sin(q * time);
  const auto loop = [&](Long w) {
    const auto z = std::polar(1.0L, w * time);
    return k / square *
           (z * (1.0L - decay * (c + d / q * s)) + decay * decay + decay * (d / q * s - c)) /
           (z * z - 2.0L * decay * c * z + decay * decay);
  };
  const auto file = reference::case_of(reference::reference_values("margins").at("cases"),
                                       "pc_disc_gh523a_T0.05");
  const json& verified = file.at("verified");
  const Margins found = margins(reference::system_of(file.at("system")));
  ASSERT_EQ(found.gain_crossovers.size(), 1u);
  const auto& gain = found.gain_crossovers[0];
  const Long w = reference::gain_crossover_near(loop, gain.frequency);
  const Long margin = std::arg(-loop(w));
  EXPECT_NEAR(gain.frequency, static_cast<double>(w), 1e-11);
  EXPECT_NEAR(gain.phase_margin_deg, static_cast<double>(margin) * degrees, 1e-10);
  EXPECT_NEAR(gain.delay_margin, static_cast<double>(margin / w), 1e-13);
  ASSERT_EQ(found.phase_crossovers.size(), 2u);
  const Long axis = reference::phase_crossover_near(loop, found.phase_crossovers[0].frequency);
  EXPECT_NEAR(found.phase_crossovers[0].frequency, static_cast<double>(axis), 1e-11);
  EXPECT_NEAR(found.phase_crossovers[0].gain_margin,
              static_cast<double>(1.0L / std::abs(loop(axis))), 1e-11);
  const auto off_by = [](const json& number, double value) {
    return reference::relative_error(number.get<double>(), value);
  };
  EXPECT_NEAR(off_by(verified.at("gain_crossover_rad_s").at(0), gain.frequency), 9.3e-8, 1e-9);
  EXPECT_NEAR(off_by(verified.at("gain_margin_abs").at(0), found.phase_crossovers[0].gain_margin),
              3.1e-7, 1e-8);
  // What was published holds.
  EXPECT_NEAR(gain.phase_margin_deg, 18.161, 5e-4);
  EXPECT_NEAR(found.increasing_gain_margin, 2.3842, 5e-5);
  EXPECT_NEAR(found.distance_to_minus_one(), 0.26953, 6e-6);
  EXPECT_NEAR(found.sensitivity.frequency, 9.1504, 5e-5);
}

TEST(MarginsReference, AtRestOfAnUnstablePlant) {
  // ControlSystems.jl issue 1045: the crossover at frequency 0 counts. The published value holds
  // (closed form above); the recomputed one of the reference is off in the sixth digit.
  const auto file =
      reference::case_of(reference::reference_values("margins_statespace").at("cases"),
                         "issue_cs1045_negative_frequency");
  const plant::StateSpace loop = reference::matrices_of(file.at("ss"));
  const double closed_form = ends("issue_cs1045_negative_frequency", loop).front().gain_margin;
  EXPECT_LT(
      reference::relative_error(file.at("published").at("gm_all").at(0).get<double>(), closed_form),
      1e-14);
  EXPECT_GT(
      reference::relative_error(file.at("verified").at("gm_at_dc").get<double>(), closed_form),
      2e-6);
  const Margins found = margins(loop);
  EXPECT_LT(reference::relative_error(found.decreasing_gain_margin, closed_form), 1e-12);
  EXPECT_EQ(found.phase_crossovers.front().frequency, 0.0);
}

}  // namespace
}  // namespace boresight::control
