#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace boresight::control {

/// A panel in ln w, and its halves once they have been created.
struct FrequencyPanel {
  double from = 0.0, to = 0.0;
  std::uint32_t first_half = 0;  // the other follows it; 0: not made

  double centre() const { return 0.5 * (from + to); }
  double half_width() const { return 0.5 * (to - from); }
};

/// Panels of frequencies that are halved where a function of frequency requires it: the bisection
/// of adaptive quadrature (P. J. Davis, P. Rabinowitz, Methods of Numerical Integration, 2nd ed.,
/// 1984, sec. 6.2). The panels are reused from one function to the next. The owner keeps the data
/// of a panel in arrays with the same indices.
class AdaptivePanels {
 public:
  /// Narrowest panel in ln w. Variation within less is treated as an undamped pole, which no panel
  /// would resolve.
  static constexpr double narrowest = 1e-7;
  /// Largest number of panels kept from one function to the next, and for one function.
  static constexpr std::size_t maximum = 4000;
  static constexpr std::size_t max_leaves = 4000;

  bool empty() const { return panels_.empty(); }
  std::size_t size() const { return panels_.size(); }
  const FrequencyPanel& operator[](std::size_t i) const { return panels_[i]; }
  /// The initial panels of every function, rising in frequency.
  const std::vector<std::uint32_t>& first() const { return first_; }

  /// Adds a panel and returns its index.
  std::uint32_t add(double from, double to);
  /// Adds the last panel to the initial panels of all later functions.
  void start_from_last() { first_.push_back(static_cast<std::uint32_t>(panels_.size() - 1)); }
  void drop_last() { panels_.pop_back(); }
  /// If there are too many halves, drops all of them and returns true. Only the initial panels
  /// remain; they must have been added before all others.
  bool drop_halves_if_too_many();

  /// The panels of a function, rising in frequency: the initial ones, halved until
  /// `close_enough(i)` or until they are too many. `make(from, to)` adds a panel; `evaluate(panels,
  /// count)` evaluates the function there.
  template <typename Make, typename Evaluate, typename CloseEnough>
  void choose(std::vector<std::uint32_t>& leaves, Make make, Evaluate evaluate,
              CloseEnough close_enough) {
    leaves.clear();
    // Each halving leaves one more to come back to.
    std::array<std::uint32_t, 64> waiting{};
    for (const std::uint32_t start : first_) {
      std::size_t count = 1;
      waiting[0] = start;
      while (count > 0) {
        const std::uint32_t i = waiting[--count];
        if (count + 2 > waiting.size() || leaves.size() > max_leaves || close_enough(i)) {
          leaves.push_back(i);
          continue;
        }
        if (panels_[i].first_half == 0) {
          const auto [from, to, none] = panels_[i];
          const double middle = 0.5 * (from + to);
          const auto half = static_cast<std::uint32_t>(panels_.size());
          make(from, middle);
          make(middle, to);
          panels_[i].first_half = half;
        }
        const std::uint32_t half = panels_[i].first_half;
        const std::array<std::uint32_t, 2> halves{half, half + 1};
        evaluate(halves.data(), halves.size());
        waiting[count++] = half + 1;
        waiting[count++] = half;
      }
    }
  }

 private:
  std::vector<FrequencyPanel> panels_;
  std::vector<std::uint32_t> first_;
};

/// ln w of the frequencies (Hz) that lie within [lowest, highest].
std::vector<double> places_within(double lowest, double highest,
                                  std::initializer_list<double> frequencies);

/// The intervals between these points (ln w, in any order), divided into equal panels no wider than
/// `widest`. Intervals narrower than AdaptivePanels::narrowest are omitted.
std::vector<FrequencyPanel> panels_between(std::vector<double> places, double widest);

}  // namespace boresight::control
