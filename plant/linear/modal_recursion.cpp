#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include <boresight/plant/linear/modal_recursion.hpp>

#if defined(__x86_64__) && defined(__GNUC__)
#define BORESIGHT_FOUR_LANES [[gnu::target("avx2")]]
#endif

namespace boresight::plant {
namespace {

constexpr Eigen::Index group = 8;    // modes side by side
constexpr Eigen::Index block = 256;  // samples whose partial sums stay in the fastest cache

// What one group needs to advance over a block.
struct Stretch {
  const double* coefficients;
  double* state;
  double* partial;
  const double* input;  // column-major
  Eigen::Index input_stride;
  Eigen::Index inputs;
  Eigen::Index outputs;
  Eigen::Index samples;
  bool first;  // the first group starts the partial sums
};

template <int Width>
struct Lanes;
template <>
struct Lanes<2> {
  using Type [[gnu::vector_size(16)]] = double;
};
template <>
struct Lanes<4> {
  using Type [[gnu::vector_size(32)]] = double;
};

template <class Vector>
[[gnu::always_inline]] inline void load(Vector& to, const double* from) {
  std::memcpy(&to, from, sizeof(Vector));
}

template <class Vector>
[[gnu::always_inline]] inline void store(double* to, const Vector& from) {
  std::memcpy(to, &from, sizeof(Vector));
}

// Every lane does the same operations in the same order, whatever the width. `Single`: one input
// and one output, whose coefficients then stay in registers.
template <int Width, bool Single>
[[gnu::always_inline]] inline void advance(const Stretch& stretch) {
  using Vector = typename Lanes<Width>::Type;
  constexpr int parts = static_cast<int>(group) / Width;
  std::array<Vector, parts> re{}, im{}, factor_re{}, factor_im{}, in_re{}, in_im{}, out_re{},
      out_im{};
  const double* of_inputs = stretch.coefficients + 2 * group;
  const double* of_outputs = of_inputs + 2 * group * stretch.inputs;
#pragma GCC unroll 4
  for (std::size_t l = 0; l < parts; ++l) {
    load(re[l], stretch.state + Width * l);
    load(im[l], stretch.state + group + Width * l);
    load(factor_re[l], stretch.coefficients + Width * l);
    load(factor_im[l], stretch.coefficients + group + Width * l);
    if constexpr (Single) {
      load(in_re[l], of_inputs + Width * l);
      load(in_im[l], of_inputs + group + Width * l);
      load(out_re[l], of_outputs + Width * l);
      load(out_im[l], of_outputs + group + Width * l);
    }
  }
  for (Eigen::Index k = 0; k < stretch.samples; ++k) {
    for (Eigen::Index r = 0; r < (Single ? 1 : stretch.outputs); ++r) {
      double* sums = stretch.partial + group * (block * r + k);
      const double* of_output = of_outputs + 2 * group * r;
#pragma GCC unroll 4
      for (std::size_t l = 0; l < parts; ++l) {
        if constexpr (!Single) {
          load(out_re[l], of_output + Width * l);
          load(out_im[l], of_output + group + Width * l);
        }
        Vector sum = out_re[l] * re[l] - out_im[l] * im[l];
        if (!stretch.first) {
          Vector before;
          load(before, sums + Width * l);
          sum += before;
        }
        store(sums + Width * l, sum);
      }
    }
    std::array<Vector, parts> next_re{}, next_im{};
#pragma GCC unroll 4
    for (std::size_t l = 0; l < parts; ++l) {
      next_re[l] = factor_re[l] * re[l];
      next_im[l] = factor_im[l] * re[l];
    }
    for (Eigen::Index j = 0; j < (Single ? 1 : stretch.inputs); ++j) {
      const double u = stretch.input[j * stretch.input_stride + k];
      const double* of_input = of_inputs + 2 * group * j;
#pragma GCC unroll 4
      for (std::size_t l = 0; l < parts; ++l) {
        if constexpr (!Single) {
          load(in_re[l], of_input + Width * l);
          load(in_im[l], of_input + group + Width * l);
        }
        next_re[l] += in_re[l] * u;
        next_im[l] += in_im[l] * u;
      }
    }
#pragma GCC unroll 4
    for (std::size_t l = 0; l < parts; ++l) {
      re[l] = next_re[l] - factor_im[l] * im[l];
      im[l] = next_im[l] + factor_re[l] * im[l];
    }
  }
#pragma GCC unroll 4
  for (std::size_t l = 0; l < parts; ++l) {
    store(stretch.state + Width * l, re[l]);
    store(stretch.state + group + Width * l, im[l]);
  }
}

void advance_two(const Stretch& stretch) {
  if (stretch.inputs == 1 && stretch.outputs == 1) {
    advance<2, true>(stretch);
  } else {
    advance<2, false>(stretch);
  }
}

#ifdef BORESIGHT_FOUR_LANES
BORESIGHT_FOUR_LANES void advance_four(const Stretch& stretch) {
  if (stretch.inputs == 1 && stretch.outputs == 1) {
    advance<4, true>(stretch);
  } else {
    advance<4, false>(stretch);
  }
}
#endif

// Numbers below the normal range would slow every operation down a hundredfold and mean nothing.
void flush(double* state, Eigen::Index count) {
  for (Eigen::Index i = 0; i < count; ++i) {
    if (std::abs(state[i]) < 1e-290) state[i] = 0.0;
  }
}

}  // namespace

bool available(LaneWidth width) {
#ifdef BORESIGHT_FOUR_LANES
  static const bool four = __builtin_cpu_supports("avx2") != 0;
  return width == LaneWidth::two || four;
#else
  return width == LaneWidth::two;
#endif
}

LaneWidth widest_lanes() {
  return available(LaneWidth::four) ? LaneWidth::four : LaneWidth::two;
}

ModalRecursion::ModalRecursion(const Eigen::VectorXcd& factor, const Eigen::MatrixXcd& input,
                               const Eigen::MatrixXcd& output, Eigen::MatrixXd feedthrough)
    : modes_(factor.size()),
      inputs_(input.cols()),
      outputs_(output.rows()),
      feedthrough_(std::move(feedthrough)),
      state_(static_cast<std::size_t>(2 * group * ((modes_ + group - 1) / group)), 0.0),
      partial_(static_cast<std::size_t>(group * block * outputs_), 0.0) {
  const Eigen::Index stride = 2 * group * (1 + inputs_ + outputs_);
  const Eigen::Index groups = (modes_ + group - 1) / group;
  coefficients_.assign(static_cast<std::size_t>(stride * groups), 0.0);
  for (Eigen::Index i = 0; i < modes_; ++i) {
    double* lane = coefficients_.data() + stride * (i / group) + i % group;
    const auto put = [&](const std::complex<double>& value) {
      lane[0] = value.real();
      lane[group] = value.imag();
      lane += 2 * group;
    };
    put(factor[i]);
    for (Eigen::Index j = 0; j < inputs_; ++j) put(input(i, j));
    for (Eigen::Index r = 0; r < outputs_; ++r) put(output(r, i));
  }
}

void ModalRecursion::set_state(const Eigen::VectorXcd& state) {
  for (Eigen::Index i = 0; i < modes_; ++i) {
    double* lane = state_.data() + 2 * group * (i / group) + i % group;
    lane[0] = state[i].real();
    lane[group] = state[i].imag();
  }
}

Eigen::VectorXcd ModalRecursion::state() const {
  return Eigen::VectorXcd::NullaryExpr(modes_, [this](Eigen::Index i) {
    const double* lane = state_.data() + 2 * group * (i / group) + i % group;
    return std::complex<double>(lane[0], lane[group]);
  });
}

bool ModalRecursion::has_finite_state() const {
  return std::all_of(state_.begin(), state_.end(), [](double x) { return std::isfinite(x); });
}

void ModalRecursion::run(const Eigen::Ref<const Eigen::MatrixXd>& input,
                         Eigen::Ref<Eigen::MatrixXd> output, LaneWidth width) {
  const Eigen::Index groups = (modes_ + group - 1) / group;
  const Eigen::Index stride = 2 * group * (1 + inputs_ + outputs_);
  auto advance_group = advance_two;
#ifdef BORESIGHT_FOUR_LANES
  if (width == LaneWidth::four) advance_group = advance_four;
#endif
  for (Eigen::Index start = 0; start < input.rows(); start += block) {
    const Eigen::Index samples = std::min(block, input.rows() - start);
    for (Eigen::Index g = 0; g < groups; ++g) {
      advance_group({coefficients_.data() + stride * g, state_.data() + 2 * group * g,
                     partial_.data(), input.data() + start, input.outerStride(), inputs_, outputs_,
                     samples, g == 0});
    }
    flush(state_.data(), 2 * group * groups);
    for (Eigen::Index r = 0; r < outputs_; ++r) {
      double* y = output.data() + r * output.outerStride() + start;
      const double* sums = partial_.data() + group * block * r;
      for (Eigen::Index k = 0; k < samples; ++k, sums += group) {
        y[k] = ((sums[0] + sums[4]) + (sums[2] + sums[6])) +
               ((sums[1] + sums[5]) + (sums[3] + sums[7]));
      }
      for (Eigen::Index j = 0; j < inputs_; ++j) {
        const double gain = feedthrough_(r, j);
        if (gain == 0.0) continue;
        const double* u = input.data() + j * input.outerStride() + start;
        for (Eigen::Index k = 0; k < samples; ++k) y[k] += gain * u[k];
      }
    }
  }
}

}  // namespace boresight::plant
