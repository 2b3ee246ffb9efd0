#include "pair_exchange.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace suffuse {
namespace {

using micromechanics::GrainPair;
static_assert(sizeof(GrainPair) == 2 * sizeof(std::int64_t));

std::size_t owner(const GrainPair& pair, std::size_t ranks) {
  // Multiplicative hashing with two large odd constants; the high bits are the well-mixed ones.
  const std::uint64_t mixed = static_cast<std::uint64_t>(pair.low) * 0x9E3779B97F4A7C15ULL ^
                              static_cast<std::uint64_t>(pair.high) * 0xC2B2AE3D27D4EB4FULL;
  return static_cast<std::size_t>((mixed >> 32) % ranks);
}

std::vector<int> offsets(const std::vector<int>& counts) {
  std::vector<int> result(counts.size(), 0);
  std::partial_sum(counts.begin(), counts.end() - 1, result.begin() + 1);
  return result;
}

}  // namespace

std::vector<GrainPair> share_out_by_hash(const std::vector<GrainPair>& pairs, MPI_Comm communicator) {
  int size = 1;
  MPI_Comm_size(communicator, &size);
  const auto ranks = static_cast<std::size_t>(size);
  std::vector<int> send_counts(ranks, 0), receive_counts(ranks, 0);  // in int64, two a pair
  for (const GrainPair& pair : pairs) send_counts[owner(pair, ranks)] += 2;
  MPI_Alltoall(send_counts.data(), 1, MPI_INT, receive_counts.data(), 1, MPI_INT, communicator);
  const std::vector<int> send_offsets = offsets(send_counts), receive_offsets = offsets(receive_counts);
  std::vector<GrainPair> outgoing(pairs.size());
  std::vector<int> next = send_offsets;
  for (const GrainPair& pair : pairs) {
    int& position = next[owner(pair, ranks)];
    outgoing[static_cast<std::size_t>(position / 2)] = pair;
    position += 2;
  }
  std::vector<GrainPair> incoming(
      static_cast<std::size_t>((receive_offsets.back() + receive_counts.back()) / 2));
  MPI_Alltoallv(outgoing.data(), send_counts.data(), send_offsets.data(), MPI_INT64_T, incoming.data(),
                receive_counts.data(), receive_offsets.data(), MPI_INT64_T, communicator);
  std::sort(incoming.begin(), incoming.end());
  return incoming;
}

std::vector<GrainPair> gather_pairs(const std::vector<GrainPair>& pairs, MPI_Comm communicator) {
  int size = 1, rank = 0;
  MPI_Comm_size(communicator, &size);
  MPI_Comm_rank(communicator, &rank);
  const int mine = static_cast<int>(2 * pairs.size());
  std::vector<int> counts(static_cast<std::size_t>(size), 0);
  MPI_Gather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, communicator);
  const std::vector<int> displacements = offsets(counts);
  std::vector<GrainPair> all;
  if (rank == 0) all.resize(static_cast<std::size_t>((displacements.back() + counts.back()) / 2));
  MPI_Gatherv(pairs.data(), mine, MPI_INT64_T, all.data(), counts.data(), displacements.data(), MPI_INT64_T,
              0, communicator);
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace suffuse
