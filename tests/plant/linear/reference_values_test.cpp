#include "reference_values.hpp"

#include <gtest/gtest.h>

#include "random_numbers.hpp"

namespace boresight::plant {
namespace {

using reference::relative_error;
using reference::system_of;

TEST(ReferenceValues, GiveEveryLoopAsASystemWithTheGainItsCrossoversHave) {
  const auto file = reference::reference_values("margins");
  for (auto entry : file.at("cases")) {
    if (entry.at("id") == "pc_disc_gh523a_T0.05") {
      // The verified values are those of 1.1 w^2/(s^2 + 0.4 w s + w^2) with w = 2 pi, of which the
      // file prints rounded coefficients and a slip: 43.42624593 for 43.42625936. With the printed
      // ones all would be up to 4.6e-7 off.
      EXPECT_EQ(entry.at("system").at("num").at(0), 43.42624593);
      entry.at("system").update(reference::sampled_resonance());
    }
    const StateSpace loop = system_of(entry.at("system"));
    for (const double w : entry.at("verified").at("gain_crossover_rad_s")) {
      EXPECT_NEAR(std::abs(frequency_response(loop, w)(0, 0)), 1.0, 1e-9) << entry.at("id");
    }
    const auto& verified = entry.at("verified");
    for (std::size_t i = 0; i < verified.at("gain_margin_abs").size(); ++i) {
      const auto gain = frequency_response(loop, verified.at("phase_crossover_rad_s").at(i))(0, 0);
      EXPECT_LT(relative_error(gain * verified.at("gain_margin_abs").at(i).get<double>(), -1.0),
                1e-9)
          << entry.at("id");
    }
  }
}

TEST(ReferenceValues, HoldARationalFunctionAsTheFileSamplesIt) {
  const auto file = reference::reference_values("c2d").at("tf_zoh");
  nlohmann::json sampled = file;
  sampled["kind"] = "tf_sampled";
  const StateSpace held = system_of(sampled);
  const StateSpace printed = [&] {
    StateSpace system = rational(reference::ascending(file.at("num_d")),
                                 reference::ascending(file.at("den_d")), "u", "y", "x");
    system.sample_time = file.at("Ts");
    return system;
  }();
  for (const double w : {0.0, 0.4, 3.0, 15.0}) {
    EXPECT_LT(
        relative_error(frequency_response(held, w)(0, 0), frequency_response(printed, w)(0, 0)),
        1e-12);
  }
}

TEST(ReferenceValues, BuildACascadeWithTheResponseOfItsZerosAndPoles) {
  const auto file = reference::case_of(reference::reference_values("norms_gramians").at("hinf_h2"),
                                       "issue_cs1014")
                        .at("system")
                        .at("P_zpk");
  const StateSpace system = reference::sections_of(file);
  for (const double w : {0.01, 1.0, 5.7, 80.0, 1e4}) {
    const std::complex<double> s(0.0, w);
    std::complex<double> expected = file.at("gain").get<double>();
    for (const auto zero : reference::complex_numbers(file.at("zeros"))) expected *= s - zero;
    for (const auto pole : reference::complex_numbers(file.at("poles"))) expected /= s - pole;
    EXPECT_LT(relative_error(frequency_response(system, w)(0, 0), expected), 1e-12) << w;
  }
}

TEST(ReferenceValues, ReadThePrintedResultsOfSlicot) {
  const auto norm = reference::slicot_result("AB13BD.res", "L2-norm of the system =");
  EXPECT_DOUBLE_EQ(norm.at(0).at(0).value, 7.93948);
  EXPECT_NEAR(norm.at(0).at(0).half_unit, 5e-6, 1e-18);
  const auto hsv = reference::slicot_result("AB09AD.res", "singular values HSV");
  ASSERT_EQ(hsv.size(), 1U);
  ASSERT_EQ(hsv.front().size(), 7U);
  EXPECT_DOUBLE_EQ(hsv.front().back().value, 0.0246);
  const auto solution = reference::slicot_result("SB03OD.res", "X = op(U)'*op(U)");
  ASSERT_EQ(solution.size(), 4U);
  EXPECT_DOUBLE_EQ(solution.at(3).at(3).value, 7.0);
  const auto response = reference::slicot_result("TB05AD.res", "response matrix G(freq)");
  ASSERT_EQ(response.size(), 2U);
  EXPECT_DOUBLE_EQ(response.at(1).at(1).value, -0.40);
}

TEST(ReferenceValues, ReadTheMatricesOfASlicotExample) {
  reference::SlicotData data("TB05AD.dat");
  EXPECT_EQ(data.scalar(0), 3.0);
  EXPECT_EQ(data.scalar(4), 0.5);
  EXPECT_EQ(data.next_matrix(3, 3)(1, 0), 4.0);
  EXPECT_EQ(data.next_matrix(3, 1)(1, 0), 0.0);
  EXPECT_EQ(data.next_matrix(2, 3)(0, 2), -1.0);
}

}  // namespace
}  // namespace boresight::plant
