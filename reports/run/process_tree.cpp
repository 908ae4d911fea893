#include "reports/run/process_tree.hpp"

#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

namespace cbc3d::reports {
namespace {
namespace fs = std::filesystem;

/// The parent of a process, from /proc/PID/stat: the second field after the command name, which is in
/// parentheses and may itself hold blanks and parentheses. -1 when the process is gone.
pid_t parent_of(pid_t process) {
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
  fields >> state >> parent;
  return parent;
}

std::multimap<pid_t, pid_t> children_by_parent() {
  std::multimap<pid_t, pid_t> children;
  std::error_code error;
  for (fs::directory_iterator entry("/proc", error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    pid_t process = 0;
    const auto parsed = std::from_chars(name.data(), name.data() + name.size(), process);
    if (parsed.ptr == name.data() + name.size()) {
      children.emplace(parent_of(process), process);
    }
  }
  return children;
}

std::vector<pid_t> descendants_of(pid_t root) {
  const std::multimap<pid_t, pid_t> children = children_by_parent();
  std::vector<pid_t> found{root};
  for (std::size_t next = 0; next < found.size(); ++next) {
    const auto [first, last] = children.equal_range(found[next]);
    for (auto child = first; child != last; ++child) {
      found.push_back(child->second);
    }
  }
  found.erase(found.begin());
  return found;
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

std::int64_t TreeMemory::sample() {
  constexpr int kCallsPerScan = 5;
  if (calls_++ % kCallsPerScan == 0) {
    members_ = descendants_of(root_);
  }
  std::int64_t sum = 0;
  for (const pid_t process : members_) {
    sum += resident_bytes(process);
  }
  return sum;
}

}  // namespace cbc3d::reports
