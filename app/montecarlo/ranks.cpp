#include <boresight/app/montecarlo/ranks.hpp>

#ifdef BORESIGHT_MPI

#include <cstdlib>
#include <limits>

#include <fmt/format.h>
#include <mpi.h>

#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

// Set by the starters of Open MPI, MPICH and Slurm. Without a starter MPI is left alone: it is slow
// to begin, and warns about things that a program on its own need not care for.
bool started_by_mpi() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"}) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing changes the environment
    if (std::getenv(name) != nullptr) return true;
  }
  return false;
}

int length_of(const std::string& bytes) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw InvalidInput(fmt::format("MPI: expected messages below 2 GB, found {}", bytes.size()));
  }
  return static_cast<int>(bytes.size());
}

}  // namespace

struct Ranks::World {
  int rank = 0, size = 1;
  bool running = false;
};

Ranks::Ranks() : world_(std::make_unique<World>()) {
  if (!started_by_mpi()) return;
  int provided = 0;
  // An error of MPI ends all ranks: its own default.
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  world_->running = true;
  MPI_Comm_rank(MPI_COMM_WORLD, &world_->rank);
  MPI_Comm_size(MPI_COMM_WORLD, &world_->size);
}

Ranks::~Ranks() {
  if (world_->running) MPI_Finalize();
}

std::size_t Ranks::rank() const {
  return static_cast<std::size_t>(world_->rank);
}

std::size_t Ranks::size() const {
  return static_cast<std::size_t>(world_->size);
}

std::string Ranks::broadcast(const std::string& bytes) {
  if (world_->size == 1) return bytes;
  int length = length_of(bytes);
  MPI_Bcast(&length, 1, MPI_INT, 0, MPI_COMM_WORLD);
  std::string received =
      world_->rank == 0 ? bytes : std::string(static_cast<std::size_t>(length), '\0');
  MPI_Bcast(received.data(), length, MPI_CHAR, 0, MPI_COMM_WORLD);
  return received;
}

std::vector<std::string> Ranks::gather(const std::string& bytes) {
  if (world_->size == 1) return {bytes};
  const int length = length_of(bytes);
  std::vector<int> lengths(size()), places(size());
  MPI_Gather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
  std::string all;
  if (first()) {
    std::size_t total = 0;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      places[i] = static_cast<int>(total);
      total += static_cast<std::size_t>(lengths[i]);
    }
    all.resize(total);
    length_of(all);
  }
  MPI_Gatherv(bytes.data(), length, MPI_CHAR, all.data(), lengths.data(), places.data(), MPI_CHAR,
              0, MPI_COMM_WORLD);
  std::vector<std::string> parts;
  for (std::size_t i = 0; first() && i < lengths.size(); ++i) {
    parts.push_back(
        all.substr(static_cast<std::size_t>(places[i]), static_cast<std::size_t>(lengths[i])));
  }
  return parts;
}

bool Ranks::any(bool yes) {
  if (world_->size == 1) return yes;
  const int mine = yes ? 1 : 0;
  int all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return all != 0;
}

bool built_with_mpi() {
  return true;
}

}  // namespace boresight::app

#else

namespace boresight::app {

struct Ranks::World {};

Ranks::Ranks() = default;
Ranks::~Ranks() = default;

// Not static: with MPI they ask the world.
// NOLINTBEGIN(readability-convert-member-functions-to-static)
std::size_t Ranks::rank() const {
  return 0;
}

std::size_t Ranks::size() const {
  return 1;
}

std::string Ranks::broadcast(const std::string& bytes) {
  return bytes;
}

std::vector<std::string> Ranks::gather(const std::string& bytes) {
  return {bytes};
}

bool Ranks::any(bool yes) {
  return yes;
}
// NOLINTEND(readability-convert-member-functions-to-static)

bool built_with_mpi() {
  return false;
}

}  // namespace boresight::app

#endif
