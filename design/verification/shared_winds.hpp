#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include <Eigen/Core>

#include <boresight/design/verification/wind_course.hpp>

namespace boresight::design {

/// Records of wind in which several controllers are compared, prepared once for all of them. A
/// record depends on the wind, the gear ratio and the sample time only, and its preparation takes
/// as long as several runs. Safe to use from several threads; the results do not depend on it.
class SharedWinds {
 public:
  /// Of the constructor of WindCourses, which throws likewise.
  struct Records {
    const TrackingProblem& problem;
    const SimulatedLoop& loop;
    double rate = 0.0;      // rad/s of motor
    double duration = 0.0;  // s
  };
  std::shared_ptr<const WindCourses> courses(const Records& records);

  /// |Fourier coefficient k|^2, k = 1 .. (counted - 1)/2, of the last `counted` samples of the
  /// gusts of seeds seed .. seed + winds - 1 ((N m)^2): one column per wind. Computed over
  /// `threads` at the first call.
  std::shared_ptr<const Eigen::ArrayXXd> line_squares(const Records& records, Eigen::Index counted,
                                                      std::uint64_t seed, int winds,
                                                      unsigned threads);

 private:
  struct Prepared {
    WindCondition wind;
    double gear_ratio = 0.0;
    double sample_time = 0.0;
    double rate = 0.0;
    double duration = 0.0;
    std::shared_ptr<const WindCourses> courses = nullptr;
    Eigen::Index counted = 0;
    std::uint64_t seed = 0;
    std::shared_ptr<const Eigen::ArrayXXd> line_squares = nullptr;  // of those, once requested

    bool is_of(const Records& records) const;
  };

  Prepared& find(const Records& records);

  std::mutex mutex_;
  std::vector<Prepared> prepared_;
};

}  // namespace boresight::design
