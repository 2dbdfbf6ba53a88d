// Writes the peers' antenna family as plain text, one matrix a file, so that every program that is
// compared works on the same numbers: write_systems FOLDER MODES...
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <string>

#include "../../tests/peer_family.hpp"
#include "../../tests/zero_order_hold.hpp"

namespace {

using boresight::plant::StateSpace;

void write(const std::filesystem::path& path, const Eigen::MatrixXd& matrix) {
  std::ofstream file(path);
  file.exceptions(std::ios::failbit | std::ios::badbit);
  file << std::setprecision(17);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) file << matrix(i, j) << ' ';
    file << '\n';
  }
}

void write(const std::filesystem::path& folder, const std::string& name, const StateSpace& system) {
  write(folder / (name + "_a"), system.a);
  write(folder / (name + "_b"), system.b);
  write(folder / (name + "_c"), system.c);
  write(folder / (name + "_d"), system.d);
}

}  // namespace

int main(int count, char** arguments) try {
  using namespace boresight::reference;
  const std::filesystem::path folder = arguments[1];
  std::filesystem::create_directories(folder);
  write(folder / "frequencies", peer_frequencies().matrix());
  write(folder / "noise", peer_noise(600'000));
  for (int i = 2; i < count; ++i) {
    const auto modes = folder / arguments[i];
    std::filesystem::create_directories(modes);
    const StateSpace closed = peer_closed_loop(std::stoi(arguments[i]));
    write(modes, "rms", channel(closed, "n", "y"));
    write(modes, "wind", channel(closed, "t", "y"));
    write(modes, "sensitivity", channel(closed, "d", "u"));
    write(modes, "regulator", channel(closed, "d", "y"));
    const StateSpace open = peer_closed_loop(std::stoi(arguments[i]), {0.0, 0.0, 0.0, 0.0});
    write(modes, "without_gains_wind", channel(open, "n", "y"));
    write(modes, "without_gains_command", channel(open, "d", "u"));
    write(modes, "loop", peer_open_loop(std::stoi(arguments[i])));
    if (closed.a.rows() <= 30) {
      write(modes, "sampled", zero_order_hold(channel(closed, "d", "y"), peer_regulator_period));
    }
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "write_systems: %s\n", error.what());
  return 1;
}
