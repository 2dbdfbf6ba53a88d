#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace boresight::control {

/// A stretch of ln w, and its halves once they were asked for.
struct FrequencyPanel {
  double from = 0.0, to = 0.0;
  std::uint32_t first_half = 0;  // the other follows it; 0: not made

  double centre() const { return 0.5 * (from + to); }
  double half_width() const { return 0.5 * (to - from); }
};

/// Panels of frequencies that halve where a function of frequency asks for it:
/// the bisection of adaptive quadrature (P. J. Davis, P. Rabinowitz, Methods of
/// Numerical Integration, 2nd ed., 1984, sec. 6.2), with its panels kept from
/// one function to the next. What goes with a panel is its owner's, in arrays
/// with the same numbers.
class AdaptivePanels {
 public:
  /// In ln w: what varies within less is taken for an undamped pole, which
  /// nothing would resolve.
  static constexpr double narrowest = 1e-7;
  /// Panels kept from one function to the next, and those of one function.
  static constexpr std::size_t most = 4000;
  static constexpr std::size_t most_leaves = 4000;

  bool empty() const { return panels_.empty(); }
  std::size_t size() const { return panels_.size(); }
  const FrequencyPanel& operator[](std::size_t i) const { return panels_[i]; }
  /// Those every function starts from, rising.
  const std::vector<std::uint32_t>& first() const { return first_; }

  /// The number of a new panel.
  std::uint32_t add(double from, double to);
  /// From now on the last one is among those that functions start from.
  void start_from_last() { first_.push_back(static_cast<std::uint32_t>(panels_.size() - 1)); }
  void drop_last() { panels_.pop_back(); }
  /// Where halves have become too many they are dropped, and it is true:
  /// nothing but the first panels is left, which must have been added before
  /// all others.
  bool drop_halves_if_too_many();

  /// The panels of a function, rising: the first ones, halved until
  /// `close_enough(i)`, or they are too many. `make(from, to)` adds a panel,
  /// `evaluate(panels, count)` takes the function there.
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
        if (count + 2 > waiting.size() || leaves.size() > most_leaves || close_enough(i)) {
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

/// ln w of those of the frequencies (Hz) that lie within [lowest, highest].
std::vector<double> places_within(double lowest, double highest,
                                  std::initializer_list<double> frequencies);

/// The stretches between these places (ln w, in any order), cut into equal
/// panels no wider than `widest`; narrower ones than AdaptivePanels::narrowest
/// are left out.
std::vector<FrequencyPanel> panels_between(std::vector<double> places, double widest);

}  // namespace boresight::control
