#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "engine/base/error.h"
#include "engine/run/context.h"
#include "tools/batch/find_items.h"
#include "tools/batch/run_items.h"
#include "tools/batch/summary.h"
#include "tools/commands.h"
#include "tools/exit_code.h"
#include "tools/forecast.h"
#include "tools/interrupt.h"
#include "tools/usual_flags.h"

namespace intarsia::tools {
namespace {

namespace fs = std::filesystem;

struct BatchFlags {
  std::string input, output, shard;
  std::uint64_t memory = 0;  // bytes; 0: what is free
  int jobs = 0, threads = 0;
  bool resume = false, quiet = false;
  std::vector<std::string> run_options;
};

void make_folder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw Error(ErrorCode::write_failed, folder.string() + ": cannot be created: " + failed.message());
}

// What is still to do. A record counts if it is of the same file and options and its folder is there; what failed is
// tried again.
std::vector<BatchItem> unfinished(const std::vector<BatchItem>& items, const BatchPlan& plan,
                                  const std::string& options) {
  std::vector<BatchItem> out;
  for (const BatchItem& item : items) {
    const ItemRecord record = read_record(plan.results, item.name);
    std::error_code unknown;
    if (record.has_layout() && record.options == options && record.state == state_of(item.input) &&
        fs::exists(plan.results / item.name / "report.json", unknown))
      continue;
    out.push_back(item);
  }
  return out;
}

void print_item(const BatchItem& item, const ItemRecord& r, std::size_t at, std::size_t of) {
  if (r.has_layout())
    fmt::print("[{}/{}] {}: {} triangles, {} patches, {:.1f} s\n", at, of, item.name, r.triangles, r.patches,
               r.seconds);
  else
    fmt::print("[{}/{}] {}: FAILED ({}): {}\n", at, of, item.name, r.exit, r.message);
  std::fflush(stdout);
}

int batch(const BatchFlags& flags) {
  const std::atomic<bool>& stop = interrupt_flag();
  const std::vector<BatchItem> all = find_items(flags.input);
  const std::vector<BatchItem> mine = items_of_shard(all, shard_of(flags.shard));
  BatchPlan plan;
  plan.program = fs::read_symlink("/proc/self/exe");
  plan.results = fs::absolute(flags.output).lexically_normal();
  plan.run_options = flags.run_options;
  RunSettings settings;
  settings.threads = flags.threads;
  plan.threads = RunContext(settings).threads();
  plan.jobs = flags.jobs > 0 ? std::min(flags.jobs, plan.threads) : plan.threads;
  plan.memory = flags.memory > 0 ? flags.memory : available_memory() / 10 * 8;
  make_folder(plan.results / ".batch");
  std::string options;
  for (const std::string& o : flags.run_options) options += (options.empty() ? "" : " ") + o;
  const std::vector<BatchItem> todo = flags.resume ? unfinished(mine, plan, options) : mine;
  if (!flags.quiet && todo.size() < mine.size())
    fmt::print("{} of {} are done already\n", mine.size() - todo.size(), mine.size());
  std::size_t ended = 0;
  const BatchCount count = run_items(
      todo, plan,
      [](const fs::path& input) {
        const std::uint64_t n = vertices_in(input);
        return kRunCost(n, 2 * n);
      },
      [&](const BatchItem& item, const ItemRecord& record) {
        ++ended;
        if (!flags.quiet) print_item(item, record, ended, todo.size());
      },
      stop);
  if (count.wrong_options) {
    spdlog::error("the options after -- are refused by intarsia run; nothing else was begun");
    return kExitUsage;
  }
  const SummaryCount sum = write_summary(plan.results, all);
  if (!flags.quiet)
    fmt::print(
        "{} meshes: {} done, {} with warnings, {} failed, {} not run\nwritten to {}: summary.csv summary.json "
        "summary.html failed.txt\n",
        all.size(), sum.done, sum.degraded, sum.failed, sum.missing, (plan.results / "").string());
  if (stop) {
    spdlog::error("interrupted; --resume goes on from here");
    return kExitInterrupted;
  }
  return count.failed > 0 ? kExitBatch : kExitDone;
}

}  // namespace

void add_batch_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<BatchFlags>();
  CLI::App* command = app.add_subcommand("batch", "layouts of many meshes; one that fails stops no other");
  command->add_option("input", flags->input, "folder of meshes, or a text file with one mesh a line")->required();
  command->add_option("run-options", flags->run_options, "after --: options of intarsia run, for every mesh");
  command->add_option("-o,--output", flags->output, "folder with a folder for each mesh and the summary")->required();
  command->add_option("--jobs", flags->jobs, "most meshes side by side; 0 = as many as threads")
      ->check(whole_number(0, kMostThreads));
  add_threads_flag(*command, flags->threads, "threads in all");
  add_memory_flag(*command, flags->memory,
                  "of all meshes at a time: bytes, or with K M G (of 1024); default: 80 % of what is free");
  command->add_option("--shard", flags->shard,
                      "i/n: every n-th mesh from the i-th; default: Slurm's array task, or all");
  command->add_flag("--resume", flags->resume, "leave out what is done: same file, same options");
  add_quiet_flag(*command, flags->quiet);
  command->callback([flags, &exit_code] { exit_code = batch(*flags); });
}

}  // namespace intarsia::tools
