// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "model/resources.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace job_memory_limit_test {

// Simulates files of the kernel in a directory that replaces the root.
class JobMemoryLimit : public ::testing::Test {
 protected:
  void own_cgroups(const std::string& lines) { write("proc/self/cgroup", lines); }
  void limit(const std::string& file, const std::string& value) {
    write("sys/fs/cgroup/" + file, value + "\n");
  }
  std::optional<std::uint64_t> limit_in_bytes() const {
    return job_memory_limit(directory_.path(), [this](const std::string& name) {
      const auto variable = environment_.find(name);
      return variable == environment_.end() ? nullptr : variable->second.c_str();
    });
  }

  std::map<std::string, std::string> environment_;

 private:
  void write(const std::string& file, const std::string& content) {
    std::filesystem::create_directories((directory_.path() / file).parent_path());
    directory_.write(file, content);
  }

  TemporaryDirectory directory_;
};

TEST_F(JobMemoryLimit, ReturnsNulloptWithoutCgroups) {
  EXPECT_EQ(limit_in_bytes(), std::nullopt);
  own_cgroups("0::/\n");
  EXPECT_EQ(limit_in_bytes(), std::nullopt);
}

// A container sees its own cgroup as the root.
TEST_F(JobMemoryLimit, ReturnsTheLimitOfTheContainer) {
  own_cgroups("0::/\n");
  limit("memory.max", "512000000");
  EXPECT_EQ(limit_in_bytes(), 512000000u);
}

TEST_F(JobMemoryLimit, ReturnsTheLeastLimitOfAllEnclosingCgroups) {
  own_cgroups("0::/slice/job/step\n");
  limit("slice/memory.max", "max");
  limit("slice/job/memory.max", "3000");
  limit("slice/job/step/memory.max", "4000");
  EXPECT_EQ(limit_in_bytes(), 3000u);
  limit("slice/memory.high", "2000");
  EXPECT_EQ(limit_in_bytes(), 2000u);
  limit("slice/other/memory.max", "1");
  EXPECT_EQ(limit_in_bytes(), 2000u);
}

TEST_F(JobMemoryLimit, ReadsCgroupsOfVersionOne) {
  own_cgroups("5:cpu,cpuacct:/job\n4:memory:/slurm/job\n1:name=systemd:/x\n0::/\n");
  limit("memory/memory.limit_in_bytes", "9223372036854771712");
  limit("cpu,cpuacct/job/memory.limit_in_bytes", "1");
  EXPECT_EQ(limit_in_bytes(), std::nullopt);
  limit("memory/slurm/job/memory.limit_in_bytes", "7000");
  EXPECT_EQ(limit_in_bytes(), 7000u);
}

// A container without its own cgroup namespace reads the path on the host, which does not exist
// inside the container.
TEST_F(JobMemoryLimit, FallsBackToTheRootForAPathOfTheHost) {
  own_cgroups("4:memory:/docker/0123\n");
  limit("memory/memory.limit_in_bytes", "8000");
  EXPECT_EQ(limit_in_bytes(), 8000u);
  own_cgroups("0::/../outside\n");
  limit("memory.max", "6000");
  limit("outside/memory.max", "1");
  EXPECT_EQ(limit_in_bytes(), 6000u);
}

constexpr std::uint64_t kMegabyte = 1 << 20;

TEST_F(JobMemoryLimit, ReturnsTheMemoryOfTheSlurmJob) {
  environment_["SLURM_MEM_PER_NODE"] = "16384";
  EXPECT_EQ(limit_in_bytes(), 16384 * kMegabyte);
  environment_["SLURM_MEM_PER_NODE"] = "0";  // means all memory of the node
  EXPECT_EQ(limit_in_bytes(), std::nullopt);
  environment_.clear();
  environment_["SLURM_MEM_PER_CPU"] = "500";
  EXPECT_EQ(limit_in_bytes(), std::nullopt);
  environment_["SLURM_CPUS_ON_NODE"] = "8";
  EXPECT_EQ(limit_in_bytes(), 4000 * kMegabyte);
  environment_["SLURM_MEM_PER_CPU"] = "much";
  EXPECT_EQ(limit_in_bytes(), std::nullopt);
}

TEST_F(JobMemoryLimit, ReturnsTheLeastOfSlurmAndCgroups) {
  environment_["SLURM_MEM_PER_NODE"] = "1000";
  own_cgroups("0::/job\n");
  limit("job/memory.max", "512000000");
  EXPECT_EQ(limit_in_bytes(), 512000000u);
  limit("job/memory.max", "2000000000");
  EXPECT_EQ(limit_in_bytes(), 1000 * kMegabyte);
}

TEST_F(JobMemoryLimit, IgnoresInvalidFiles) {
  own_cgroups("\n:\n::\nmemory\n0::/\n");
  limit("memory.max", "much");
  EXPECT_EQ(limit_in_bytes(), std::nullopt);
}

}  // namespace job_memory_limit_test
}  // namespace grove::detail
