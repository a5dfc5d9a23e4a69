#include "engine/run/checkpoints.h"

#include <cerrno>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "engine/base/hash.h"
#include "engine/io/artefact_file.h"
#include "engine/io/file_error.h"

namespace intarsia {
namespace {

std::string note_of(const NodeOutcome& outcome) {
  using nlohmann::json;
  json warnings = json::array();
  for (const Warning& w : outcome.warnings) warnings.push_back({w.code, w.message, w.count});
  const json note = {
      {"items", outcome.items}, {"bytes", outcome.bytes}, {"hash", outcome.hash}, {"warnings", warnings}};
  return note.dump(-1, ' ', false, json::error_handler_t::replace);
}

NodeOutcome outcome_of(const std::string& note) {
  const auto json = nlohmann::json::parse(note);
  NodeOutcome outcome{json.at("items"), json.at("bytes"), json.at("hash")};
  for (const auto& w : json.at("warnings")) outcome.warnings.push_back({w.at(0), w.at(1), w.at(2), {}});
  return outcome;
}

}  // namespace

Checkpoints::Checkpoints(const std::filesystem::path& folder, std::uint64_t program) : program_(program) {
  std::error_code error;
  folder_ = std::filesystem::absolute(folder, error);
  if (!error) std::filesystem::create_directory(folder_, error);
  if (error) throw_write_failed(folder, "no folder for checkpoints can be made there", error.value());
  if (!std::filesystem::is_directory(folder_)) throw_write_failed(folder, "is a file; name a folder", 0);
  if (::access(folder_.c_str(), R_OK | W_OK | X_OK) != 0) throw_write_failed(folder, "cannot be written", errno);
}

std::filesystem::path Checkpoints::file_of(const NodeSpec& node) const {
  return folder_ / (node.stage + (node.branch.empty() ? "" : "-" + node.branch) + ".stage");
}

CheckpointPlan::CheckpointPlan(const Checkpoints& checkpoints, const std::vector<NodeSpec>& nodes, RunRecord& record)
    : checkpoints_(checkpoints), nodes_(nodes), record_(record), entry_(nodes.size()) {}

CheckpointPlan::Action CheckpointPlan::begin(const Work& work, Index node) {
  const std::lock_guard lock(mutex_);
  if (!planned_ && nodes_[node].recipe) {
    plan(work);
    planned_ = true;
  }
  return entry_[node].action;
}

void CheckpointPlan::find_key(Index node) {
  const NodeSpec& spec = nodes_[node];
  Entry& entry = entry_[node];
  if (!spec.recipe) return;  // what was read has got its key when it was there
  Hash hash;
  hash.add(checkpoints_.program()), hash.add(*spec.recipe);
  for (const Index before : spec.after) {
    if (!entry_[before].has_key) return;
    hash.add(entry_[before].key);
  }
  entry.key = hash.value();
  entry.has_key = true;
}

// Inputs come before what is made from them.
void CheckpointPlan::plan(const Work& work) {
  const auto count = static_cast<Index>(nodes_.size());
  for (Index i = 0; i < count; ++i) find_key(i);
  std::vector<std::uint8_t> is_input(count, 0), is_wanted(count, 0);
  for (const NodeSpec& spec : nodes_)
    for (const Index before : spec.after) is_input[before] = 1;
  for (Index i = count; i-- > 0;) {
    Entry& entry = entry_[i];
    const bool wanted = is_wanted[i] != 0 || is_input[i] == 0 || (nodes_[i].is_kept && nodes_[i].is_kept());
    if (entry.has_key && nodes_[i].recipe && look_up(work, i, wanted))
      entry.action = wanted ? Action::restore : Action::skip;
    else
      for (const Index before : nodes_[i].after) is_wanted[before] = 1;
  }
}

bool CheckpointPlan::look_up(const Work& work, Index node, bool with_artefact) {
  const std::filesystem::path file = checkpoints_.file_of(nodes_[node]);
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return false;
  bool ours = false;
  try {
    ArtefactReader reader(work, file);
    ours = reader.key() == entry_[node].key;
    if (!ours) return false;
    entry_[node].outcome = outcome_of(reader.note());
    if (!with_artefact) return true;
    nodes_[node].restore(reader);
    reader.finish();
    return true;
  } catch (const Error& e) {
    if (e.code() != ErrorCode::bad_file) throw;
  } catch (const nlohmann::json::exception&) {
  }
  nodes_[node].drop_artefact();
  record_.add(Warning{"checkpoint-damaged",
                      file.string() + " was damaged" + (ours ? "" : " or is no checkpoint") + "; computed again", 1,
                      nodes_[node].stage});
  return false;
}

void CheckpointPlan::end(const Work& work, Index node, const NodeOutcome& outcome, bool exact) {
  const NodeSpec& spec = nodes_[node];
  const std::uint64_t content = spec.content ? spec.content() : 0;
  Entry entry;
  {
    const std::lock_guard lock(mutex_);
    for (const Index before : spec.after) exact = exact && entry_[before].is_exact;
    entry_[node].is_exact = exact;
    if (spec.content) entry_[node].key = content, entry_[node].has_key = true;
    entry = entry_[node];
  }
  if (!spec.recipe || !entry.has_key || !exact) return;
  const std::filesystem::path file = checkpoints_.file_of(spec);
  try {
    ArtefactWriter writer(work, file, entry.key, note_of(outcome));
    spec.store(writer);
    writer.commit();
  } catch (const Error& e) {
    if (e.code() != ErrorCode::write_failed) throw;
    record_.add(Warning{"checkpoint-not-written", std::string("no checkpoint: ") + e.what(), 1, spec.stage});
  }
}

}  // namespace intarsia
