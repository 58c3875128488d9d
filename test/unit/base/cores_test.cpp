#include "shelfbeam/base/cores.hpp"

#include <sched.h>

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

TEST(Cores, HaveTheQuotaOfAContainer) {
  const TempFolder system;
  EXPECT_EQ(detail::core_quota(system.path()), unlimited);
  system.write("proc/self/cgroup", "0::/\n");
  EXPECT_EQ(detail::core_quota(system.path()), unlimited);
  system.write("sys/fs/cgroup/cpu.max", "max 100000\n");
  EXPECT_EQ(detail::core_quota(system.path()), unlimited);
  system.write("sys/fs/cgroup/cpu.max", "150000 100000\n");
  EXPECT_EQ(detail::core_quota(system.path()), 1.5);
}

TEST(Cores, HaveTheLowestQuotaOfTheGroups) {
  const TempFolder system;
  system.write("proc/self/cgroup", "0::/batch/job\n");
  system.write("sys/fs/cgroup/batch/job/cpu.max", "400000 100000\n");
  system.write("sys/fs/cgroup/batch/cpu.max", "50000 25000\n");
  system.write("sys/fs/cgroup/other/cpu.max", "100000 100000\n");
  EXPECT_EQ(detail::core_quota(system.path()), 2);
}

TEST(Cores, HaveTheQuotaOfVersion1) {
  const TempFolder system;
  system.write("proc/self/cgroup", "5:cpu,cpuacct:/docker/ab\n4:cpuset:/other\n0::/\n");
  system.write("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "-1\n");
  system.write("sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(detail::core_quota(system.path()), unlimited);
  system.write("sys/fs/cgroup/cpu/docker/ab/cpu.cfs_quota_us", "300000\n");
  system.write("sys/fs/cgroup/cpu/docker/ab/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(detail::core_quota(system.path()), 3);
}

// "taskset", and the cores of a batch system.
TEST(Cores, AreThoseOnWhichTheProcessMayRun) {
  cpu_set_t before, one;
  ASSERT_EQ(::sched_getaffinity(0, sizeof before, &before), 0);
  EXPECT_GE(core_count(), 1U);
  EXPECT_LE(core_count(), static_cast<unsigned>(CPU_COUNT(&before)));
  CPU_ZERO(&one);
  for (int cpu = 0; CPU_COUNT(&one) == 0; ++cpu)
    if (CPU_ISSET(cpu, &before)) CPU_SET(cpu, &one);
  ASSERT_EQ(::sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(core_count(), 1U);
  EXPECT_EQ(::sched_setaffinity(0, sizeof before, &before), 0);
}

}  // namespace
}  // namespace shelfbeam::test
