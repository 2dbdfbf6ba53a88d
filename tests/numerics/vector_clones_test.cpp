#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <boresight/numerics/complex_packs.hpp>
#include <boresight/numerics/vector_clones.hpp>

namespace boresight::numerics {
namespace {

// The geometric series of eight complex numbers, and the registers it was summed in.
struct Series {
  template <std::size_t width>
  [[gnu::always_inline]] static inline std::size_t run(const ComplexPack& ratio, int terms,
                                                       ComplexPack& sum) {
    for (std::size_t k = 0; k < pack_size / width; ++k) {
      const ComplexLanes<width> z = part<width>(ratio, k);
      ComplexLanes<width> power{1.0, 0.0}, total{};
      for (int i = 0; i < terms; ++i) {
        total = total + power;
        power = power * z;
      }
      set_part(sum, k, total);
    }
    return width;
  }
};

ComplexPack ratios() {
  ComplexPack z;
  for (std::size_t lane = 0; lane < pack_size; ++lane) {
    const double angle = 0.3 + 0.7 * static_cast<double>(lane);
    z.re.set(lane, 0.9 * std::cos(angle));
    z.im.set(lane, 0.9 * std::sin(angle));
  }
  return z;
}

TEST(VectorClones, UseRegistersAsWideAsTheyMay) {
  const std::size_t widest = register_lanes();
  EXPECT_TRUE(widest == 2 || widest == 4 || widest == 8) << widest;
  for (const std::size_t maximum : {2U, 4U, 8U}) {
    const NarrowRegisters narrow(maximum);
    EXPECT_EQ(register_lanes(), std::min(maximum, widest));
    ComplexPack sum;
    EXPECT_EQ(run_on_widest_lanes<Series>(ratios(), 3, sum), register_lanes());
  }
  EXPECT_EQ(register_lanes(), widest);
}

// Their sizes decide in which order Eigen sums a product.
#ifndef EIGEN_NO_CPUID
#error "Eigen would choose its blocks by the processor's caches"
#endif
TEST(VectorClones, GoWithEigenBlockSizesThatDoNotDependOnTheProcessor) {
  EXPECT_EQ(Eigen::l1CacheSize(), Eigen::internal::defaultL1CacheSize);
  EXPECT_EQ(Eigen::l2CacheSize(), Eigen::internal::defaultL2CacheSize);
  EXPECT_EQ(Eigen::l3CacheSize(), Eigen::internal::defaultL3CacheSize);
}

TEST(VectorClones, SumTheSameBitsInRegistersOfEveryWidth) {
  std::array<ComplexPack, 3> sums;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const NarrowRegisters narrow(std::size_t{2} << i);
    run_on_widest_lanes<Series>(ratios(), 50, sums[i]);
  }
  for (std::size_t lane = 0; lane < pack_size; ++lane) {
    // (1 - z^50)/(1 - z)
    const std::complex<double> z{ratios().re[lane], ratios().im[lane]};
    const std::complex<double> expected = (1.0 - std::pow(z, 50)) / (1.0 - z);
    EXPECT_NEAR(sums[0].re[lane], expected.real(), 1e-14);
    EXPECT_NEAR(sums[0].im[lane], expected.imag(), 1e-14);
    for (const ComplexPack& sum : sums) {
      EXPECT_EQ(sum.re[lane], sums[0].re[lane]);
      EXPECT_EQ(sum.im[lane], sums[0].im[lane]);
    }
  }
}

}  // namespace
}  // namespace boresight::numerics
