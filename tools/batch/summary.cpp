#include "tools/batch/summary.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "engine/io/write_file.h"

namespace intarsia::tools {
namespace {

namespace fs = std::filesystem;

// Shards end at the same time: one of them writes the summary, the others wait.
class Turn {
 public:
  explicit Turn(const fs::path& file) : file_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
    if (file_ >= 0) flock(file_, LOCK_EX);
  }
  ~Turn() {
    if (file_ >= 0) close(file_);
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  int file_;
};

struct Row {
  const BatchItem* item;
  ItemRecord record;
};

const char* word_for(const ItemRecord& r) {
  return r.exit == 0 ? "done" : r.exit == 5 ? "degraded" : r.exit < 0 ? "missing" : "failed";
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"') out += '"';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out + "\"";
}

std::string csv(const std::vector<Row>& rows) {
  std::string out = "name,status,exit,triangles,patches,seconds,cpu_seconds,peak_memory_bytes,hash,input,message\n";
  for (const auto& [item, r] : rows)
    out += fmt::format("{},{},{},{},{},{:.3f},{:.3f},{},{},{},{}\n", quoted(item->name), word_for(r), r.exit,
                       r.triangles, r.patches, r.seconds, r.cpu_seconds, r.peak_memory, r.hash,
                       quoted(item->input.string()), quoted(r.message));
  return out;
}

nlohmann::json json(const std::vector<Row>& rows, const SummaryCount& count) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [item, r] : rows) {
    nlohmann::json mesh = record_json(r);
    mesh["name"] = item->name, mesh["input"] = item->input.string(), mesh["status"] = word_for(r);
    list.push_back(std::move(mesh));
  }
  return {{"schema", "intarsia-batch"},
          {"schema_version", 1},
          {"counts",
           {{"done", count.done}, {"degraded", count.degraded}, {"failed", count.failed}, {"missing", count.missing}}},
          {"meshes", list}};
}

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

// For the address of a file: everything but the plainest characters as %XX.
std::string address(const std::string& text) {
  std::string out;
  for (unsigned char c : text)
    if (std::isalnum(c) || c == '-' || c == '_' || c == '.')
      out += static_cast<char>(c);
    else
      out += fmt::format("%{:02X}", c);
  return out;
}

std::string html(const std::vector<Row>& rows, const SummaryCount& count) {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Intarsia batch</title>\n<style>"
      ":root{color-scheme:light dark}body{font:15px/1.4 "
      "system-ui,sans-serif;margin:2rem}table{border-collapse:collapse}"
      "td,th{padding:.35rem .8rem;border-bottom:1px solid #8884;text-align:left;vertical-align:middle}"
      ".n{text-align:right;font-variant-numeric:tabular-nums}img{height:90px;display:block;background:#fff}"
      ".failed td,.missing td{color:#c33}.degraded td{color:#b70}</style></head><body>\n";
  out += fmt::format(
      "<h1>{} meshes: {} done, {} with warnings, {} failed, {} not run</h1>\n<table><tr><th></th>"
      "<th>mesh</th><th>status</th><th class=n>triangles</th><th class=n>patches</th>"
      "<th class=n>seconds</th><th class=n>peak MB</th><th>message</th></tr>\n",
      rows.size(), count.done, count.degraded, count.failed, count.missing);
  for (const auto& [item, r] : rows) {
    const std::string folder = address(item->name);
    const std::string picture =
        r.has_layout()
            ? fmt::format("<a href=\"{0}/preview.png\"><img loading=lazy src=\"{0}/preview.png\" alt=\"\"></a>", folder)
            : "";
    out += fmt::format(
        "<tr class={}><td>{}</td><td title=\"{}\">{}</td><td>{}</td><td class=n>{}</td><td class=n>{}</td>"
        "<td class=n>{:.2f}</td><td class=n>{:.0f}</td><td>{}</td></tr>\n",
        word_for(r), picture, escaped(item->input.string()), escaped(item->name), word_for(r), r.triangles, r.patches,
        r.seconds, static_cast<double>(r.peak_memory) / 1e6, escaped(r.message));
  }
  return out + "</table></body></html>\n";
}

}  // namespace

SummaryCount write_summary(const fs::path& results, const std::vector<BatchItem>& items) {
  const Turn turn(results / ".batch" / "lock");
  std::vector<Row> rows;
  SummaryCount count;
  std::string failed;
  for (const BatchItem& item : items) {
    rows.push_back({&item, read_record(results, item.name)});
    const ItemRecord& r = rows.back().record;
    ++(r.exit == 0 ? count.done : r.exit == 5 ? count.degraded : r.exit < 0 ? count.missing : count.failed);
    if (!r.has_layout()) failed += item.input.string() + "\n";
  }
  write_file_atomically(results / "summary.csv", csv(rows));
  write_file_atomically(results / "summary.json",
                        json(rows, count).dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  write_file_atomically(results / "summary.html", html(rows, count));
  write_file_atomically(results / "failed.txt", failed);
  return count;
}

}  // namespace intarsia::tools
