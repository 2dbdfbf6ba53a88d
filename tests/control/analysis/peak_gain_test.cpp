#include <algorithm>
#include <limits>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "peer_family.hpp"
#include "random_stable_system.hpp"
#include "reference_values.hpp"
#include "refused_call.hpp"
#include <boresight/control/analysis/peak_gain.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using reference::RandomNumbers;
using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double infinity = std::numeric_limits<double>::infinity();

double gain_at(const plant::StateSpace& system, double w) {
  return std::abs(plant::frequency_response(system, w)(0, 0));
}

// Whether some frequency has a gain of `level`: eigenvalues of the Hamiltonian matrix on the
// imaginary axis (S. Boyd, V. Balakrishnan, P. Kabamba, Math. Control Signals Systems 2, 1989).
// How near the axis the nearest one comes, relative to its size.
double hamiltonian_distance(const plant::StateSpace& system, double level) {
  const double d = system.d(0, 0);
  const double r = d * d - level * level;
  const Eigen::Index n = system.a.rows();
  const Eigen::MatrixXd bb = system.b * system.b.transpose();
  const Eigen::MatrixXd cc = system.c.transpose() * system.c;
  const Eigen::MatrixXd f = system.a - system.b * (d / r) * system.c;
  Eigen::MatrixXd hamiltonian(2 * n, 2 * n);
  hamiltonian << f, -level / r * bb, level / r * cc, -f.transpose();
  double nearest = infinity;
  for (const auto& value : numerics::eigenvalues(hamiltonian)) {
    nearest = std::min(nearest, std::abs(value.real()) / (std::abs(value) + 1e-300));
  }
  return nearest;
}

TEST(PeakGain, OfAnOscillatorIsTheTextbooks) {
  // 1/(s^2 + 2 z s + 1): 1/(2 z sqrt(1 - z^2)) at sqrt(1 - 2 z^2).
  for (const double zeta : {0.5, 0.1, 1e-2, 1e-4, 1e-6}) {
    const auto system = plant::rational({1.0}, {1.0, 2.0 * zeta, 1.0}, "u", "y", "x");
    const PeakGain found = peak_gain(system);
    const double expected = 0.5 / (zeta * std::sqrt(1.0 - zeta * zeta));
    EXPECT_LE(found.lower, expected * (1.0 + 1e-15 + 1e-16 / zeta));
    EXPECT_GE(found.upper, expected * (1.0 - 1e-15));
    EXPECT_LT(found.upper / found.lower - 1.0, 1e-9 + 1e-14 / zeta);
    EXPECT_NEAR(found.frequency, std::sqrt(1.0 - 2.0 * zeta * zeta), 1e-4 * zeta);
  }
}

TEST(PeakGain, AtTheEndsOfTheAxis) {
  const PeakGain low = peak_gain(plant::rational({1.0}, {1.0, 1.0}, "u", "y", "x"));
  EXPECT_EQ(low.frequency, 0.0);
  EXPECT_NEAR(low.lower, 1.0, 1e-14);
  EXPECT_TRUE(low.closed);
  const PeakGain high = peak_gain(plant::rational({1.0, 3.0}, {2.0, 1.0}, "u", "y", "x"));
  EXPECT_EQ(high.frequency, infinity);
  EXPECT_EQ(high.lower, 3.0);
  EXPECT_TRUE(high.closed);
  const PeakGain flat = peak_gain(plant::rational({-1.0, 1.0}, {1.0, 1.0}, "u", "y", "all-pass"));
  EXPECT_NEAR(flat.lower, 1.0, 1e-14);
  EXPECT_LT(flat.upper, 1.0 + 2e-9);
  const PeakGain none =
      peak_gain(plant::static_gain(Eigen::MatrixXd::Constant(1, 1, -2.5), {"u"}, {"y"}));
  EXPECT_EQ(none.lower, 2.5);
  EXPECT_LT(none.upper, 2.5 * (1.0 + 1e-9));
}

TEST(PeakGain, OfTenThousandSystemsIsBracketed) {
  RandomNumbers random(4711);
  int closed = 0;
  double widest = 0.0;
  for (int trial = 0; trial < 10000; ++trial) {
    const auto system = reference::random_stable_system(random);
    const PeakGain found = peak_gain(system);
    if (found.upper <= found.lower * (1.0 + 1e-8)) ++closed;
    widest = std::max(widest, found.upper / found.lower - 1.0);
    // The lower bound is a gain of the system, found again by a linear solve.
    const double through = std::abs(system.d(0, 0));
    const double again =
        std::isfinite(found.frequency) ? gain_at(system, found.frequency) : through;
    EXPECT_LT(std::abs(again - found.lower), 1e-8 * found.lower) << "trial " << trial;
    // And nothing is above the upper one.
    for (const auto& pole : numerics::eigenvalues(system.a)) {
      EXPECT_LE(gain_at(system, std::abs(pole.imag())), found.upper * (1.0 + 1e-10));
      EXPECT_LE(gain_at(system, std::abs(pole)), found.upper * (1.0 + 1e-10));
    }
    // Where the peak stands out, the Hamiltonian tells levels below it from levels above.
    const bool stands_out = found.lower > 1.1 * std::max(through, gain_at(system, 0.0));
    if (trial % 10 == 0 && stands_out && found.lower > 1e-6) {
      EXPECT_LT(hamiltonian_distance(system, found.lower * (1.0 - 1e-5)), 1e-7) << trial;
      EXPECT_GT(hamiltonian_distance(system, found.upper * (1.0 + 1e-4)), 1e-7) << trial;
    }
  }
  EXPECT_EQ(closed, 10000) << "the widest bracket is " << widest;
}

// The same gain with 50 digits.
using Wide = boost::multiprecision::cpp_bin_float_50;

Wide wide_gain_squared(const plant::StateSpace& system, const Wide& w) {
  // (A - j w I) z = -B as 2 n real equations, Gaussian elimination with row exchange.
  const auto n = static_cast<std::size_t>(system.a.rows());
  std::vector<std::vector<Wide>> rows(2 * n, std::vector<Wide>(2 * n + 1, Wide(0)));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const Wide a = system.a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      rows[i][j] = a;
      rows[n + i][n + j] = a;
    }
    rows[i][n + i] += w;
    rows[n + i][i] -= w;
    rows[i][2 * n] = -Wide(system.b(static_cast<Eigen::Index>(i), 0));
  }
  for (std::size_t i = 0; i < 2 * n; ++i) {
    std::size_t pivot = i;
    for (std::size_t k = i + 1; k < 2 * n; ++k) {
      if (abs(rows[k][i]) > abs(rows[pivot][i])) pivot = k;
    }
    std::swap(rows[i], rows[pivot]);
    for (std::size_t k = i + 1; k < 2 * n; ++k) {
      const Wide factor = rows[k][i] / rows[i][i];
      for (std::size_t j = i; j <= 2 * n; ++j) rows[k][j] -= factor * rows[i][j];
    }
  }
  std::vector<Wide> x(2 * n);
  for (std::size_t i = 2 * n; i-- > 0;) {
    Wide sum = rows[i][2 * n];
    for (std::size_t j = i + 1; j < 2 * n; ++j) sum -= rows[i][j] * x[j];
    x[i] = sum / rows[i][i];
  }
  Wide real = system.d(0, 0), imaginary = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Wide c = system.c(0, static_cast<Eigen::Index>(i));
    real += c * x[i];
    imaginary += c * x[n + i];
  }
  return real * real + imaginary * imaginary;
}

// The highest gain within a relative distance of a frequency, by golden section.
Wide wide_peak(const plant::StateSpace& system, double near, double reach) {
  const Wide golden = (sqrt(Wide(5)) - 1) / 2;
  Wide low = Wide(near) * (1 - Wide(reach)), high = Wide(near) * (1 + Wide(reach));
  Wide x1 = high - golden * (high - low), x2 = low + golden * (high - low);
  Wide f1 = wide_gain_squared(system, x1), f2 = wide_gain_squared(system, x2);
  for (int step = 0; step < 45; ++step) {
    if (f1 < f2) {
      low = x1;
      x1 = x2;
      f1 = f2;
      x2 = low + golden * (high - low);
      f2 = wide_gain_squared(system, x2);
    } else {
      high = x2;
      x2 = x1;
      f2 = f1;
      x1 = high - golden * (high - low);
      f1 = wide_gain_squared(system, x1);
    }
  }
  return sqrt(f1 < f2 ? f2 : f1);
}

TEST(PeakGain, HoldsTheValueOfFiftyDigitsDownToADampingOfOneInAMillion) {
  RandomNumbers random(815);
  reference::RandomSystemOptions options;
  options.min_damping = 1e-6;
  options.max_damping = 1e-3;
  int inside = 0, trials = 0;
  double widest = 0.0;
  while (trials < 150) {
    const auto system = reference::random_stable_system(random, options);
    const PeakGain found = peak_gain(system);
    if (!(found.frequency > 0.0 && std::isfinite(found.frequency))) continue;
    ++trials;
    const Wide exact = wide_peak(system, found.frequency, 1e-7);
    EXPECT_LE(exact, Wide(found.upper)) << "trial " << trials;
    EXPECT_GE(exact, Wide(found.lower)) << "trial " << trials;
    if (exact <= Wide(found.upper) && exact >= Wide(found.lower)) ++inside;
    widest = std::max(widest, found.upper / found.lower - 1.0);
  }
  EXPECT_EQ(inside, trials);
  EXPECT_LT(widest, 1e-5) << "a bracket that says something";
}

TEST(PeakGain, OfSeveralChannelsIsTheLargestSingularValue) {
  RandomNumbers random(99);
  reference::RandomSystemOptions options;
  for (int trial = 0; trial < 200; ++trial) {
    options.inputs = random.integer(1, 3);
    options.outputs = random.integer(1, 3);
    const auto system = reference::random_stable_system(random, options);
    const PeakGain found = peak_gain(system);
    EXPECT_TRUE(found.closed) << trial << ' ' << found.lower << ' ' << found.upper;
    // The gain of any pair of directions stays below, and scaling scales.
    for (int i = 0; i < 20; ++i) {
      const Eigen::MatrixXcd h = plant::frequency_response(system, random.log_uniform(0.05, 200.0));
      const Eigen::VectorXd u = random.matrix(options.inputs, 1);
      EXPECT_LE((h * u).norm() / u.norm(), found.upper);
    }
    auto scaled = system;
    scaled.c *= 3.0;
    scaled.d *= 3.0;
    EXPECT_NEAR(peak_gain(scaled).lower / found.lower, 3.0, 1e-8);
    // Inputs and outputs exchanged.
    auto transposed = system;
    transposed.a.transposeInPlace();
    transposed.b = system.c.transpose();
    transposed.c = system.b.transpose();
    transposed.d = system.d.transpose();
    std::swap(transposed.inputs, transposed.outputs);
    EXPECT_NEAR(peak_gain(transposed).lower / found.lower, 1.0, 1e-8);
  }
}

TEST(PeakGain, OfAModalSystemIsThatOfItsStateSpace) {
  for (const int modes : {5, 20}) {
    const auto system = reference::peer_modal_system(modes);
    const auto dense = reference::peer_closed_loop(modes);
    for (const auto& [input, output] : {std::pair{"d", "u"}, std::pair{"t", "y"}}) {
      const PeakGain found = peak_gain(system, input, output);
      const PeakGain expected = peak_gain(reference::channel(dense, input, output));
      EXPECT_TRUE(found.closed);
      EXPECT_NEAR(found.lower / expected.lower, 1.0, 1e-9);
      EXPECT_LE(found.lower, expected.upper);
      EXPECT_LE(expected.lower, found.upper);
    }
  }
}

TEST(PeakGain, WithDeadTimeIsThatOfADenseScan) {
  // S of k e^(-s delay)/s: peak above 1 near the crossover.
  plant::ModalSystem system;
  system.core = plant::rational({1.5}, {0.0, 1.0}, "late", "angle", "integrator");
  plant::StateSpace sum = plant::static_gain(Eigen::RowVector2d(-1.0, 1.0), {"angle", "r"}, {"e"});
  system.core = plant::connect({system.core, sum}, {"late", "r"}, {"e"});
  system.modes.force_shape.resize(0, 0);
  system.modes.displacement_shape.resize(0, 0);
  system.dead_times = {{"e", "late", 0.3}};
  system.inputs = {"r"};
  system.outputs = {"e"};
  const PeakGain found = peak_gain(system, "r", "e");
  double highest = 0.0;
  for (int i = 0; i <= 200000; ++i) {
    const double w = 0.5 + 1e-4 * i;
    const std::complex<double> loop =
        1.5 * std::polar(1.0, -0.3 * w) / std::complex<double>(0.0, w);
    highest = std::max(highest, 1.0 / std::abs(1.0 + loop));
  }
  EXPECT_TRUE(found.closed);
  EXPECT_GE(found.upper, highest);
  EXPECT_NEAR(found.lower / highest, 1.0, 1e-8);
}

TEST(PeakGain, IsInfiniteWithAPoleOnTheAxis) {
  const PeakGain found = peak_gain(plant::rational({1.0}, {1.0, 0.0, 1.0}, "u", "y", "x"));
  EXPECT_EQ(found.lower, infinity);
  EXPECT_EQ(found.upper, infinity);
  EXPECT_EQ(peak_gain(plant::rational({1.0}, {0.0, 1.0}, "u", "y", "x")).lower, infinity);
}

TEST(PeakGain, TakesSystemsWithoutIndependentEigenvectors) {
  // 1/(s + 1)^4 times a light mode.
  auto chain = plant::rational({1.0}, {1.0, 4.0, 6.0, 4.0, 1.0}, "u", "v", "lag");
  auto light = plant::rational({1.0}, {1.0, 0.02, 1.0}, "v", "y", "mode");
  const PeakGain found = peak_gain(plant::connect({chain, light}, {"u"}, {"y"}));
  // 1/|(1 + w^2)^2 (1 - w^2 + 0.02 j w)|, by a dense scan.
  double highest = 0.0;
  for (int i = 0; i <= 400000; ++i) {
    const double w = 0.9 + 5e-7 * i;
    highest =
        std::max(highest, 1.0 / (std::pow(1.0 + w * w, 2) * std::hypot(1.0 - w * w, 0.02 * w)));
  }
  EXPECT_NEAR(found.lower / highest, 1.0, 1e-9);
  EXPECT_GE(found.upper, highest * (1.0 - 1e-12));
}

TEST(PeakGain, RefusesWhatHasNoMeaning) {
  auto system = plant::rational({1.0}, {1.0, 1.0}, "u", "y", "x");
  EXPECT_THAT(reference::Call([&] {
                peak_gain(system, {1e-16, 100});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 1e-16")));
  EXPECT_THAT(reference::Call([&] {
                peak_gain(system, {1e-9, 0});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("at least 2 intervals, found 0")));
  system.a(0, 0) = infinity;
  EXPECT_THAT(reference::Call([&] { peak_gain(system); }),
              ThrowsMessage<InvalidInput>(HasSubstr("not finite")));
  auto sampled = plant::rational({1.0}, {1.0, 1.0}, "u", "y", "x");
  sampled.sample_time = 0.1;
  EXPECT_THAT(reference::Call([&] { peak_gain(sampled); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("a pole at -1")));
  // Too few intervals: a bracket that is open and says so.
  const PeakGain open =
      peak_gain(plant::rational({1.0}, {1.0, 0.02, 1.0}, "u", "y", "x"), {1e-9, 8});
  EXPECT_FALSE(open.closed);
  EXPECT_GT(open.upper, open.lower);
  EXPECT_LE(open.intervals, 20U);
}

}  // namespace
}  // namespace boresight::control
