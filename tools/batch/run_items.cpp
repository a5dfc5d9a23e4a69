#include "tools/batch/run_items.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "tools/exit_code.h"

namespace intarsia::tools {
namespace {

using Clock = std::chrono::steady_clock;

struct Waiting {
  const BatchItem* item;
  Forecast forecast;
};

struct Running {
  pid_t process;
  const BatchItem* item;
  ItemState state;
  Forecast forecast;
  Clock::time_point begin;
  bool alone;  // has all threads
};

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& w : words) out += (out.empty() ? "" : " ") + w;
  return out;
}

// The last line of a log that says what went wrong.
std::string complaint_in(const std::filesystem::path& log) {
  std::ifstream in(log);
  std::string line, found;
  while (std::getline(in, line)) {
    const std::size_t at = line.find("error: ");
    if (at != std::string::npos)
      found = line.substr(at + 7);
    else if (found.empty() && !line.empty())
      found = line;
  }
  return found;
}

class Batch {
 public:
  Batch(const BatchPlan& plan, const OnItem& on_item, const std::atomic<bool>& stop)
      : plan_(plan), options_(joined(plan.run_options)), on_item_(on_item), stop_(stop) {}

  BatchCount run(std::vector<Waiting> waiting) {
    waiting_ = std::move(waiting);
    while (!waiting_.empty() || !running_.empty()) {
      if (stop_ || count_.wrong_options) {
        for (const Running& r : running_) kill(r.process, SIGINT);
        while (!running_.empty()) collect(true);
        break;
      }
      while (begin_next()) {
      }
      if (!running_.empty()) collect(false);
    }
    count_.left += waiting_.size();
    return count_;
  }

 private:
  bool fits(const Waiting& w) const {
    const bool alone = is_large(w);
    if (alone && !running_.empty()) return false;
    if (static_cast<int>(running_.size()) >= std::min(plan_.jobs, plan_.threads)) return false;
    if (std::any_of(running_.begin(), running_.end(), [](const Running& r) { return r.alone; })) return false;
    std::uint64_t used = 0;
    for (const Running& r : running_) used += r.forecast.peak_memory;
    return plan_.memory == 0 || used + w.forecast.peak_memory <= plan_.memory;
  }
  bool is_large(const Waiting& w) const { return plan_.jobs == 1 || w.forecast.cpu_seconds > plan_.large_seconds; }

  // Begins what can be begun now. Large meshes wait at the front until nothing runs, so they go first and cannot be
  // put off for ever; of small ones the first that fits into the memory goes.
  bool begin_next() {
    for (auto w = waiting_.begin(); w != waiting_.end(); ++w) {
      if (plan_.memory > 0 && w->forecast.peak_memory > plan_.memory) {
        refuse(*w);
        waiting_.erase(w);
        return true;
      }
      if (fits(*w)) {
        begin(*w);
        waiting_.erase(w);
        return true;
      }
      if (is_large(*w)) return false;
    }
    return false;
  }

  void refuse(const Waiting& w) {
    ItemRecord record = fresh_record(state_of(w.item->input));
    record.exit = kExitLimit;
    record.message = "needs about " + std::to_string(w.forecast.peak_memory >> 20) + " MB by forecast, more than the " +
                     std::to_string(plan_.memory >> 20) + " MB of --max-memory";
    finish(*w.item, record);
  }

  ItemRecord fresh_record(const ItemState& state) const {
    ItemRecord record;
    record.state = state, record.options = options_;
    return record;
  }

  void begin(const Waiting& w) {
    const bool alone = is_large(w);
    const int threads = alone ? plan_.threads : std::max(1, plan_.threads / plan_.jobs);
    std::vector<std::string> words{plan_.program.string(),
                                   "run",
                                   w.item->input.string(),
                                   "-o",
                                   (plan_.results / w.item->name).string(),
                                   "-q",
                                   "-t",
                                   std::to_string(threads)};
    words.insert(words.end(), plan_.run_options.begin(), plan_.run_options.end());
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const std::string log = log_file(plan_.results, w.item->name).string();
    const ItemState state = state_of(w.item->input);
    const pid_t child = fork();
    if (child < 0) throw Error(ErrorCode::no_memory, "no process can be started; try fewer --jobs");
    if (child == 0) {
      setpgid(0, 0);  // Ctrl-C goes to the batch, which hands it on
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644),
                null = open("/dev/null", O_RDWR);
      if (out < 0 || null < 0 || dup2(null, 0) < 0 || dup2(null, 1) < 0 || dup2(out, 2) < 0) _exit(kExitWrite);
      execv(argv[0], argv.data());
      _exit(kExitInternal);
    }
    running_.push_back({child, w.item, state, w.forecast, Clock::now(), alone});
  }

  // Waits for one process to end, or for an interrupt. The wait is by polling, because a signal may arrive between a
  // look at the flag and a blocking call.
  void collect(bool stopping) {
    while (true) {
      for (auto r = running_.begin(); r != running_.end(); ++r) {
        int status = 0;
        rusage usage{};
        const pid_t ended = wait4(r->process, &status, WNOHANG, &usage);
        if (ended != r->process) continue;
        const Running done = *r;
        running_.erase(r);
        if (stopping && !(WIFEXITED(status) && WEXITSTATUS(status) != kExitInterrupted))
          ++count_.left;
        else
          note(done, status, usage);
        return;
      }
      if (stop_ && !stopping) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  void note(const Running& done, int status, const rusage& usage) {
    ItemRecord record = fresh_record(done.state);
    record.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (record.exit == kExitUsage) {
      count_.wrong_options = true;
      record.message = complaint_in(log_file(plan_.results, done.item->name));
      on_item_(*done.item, record);
      ++count_.failed;
      return;
    }
    if (record.has_layout()) add_report(plan_.results / done.item->name, record);
    if (record.exit != 0) {
      record.message = complaint_in(log_file(plan_.results, done.item->name));
      if (!WIFEXITED(status)) record.message = "killed by signal " + std::to_string(WTERMSIG(status));
    }
    record.seconds = std::chrono::duration<double>(Clock::now() - done.begin).count();
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    record.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    record.peak_memory = static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
    finish(*done.item, record);
  }

  void finish(const BatchItem& item, const ItemRecord& record) {
    write_record(plan_.results, item.name, record);
    ++(record.exit == 0 ? count_.done : count_.failed);
    on_item_(item, record);
  }

  const BatchPlan& plan_;
  std::string options_;
  const OnItem& on_item_;
  const std::atomic<bool>& stop_;
  std::vector<Waiting> waiting_;
  std::vector<Running> running_;
  BatchCount count_;
};

}  // namespace

BatchCount run_items(const std::vector<BatchItem>& items, const BatchPlan& plan, const ForecastOf& forecast_of,
                     const OnItem& on_item, const std::atomic<bool>& stop) {
  std::vector<Waiting> waiting;
  waiting.reserve(items.size());
  for (const BatchItem& item : items) waiting.push_back({&item, forecast_of(item.input)});
  std::stable_sort(waiting.begin(), waiting.end(),
                   [](const Waiting& a, const Waiting& b) { return a.forecast.cpu_seconds > b.forecast.cpu_seconds; });
  return Batch(plan, on_item, stop).run(std::move(waiting));
}

}  // namespace intarsia::tools
