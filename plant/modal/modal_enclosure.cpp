#include <algorithm>
#include <cmath>
#include <limits>

#include <boresight/plant/modal/modal_enclosure.hpp>

namespace boresight::plant {
namespace {

using Complex = std::complex<double>;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

// e^(-j w delay), or where frequency runs to infinity no more than that its magnitude is 1.
numerics::TaylorModel dead_time(double delay, const numerics::FrequencyInterval& interval) {
  if (delay == 0.0) return numerics::TaylorModel::constant(1.0);
  const double turn = delay * interval.half_width;
  if (interval.reciprocal || turn > 1.0) return {0.0, 0.0, 0.0, 1.0};
  const Complex value = std::polar(1.0, -delay * interval.centre);
  return {value, Complex(0.0, -delay) * value, -0.5 * delay * delay * value,
          turn * turn * turn / 6.0 + epsilon * (1.0 + delay * interval.centre)};
}

void add_product(numerics::TaylorModel& sum, const numerics::TaylorModel& a,
                 const numerics::TaylorModel& b, double half_width) {
  sum = sum + product(a, b, half_width);
}

}  // namespace

ModalEnclosure::ModalEnclosure(const ModalSystem& system, std::string_view input,
                               std::string_view output)
    : reduction_(reduce(system, input, output)), core_(reduction_.core) {
  const std::size_t drives = reduction_.in_loop.size();
  path_number_.assign(reduction_.returns.size() * drives, -1);
  for (std::size_t p = 0; p < reduction_.paths.size(); ++p) {
    const auto& found = reduction_.paths[p];
    path_number_[found.to_return * drives + found.from_drive] = static_cast<int>(p);
    if (found.gain.size() > 0) mode_path_.push_back(p);
  }
  for (Eigen::Index i = 0; i < reduction_.mode_frequency.size(); ++i) {
    mode_decay_.push_back(reduction_.mode_damping_ratio[i] * reduction_.mode_frequency[i]);
    for (const std::size_t p : mode_path_) mode_gain_.push_back(reduction_.paths[p].gain[i]);
  }
  transfer_.resize(reduction_.paths.size());
  rate_transfer_.resize(reduction_.paths.size());
  drive_.resize(drives);
  moved_.resize(reduction_.returns.size());
  moved_rate_.resize(reduction_.returns.size());
  for (std::size_t k = 0; k < drives; ++k) {
    if (reduction_.in_loop[k]) looped_.push_back(k);
  }
  matrix_.resize(looped_.size() * (looped_.size() + 1));
}

double ModalEnclosure::highest_pole() const {
  const ModalForm* form = core_.form();
  double highest = form != nullptr ? 0.0 : reduction_.core.a.norm();
  if (form != nullptr) {
    for (const auto& pole : form->poles) highest = std::max(highest, std::abs(pole));
  }
  for (const double frequency : reduction_.mode_frequency) highest = std::max(highest, frequency);
  for (const auto& back : reduction_.returns) {
    if (back.is_dead_time && back.delay > 0.0) highest = std::max(highest, 1.0 / back.delay);
  }
  return highest;
}

const numerics::TaylorModel* ModalEnclosure::path(std::size_t j, std::size_t k) const {
  const int number = path_number_[j * drive_.size() + k];
  return number < 0 ? nullptr : &transfer_[static_cast<std::size_t>(number)];
}

const numerics::TaylorModel* ModalEnclosure::rate_path(std::size_t j, std::size_t k) const {
  const int number = path_number_[j * drive_.size() + k];
  return number < 0 ? nullptr : &rate_transfer_[static_cast<std::size_t>(number)];
}

void ModalEnclosure::sum_modes(const numerics::FrequencyInterval& interval) {
  const double c = interval.centre, h = interval.half_width;
  const std::size_t paths = mode_path_.size();
  for (const std::size_t p : mode_path_) transfer_[p] = {};
  for (std::size_t i = 0; i < mode_decay_.size(); ++i) {
    const double w = reduction_.mode_frequency[static_cast<Eigen::Index>(i)];
    const double decay = mode_decay_[i];
    // A pair -decay +- j sqrt(w^2 - decay^2); two real poles above critical damping.
    numerics::TaylorModel term;
    if (decay <= w) {
      term = resonance_inverse(std::sqrt((w - decay) * (w + decay)), decay, interval);
    } else if (interval.reciprocal) {
      term = numerics::inverse(
          {{w * w * c * c - 1.0, 2.0 * decay * c}, {2.0 * w * w * c, 2.0 * decay}, w * w, 0.0}, h);
    } else {
      term = numerics::inverse(
          {{(w - c) * (w + c), 2.0 * decay * c}, {-2.0 * c, 2.0 * decay}, -1.0, 0.0}, h);
    }
    term.rest += 4.0 * epsilon * (magnitude_bound(term, h) + term.rest);
    const double* gain = mode_gain_.data() + i * paths;
    for (std::size_t q = 0; q < paths; ++q) {
      numerics::TaylorModel& sum = transfer_[mode_path_[q]];
      const double g = gain[q];
      sum.value += g * term.value;
      sum.slope += g * term.slope;
      sum.curvature += g * term.curvature;
      sum.rest += std::abs(g) * term.rest;
    }
  }
  // Displacement b^2/q and rate j a b/q with w = a/b.
  const numerics::TaylorModel varying{c, 1.0, 0.0, 0.0};
  for (const std::size_t p : mode_path_) {
    const numerics::TaylorModel once = product(transfer_[p], varying, h);
    rate_transfer_[p] = product(once, numerics::TaylorModel::constant({0.0, 1.0}), h);
    if (interval.reciprocal) transfer_[p] = product(once, varying, h);
  }
}

void ModalEnclosure::add_return(numerics::TaylorModel& sum, Eigen::Index row, std::size_t j,
                                const numerics::TaylorModel& moved,
                                const numerics::TaylorModel& moved_rate, double half_width) const {
  const auto& back = reduction_.returns[j];
  const auto add = [&](Eigen::Index column, const numerics::TaylorModel& signal) {
    if (column < 0 || !reduction_.entry(row, column)) return;
    add_product(sum, elements_[static_cast<std::size_t>(row * core_.columns() + column)], signal,
                half_width);
  };
  add(back.column, moved);
  add(back.rate_column, moved_rate);
}

numerics::TaylorModel ModalEnclosure::enclose(const numerics::FrequencyInterval& interval) {
  const double h = interval.half_width;
  core_.enclose(interval, elements_);
  sum_modes(interval);
  for (std::size_t p = 0; p < reduction_.paths.size(); ++p) {
    if (reduction_.paths[p].gain.size() > 0) continue;
    transfer_[p] = dead_time(reduction_.returns[reduction_.paths[p].to_return].delay, interval);
  }
  for (std::size_t p = 0; p < reduction_.paths.size(); ++p) {
    transfer_[p].value -= reduction_.paths[p].within_core;
  }
  const auto element = [&](std::size_t row) -> const numerics::TaylorModel& {
    return elements_[row * static_cast<std::size_t>(core_.columns())];
  };
  const auto move = [&](std::size_t k) {
    for (std::size_t j = 0; j < moved_.size(); ++j) {
      const numerics::TaylorModel* through = path(j, k);
      if (through == nullptr) continue;
      add_product(moved_[j], *through, drive_[k], h);
      if (reduction_.returns[j].rate_column >= 0) {
        add_product(moved_rate_[j], *rate_path(j, k), drive_[k], h);
      }
    }
  };

  for (std::size_t j = 0; j < moved_.size(); ++j) moved_[j] = moved_rate_[j] = {};
  for (std::size_t k = 0; k < drive_.size(); ++k) {
    if (reduction_.in_loop[k]) continue;
    drive_[k] = element(1 + k);
    move(k);
  }

  // (1 - loop) drive = right, eliminated with the largest pivot; one more column for the right.
  const std::size_t unknowns = looped_.size(), width = unknowns + 1;
  for (std::size_t u = 0; u < unknowns; ++u) {
    const auto row = static_cast<Eigen::Index>(1 + looped_[u]);
    numerics::TaylorModel& right = matrix_[u * width + unknowns];
    right = element(1 + looped_[u]);
    for (std::size_t j = 0; j < moved_.size(); ++j) {
      add_return(right, row, j, moved_[j], moved_rate_[j], h);
    }
    for (std::size_t v = 0; v < unknowns; ++v) {
      numerics::TaylorModel loop{};
      for (std::size_t j = 0; j < moved_.size(); ++j) {
        const numerics::TaylorModel* through = path(j, looped_[v]);
        if (through != nullptr) {
          add_return(loop, row, j, *through, *rate_path(j, looped_[v]), h);
        }
      }
      matrix_[u * width + v] = numerics::TaylorModel::constant(u == v ? 1.0 : 0.0) - loop;
    }
  }
  for (std::size_t u = 0; u < unknowns; ++u) {
    std::size_t pivot = u;
    for (std::size_t v = u + 1; v < unknowns; ++v) {
      if (std::norm(matrix_[v * width + u].value) > std::norm(matrix_[pivot * width + u].value)) {
        pivot = v;
      }
    }
    for (std::size_t v = u; v < width; ++v) {
      std::swap(matrix_[u * width + v], matrix_[pivot * width + v]);
    }
    const numerics::TaylorModel scale = inverse(matrix_[u * width + u], h);
    for (std::size_t v = u + 1; v < width; ++v) {
      matrix_[u * width + v] = product(matrix_[u * width + v], scale, h);
    }
    for (std::size_t row = u + 1; row < unknowns; ++row) {
      for (std::size_t v = u + 1; v < width; ++v) {
        matrix_[row * width + v] =
            matrix_[row * width + v] - product(matrix_[row * width + u], matrix_[u * width + v], h);
      }
    }
  }
  for (std::size_t u = unknowns; u-- > 0;) {
    numerics::TaylorModel& value = drive_[looped_[u]];
    value = matrix_[u * width + unknowns];
    for (std::size_t v = u + 1; v < unknowns; ++v) {
      value = value - product(matrix_[u * width + v], drive_[looped_[v]], h);
    }
  }
  for (const std::size_t k : looped_) move(k);

  numerics::TaylorModel output = element(0);
  for (std::size_t j = 0; j < moved_.size(); ++j) {
    add_return(output, 0, j, moved_[j], moved_rate_[j], h);
  }
  return output;
}

}  // namespace boresight::plant
