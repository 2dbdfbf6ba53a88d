#include <array>
#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/design/tuning/feasible_search.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double infinity = std::numeric_limits<double>::infinity();

double squared(double x) {
  return x * x;
}

// Least distance to (3, 2), twice a local ripple on it, where the larger of two kinked constraints
// is met: x + |y| <= 2 (each branch of |y| an entry) and y >= x^2 - 1. A bite around (-2, 0) is
// undefined.
struct Kinked {
  struct Seen {
    double cost, violation;
  };
  std::vector<Seen> seen;

  static double cost(double x, double y) {
    return squared(x - 3.0) + squared(y - 2.0) + 0.5 * std::sin(4.0 * x) * std::sin(3.0 * y);
  }
  static double violation(double x, double y) {
    return std::max(x + std::abs(y) - 2.0, x * x - 1.0 - y);
  }

  ConstrainedProblem problem() {
    ConstrainedProblem problem;
    problem.lower = {-4.0, -4.0};
    problem.upper = {4.0, 4.0};
    problem.constraints = 3;
    problem.evaluate = [this](const std::vector<double>& at, ConstrainedValues& values) {
      const double x = at[0], y = at[1];
      EXPECT_TRUE(std::isfinite(x) && std::isfinite(y));
      if (std::hypot(x + 2.0, y) < 0.7) return false;
      values.objectives = {cost(x, y)};
      values.objective_gradients = {2.0 * (x - 3.0) + 2.0 * std::cos(4.0 * x) * std::sin(3.0 * y),
                                    2.0 * (y - 2.0) + 1.5 * std::sin(4.0 * x) * std::cos(3.0 * y)};
      values.constraints = {x + y - 2.0, x - y - 2.0, x * x - 1.0 - y};
      values.constraint_gradients = {1.0, 1.0, 1.0, -1.0, 2.0 * x, -1.0};
      seen.push_back({values.cost(), values.violation()});
      return true;
    };
    return problem;
  }

  // By brute force.
  static double min_cost() {
    double minimum = infinity;
    constexpr int steps = 4000;
    for (int i = 0; i <= steps; ++i) {
      const double x = -4.0 + 8.0 * i / steps;
      for (int j = 0; j <= steps; ++j) {
        const double y = -4.0 + 8.0 * j / steps;
        if (violation(x, y) <= 0.0) minimum = std::min(minimum, cost(x, y));
      }
    }
    return minimum;
  }
};

TEST(FeasibleSearch, NeverReportsAnInfeasiblePointOrOneWorseThanItHasSeen) {
  Kinked kinked;
  const double minimum = Kinked::min_cost();
  std::mt19937_64 generator(7);
  int optimal = 0, started = 0;
  for (int start = 0; start < 500; ++start) {
    kinked.seen.clear();
    FeasibleSearch search(kinked.problem());
    const auto from = search.random_point(generator);
    const auto found = search.search_from(from);
    if (std::hypot(from[0] + 2.0, from[1]) < 0.7) {
      EXPECT_FALSE(found) << "an undefined start";
      continue;
    }
    ++started;
    ASSERT_TRUE(found) << from[0] << " " << from[1];
    EXPECT_LE(Kinked::violation(found->point[0], found->point[1]), 0.0);
    EXPECT_EQ(Kinked::cost(found->point[0], found->point[1]), found->cost);
    double best_seen = infinity;
    for (const auto& [cost, violation] : kinked.seen) {
      if (violation <= 0.0) best_seen = std::min(best_seen, cost);
    }
    EXPECT_EQ(found->cost, best_seen);
    EXPECT_EQ(search.best()->cost, best_seen);
    EXPECT_EQ(static_cast<std::size_t>(search.evaluations()),
              kinked.seen.size() + static_cast<std::size_t>(search.undefined_evaluations()));
    if (found->cost < minimum + 1e-6) ++optimal;
  }
  EXPECT_GT(started, 450);
  EXPECT_GT(optimal, 0.95 * started) << optimal << " of " << started;
}

TEST(FeasibleSearch, FindsTheCornerWhereTwoBranchesMeet) {
  // |x - 1| + |y - 2| has no gradient at its least: as the largest of four planes it has.
  ConstrainedProblem problem;
  problem.lower = {-5.0, -5.0};
  problem.upper = {5.0, 5.0};
  problem.objectives = 4;
  problem.evaluate = [](const std::vector<double>& at, ConstrainedValues& values) {
    const double x = at[0] - 1.0, y = at[1] - 2.0;
    values.objectives = {x + y, x - y, -x + y, -x - y};
    values.objective_gradients = {1.0, 1.0, 1.0, -1.0, -1.0, 1.0, -1.0, -1.0};
    return true;
  };
  FeasibleSearch search(problem);
  const auto found = search.search_from({-4.0, 4.5});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->point[0], 1.0, 1e-7);
  EXPECT_NEAR(found->point[1], 2.0, 1e-7);
  EXPECT_NEAR(found->cost, 0.0, 1e-7);
}

TEST(FeasibleSearch, EndsOnABoundWhereThatIsBest) {
  ConstrainedProblem problem;
  problem.lower = {0.5};
  problem.upper = {2.0};
  problem.evaluate = [](const std::vector<double>& at, ConstrainedValues& values) {
    EXPECT_GE(at[0], 0.5);
    EXPECT_LE(at[0], 2.0);
    values.objectives = {at[0] * at[0]};
    values.objective_gradients = {2.0 * at[0]};
    return true;
  };
  FeasibleSearch search(problem);
  EXPECT_EQ(search.search_from({1.7})->point[0], 0.5);
}

// Two discs of radius 1 that do not meet, 3 apart: the nearest point is half way, 0.5 beyond each.
ConstrainedProblem two_discs() {
  ConstrainedProblem problem;
  problem.lower = {-5.0, -5.0};
  problem.upper = {5.0, 5.0};
  problem.constraints = 2;
  problem.evaluate = [](const std::vector<double>& at, ConstrainedValues& values) {
    const double left = std::hypot(at[0], at[1]) + 1e-300;
    const double right = std::hypot(at[0] - 3.0, at[1]) + 1e-300;
    values.objectives = {at[1]};
    values.objective_gradients = {0.0, 1.0};
    values.constraints = {left - 1.0, right - 1.0};
    values.constraint_gradients = {at[0] / left, at[1] / left, (at[0] - 3.0) / right,
                                   at[1] / right};
    return true;
  };
  return problem;
}

TEST(FeasibleSearch, FindsTheNearestPointWhereNoneIsFeasible) {
  FeasibleSearch search(two_discs());
  EXPECT_FALSE(search.search_from({-2.0, 3.0}));
  EXPECT_FALSE(search.best());
  const auto nearest = search.approach_from({-2.0, 3.0});
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(nearest->violation, 0.5, 1e-7);
  EXPECT_NEAR(nearest->point[0], 1.5, 1e-5);
  EXPECT_NEAR(nearest->point[1], 0.0, 1e-3);
  EXPECT_LE(search.nearest()->violation, nearest->violation);
}

TEST(FeasibleSearch, GoesOnBeyondZeroWhenItApproaches) {
  ConstrainedProblem problem = two_discs();
  problem.constraints = 1;
  problem.evaluate = [](const std::vector<double>& at, ConstrainedValues& values) {
    values.objectives = {at[0]};
    values.objective_gradients = {1.0, 0.0};
    values.constraints = {squared(at[0]) + squared(at[1]) - 4.0};
    values.constraint_gradients = {2.0 * at[0], 2.0 * at[1]};
    return true;
  };
  FeasibleSearch search(problem);
  EXPECT_NEAR(search.approach_from({3.0, 3.0})->violation, -4.0, 1e-6);
  EXPECT_NEAR(search.search_from({3.0, 3.0})->cost, -2.0, 1e-6);
}

TEST(FeasibleSearch, TakesNotANumberForUndefined) {
  for (int where = 0; where < 4; ++where) {
    ConstrainedProblem problem;
    problem.lower = {-3.0, -3.0};
    problem.upper = {3.0, 3.0};
    problem.constraints = 1;
    problem.evaluate = [where](const std::vector<double>& at, ConstrainedValues& values) {
      values.objectives = {squared(at[0]) + squared(at[1] - 1.0)};
      values.objective_gradients = {2.0 * at[0], 2.0 * (at[1] - 1.0)};
      values.constraints = {at[1] - 0.5};
      values.constraint_gradients = {0.0, 1.0};
      if (at[1] > 0.6) {  // beyond the constraint
        const std::array lists{&values.objectives, &values.objective_gradients, &values.constraints,
                               &values.constraint_gradients};
        lists.at(static_cast<std::size_t>(where))->back() =
            where % 2 == 0 ? std::nan("") : -infinity;
      }
      return true;
    };
    FeasibleSearch search(problem);
    EXPECT_FALSE(search.search_from({0.0, 2.0})) << "an undefined start is given up";
    EXPECT_EQ(search.evaluations(), 1);
    const auto start = search.backtrack({0.0, 2.0}, {1.0, -2.0});
    EXPECT_LE(start[1], 0.6);
    const auto found = search.search_from(start);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->cost, 0.25, 1e-6);
    EXPECT_TRUE(std::isfinite(search.nearest()->violation));
    EXPECT_GE(search.undefined_evaluations(), 1);
  }
}

TEST(FeasibleSearch, HandsOnAnExceptionAndKeepsItsRecord) {
  for (const int bad_call : {2, 5, 6}) {
    int calls = 0;
    Kinked kinked;
    const ConstrainedProblem honest = kinked.problem();
    ConstrainedProblem problem = honest;
    problem.evaluate = [&](const std::vector<double>& at, ConstrainedValues& values) {
      if (++calls == bad_call) throw std::domain_error("no value here");
      return honest.evaluate(at, values);
    };
    FeasibleSearch search(problem);
    EXPECT_THROW(search.search_from({0.0, 0.0}), std::domain_error);
    ASSERT_TRUE(search.best());
    EXPECT_LE(search.best()->violation, 0.0);
    // And can be used again.
    EXPECT_TRUE(search.search_from({0.0, 0.0}));
  }
}

TEST(FeasibleSearch, KeepsTheBestWhenItIsStopped) {
  Kinked kinked;
  for (const long cap : {1L, 2L, 5L, 9L}) {
    kinked.seen.clear();
    FeasibleSearchOptions options;
    options.stop = [&] { return static_cast<long>(kinked.seen.size()) >= cap; };
    FeasibleSearch search(kinked.problem(), options);
    const auto found = search.search_from({0.0, 0.5});
    EXPECT_TRUE(search.stopped());
    EXPECT_EQ(static_cast<long>(kinked.seen.size()), cap);
    ASSERT_TRUE(found);  // the start itself is feasible
    EXPECT_LE(found->violation, 0.0);

    FeasibleSearchOptions capped;
    capped.max_evaluations = cap;
    FeasibleSearch other(kinked.problem(), capped);
    EXPECT_EQ(other.search_from({0.0, 0.5})->point, found->point);
    EXPECT_EQ(other.evaluations(), cap);
    EXPECT_TRUE(other.stopped());
  }
}

TEST(FeasibleSearch, GivesTheSameBytesAgain) {
  std::array<std::vector<double>, 2> found;
  for (auto& points : found) {
    Kinked kinked;
    FeasibleSearch search(kinked.problem());
    std::mt19937_64 generator(3);
    for (int start = 0; start < 20; ++start) {
      const auto best = search.search_from(search.random_point(generator));
      if (best) points.insert(points.end(), best->point.begin(), best->point.end());
    }
  }
  EXPECT_EQ(found[0], found[1]);
}

TEST(FeasibleSearch, SaysWhatItExpects) {
  const auto construct = [](const ConstrainedProblem& problem, FeasibleSearchOptions options = {}) {
    return [=] { FeasibleSearch search(problem, options); };
  };
  ConstrainedProblem problem = two_discs();
  problem.upper = {1.0};
  EXPECT_THAT(reference::Call(construct(problem)),
              ThrowsMessage<InvalidInput>(HasSubstr("found 2 and 1")));
  problem.upper = {1.0, -5.0};
  EXPECT_THAT(reference::Call(construct(problem)),
              ThrowsMessage<InvalidInput>(HasSubstr("lower < upper")));
  problem.upper = {1.0, infinity};
  EXPECT_THAT(reference::Call(construct(problem)),
              ThrowsMessage<InvalidInput>(HasSubstr("finite bounds")));
  problem = two_discs();
  problem.objectives = 0;
  EXPECT_THAT(reference::Call(construct(problem)),
              ThrowsMessage<InvalidInput>(HasSubstr("one objective")));
  problem = two_discs();
  problem.evaluate = nullptr;
  EXPECT_THAT(reference::Call(construct(problem)),
              ThrowsMessage<InvalidInput>(HasSubstr("a callback")));
  FeasibleSearchOptions options;
  options.evaluations_per_run = 0;
  EXPECT_THAT(reference::Call(construct(two_discs(), options)),
              ThrowsMessage<InvalidInput>(HasSubstr("at least 1 evaluation")));
  options = {};
  options.reserve = std::nan("");
  EXPECT_THAT(reference::Call(construct(two_discs(), options)),
              ThrowsMessage<InvalidInput>(HasSubstr("of 0 or more")));
  FeasibleSearch search(two_discs());
  EXPECT_THAT(reference::Call([&] { search.evaluate({1.0}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("2 variables, found 1")));
  EXPECT_THAT(reference::Call([&] {
                search.backtrack({1.0, 1.0}, {1.0});
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("one size, found 2 and 1")));
}

}  // namespace
}  // namespace boresight::design
