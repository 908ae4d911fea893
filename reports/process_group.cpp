#include "reports/process_group.hpp"

#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace cbc3d::reports {
namespace {
namespace fs = std::filesystem;

/// The group of a process, from /proc/PID/stat: the third field after the command name, which is in
/// parentheses and may itself hold blanks and parentheses. -1 when the process is gone.
pid_t group_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string line;
  std::getline(file, line);
  const std::size_t name_end = line.rfind(')');
  if (name_end == std::string::npos) {
    return -1;
  }
  std::istringstream fields(line.substr(name_end + 1));
  std::string state;
  pid_t parent = -1;
  pid_t group = -1;
  fields >> state >> parent >> group;
  return group;
}

std::vector<pid_t> members_of(pid_t group) {
  std::vector<pid_t> members;
  std::error_code error;
  for (fs::directory_iterator entry("/proc", error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    pid_t process = 0;
    const auto parsed = std::from_chars(name.data(), name.data() + name.size(), process);
    if (parsed.ptr == name.data() + name.size() && group_of(process) == group) {
      members.push_back(process);
    }
  }
  return members;
}

std::int64_t resident_bytes(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/statm");
  std::int64_t virtual_pages = 0;
  std::int64_t resident_pages = 0;
  if (!(file >> virtual_pages >> resident_pages)) {
    return 0;
  }
  return resident_pages * static_cast<std::int64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

std::int64_t GroupMemory::sample() {
  constexpr int kCallsPerScan = 5;
  if (calls_++ % kCallsPerScan == 0) {
    members_ = members_of(group_);
  }
  std::int64_t sum = 0;
  for (const pid_t process : members_) {
    sum += resident_bytes(process);
  }
  return sum;
}

}  // namespace cbc3d::reports
