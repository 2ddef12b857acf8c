#include "tests/faults/fault_injector.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <thread>

#include "core/io/files/file_bytes.h"
#include "core/io/files/leftovers.h"

namespace flytri::testing {
namespace {

namespace fs = std::filesystem;

/// The question mark: not every processor has every call.
constexpr const char* kCalls =
    "write,pwrite64,writev,fsync,fdatasync,?rename,renameat,renameat2,?open,openat,?link,linkat,"
    "ftruncate,fallocate,?unlink,unlinkat,?mkdir,mkdirat,mmap,close";

/// What the child tells its parent, in memory that both see.
struct Report {
  std::array<char, 2000> message;
};

enum ChildCode { kWorkDone = 0, kWorkFailed = 10, kThrew = 11 };

class SharedReport {
 public:
  SharedReport()
      : report_(static_cast<Report*>(::mmap(nullptr, sizeof(Report), PROT_READ | PROT_WRITE,
                                            MAP_SHARED | MAP_ANONYMOUS, -1, 0))) {}
  SharedReport(const SharedReport&) = delete;
  SharedReport& operator=(const SharedReport&) = delete;
  ~SharedReport() { ::munmap(report_, sizeof(Report)); }

  void set(const std::string& message) {
    std::strncpy(report_->message.data(), message.c_str(), report_->message.size() - 1);
  }
  [[nodiscard]] std::string message() const { return report_->message.data(); }

 private:
  Report* report_;
};

int run_in_child(const FaultyWork& work, SharedReport& report) {
  try {
    const Result<void> done = work();
    if (done) return kWorkDone;
    report.set(done.error().message);
    return kWorkFailed;
  } catch (const std::exception& error) {
    report.set(error.what());
    return kThrew;
  }
}

/// Starts the child, which stops at once.
pid_t start_child(const FaultyWork& work, SharedReport& report) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::prctl(PR_SET_PTRACER, PR_SET_PTRACER_ANY);
  ::raise(SIGSTOP);
  ::_exit(run_in_child(work, report));
}

pid_t start_strace(pid_t child, const std::string& log, const std::string& inject) {
  const std::string process = std::to_string(child);
  const std::string trace = std::string("trace=") + kCalls;
  std::vector<std::string> words = {"strace", "-q", "-o", log, "-e", trace, "-p", process};
  if (!inject.empty()) words.insert(words.end(), {"-e", inject});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t strace = ::fork();
  if (strace != 0) return strace;
  const int nowhere = ::open("/dev/null", O_RDWR);
  ::dup2(nowhere, STDERR_FILENO);
  ::execvp("strace", arguments.data());
  ::_exit(127);
}

bool is_traced(pid_t process) {
  std::ifstream status(fmt::format("/proc/{}/status", process));
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("TracerPid:"))
      return line.substr(10).find_first_not_of("\t 0") != line.npos;
  }
  return false;
}

/// Waits until strace watches the child. False: it has ended instead.
bool wait_until_traced(pid_t child, pid_t strace) {
  while (!is_traced(child)) {
    if (::waitpid(strace, nullptr, WNOHANG) == strace) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

/// Runs the work under strace.
RunEnd run_traced(const FaultyWork& work, const std::string& log, const std::string& inject) {
  SharedReport report;
  const pid_t child = start_child(work, report);
  ::waitpid(child, nullptr, WUNTRACED);
  const pid_t strace = start_strace(child, log, inject);
  const bool is_watched = wait_until_traced(child, strace);
  if (!is_watched) ::kill(child, SIGKILL);
  ::kill(child, SIGCONT);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (!is_watched) return {false, false, {}, "strace cannot trace here"};
  ::waitpid(strace, nullptr, 0);
  RunEnd end;
  end.message = report.message();
  end.is_killed = WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
  end.is_done = WIFEXITED(status) && WEXITSTATUS(status) == kWorkDone;
  const bool has_failed = WIFEXITED(status) && WEXITSTATUS(status) == kWorkFailed;
  if (!end.is_killed && !end.is_done && !has_failed) {
    end.trouble = fmt::format("ended with status {:x}: {}", status, end.message);
  }
  return end;
}

int fault_step() {
  const char* const step = std::getenv("FLYTRI_FAULT_STEP");
  return step == nullptr ? 1 : std::max(std::atoi(step), 1);
}

/// What is left of a killed program, but for second names of former files, which stay for a day.
std::vector<std::string> temporary_names(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(".") && !name.starts_with(io::kSecondNamePrefix)) names.push_back(name);
  }
  return names;
}

/// What the next start of the program does.
void remove_all_leftovers(const fs::path& folder) {
  io::remove_leftovers(folder);
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory()) io::remove_leftovers(entry.path());
  }
}

void check_run(const FaultyOperation& operation, const fs::path& folder, const Fault& fault,
               const RunEnd& end) {
  EXPECT_EQ(end.trouble, "");
  if (!end.is_done && !end.is_killed) {
    EXPECT_NE(end.message.find(folder.string()), std::string::npos) << end.message;
  }
  if (end.is_killed || fault.call.starts_with("unlink")) remove_all_leftovers(folder);
  EXPECT_EQ(temporary_names(folder), std::vector<std::string>());
  operation.check(folder, end);
}

std::vector<std::string> effects_of(const std::string& call) {
  if (call == "mmap") return {"error=ENOMEM", "signal=KILL"};
  return {"error=ENOSPC", "error=EIO", "signal=KILL"};
}

}  // namespace

std::string why_no_faults() {
  static const std::string kWhy = [] {
    const TemporaryFolder folder;
    const auto calls = count_calls([&] { return io::write_file(folder / "a", "a"); });
    return calls.count("fsync") > 0 ? "" : "strace is missing, or may not trace here (ptrace)";
  }();
  return kWhy;
}

std::map<std::string, int> count_calls(const FaultyWork& work) {
  const TemporaryFolder folder;
  const std::string log = folder / "log";
  const RunEnd end = run_traced(work, log, {});
  std::map<std::string, int> counts;
  if (!end.is_done) return counts;
  std::ifstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t bracket = line.find('(');
    if (bracket != std::string::npos && bracket > 0 && std::islower(line[0]) != 0) {
      ++counts[line.substr(0, bracket)];
    }
  }
  return counts;
}

RunEnd run_with(const Fault& fault, const FaultyWork& work) {
  return run_traced(work, "/dev/null",
                    fmt::format("inject={}:{}:when={}", fault.call, fault.effect, fault.number));
}

void expect_withstands_faults(const FaultyOperation& operation) {
  std::map<std::string, int> calls;
  {
    const TemporaryFolder folder;
    operation.prepare(folder.path());
    calls = count_calls([&] { return operation.work(folder.path()); });
    ASSERT_FALSE(calls.empty()) << "the work fails without a fault, too";
  }
  int run = 0;
  for (const auto& [call, count] : calls) {
    for (int number = 1; number <= count; ++number) {
      for (const std::string& effect : effects_of(call)) {
        if (run++ % fault_step() != 0) continue;
        SCOPED_TRACE(fmt::format("{} number {} of {}: {}", call, number, count, effect));
        const TemporaryFolder folder;
        operation.prepare(folder.path());
        const Fault fault{call, effect, number};
        const RunEnd end = run_with(fault, [&] { return operation.work(folder.path()); });
        check_run(operation, folder.path(), fault, end);
      }
    }
  }
  ::testing::Test::RecordProperty("faults", run);
  std::printf("%d faults\n", (run + fault_step() - 1) / fault_step());
}

}  // namespace flytri::testing
