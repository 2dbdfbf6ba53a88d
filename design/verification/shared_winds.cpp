#include <algorithm>
#include <utility>

#include <boresight/design/verification/shared_winds.hpp>
#include <boresight/numerics/fourier_transform.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {

using Eigen::Index;

bool SharedWinds::Prepared::is_of(const Records& records) const {
  const SimulatedLoop& loop = records.loop;
  return wind == records.problem.wind && gear_ratio == loop.gear_ratio &&
         sample_time == loop.sample_time && rate == records.rate && duration == records.duration;
}

SharedWinds::Prepared& SharedWinds::find(const Records& records) {
  const auto known =
      std::ranges::find_if(prepared_, [&](const Prepared& one) { return one.is_of(records); });
  if (known != prepared_.end()) return *known;
  const auto& [problem, loop, rate, duration] = records;
  Prepared fresh{.wind = problem.wind,
                 .gear_ratio = loop.gear_ratio,
                 .sample_time = loop.sample_time,
                 .rate = rate,
                 .duration = duration};
  fresh.courses = std::make_shared<const WindCourses>(problem, loop, rate, duration);
  return prepared_.emplace_back(std::move(fresh));
}

std::shared_ptr<const WindCourses> SharedWinds::courses(const Records& records) {
  const std::scoped_lock lock(mutex_);
  return find(records).courses;
}

std::shared_ptr<const Eigen::ArrayXXd> SharedWinds::line_squares(const Records& records,
                                                                 Index counted, std::uint64_t seed,
                                                                 int winds, unsigned threads) {
  const std::scoped_lock lock(mutex_);
  Prepared& prepared = find(records);
  if (prepared.line_squares && prepared.counted == counted && prepared.seed == seed &&
      prepared.line_squares->cols() == winds) {
    return prepared.line_squares;
  }
  const Index lines = (counted - 1) / 2;
  auto squares = std::make_shared<Eigen::ArrayXXd>(lines, winds);
  numerics::for_each_index(static_cast<std::size_t>(winds), threads, [&](std::size_t i) {
    const Eigen::VectorXd gusts = prepared.courses->gusts(seed + i);
    const Eigen::VectorXcd spectrum = numerics::fourier_transform(gusts.tail(counted));
    squares->col(static_cast<Index>(i)) = spectrum.segment(1, lines).array().abs2();
  });
  prepared.counted = counted;
  prepared.seed = seed;
  prepared.line_squares = std::move(squares);
  return prepared.line_squares;
}

}  // namespace boresight::design
