#include "mesher/core/runtime.hpp"

#include <fcntl.h>
#include <itkMultiThreaderBase.h>
#include <malloc.h>
#include <omp.h>
#include <sys/resource.h>
#include <unistd.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <cstdlib>

namespace cbc3d {

int set_thread_count(int threads) {
  const int count = threads > 0 ? threads : std::max(1, omp_get_num_procs());
  omp_set_num_threads(count);
  itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(static_cast<itk::ThreadIdType>(count));
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(static_cast<itk::ThreadIdType>(count));
  vtkSMPTools::SetBackend("Sequential");  // VTK is used for files alone
  return count;
}

namespace {
rusage self_usage() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage;
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}
}  // namespace

double process_cpu_seconds() {
  const rusage usage = self_usage();
  return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

double process_system_cpu_seconds() {
  return seconds_of(self_usage().ru_stime);
}

std::int64_t process_peak_rss_bytes() {
  return static_cast<std::int64_t>(self_usage().ru_maxrss) * 1024;
}

bool choose_sleeping_waits() {
  constexpr const char* kTurns = "1000";  // about 20 us, as long as it takes to wake a thread
  return std::getenv("OMP_WAIT_POLICY") == nullptr && std::getenv("GOMP_SPINCOUNT") == nullptr &&
         ::setenv("OMP_WAIT_POLICY", "passive", 1) == 0 && ::setenv("GOMP_SPINCOUNT", kTurns, 1) == 0;
}

void let_waiting_threads_sleep(char** argv) {
  if (choose_sleeping_waits()) {
    ::execv("/proc/self/exe", argv);
  }
}

void open_standard_streams() {
  constexpr int kStreams = 3;
  int opened = ::open("/dev/null", O_RDWR);
  while (opened >= 0 && opened < kStreams) {
    opened = ::open("/dev/null", O_RDWR);
  }
  if (opened >= kStreams) {
    ::close(opened);
  }
}

void keep_freed_memory() {
  constexpr int kLargestKept = 32 << 20;  // glibc accepts no more; larger blocks are returned at once
  ::mallopt(M_MMAP_THRESHOLD, kLargestKept);
  ::mallopt(M_TRIM_THRESHOLD, 8 * kLargestKept);
}

}  // namespace cbc3d
