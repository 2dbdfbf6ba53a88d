#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <boresight/control/analysis/crossovers_on_grid.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/bracketed_search.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;

// Zero where L crosses, its sign the side: ln|L|, or the sine of the angle to the real axis.
double offset(CrossoverKind kind, Complex gain) {
  const double magnitude = std::abs(gain);
  if (kind == CrossoverKind::phase) {
    return magnitude > 0.0 && std::isfinite(magnitude) ? gain.imag() / magnitude : 0.0;
  }
  constexpr double beyond_all = 1e3;
  return std::clamp(std::log(magnitude), -beyond_all, beyond_all);
}

// The search for one kind of crossover, in x = ln w.
class Search {
 public:
  Search(const LoopOnGrid& loop, const CrossoverOptions& options, CrossoverKind kind)
      : loop_(loop), options_(options), kind_(kind) {
    const Eigen::Index count = loop.frequency.size();
    x_ = loop.frequency.log();
    offset_.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      offset_[i] = offset(kind, loop.value[i]);
      // Infinite or not a number: a pole, of no side.
      if (!(std::abs(offset_[i]) > loop.uncertainty[i])) offset_[i] = 0.0;
    }
    const double twice = 2.0 * loop.largest_turn;
    if (kind == CrossoverKind::gain) {
      furthest_ = twice;
    } else if (twice < 0.5 * std::numbers::pi) {
      furthest_ = std::sin(twice);
    }
    function_ = [this](double x) { return offset(kind_, loop_.gain(std::exp(x))); };
  }

  // Places of the crossovers; the tangencies are appended.
  std::vector<double> run(std::vector<Tangency>& tangencies) {
    Eigen::Index before = -1, last = -1;  // the last two points of a certain side
    for (Eigen::Index i = 0; i < x_.size(); ++i) {
      if (offset_[i] == 0.0) continue;
      if (last >= 0) {
        if ((offset_[last] > 0.0) != (offset_[i] > 0.0)) {
          add_root(x_[last], x_[i], offset_[last], offset_[i]);
        } else if (i - last > 1) {
          turn_back(last, i);
        } else if (before >= 0 && is_nearest(before, last, i)) {
          turn_back(before, i);
        }
      }
      before = last;
      last = i;
    }
    std::sort(places_.begin(), places_.end());
    merge_shallow_pairs();
    std::erase_if(tangencies_, [this](const Tangency& miss) {
      return miss.approach == Approach::misses && is_rounding(std::log(miss.frequency));
    });
    std::sort(tangencies_.begin(), tangencies_.end(),
              [](const Tangency& a, const Tangency& b) { return a.frequency < b.frequency; });
    tangencies.insert(tangencies.end(), tangencies_.begin(), tangencies_.end());
    return places_;
  }

 private:
  bool counts(double x) const {
    return kind_ == CrossoverKind::gain || loop_.gain(std::exp(x)).real() < 0.0;
  }

  // Same side at all three, the middle one nearest to zero by more than rounding.
  bool is_nearest(Eigen::Index i, Eigen::Index j, Eigen::Index k) const {
    if ((offset_[i] > 0.0) != (offset_[j] > 0.0)) return false;
    if (std::abs(offset_[j]) > furthest_) return false;
    const double left = std::abs(offset_[i]), middle = std::abs(offset_[j]),
                 right = std::abs(offset_[k]);
    return middle <= left && middle <= right &&
           std::max(left, right) - middle > loop_.uncertainty[j];
  }

  // Whether the zero at x is one that L passes through, not a jump at a pole or zero of L.
  bool is_smooth(double x) const {
    constexpr double nearby = 1e-11;
    if (std::abs(function_(x)) > 1e-2) return false;
    const double low = std::abs(loop_.gain(std::exp(x - nearby)));
    const double high = std::abs(loop_.gain(std::exp(x + nearby)));
    const double here = std::abs(loop_.gain(std::exp(x)));
    return std::isfinite(here) && here > 0.0 && std::max(low, high) < 3.0 * here &&
           std::min(low, high) > here / 3.0;
  }

  void add_root(double low, double high, double at_low, double at_high) {
    const double x = numerics::bracketed_root(function_, low, high, at_low, at_high);
    if (is_smooth(x) && counts(x)) places_.push_back(x);
  }

  void add_tangency(double x, Approach approach, double distance) {
    if (distance >= options_.near_tangent) return;
    tangencies_.push_back({std::exp(x), kind_, approach, distance});
  }

  // Place of the extremum towards, or from, zero on the side given.
  double extremum(double low, double high, double side) const {
    return numerics::bracketed_maximum([&](double x) { return side * function_(x); }, low, high);
  }

  // The same side at both ends and something nearer to zero between them.
  void turn_back(Eigen::Index first, Eigen::Index last) {
    const double side = offset_[first] > 0.0 ? 1.0 : -1.0;
    const double x = extremum(x_[first], x_[last], -side);
    // Found from a neighbouring point before, where points are closer than rounding separates.
    constexpr double same = 0.05;
    if (std::abs(x - last_turn_) < same * (x_[last] - x_[first])) return;
    last_turn_ = x;
    const double value = side * function_(x);
    // What is not clearly nearer than both ends is a rounding error of something that only comes
    // or goes.
    constexpr double clearly = 10.0;
    const double dip = std::min(height_beside(first, -1), height_beside(last, 1)) - value;
    double noise = loop_.uncertainty.segment(first, last - first + 1).maxCoeff();
    if (std::min(std::abs(value), dip / clearly) <= noise && loop_.error) {
      noise = std::min(noise, loop_.error(std::exp(x)));
    }
    if (!(dip > clearly * noise) || !counts(x)) return;
    const double touch = std::max(options_.touch, noise);
    if (value < -touch) {
      add_root(x_[first], x, offset_[first], side * value);
      add_root(x, x_[last], side * value, offset_[last]);
      add_tangency(x, Approach::crosses, -value);
    } else if (value > touch) {
      add_tangency(x, Approach::misses, value);
    } else if (is_smooth(x)) {
      places_.push_back(x);
      add_tangency(x, Approach::touches, std::abs(value));
    }
  }

  // How far from zero L gets from that point on before it turns.
  double height_beside(Eigen::Index i, Eigen::Index step) const {
    double height = std::abs(offset_[i]);
    for (Eigen::Index next = i + step; next >= 0 && next < x_.size(); next += step) {
      const double further = offset_[next];
      if ((further > 0.0) != (offset_[i] > 0.0) || !(std::abs(further) > height)) break;
      height = std::abs(further);
    }
    return height;
  }

  // Whether an extremum is so near to a crossover that it is one of its rounding errors.
  bool is_rounding(double x) const {
    constexpr double nearby = 1e-7;
    return std::any_of(places_.begin(), places_.end(),
                       [&](double place) { return std::abs(place - x) < nearby; });
  }

  // Neighbouring crossovers between which L leaves zero by little, with grid points between them.
  void merge_shallow_pairs() {
    for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
      const double low = places_[i], high = places_[i + 1];
      double furthest = 0.0;
      const double* point = std::upper_bound(x_.data(), x_.data() + x_.size(), low);
      for (; point != x_.data() + x_.size() && *point < high; ++point) {
        const double here = offset_[point - x_.data()];
        if (std::abs(here) > std::abs(furthest)) furthest = here;
      }
      if (furthest == 0.0 || std::abs(furthest) >= options_.near_tangent) continue;
      const double side = furthest > 0.0 ? 1.0 : -1.0;
      const double x = extremum(low, high, side);
      const double distance = std::abs(function_(x));
      if (!counts(x)) continue;
      if (distance > options_.touch) {
        add_tangency(x, Approach::crosses, distance);
        continue;
      }
      add_tangency(x, Approach::touches, distance);
      places_[i] = x;
      places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
  }

  const LoopOnGrid& loop_;
  const CrossoverOptions& options_;
  CrossoverKind kind_;
  Eigen::ArrayXd x_, offset_;
  double last_turn_ = std::numeric_limits<double>::infinity();
  double furthest_ = std::numeric_limits<double>::infinity();  // an extremum beyond is no concern
  std::function<double(double)> function_;
  std::vector<double> places_;
  std::vector<Tangency> tangencies_;
};

}  // namespace

Crossovers crossovers_on_grid(const LoopOnGrid& loop, const CrossoverOptions& options) {
  Crossovers result;
  for (const double x : Search(loop, options, CrossoverKind::gain).run(result.tangencies)) {
    const double w = std::exp(x);
    double margin = std::arg(-loop.gain(w));
    if (margin <= -std::numbers::pi) margin = std::numbers::pi;
    const double turn = margin >= 0.0 ? margin : margin + two_pi;
    result.gain.push_back({w, margin * 180.0 / std::numbers::pi, turn / w});
  }
  for (const double x : Search(loop, options, CrossoverKind::phase).run(result.tangencies)) {
    const double w = std::exp(x);
    result.phase.push_back({w, 1.0 / std::abs(loop.gain(w))});
  }
  return result;
}

}  // namespace boresight::control
