#include "engine/run/record.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "engine/base/hash.h"

namespace intarsia {
namespace {

using Span = std::pair<Real, Real>;

Real union_length(std::vector<Span> spans) {
  std::sort(spans.begin(), spans.end());
  Real length = 0, reached = -1;
  for (const auto& [begin, end] : spans) {
    if (end <= reached) continue;
    length += end - std::max(begin, reached);
    reached = end;
  }
  return length;
}

}  // namespace

void RunRecord::add(NodeRecord node) {
  const std::lock_guard lock(mutex_);
  nodes_.push_back(std::move(node));
}

void RunRecord::add(Warning warning) {
  const std::lock_guard lock(mutex_);
  warnings_.push_back(std::move(warning));
}

void RunRecord::set_failure(std::string stage, std::string code, std::string message) {
  const std::lock_guard lock(mutex_);
  failed_stage_ = std::move(stage), failure_code_ = std::move(code), failure_ = std::move(message);
}

std::vector<NodeRecord> RunRecord::nodes() const {
  const std::lock_guard lock(mutex_);
  std::vector<NodeRecord> sorted(nodes_);
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
  return sorted;
}

std::vector<StageSummary> RunRecord::stages() const {
  std::vector<StageSummary> out;
  std::vector<std::vector<Span>> spans;
  std::vector<std::vector<std::uint64_t>> hashes;
  for (const NodeRecord& node : nodes()) {
    const auto same = [&](const StageSummary& s) { return s.name == node.stage; };
    const auto at = static_cast<std::size_t>(std::find_if(out.begin(), out.end(), same) - out.begin());
    if (at == out.size()) {
      out.emplace_back().name = node.stage;
      spans.emplace_back(), hashes.emplace_back();
    }
    StageSummary& s = out[at];
    s.cpu += node.cpu, s.items += node.items, s.bytes += node.bytes;
    s.restored = s.restored && node.restored;
    s.shortened = s.shortened || node.shortened;
    spans[at].push_back({node.start, node.start + node.wall});
    hashes[at].push_back(node.hash);
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].wall = union_length(spans[i]);
    Hash all;
    all.add(hashes[i]);
    out[i].hash = hashes[i].size() == 1 ? hashes[i].front() : all.value();
  }
  return out;
}

std::vector<Warning> RunRecord::warnings() const {
  const std::vector<StageSummary> order = stages();
  const auto place = [&](const Warning& w) {
    return std::find_if(order.begin(), order.end(), [&](const StageSummary& s) { return s.name == w.stage; }) -
           order.begin();
  };
  const std::lock_guard lock(mutex_);
  std::vector<Warning> sorted(warnings_);
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Warning& a, const Warning& b) {
    return std::pair(place(a), std::tie(a.code, a.message)) < std::pair(place(b), std::tie(b.code, b.message));
  });
  return sorted;
}

nlohmann::json RunRecord::to_json() const {
  using nlohmann::json;
  json list = json::array();
  Real cpu = 0;
  for (const StageSummary& s : stages()) {
    cpu += s.cpu;
    list.push_back({{"name", s.name},
                    {"seconds", s.wall},
                    {"cpu_seconds", s.cpu},
                    {"items", s.items},
                    {"bytes", s.bytes},
                    {"hash", hex_text(s.hash)}});
    if (s.restored) list.back()["from_checkpoint"] = true;
    if (s.shortened) list.back()["shortened"] = true;
  }
  json warned = json::array();
  for (const Warning& w : warnings())
    warned.push_back({{"code", w.code}, {"stage", w.stage}, {"count", w.count}, {"message", w.message}});
  json out = {{"seconds", wall_},
              {"cpu_seconds", cpu},
              {"peak_memory_bytes", peak_memory_bytes()},
              {"stages", std::move(list)},
              {"warnings", std::move(warned)}};
  if (!failure_code_.empty()) out["error"] = {{"stage", failed_stage_}, {"code", failure_code_}, {"message", failure_}};
  return out;
}

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::string hex_text(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace intarsia
