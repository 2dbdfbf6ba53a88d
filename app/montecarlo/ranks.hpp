#pragma once

#include <memory>
#include <string>
#include <vector>

namespace boresight::app {

/// The copies of the program that MPI started together, or this one alone: where the program was
/// built without MPI (CMake's BORESIGHT_MPI), and where no mpirun started it. Every function is
/// called by all ranks, in the same order, from the thread that made the object.
class Ranks {
 public:
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  Ranks(Ranks&&) = delete;
  Ranks& operator=(Ranks&&) = delete;

  std::size_t rank() const;
  std::size_t size() const;
  bool first() const { return rank() == 0; }
  /// What rank 0 has, on every rank.
  std::string broadcast(const std::string& bytes);
  /// What every rank has, by rank, on rank 0; nothing on the others.
  std::vector<std::string> gather(const std::string& bytes);
  /// True on every rank if `yes` is true on any rank.
  bool any(bool yes);

 private:
  struct World;
  std::unique_ptr<World> world_;
};

/// Whether this program can be split over ranks at all.
bool built_with_mpi();

}  // namespace boresight::app
