// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "model/resources.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace memory_granted_test {

// Files as the kernel shows them, in a folder that stands for the root.
class MemoryGranted : public ::testing::Test {
 protected:
  void own_groups(const std::string& lines) { write("proc/self/cgroup", lines); }
  void limit(const std::string& file, const std::string& value) {
    write("sys/fs/cgroup/" + file, value + "\n");
  }
  std::optional<std::uint64_t> granted() const {
    return memory_granted(directory_.path(), [this](const std::string& name) {
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

TEST_F(MemoryGranted, IsNoneWithoutGroups) {
  EXPECT_EQ(granted(), std::nullopt);
  own_groups("0::/\n");
  EXPECT_EQ(granted(), std::nullopt);
}

// A container sees its own group as the root.
TEST_F(MemoryGranted, IsThatOfAContainer) {
  own_groups("0::/\n");
  limit("memory.max", "512000000");
  EXPECT_EQ(granted(), 512000000u);
}

TEST_F(MemoryGranted, IsTheLeastOfAllGroupsAround) {
  own_groups("0::/slice/job/step\n");
  limit("slice/memory.max", "max");
  limit("slice/job/memory.max", "3000");
  limit("slice/job/step/memory.max", "4000");
  EXPECT_EQ(granted(), 3000u);
  limit("slice/memory.high", "2000");
  EXPECT_EQ(granted(), 2000u);
  limit("slice/other/memory.max", "1");
  EXPECT_EQ(granted(), 2000u);
}

TEST_F(MemoryGranted, KnowsVersionOne) {
  own_groups("5:cpu,cpuacct:/job\n4:memory:/slurm/job\n1:name=systemd:/x\n0::/\n");
  limit("memory/memory.limit_in_bytes", "9223372036854771712");
  limit("cpu,cpuacct/job/memory.limit_in_bytes", "1");
  EXPECT_EQ(granted(), std::nullopt);
  limit("memory/slurm/job/memory.limit_in_bytes", "7000");
  EXPECT_EQ(granted(), 7000u);
}

// Without a name space of its own a container sees the host's path, which is not there.
TEST_F(MemoryGranted, IsFoundUnderAPathOfTheHost) {
  own_groups("4:memory:/docker/0123\n");
  limit("memory/memory.limit_in_bytes", "8000");
  EXPECT_EQ(granted(), 8000u);
  own_groups("0::/../outside\n");
  limit("memory.max", "6000");
  limit("outside/memory.max", "1");
  EXPECT_EQ(granted(), 6000u);
}

constexpr std::uint64_t kMegabyte = 1 << 20;

TEST_F(MemoryGranted, IsThatOfASlurmJob) {
  environment_["SLURM_MEM_PER_NODE"] = "16384";
  EXPECT_EQ(granted(), 16384 * kMegabyte);
  environment_["SLURM_MEM_PER_NODE"] = "0";  // all of it
  EXPECT_EQ(granted(), std::nullopt);
  environment_.clear();
  environment_["SLURM_MEM_PER_CPU"] = "500";
  EXPECT_EQ(granted(), std::nullopt);
  environment_["SLURM_CPUS_ON_NODE"] = "8";
  EXPECT_EQ(granted(), 4000 * kMegabyte);
  environment_["SLURM_MEM_PER_CPU"] = "much";
  EXPECT_EQ(granted(), std::nullopt);
}

TEST_F(MemoryGranted, IsTheLeastOfSlurmAndGroups) {
  environment_["SLURM_MEM_PER_NODE"] = "1000";
  own_groups("0::/job\n");
  limit("job/memory.max", "512000000");
  EXPECT_EQ(granted(), 512000000u);
  limit("job/memory.max", "2000000000");
  EXPECT_EQ(granted(), 1000 * kMegabyte);
}

TEST_F(MemoryGranted, IgnoresWhatItDoesNotUnderstand) {
  own_groups("\n:\n::\nmemory\n0::/\n");
  limit("memory.max", "much");
  EXPECT_EQ(granted(), std::nullopt);
}

}  // namespace memory_granted_test
}  // namespace grove::detail
