// SPDX-License-Identifier: MIT
#include "mpi/mpi_session.h"

#include <mpi.h>

#include <cstdlib>
#include <numeric>
#include <stdexcept>

#include "mpi/mpi_shared_memory.h"
#include "mpi/mpi_transport.h"

namespace grove::detail {

MpiSession::MpiSession(int& argc, char**& argv) : has_mpi_(true) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  if (provided < MPI_THREAD_FUNNELED)
    throw std::runtime_error("this MPI library does not support processes with threads");
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
}

MpiSession::~MpiSession() {
  if (has_mpi_) MPI_Finalize();
}

std::vector<std::string> MpiSession::gather(const std::string& mine) const {
  if (!has_mpi_) return {mine};
  const auto ranks = static_cast<std::size_t>(ranks_);
  const int length = static_cast<int>(mine.size());
  std::vector<int> lengths(ranks);
  MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, MPI_COMM_WORLD);
  std::vector<int> begins(ranks);
  std::exclusive_scan(lengths.begin(), lengths.end(), begins.begin(), 0);
  std::string all(static_cast<std::size_t>(begins.back() + lengths.back()), '\0');
  MPI_Allgatherv(mine.data(), length, MPI_CHAR, all.data(), lengths.data(), begins.data(), MPI_CHAR,
                 MPI_COMM_WORLD);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < ranks; ++i)
    texts.push_back(
        all.substr(static_cast<std::size_t>(begins[i]), static_cast<std::size_t>(lengths[i])));
  return texts;
}

std::unique_ptr<Transport> MpiSession::connect(int group) const {
  MPI_Comm communicator = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, group, rank_, &communicator);
  auto transport = std::make_unique<MpiTransport>(communicator);
  MPI_Comm_free(&communicator);
  return transport;
}

std::unique_ptr<SharedMemory> MpiSession::share(std::size_t bytes, std::size_t zero_bytes) const {
  return std::make_unique<MpiSharedMemory>(MPI_COMM_WORLD, bytes, zero_bytes);
}

void MpiSession::abort(int exit_code) const {
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::abort();
}

}  // namespace grove::detail
